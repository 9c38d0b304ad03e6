use crate::data::{Shape, sort_keyed};
use crate::math::{Aabb, Vec3};

/// Integer coordinates of a cell: it spans `origin + spacing * cell` to `origin + spacing * (cell + 1)`.
pub type Cell = [i32; 3];

/// Cells have coordinates up to this; what lies beyond is in the last.
const FARTHEST: f64 = (1 << 30) as f64;
/// Rows of points on a triangle, at most.
const MOST_ROWS: f64 = u32::MAX as f64;

/// The cell that holds `p`.
pub fn cells_of_point(p: Vec3, origin: Vec3, spacing: Vec3) -> Cell {
    ((p - origin) / spacing).floor().to_array().map(|c| c.clamp(-FARTHEST, FARTHEST) as i32)
}

/// Points strewn over a triangle, at most half a cell apart: in rows along its shortest side, as long needles have few in each.
struct Strewn {
    apex: Vec3,
    /// From the apex to the ends of the shortest side.
    sides: [Vec3; 2],
    rows: usize,
    step: f64,
}

impl Strewn {
    fn over(corners: [Vec3; 3], step: f64) -> Strewn {
        let length = |k: usize| corners[(k + 1) % 3].distance(corners[(k + 2) % 3]);
        let first = (1..3).fold(0, |best, k| if length(k) < length(best) { k } else { best });
        let [apex, b, c] = [0, 1, 2].map(|k| corners[(first + k) % 3]);
        let sides = [b - apex, c - apex];
        let longest = sides[0].length().max(sides[1].length());
        Strewn { apex, sides, rows: (longest / step).ceil().clamp(1.0, MOST_ROWS) as usize, step }
    }

    /// The ends of a row.
    fn ends(&self, row: usize) -> [Vec3; 2] {
        let share = row as f64 / self.rows as f64;
        self.sides.map(|side| self.apex + share * side)
    }

    /// Calls `found` with the points of some rows, but for those that are clearly outside of `limits`.
    fn points(&self, rows: [usize; 2], limits: &Aabb, found: &mut dyn FnMut(Vec3)) {
        let [first, last] = rows.map(|row| self.ends(row));
        let bounds = Aabb::around([first, last].concat());
        if !bounds.overlaps(limits) {
            return;
        }
        if rows[0] < rows[1] {
            let middle = rows[0] + (rows[1] - rows[0]) / 2;
            self.points([rows[0], middle], limits, found);
            self.points([middle + 1, rows[1]], limits, found);
            return;
        }
        let [start, end] = first;
        let along = end - start;
        let count = (along.length() / self.step).ceil().clamp(1.0, MOST_ROWS);
        let [from, to] = within(start, along, limits);
        let (from, to) = ((from * count).floor().max(0.0) as usize, (to * count).ceil().min(count) as usize);
        (from..=to).for_each(|k| found(start + k as f64 / count * along));
    }
}

/// Between which shares of its way a segment may be inside of a box.
fn within(start: Vec3, along: Vec3, limits: &Aabb) -> [f64; 2] {
    let (mut from, mut to) = (0.0f64, 1.0f64);
    for axis in 0..3 {
        let [low, high] = [limits.min, limits.max].map(|limit| (limit[axis] - start[axis]) / along[axis]);
        // What is no number, as along an axis on which the segment stays, narrows nothing.
        (from, to) = (from.max(low.min(high)), to.min(low.max(high)));
    }
    [from, to]
}

/// Calls `found` with the cells of points strewn over the part of a triangle inside of `limits`, and around that, at most half a cell
/// apart. Cells that it only grazes may be missed; their neighbours are not.
pub fn cells_of_triangle(
    corners: [Vec3; 3],
    origin: Vec3,
    spacing: Vec3,
    limits: &Aabb,
    mut found: impl FnMut(Cell),
) {
    let strewn = Strewn::over(corners, 0.5 * spacing.min_element());
    strewn.points([0, strewn.rows], limits, &mut |p| found(cells_of_point(p, origin, spacing)));
}

/// About how many points are strewn over a soup in search of its cells.
pub fn places_of_shape(shape: &Shape, spacing: f64) -> f64 {
    let points = |corners: [Vec3; 3]| {
        let strewn = Strewn::over(corners, 0.5 * spacing);
        let widest = strewn.sides[0].distance(strewn.sides[1]) / strewn.step;
        strewn.rows as f64 * (1.0 + 0.5 * widest)
    };
    match shape {
        Shape::Soup(soup) => (0..soup.len()).map(|t| points(soup.corners(t))).sum(),
        Shape::Cloud(cloud) => cloud.len() as f64,
    }
}

/// The cells that hold points, sorted, each once.
pub fn cells_of_points(points: &[Vec3], origin: Vec3, spacing: Vec3) -> Vec<Cell> {
    sorted(points.iter().map(|p| cells_of_point(*p, origin, spacing)).collect())
}

