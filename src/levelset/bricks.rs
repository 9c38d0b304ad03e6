//! The cells that a level set passes through, found by continuation. Nodes are kept in bricks of 4 × 4 × 4, which lie only where
//! it passes: memory grows with the surface, not with the space around it.
use super::seeds::Cell;
use super::{Edge, LevelSet, SurfaceGrid, TraceError};
use crate::bvh::morton_code;
use crate::data::{Monitor, ones, sort_keyed};
use crate::math::{Aabb, Vec3};
use rustc_hash::FxHashMap;

/// Nodes of a brick: a bit for each in its masks, x fastest.
pub(super) const NODES: usize = 64;
/// Coordinates of nodes stay within ±2¹⁹, so that three of them fit one key.
pub(super) const LIMIT: i32 = 1 << 19;
/// The cells of a brick that reach into the next one along each axis.
const LAST: [u64; 3] = [0x8888_8888_8888_8888, 0xf000_f000_f000_f000, 0xffff_0000_0000_0000];

/// 4 × 4 × 4 nodes, and the cells at their positive sides.
#[derive(Clone, Copy, Default)]
pub(super) struct Brick {
    /// Its lowest node.
    pub first: Cell,
    /// Nodes that were asked for, those still to be asked for, those inside, and those without a value.
    pub known: u64,
    pub wanted: u64,
    pub inside: u64,
    pub void: u64,
    /// Cells still to be looked at, those that were, and those that the level set passes through.
    pending: u64,
    visited: u64,
    pub active: u64,
    /// Whether it has values that are not smoothed.
    pub is_sampled: bool,
}

#[derive(Default)]
pub(super) struct Bricks {
    places: FxHashMap<u64, u32>,
    pub bricks: Vec<Brick>,
    /// Of the nodes, brick by brick; and before they are smoothed, if they are.
    pub values: Vec<f32>,
    pub sharp: Vec<f32>,
    /// Bricks with nodes to be asked for.
    pub requests: Vec<u32>,
}

/// The bricks that the corners of a brick's cells lie in: itself, and those after it along the axes whose bits are set.
pub(super) type Around = [u32; 8];
const NOWHERE: u32 = u32::MAX;

/// Where a corner of a cell lies: which of the bricks around, and the bit of the node there.
pub(super) fn corner_of(cell: usize, corner: usize) -> (usize, usize) {
    let (mut brick, mut node) = (0, 0);
    for axis in 0..3 {
        let at = (cell >> (2 * axis) & 3) + (corner >> axis & 1);
        brick |= (at >> 2) << axis;
        node |= (at & 3) << (2 * axis);
    }
    (brick, node)
}

pub(super) fn node_of(first: Cell, bit: usize) -> Cell {
    [0, 1, 2].map(|axis| first[axis] + (bit >> (2 * axis) & 3) as i32)
}

impl Bricks {
    /// Visits the seeds and, from each cell that the level set passes through, the neighbours that it goes on in. Of a set that is
    /// smooth, and may pass by what made it, also the cells around seeds that it passes nowhere near.
    pub fn trace(
        grid: &SurfaceGrid,
        seeds: &[Cell],
        level_set: &dyn LevelSet,
        monitor: &dyn Monitor,
    ) -> Result<Bricks, TraceError> {
        let mut bricks = Bricks::default();
        let mut open = Vec::new();
        for seed in seeds {
            bricks.visit_later(*seed, &mut open)?;
        }
        bricks.go_on(open, grid, level_set, monitor)?;
        if level_set.takes_bricks() {
            let is_alone = |seed: &&Cell| !(0..27).any(|k| bricks.is_active(neighbour(**seed, k)));
            let alone: Vec<Cell> = seeds.iter().filter(is_alone).copied().collect();
            let mut open = Vec::new();
            for (seed, k) in alone.into_iter().flat_map(|seed| (0..27).map(move |k| (seed, k))) {
                bricks.visit_later(neighbour(seed, k), &mut open)?;
            }
            bricks.go_on(open, grid, level_set, monitor)?;
        }
        Ok(bricks)
    }

