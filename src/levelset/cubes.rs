//! Marching cubes by continuation: a closed, manifold, outward-oriented surface of a level set.
use super::bricks::{Around, Bricks, LIMIT, corner_of};
use super::cube_cases::{EDGES, TRIANGLES};
use super::seeds::Cell;
use super::{Blur, CLEARANCE};
use crate::data::{Cancelled, Lattice, Monitor, OutOfMemory, SurfaceMesh, ones};
use crate::math::{Aabb, Vec3};

/// Cubic cells in space: node (i, j, k) lies at `origin + spacing * (i, j, k)`, its cell is on the positive side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceGrid {
    pub origin: Vec3,
    pub spacing: f64,
}

impl SurfaceGrid {
    /// Nodes in the middles of the cells that cover bounds which are not empty, as those of [`Lattice::with_spacing`].
    pub fn over(bounds: Aabb, spacing: f64) -> SurfaceGrid {
        SurfaceGrid { origin: Lattice::cells_over(bounds, spacing).0, spacing }
    }

    pub(super) fn position(&self, [x, y, z]: Cell) -> Vec3 {
        self.origin + self.spacing * Vec3::new(f64::from(x), f64::from(y), f64::from(z))
    }
}

/// Why a surface could not be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TraceError {
    #[error("the surface spans more than {} cells on an axis: ask for larger cells", LIMIT)]
    TooFine,
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

/// An edge of the grid with one end inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub start: Vec3,
    /// From the start to the end.
    pub along: Vec3,
    /// What [`LevelSet::values`] said of the start and the end.
    pub ends: [f32; 2],
}

impl Edge {
    pub fn at(&self, t: f64) -> Vec3 {
        self.start + t * self.along
    }

    /// Where the line through the values at both ends vanishes, from 0 to 1.
    pub fn interpolated(&self) -> f64 {
        let [start, end] = self.ends.map(f64::from);
        if start == end { 0.5 } else { (start / (start - end)).clamp(0.0, 1.0) }
    }
}

/// What is traced: where a function of space changes its sign.
pub trait LevelSet {
    /// Whether the function is best asked for at 64 nodes that lie close together, also where not all of them are needed.
    fn takes_bricks(&self) -> bool;

    /// How its values are to be smoothed before they are looked at, if they are; such a function takes bricks.
    fn blur(&self) -> Option<Blur> {
        None
    }

    /// The function at some points: positive or zero inside, negative outside. NaN where the level set is not to be traced:
    /// it is then open there.
    ///
    /// # Errors
    /// If and only if the monitor cancels, or memory does not suffice.
    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError>;

    /// Where each edge is crossed, from 0 at its start to 1 at its end.
    ///
    /// # Errors
    /// If and only if the monitor cancels, or memory does not suffice.
    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError>;
}

/// Edges that are asked for together.
const EDGES_AT_ONCE: usize = 1 << 18;

