//! Marching cubes by continuation: a closed, manifold, outward-oriented surface of an inside test.
use super::cube_cases::{EDGES, TRIANGLES};
use super::seeds::Cell;
use super::{At, crossing};
use crate::data::{Cancelled, Monitor, SurfaceMesh, fill_in_blocks, sort_keyed};
use crate::math::Vec3;
use rustc_hash::{FxHashMap, FxHashSet};
use std::marker::PhantomData;

/// Cubic cells in space: node (i, j, k) lies at `origin + spacing * (i, j, k)`, its cell is on the positive side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceGrid {
    pub origin: Vec3,
    pub spacing: f64,
}

/// Why a surface could not be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TraceError {
    #[error("the surface spans more than {} cells on an axis: ask for larger cells", LIMIT)]
    TooFine,
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Coordinates must stay within ±2¹⁹ so that three of them and an axis fit one 64-bit key.
const LIMIT: i32 = 1 << 19;

fn key([x, y, z]: Cell) -> u64 {
    let part = |c: i32| (c + LIMIT) as u64;
    part(x) | part(y) << 20 | part(z) << 40
}

fn cell_of(key: u64) -> Cell {
    [0, 20, 40].map(|shift| (key >> shift & 0xf_ffff) as i32 - LIMIT)
}

fn fits(cell: Cell) -> bool {
    cell.iter().all(|c| (-LIMIT + 2..LIMIT - 2).contains(c))
}

fn corner_of([x, y, z]: Cell, corner: usize) -> Cell {
    [x + (corner & 1) as i32, y + (corner >> 1 & 1) as i32, z + (corner >> 2 & 1) as i32]
}

/// Traces the surface of {inside} through all cells connected to a seed. Every vertex is found by bisection on an edge
/// of the grid; triangles are counter-clockwise seen from outside.
///
/// `inside` gets a position, what that is, and scratch space; it is called from many threads.
///
/// # Errors
/// If and only if the surface spans more than half a million cells, or the monitor cancels.
pub fn trace_surface<S: Default>(
    grid: &SurfaceGrid,
    seeds: &[Cell],
    inside: impl Fn(Vec3, At, &mut S) -> bool + Sync,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, TraceError> {
    let mut continuation =
        Continuation { grid, inside: &inside, nodes: FxHashMap::default(), scratch: PhantomData };
    let active = continuation.active_cells(seeds, monitor)?;
    let edges = crossed_edges(&active);
    let positions = continuation.vertices(&edges, monitor)?;
    let index: FxHashMap<u64, u32> = edges.iter().zip(0..).map(|(e, i)| (*e, i)).collect();
    let triangles = active.iter().flat_map(|&(cell, case)| {
        TRIANGLES[usize::from(case)].iter().map(move |t| t.map(|e| (cell, usize::from(e))))
    });
    let triangles = triangles.map(|t| t.map(|(cell, e)| index[&edge_key(cell, e)])).collect();
    Ok(SurfaceMesh::with_face_normals(positions, triangles))
}

/// Key of an edge of a cell: that of its lower node, and the axis in the top bits.
fn edge_key(cell: Cell, edge: usize) -> u64 {
    let (corner, axis) = EDGES[edge];
    key(corner_of(cell, corner)) | (axis as u64) << 60
}

fn crossed_edges(active: &[(Cell, u8)]) -> Vec<u64> {
    let mut edges: Vec<u64> = Vec::with_capacity(active.len() * 4);
    for &(cell, case) in active {
        let is_crossed = |edge: &usize| {
            let (corner, axis) = EDGES[*edge];
            (case >> corner & 1) != (case >> (corner | 1 << axis) & 1)
        };
        edges.extend((0..EDGES.len()).filter(is_crossed).map(|edge| edge_key(cell, edge)));
    }
    edges.sort_unstable();
    edges.dedup();
    edges
}

struct Continuation<'a, F, S> {
    grid: &'a SurfaceGrid,
    inside: &'a F,
    nodes: FxHashMap<u64, bool>,
    scratch: PhantomData<fn() -> S>,
}