    fn go_on(
        &mut self,
        mut open: Vec<u32>,
        grid: &SurfaceGrid,
        level_set: &dyn LevelSet,
        monitor: &dyn Monitor,
    ) -> Result<(), TraceError> {
        // How far a continuation has to go is not known: progress begins with the vertices.
        let undetermined = |_: f64, _: &str| monitor.report(0.0, "surface cells").is_ok();
        while !open.is_empty() {
            let mut waiting = Vec::new();
            while let Some(brick) = open.pop() {
                let around = self.make_around(brick, self.bricks[brick as usize].pending)?;
                if self.request(&around, level_set.takes_bricks()) {
                    waiting.push(brick);
                } else {
                    self.visit(&around, &mut open)?;
                }
            }
            self.sample(grid, level_set, &undetermined)?;
            open = waiting;
        }
        Ok(())
    }

    fn is_active(&self, cell: Cell) -> bool {
        self.places
            .get(&key(cell))
            .is_some_and(|place| self.bricks[*place as usize].active >> bit_of(cell) & 1 == 1)
    }

    /// The brick of a node and the node's bit there.
    pub fn place(&mut self, node: Cell) -> Result<(u32, usize), TraceError> {
        if !node.iter().all(|c| (-LIMIT + 8..LIMIT - 8).contains(c)) {
            return Err(TraceError::TooFine);
        }
        let new = self.bricks.len() as u32;
        let brick = *self.places.entry(key(node)).or_insert(new);
        if brick == new {
            let first = node.map(|c| c & !3);
            self.bricks.push(Brick { first, ..Brick::default() });
            self.values.extend([f32::NAN; NODES]);
        }
        Ok((brick, bit_of(node)))
    }

    /// Marks a cell to be visited; its brick is added to `open` unless it is there already.
    fn visit_later(&mut self, cell: Cell, open: &mut Vec<u32>) -> Result<(), TraceError> {
        let (place, bit) = self.place(cell)?;
        let brick = &mut self.bricks[place as usize];
        let is_closed = brick.pending == 0;
        brick.pending |= (1 << bit) & !brick.visited;
        if is_closed && brick.pending != 0 {
            open.push(place);
        }
        Ok(())
    }

    /// The bricks that corners of some cells lie in, made where there are none.
    fn make_around(&mut self, brick: u32, cells: u64) -> Result<Around, TraceError> {
        let first = self.bricks[brick as usize].first;
        let mut around = [NOWHERE; 8];
        for (k, place) in around.iter_mut().enumerate() {
            let reaching = (0..3).filter(|axis| k >> axis & 1 == 1).fold(cells, |c, axis| c & LAST[axis]);
            if reaching != 0 {
                *place = self.place(after(first, k))?.0;
            }
        }
        Ok(around)
    }

    /// The bricks around one, as far as there are any.
    pub fn around(&self, brick: u32) -> Around {
        let first = self.bricks[brick as usize].first;
        std::array::from_fn(|k| self.places.get(&key(after(first, k))).copied().unwrap_or(NOWHERE))
    }

    /// Requests what is not known of the corners of a brick's pending cells; answers whether there was anything.
    fn request(&mut self, around: &Around, whole: bool) -> bool {
        let mut wanted = [0; 8];
        if whole {
            wanted = around.map(|place| if place == NOWHERE { 0 } else { u64::MAX });
        } else {
            for cell in ones(self.bricks[around[0] as usize].pending) {
                (0..8).map(|c| corner_of(cell, c)).for_each(|(brick, node)| wanted[brick] |= 1 << node);
            }
        }
        let mut waits = false;
        for (wanted, place) in wanted.into_iter().zip(around).filter(|(wanted, _)| *wanted != 0) {
            let brick = &mut self.bricks[*place as usize];
            let missing = wanted & !brick.known;
            if missing != 0 && brick.wanted == 0 {
                self.requests.push(*place);
            }
            brick.wanted |= missing;
            waits |= missing != 0;
        }
        waits
    }