/// Traces a level set through all cells connected to a seed. Every vertex lies on an edge of the grid; triangles are
/// counter-clockwise seen from outside. The surface is manifold, and closed unless the function has no value somewhere.
///
/// # Errors
/// If and only if the surface spans more than half a million cells, the monitor cancels, or memory does not suffice.
pub fn trace_surface(
    grid: &SurfaceGrid,
    seeds: &[Cell],
    level_set: &dyn LevelSet,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, TraceError> {
    let bricks = Bricks::trace(grid, seeds, level_set, monitor)?;
    let vertices = Vertices::number(bricks);
    let positions = vertices.positions(grid, level_set, monitor)?;
    Ok(SurfaceMesh::with_face_normals(positions, vertices.triangles()))
}

/// The edges that the level set crosses, and numbers for them.
struct Vertices {
    bricks: Bricks,
    /// Bricks, in the order of the vertices and the triangles.
    order: Vec<u32>,
    /// Of each brick: the edges that begin at its nodes and are crossed, by axis, and the number of the first of them.
    crossed: Vec<([u64; 3], u32)>,
    count: usize,
}

impl Vertices {
    fn number(bricks: Bricks) -> Vertices {
        let mut order: Vec<u32> = (0..bricks.bricks.len() as u32).collect();
        bricks.sort(&mut order);
        let mut crossed = vec![([0; 3], 0); bricks.bricks.len()];
        for (place, brick) in bricks.bricks.iter().enumerate().filter(|(_, brick)| brick.active != 0) {
            let around = bricks.around(place as u32);
            for cell in ones(brick.active) {
                let case = bricks.case(&around, cell).unwrap_or(0);
                for edge in (0..EDGES.len()).filter(|edge| is_crossed(case, *edge)) {
                    let (owner, node) = lower_end(&around, cell, edge);
                    crossed[owner].0[EDGES[edge].1] |= 1 << node;
                }
            }
        }
        let mut count = 0;
        for &place in &order {
            let (masks, first): &mut ([u64; 3], u32) = &mut crossed[place as usize];
            *first = count as u32;
            count += masks.iter().map(|mask| mask.count_ones() as usize).sum::<usize>();
        }
        Vertices { bricks, order, crossed, count }
    }

    fn positions(
        &self,
        grid: &SurfaceGrid,
        level_set: &dyn LevelSet,
        monitor: &dyn Monitor,
    ) -> Result<Vec<Vec3>, TraceError> {
        let mut positions = Vec::with_capacity(self.count);
        let mut edges = Vec::new();
        for (number, &place) in self.order.iter().enumerate() {
            for axis in 0..3 {
                let nodes = ones(self.crossed[place as usize].0[axis]);
                edges.extend(nodes.map(|node| self.bricks.edge(grid, place, node, axis)));
            }
            if edges.len() >= EDGES_AT_ONCE || number + 1 == self.order.len() {
                let (done, total) = (positions.len() as f64, self.count.max(1) as f64);
                let share = edges.len() as f64;
                let of_all =
                    |part: f64, stage: &str| monitor.report((done + share * part) / total, stage).is_ok();
                let crossings = level_set.crossings(&edges, &of_all)?;
                // Where rounding leaves no number, as of shapes of no size, the crossing is at the start.
                let number = |t: f64| if t.is_nan() { 0.0 } else { t };
                let place = |t: f64| number(t).clamp(CLEARANCE, 1.0 - CLEARANCE);
                positions.extend(edges.drain(..).zip(crossings).map(|(edge, t)| edge.at(place(t))));
            }
        }
        Ok(positions)
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        let mut triangles = Vec::with_capacity(2 * self.count);
        for &place in &self.order {
            let active = self.bricks.bricks[place as usize].active;
            let around = if active == 0 { continue } else { self.bricks.around(place) };
            for cell in ones(active) {
                let case = self.bricks.case(&around, cell).unwrap_or(0);
                let number = |edge: u8| self.number_of(&around, cell, usize::from(edge));
                triangles.extend(TRIANGLES[usize::from(case)].iter().map(|t| t.map(number)));
            }
        }
        triangles
    }

    fn number_of(&self, around: &Around, cell: usize, edge: usize) -> u32 {
        let (owner, node) = lower_end(around, cell, edge);
        let (masks, first) = &self.crossed[owner];
        let axis = EDGES[edge].1;
        let before = masks[axis] & ((1 << node) - 1);
        masks[..axis].iter().fold(first + before.count_ones(), |number, mask| number + mask.count_ones())
    }
}

/// The lower end of an edge of a cell: its brick and its bit there.
fn lower_end(around: &Around, cell: usize, edge: usize) -> (usize, usize) {
    let (brick, node) = corner_of(cell, EDGES[edge].0);
    (around[brick] as usize, node)
}

fn is_crossed(case: u8, edge: usize) -> bool {
    let (corner, axis) = EDGES[edge];
    (case >> corner & 1) != (case >> (corner | 1 << axis) & 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;
    use crate::levelset::crossing;
    use std::collections::HashMap;
    use std::f64::consts::PI;

    /// A level set of which is known only what is inside.
    struct InsideTest<F>(F);

    impl<F: Fn(Vec3) -> bool> LevelSet for InsideTest<F> {
        fn takes_bricks(&self) -> bool {
            false
        }

        fn values(&self, points: &[Vec3], _: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
            Ok(points.iter().map(|p| if (self.0)(*p) { 1.0 } else { -1.0 }).collect())
        }

        fn crossings(&self, edges: &[Edge], _: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
            let cross = |edge: &Edge| crossing(edge.ends[0] > 0.0, |t| (self.0)(edge.at(t)));
            Ok(edges.iter().map(cross).collect())
        }
    }

    /// V − E + F, after checking that every edge has two opposite triangles.
    fn euler_number(mesh: &SurfaceMesh) -> i64 {
        let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
        for t in &mesh.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                assert!(edges.insert((a, b), 1).is_none(), "an edge is used twice in one direction");
            }
        }
        assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))), "an edge has one triangle only");
        mesh.positions.len() as i64 - edges.len() as i64 / 2 + mesh.triangles.len() as i64
    }

    fn trace(spacing: f64, seeds: &[Vec3], inside: impl Fn(Vec3) -> bool) -> SurfaceMesh {
        let grid = SurfaceGrid { origin: Vec3::new(0.013, -0.02, 0.007), spacing };
        let cells: Vec<Cell> = seeds
            .iter()
            .map(|p| crate::levelset::cells_of_point(*p, grid.origin, Vec3::splat(spacing)))
            .collect();
        trace_surface(&grid, &cells, &InsideTest(inside), &Silent).unwrap()
    }

    #[test]
    fn sphere_is_closed_and_has_its_volume() {
        let mesh = trace(0.05, &[Vec3::X], |p| p.length() < 1.0);
        assert_eq!(euler_number(&mesh), 2);
        assert!((mesh.volume() / (4.0 / 3.0 * PI) - 1.0).abs() < 2e-3, "{}", mesh.volume());
        assert!(mesh.positions.iter().all(|p| (p.length() - 1.0).abs() < 1e-6));
        assert!(mesh.positions.iter().zip(&mesh.normals).all(|(p, n)| p.dot(*n) > 0.98));
    }

    #[test]
    fn torus_has_a_handle() {
        let torus = |p: Vec3| Vec3::new(p.truncate().length() - 1.0, 0.0, p.z).length() < 0.35;
        let mesh = trace(0.06, &[Vec3::new(1.35, 0.0, 0.0)], torus);
        assert_eq!(euler_number(&mesh), 0);
        assert!((mesh.volume() / (2.0 * PI * PI * 0.35 * 0.35) - 1.0).abs() < 1e-2, "{}", mesh.volume());
    }

    #[test]
    fn random_cells_still_make_a_manifold() {
        // All 256 cases, next to each other in all ways: a hash of the node decides.
        let grid = SurfaceGrid { origin: Vec3::ZERO, spacing: 1.0 };
        let inside = |p: Vec3| {
            let n = p.round();
            let in_box = n.cmpgt(Vec3::ZERO).all() && n.cmplt(Vec3::splat(14.0)).all();
            let h = (n.x * 7919.0 + n.y * 104_729.0 + n.z * 1_299_709.0).sin() * 43_758.545;
            in_box && h - h.floor() < 0.5
        };
        let seeds: Vec<Cell> = (0..15 * 15 * 15).map(|i| [i % 15, i / 15 % 15, i / 225]).collect();
        let mesh = trace_surface(&grid, &seeds, &InsideTest(inside), &Silent).unwrap();
        assert!(mesh.triangles.len() > 5_000);
        euler_number(&mesh);
    }

    #[test]
    fn surfaces_too_large_for_the_keys_are_refused() {
        let grid = SurfaceGrid { origin: Vec3::ZERO, spacing: 1.0 };
        let cell = [LIMIT, 0, 0];
        let all = InsideTest(|_| true);
        assert_eq!(trace_surface(&grid, &[cell], &all, &Silent), Err(TraceError::TooFine));
    }
}