/// The cells that hold some of a shape, sorted, each once: those of its triangles, or those of its points and the 26
/// around each.
pub fn cells_of_shape(shape: &Shape, origin: Vec3, spacing: Vec3) -> Vec<Cell> {
    let mut cells = Vec::new();
    let everywhere = Aabb { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };
    for_each_cell_of_shape(shape, origin, spacing, &everywhere, &mut |cell| {
        if cells.last() != Some(&cell) {
            cells.push(cell);
        }
    });
    sorted(cells)
}

/// Calls `found` with the cells of [`cells_of_shape`] that lie inside of `limits`, and perhaps others, as they come, many more than
/// once.
pub fn for_each_cell_of_shape(
    shape: &Shape,
    origin: Vec3,
    spacing: Vec3,
    limits: &Aabb,
    found: &mut dyn FnMut(Cell),
) {
    match shape {
        Shape::Soup(soup) => (0..soup.len())
            .for_each(|t| cells_of_triangle(soup.corners(t), origin, spacing, limits, &mut *found)),
        Shape::Cloud(cloud) => {
            for &p in cloud.points() {
                let [x, y, z] = cells_of_point(p, origin, spacing);
                let around = |k: i32, axis: i32| k / 3i32.pow(axis as u32) % 3 - 1;
                (0..27).for_each(|k| found([x + around(k, 0), y + around(k, 1), z + around(k, 2)]));
            }
        }
    }
}

/// Cells in a fixed order, each once.
fn sorted(cells: Vec<Cell>) -> Vec<Cell> {
    // Flipping the sign bit makes the order of unsigned numbers that of signed ones.
    let unsigned = |c: i32| c as u32 ^ 1 << 31;
    let signed = |c: u32| (c ^ 1 << 31) as i32;
    let pack = |[x, y, z]: Cell| (u64::from(unsigned(x)) << 32 | u64::from(unsigned(y)), unsigned(z));
    let mut packed: Vec<(u64, u32)> = cells.into_iter().map(pack).collect();
    sort_keyed(&mut packed);
    packed.dedup();
    packed.into_iter().map(|(xy, z)| [(xy >> 32) as u32, xy as u32, z].map(signed)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::{OrientedCloud, TriangleSoup};

    #[test]
    fn cells_of_a_flat_square_form_one_sheet() {
        let corners = vec![Vec3::ZERO, 4.0 * Vec3::X, 4.0 * (Vec3::X + Vec3::Y), 4.0 * Vec3::Y];
        let soup = TriangleSoup::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let cells = cells_of_shape(&soup.into(), Vec3::splat(-0.5), Vec3::ONE);
        assert_eq!(cells.len(), 25);
        assert!(cells.iter().all(|c| c[2] == 0));
    }

    #[test]
    fn limits_leave_the_cells_inside_of_them() {
        let corners = vec![Vec3::new(-3.0, 0.2, 1.0), Vec3::new(70.0, 3.0, 2.0), Vec3::new(4.0, 90.0, -30.0)];
        let shape = TriangleSoup::new(corners, vec![[0, 1, 2]]).unwrap().into();
        let limits = Aabb { min: Vec3::new(5.0, 5.0, -20.0), max: Vec3::splat(20.0) };
        let is_inside =
            |cell: &Cell| cell[0] >= 5 && cell[1] >= 5 && cell[2] >= -20 && cell.iter().all(|c| *c < 20);
        let expected: Vec<Cell> =
            cells_of_shape(&shape, Vec3::ZERO, Vec3::ONE).into_iter().filter(is_inside).collect();
        let (mut cells, mut calls) = (Vec::new(), 0);
        for_each_cell_of_shape(&shape, Vec3::ZERO, Vec3::ONE, &limits, &mut |cell| {
            calls += 1;
            cells.extend(is_inside(&cell).then_some(cell));
        });
        assert!(sorted(cells) == expected && expected.len() > 100);
        assert!(f64::from(calls) < 0.5 * places_of_shape(&shape, 1.0), "{calls}");
    }

    #[test]
    fn huge_triangles_take_as_long_as_what_is_inside_of_the_limits() {
        let corners = [Vec3::new(-1e75, -1e75, 0.0), Vec3::new(1e75, -1e75, 0.0), Vec3::new(0.0, 1e75, 0.0)];
        let soup =
            TriangleSoup::new([corners, corners.map(|p| 1e-60 * p)].concat(), vec![[0, 1, 2], [3, 4, 5]]);
        let limits = Aabb { min: Vec3::splat(-4.0), max: Vec3::splat(4.0) };
        let mut calls = 0;
        for_each_cell_of_shape(&soup.unwrap().into(), Vec3::ZERO, Vec3::ONE, &limits, &mut |_| calls += 1);
        assert!(calls < 10_000, "{calls}");
    }

    #[test]
    fn a_point_brings_its_neighbours() {
        let cloud = OrientedCloud::new(vec![Vec3::splat(7.5)], vec![Vec3::Z], vec![1.0]).unwrap();
        let cells = cells_of_shape(&cloud.into(), Vec3::ZERO, Vec3::ONE);
        assert_eq!((cells.len(), cells[0], cells[26]), (27, [6, 6, 6], [8, 8, 8]));
    }
}