impl<S: Default, F: Fn(Vec3, At, &mut S) -> bool + Sync> Continuation<'_, F, S> {
    fn position(&self, [x, y, z]: Cell) -> Vec3 {
        self.grid.origin + self.grid.spacing * Vec3::new(f64::from(x), f64::from(y), f64::from(z))
    }

    /// All cells that the level set passes through, with their cases, in the order of their keys.
    fn active_cells(&mut self, seeds: &[Cell], monitor: &dyn Monitor) -> Result<Vec<(Cell, u8)>, TraceError> {
        let mut visited: FxHashSet<u64> = FxHashSet::default();
        let mut active = Vec::new();
        let mut frontier: Vec<Cell> = seeds.to_vec();
        while !frontier.is_empty() {
            if !frontier.iter().all(|c| fits(*c)) {
                return Err(TraceError::TooFine);
            }
            frontier.retain(|&cell| visited.insert(key(cell)));
            self.sample_corners(&frontier, monitor)?;
            let mut next = Vec::new();
            for &cell in &frontier {
                let case = self.case(cell);
                if case != 0 && case != u8::MAX {
                    active.push((key(cell), u32::from(case)));
                    next.extend(neighbours_crossed(cell, case));
                }
            }
            frontier = next;
        }
        sort_keyed(&mut active);
        Ok(active.into_iter().map(|(key, case)| (cell_of(key), case as u8)).collect())
    }

    fn case(&self, cell: Cell) -> u8 {
        (0..8).fold(0, |case, c| case | u8::from(self.nodes[&key(corner_of(cell, c))]) << c)
    }

    fn sample_corners(&mut self, cells: &[Cell], monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let corners = cells.iter().flat_map(|&cell| (0..8).map(move |c| key(corner_of(cell, c))));
        let mut missing: Vec<u64> = corners.filter(|k| !self.nodes.contains_key(k)).collect();
        missing.sort_unstable();
        missing.dedup();
        let mut values = vec![false; missing.len()];
        let value =
            |i: usize, scratch: &mut S| (self.inside)(self.position(cell_of(missing[i])), At::Node, scratch);
        // How far a continuation has to go is not known: progress begins with the vertices.
        let undetermined = |_: f64, stage: &str| monitor.report(0.0, stage).is_ok();
        fill_in_blocks(&mut values, value, "surface cells", &undetermined)?;
        self.nodes.extend(missing.into_iter().zip(values));
        Ok(())
    }

    fn vertices(&self, edges: &[u64], monitor: &dyn Monitor) -> Result<Vec<Vec3>, Cancelled> {
        let mut positions = vec![Vec3::ZERO; edges.len()];
        let vertex = |i: usize, scratch: &mut S| {
            let (node, axis) = (cell_of(edges[i]), (edges[i] >> 60) as usize);
            let start = self.position(node);
            let at = |t: f64| start + t * self.grid.spacing * Vec3::AXES[axis];
            at(crossing(self.nodes[&key(node)], |t| (self.inside)(at(t), At::Edge, scratch)))
        };
        fill_in_blocks(&mut positions, vertex, "surface vertices", monitor)?;
        Ok(positions)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;
    use std::collections::HashMap;
    use std::f64::consts::PI;

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

    fn trace(spacing: f64, seeds: &[Vec3], inside: impl Fn(Vec3) -> bool + Sync) -> SurfaceMesh {
        let grid = SurfaceGrid { origin: Vec3::new(0.013, -0.02, 0.007), spacing };
        let cells: Vec<Cell> = seeds
            .iter()
            .map(|p| crate::levelset::cells_of_point(*p, grid.origin, Vec3::splat(spacing)))
            .collect();
        trace_surface(&grid, &cells, |p, _, ()| inside(p), &Silent).unwrap()
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
        let inside = |p: Vec3, _: At, (): &mut ()| {
            let n = p.round();
            let in_box = n.cmpgt(Vec3::ZERO).all() && n.cmplt(Vec3::splat(14.0)).all();
            let h = (n.x * 7919.0 + n.y * 104_729.0 + n.z * 1_299_709.0).sin() * 43_758.545;
            in_box && h - h.floor() < 0.5
        };
        let seeds: Vec<Cell> = (0..15 * 15 * 15).map(|i| [i % 15, i / 15 % 15, i / 225]).collect();
        let mesh = trace_surface(&grid, &seeds, inside, &Silent).unwrap();
        assert!(mesh.triangles.len() > 5_000);
        euler_number(&mesh);
    }

    #[test]
    fn surfaces_too_large_for_the_keys_are_refused() {
        let grid = SurfaceGrid { origin: Vec3::ZERO, spacing: 1.0 };
        let cell = [LIMIT, 0, 0];
        assert_eq!(trace_surface(&grid, &[cell], |_, _, ()| true, &Silent), Err(TraceError::TooFine));
    }
}
