//! The shapes of the paper, with as many triangles.
use fast_winding::TriangleSoup;
use fast_winding::math::Vec3;
use std::f64::consts::{PI, TAU};

/// A grid of (u, v) cells, two triangles each, mapped to space; cells without area are left out.
fn grid(columns: usize, rows: usize, place: impl Fn(f64, f64) -> Vec3) -> TriangleSoup {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for row in 0..=rows {
        for column in 0..=columns {
            positions.push(place(column as f64 / columns as f64, row as f64 / rows as f64));
        }
    }
    let at = |column: usize, row: usize| (row * (columns + 1) + column) as u32;
    let is_flat = |t: [u32; 3]| {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        (b - a).cross(c - a).length() < 1e-12
    };
    for row in 0..rows {
        for column in 0..columns {
            let [a, b, c, d] =
                [at(column, row), at(column + 1, row), at(column + 1, row + 1), at(column, row + 1)];
            triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(|t| !is_flat(*t)));
        }
    }
    TriangleSoup::new(positions, triangles).expect("a grid is a soup")
}

/// Radius 1, section radius ½: 2 · columns · rows triangles.
pub fn torus(columns: usize, rows: usize) -> TriangleSoup {
    grid(columns, rows, torus_at)
}

/// The point of the torus at u around the axis, v around the section, both of period 1.
pub fn torus_at(u: f64, v: f64) -> Vec3 {
    let (u, v) = (TAU * u, TAU * v);
    let r = 1.0 + 0.5 * v.cos();
    Vec3::new(r * u.cos(), r * u.sin(), 0.5 * v.sin())
}

/// Its outward normal.
pub fn torus_normal(u: f64, v: f64) -> Vec3 {
    let (u, v) = (TAU * u, TAU * v);
    Vec3::new(v.cos() * u.cos(), v.cos() * u.sin(), v.sin())
}

/// A torus of so many triangles, twice as many cells around as across.
pub fn torus_of(triangles: usize) -> TriangleSoup {
    let rows = (triangles as f64 / 4.0).sqrt().round() as usize;
    let rows =
        (0..rows).map(|k| rows - k).find(|rows| triangles.is_multiple_of(2 * rows)).expect("1 divides all");
    torus(triangles / 2 / rows, rows)
}

/// 4,900 triangles with columns 50, rows 50: circles of latitude.
pub fn sphere(columns: usize, rows: usize) -> TriangleSoup {
    grid(columns, rows, |u, v| {
        let (u, v) = (TAU * u, PI * v);
        let r = if v == PI { 0.0 } else { v.sin() };
        Vec3::new(r * u.cos(), r * u.sin(), -v.cos())
    })
}

/// Radius 1, height 2, lids of rings around a middle: 2 columns (side rows + 2 lid rings − 1) triangles.
pub fn cylinder(columns: usize, side: usize, rings: usize) -> TriangleSoup {
    let rows = side + 2 * rings;
    grid(columns, rows, |u, v| {
        let row = (v * rows as f64).round();
        let (inner, outer) = (rings as f64, (rings + side) as f64);
        let (r, z) = if row <= inner {
            (row / inner, -1.0)
        } else if row <= outer {
            (1.0, -1.0 + 2.0 * (row - inner) / side as f64)
        } else {
            ((rows as f64 - row) / rings as f64, 1.0)
        };
        Vec3::new(r * (TAU * u).cos(), r * (TAU * u).sin(), z)
    })
}

/// Side 2, with as many of n² cells of two triangles on each face as make 12 n²; `flips` cells of the first face are cut into four
/// so that the number of triangles comes out.
pub fn cube(cells: usize, extra: usize) -> TriangleSoup {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for face in 0..6 {
        let (axis, sign) = (face / 2, if face % 2 == 0 { 1.0 } else { -1.0 });
        let first = positions.len();
        for j in 0..=cells {
            for i in 0..=cells {
                let [u, v] = [i, j].map(|k| -1.0 + 2.0 * k as f64 / cells as f64);
                let mut p = [0.0; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (sign, u, sign * v);
                positions.push(Vec3::from_array(p));
            }
        }
        for j in 0..cells {
            for i in 0..cells {
                let at = |i: usize, j: usize| (first + j * (cells + 1) + i) as u32;
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if face == 0 && j * cells + i < extra {
                    let middle = positions.len() as u32;
                    positions.push(0.5 * (positions[a as usize] + positions[c as usize]));
                    triangles.extend([[a, b, middle], [b, c, middle], [c, d, middle], [d, a, middle]]);
                } else {
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
    }
    TriangleSoup::new(positions, triangles).expect("a cube is a soup")
}
