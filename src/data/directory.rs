//! Where the bricks of a lattice are kept: memory grows with those that are not all inside or all outside.
use super::{BRICK_SIDE, Lattice, OutOfMemory, zeroed};

/// Bricks along each side of a node.
const SIDE: usize = 8;
const BRICKS_OF_NODE: usize = SIDE * SIDE * SIDE;

/// Slots of a [`Directory`] that are no numbers of bricks.
pub(crate) const OUTSIDE: u32 = u32::MAX;
pub(crate) const INSIDE: u32 = u32::MAX - 1;
const STATES: std::ops::RangeInclusive<u32> = INSIDE..=OUTSIDE;

/// A slot for each brick of a lattice: a state, or the number of a brick that is kept elsewhere. Nodes of 8 × 8 × 8 bricks that
/// are all in one state have one slot together.
#[derive(Clone, Debug)]
pub(crate) struct Directory {
    /// Bricks, and nodes, along each axis.
    bricks: [usize; 3],
    nodes_along: [usize; 3],
    /// Of the nodes, x fastest: a state, or where in `nodes` it is.
    tops: Vec<u32>,
    nodes: Vec<[u32; BRICKS_OF_NODE]>,
}

impl Directory {
    /// A directory of a lattice, outside everywhere.
    ///
    /// # Errors
    /// If and only if it does not fit in memory, or the lattice has more than [`Lattice::MAX_SAMPLES`].
    pub fn new(lattice: &Lattice) -> Result<Directory, OutOfMemory> {
        if lattice.len() > Lattice::MAX_SAMPLES {
            return Err(OutOfMemory { bytes: lattice.len() });
        }
        let bricks = lattice.counts.map(|n| n.div_ceil(BRICK_SIDE));
        let nodes_along = bricks.map(|n| n.div_ceil(SIDE));
        let mut tops = zeroed(nodes_along.iter().product())?;
        tops.fill(OUTSIDE);
        Ok(Directory { bricks, nodes_along, tops, nodes: Vec::new() })
    }

    /// Bricks along each axis.
    pub fn bricks(&self) -> [usize; 3] {
        self.bricks
    }

    fn top(&self, brick: [usize; 3]) -> usize {
        let [i, j, k] = brick.map(|b| b / SIDE);
        (k * self.nodes_along[1] + j) * self.nodes_along[0] + i
    }

    pub fn get(&self, brick: [usize; 3]) -> u32 {
        match self.tops[self.top(brick)] {
            state if STATES.contains(&state) => state,
            node => self.nodes[node as usize][place_in_node(brick)],
        }
    }

    pub fn set(&mut self, brick: [usize; 3], slot: u32) {
        let top = self.top(brick);
        let mut node = self.tops[top];
        if STATES.contains(&node) {
            if node == slot {
                return;
            }
            self.nodes.push([node; BRICKS_OF_NODE]);
            node = self.nodes.len() as u32 - 1;
            self.tops[top] = node;
        }
        self.nodes[node as usize][place_in_node(brick)] = slot;
    }

    /// Gives nodes that are all in one state one slot.
    pub fn collapse(&mut self) {
        let mut kept = Vec::new();
        for top in 0..self.tops.len() {
            let node = self.tops[top];
            if STATES.contains(&node) {
                continue;
            }
            let slots = self.nodes[node as usize];
            let [nx, ny, _] = self.nodes_along;
            let first = [top % nx, top / nx % ny, top / (nx * ny)].map(|n| n * SIDE);
            // A node may reach beyond the lattice.
            let is_in = |place: usize| {
                let at = [place % SIDE, place / SIDE % SIDE, place / (SIDE * SIDE)];
                (0..3).all(|axis| first[axis] + at[axis] < self.bricks[axis])
            };
            let is_one = (0..BRICKS_OF_NODE).all(|p| slots[p] == slots[0] || !is_in(p));
            self.tops[top] = if is_one && STATES.contains(&slots[0]) {
                slots[0]
            } else {
                kept.push(slots);
                kept.len() as u32 - 1
            };
        }
        kept.shrink_to_fit();
        self.nodes = kept;
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.tops[..]) + size_of_val(&self.nodes[..])
    }
}

fn place_in_node(brick: [usize; 3]) -> usize {
    let [i, j, k] = brick.map(|b| b % SIDE);
    (k * SIDE + j) * SIDE + i
}