    /// Which corners of a cell are inside, a bit for each; nothing where one of them has no value.
    pub fn case(&self, around: &Around, cell: usize) -> Option<u8> {
        (0..8).try_fold(0, |case, c| {
            let (brick, node) = corner_of(cell, c);
            let brick = &self.bricks[around[brick] as usize];
            (brick.void >> node & 1 == 0).then(|| case | ((brick.inside >> node & 1) as u8) << c)
        })
    }

    /// Looks at the pending cells of a brick, the nodes of which are known.
    fn visit(&mut self, around: &Around, open: &mut Vec<u32>) -> Result<(), TraceError> {
        let place = around[0] as usize;
        let brick = &mut self.bricks[place];
        let (cells, first) = (brick.pending, brick.first);
        (brick.pending, brick.visited) = (0, brick.visited | cells);
        for cell in ones(cells) {
            let Some(case) = self.case(around, cell).filter(|case| ![0, u8::MAX].contains(case)) else {
                continue;
            };
            self.bricks[place].active |= 1 << cell;
            for neighbour in neighbours_crossed(node_of(first, cell), case) {
                self.visit_later(neighbour, open)?;
            }
        }
        Ok(())
    }

    /// Puts bricks in the order of the Morton curve, so that neighbours are mostly near each other.
    pub fn sort(&self, places: &mut [u32]) {
        let all = Aabb { min: Vec3::splat(f64::from(-LIMIT)), max: Vec3::splat(f64::from(LIMIT)) };
        let code = |place: u32| {
            morton_code(Vec3::from_array(self.bricks[place as usize].first.map(f64::from)), &all)
        };
        let mut keyed: Vec<(u64, u32)> = places.iter().map(|place| (code(*place), *place)).collect();
        sort_keyed(&mut keyed);
        places.iter_mut().zip(keyed).for_each(|(place, (_, sorted))| *place = sorted);
    }

    /// The edge of the grid from a node of a brick to the next one along an axis, both of them known.
    pub fn edge(&self, grid: &SurfaceGrid, place: u32, node: usize, axis: usize) -> Edge {
        let step = 1 << (2 * axis);
        let first = self.bricks[place as usize].first;
        let next = match LAST[axis] >> node & 1 {
            0 => place as usize * NODES + node + step,
            _ => self.places[&key(after(first, 1 << axis))] as usize * NODES + node - 3 * step,
        };
        let ends = [self.values[place as usize * NODES + node], self.values[next]];
        Edge { start: grid.position(node_of(first, node)), along: grid.spacing * Vec3::AXES[axis], ends }
    }
}

/// A number for the brick of a node.
fn key(node: Cell) -> u64 {
    (0..3).fold(0, |key, axis| key | (((node[axis] + LIMIT) >> 2) as u64) << (20 * axis))
}

/// The bit of a node in its brick.
fn bit_of(node: Cell) -> usize {
    (0..3).fold(0, |bit, axis| bit | ((node[axis] & 3) as usize) << (2 * axis))
}

/// The cells around one, for numbers below 27, beginning with itself.
fn neighbour(cell: Cell, number: i32) -> Cell {
    let part = |power: i32| (number / power + 1) % 3 - 1;
    [cell[0] + part(1), cell[1] + part(3), cell[2] + part(9)]
}

/// The first node of the brick after one along the axes whose bits are set.
fn after(first: Cell, axes: usize) -> Cell {
    [0, 1, 2].map(|axis| first[axis] + 4 * (axes >> axis & 1) as i32)
}

/// The neighbours across the faces that the level set crosses.
fn neighbours_crossed(cell: Cell, case: u8) -> impl Iterator<Item = Cell> {
    (0..6).filter_map(move |face| {
        let (axis, side) = (face / 2, face % 2);
        let on_face = (0..8).filter(|c| c >> axis & 1 == side);
        let inside = on_face.filter(|c| case >> c & 1 == 1).count();
        (inside != 0 && inside != 4).then(|| {
            let mut neighbour = cell;
            neighbour[axis] += 2 * side as i32 - 1;
            neighbour
        })
    })
}
