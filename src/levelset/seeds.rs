use crate::data::{Shape, sort_keyed};
use crate::math::Vec3;

/// Integer coordinates of a cell: it spans `origin + spacing * cell` to `origin + spacing * (cell + 1)`.
pub type Cell = [i32; 3];

/// The cell that holds `p`.
pub fn cells_of_point(p: Vec3, origin: Vec3, spacing: Vec3) -> Cell {
    ((p - origin) / spacing).floor().to_array().map(|c| c as i32)
}

/// Calls `found` with the cells of points strewn over a triangle at most half a cell apart. Cells that it only grazes
/// may be missed; their neighbours are not.
pub fn cells_of_triangle([a, b, c]: [Vec3; 3], origin: Vec3, spacing: Vec3, mut found: impl FnMut(Cell)) {
    let step = 0.5 * spacing.min_element();
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    let rows = (longest / step).ceil().max(1.0) as usize;
    for i in 0..=rows {
        for j in 0..=rows - i {
            let (u, v) = (i as f64 / rows as f64, j as f64 / rows as f64);
            found(cells_of_point(a + u * (b - a) + v * (c - a), origin, spacing));
        }
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
    for_each_cell_of_shape(shape, origin, spacing, &mut |cell| {
        if cells.last() != Some(&cell) {
            cells.push(cell);
        }
    });
    sorted(cells)
}

/// Calls `found` with the cells of [`cells_of_shape`] as they come, many more than once.
pub fn for_each_cell_of_shape(shape: &Shape, origin: Vec3, spacing: Vec3, found: &mut dyn FnMut(Cell)) {
    match shape {
        Shape::Soup(soup) => {
            (0..soup.len()).for_each(|t| cells_of_triangle(soup.corners(t), origin, spacing, &mut *found));
        }
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
    fn a_point_brings_its_neighbours() {
        let cloud = OrientedCloud::new(vec![Vec3::splat(7.5)], vec![Vec3::Z], vec![1.0]).unwrap();
        let cells = cells_of_shape(&cloud.into(), Vec3::ZERO, Vec3::ONE);
        assert_eq!((cells.len(), cells[0], cells[26]), (27, [6, 6, 6], [8, 8, 8]));
    }
}
