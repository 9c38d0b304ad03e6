//! The Voronoi cell with the area of the curved surface above it: the neighbours' heights above their plane are fitted by
//! a quadratic polynomial h (Cazals & Pouget 2005, *Estimating differential quantities using polynomial fitting of
//! osculating jets*, with degree 2), and √(1 + |∇h|²) is summed over the cell.
use super::neighbours::Neighbourhoods;
use super::sites::Sites;
use super::voronoi::{Cell, areas_of_cells};
use crate::data::{Cancelled, Monitor, signed_area};
use crate::math::{Vec2, Vec3};

/// Coefficients of a quadratic height: 1, x, y, x², xy, y².
const TERMS: usize = 6;
/// A pivot of the normal equations below this share of its diagonal entry tells of points on a conic, which no height is
/// fitted to: rounding leaves some 1e-16 of one that is zero, and 20 random places about 1e-2.
const LEAST_PIVOT: f64 = 1e-10;

/// Areas in the square of the points' unit, one for each place; `normals` are those of the places.
pub(super) fn curved_areas(
    sites: &Sites,
    normals: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    areas_of_cells(sites, normals, neighbourhoods, &curved_area, monitor)
}

/// The area of the fitted surface above the cell; the cell's own where there are too few neighbours for a fit.
fn curved_area(cell: &Cell) -> f64 {
    let Some(height) = fit_height(&cell.neighbours, cell.radius) else { return cell.area() };
    let element = |p: Vec2| (1.0 + height.gradient(p).length_squared()).sqrt();
    // Midpoints of the sides are exact for quadratic integrands.
    let triangle = |(k, &b): (usize, &Vec2)| {
        let c = cell.corners[(k + 1) % cell.corners.len()];
        let mean = (element(0.5 * b) + element(0.5 * c) + element(0.5 * (b + c))) / 3.0;
        mean * signed_area(&[Vec2::ZERO, b, c])
    };
    cell.share(cell.corners.iter().enumerate().map(triangle).sum())
}

/// A quadratic polynomial over the plane, in units of `scale`.
pub(super) struct Height {
    terms: [f64; TERMS],
    scale: f64,
}

impl Height {
    pub fn at(&self, p: Vec2) -> f64 {
        let [one, x, y, xx, xy, yy] = self.terms;
        let p = p / self.scale;
        self.scale * (one + x * p.x + y * p.y + xx * p.x * p.x + xy * p.x * p.y + yy * p.y * p.y)
    }

    fn gradient(&self, p: Vec2) -> Vec2 {
        let [_, x, y, xx, xy, yy] = self.terms;
        let p = p / self.scale;
        Vec2::new(x + 2.0 * xx * p.x + xy * p.y, y + xy * p.x + 2.0 * yy * p.y)
    }
}

/// The least-squares height of the point at the origin and its neighbours; nothing where they leave it open.
pub(super) fn fit_height(neighbours: &[Vec3], scale: f64) -> Option<Height> {
    let mut matrix = [[0.0; TERMS]; TERMS];
    let mut right = [0.0; TERMS];
    for p in [Vec3::ZERO].iter().chain(neighbours) {
        let Vec3 { x, y, z } = *p / scale;
        let row = [1.0, x, y, x * x, x * y, y * y];
        for (i, a) in row.iter().enumerate() {
            right[i] += a * z;
            row.iter().zip(&mut matrix[i]).for_each(|(b, entry)| *entry += a * b);
        }
    }
    Some(Height { terms: solve(matrix, right)?, scale })
}

/// Solves a symmetric, positive definite system by Cholesky's decomposition; nothing if it is singular.
fn solve(mut m: [[f64; TERMS]; TERMS], mut x: [f64; TERMS]) -> Option<[f64; TERMS]> {
    for i in 0..TERMS {
        for j in 0..=i {
            let products: f64 = (0..j).map(|k| m[i][k] * m[j][k]).sum();
            let rest = m[i][j] - products;
            m[i][j] = if i > j {
                rest / m[j][j]
            } else if rest > LEAST_PIVOT * m[i][i] {
                rest.sqrt()
            } else {
                return None;
            };
        }
    }
    for i in 0..TERMS {
        let known: f64 = (0..i).map(|k| m[i][k] * x[k]).sum();
        x[i] = (x[i] - known) / m[i][i];
    }
    for i in (0..TERMS).rev() {
        let known: f64 = (i + 1..TERMS).map(|k| m[k][i] * x[k]).sum();
        x[i] = (x[i] - known) / m[i][i];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadratic_height_is_found_and_a_line_leaves_it_open() {
        let height = |x: f64, y: f64| 0.25 + 0.5 * x - y + 0.125 * x * x - 2.0 * x * y + y * y;
        let at = |i: u32| Vec2::from_angle(f64::from(i)) * (0.3 + 0.1 * f64::from(i));
        let points: Vec<Vec3> = (0..12).map(at).map(|p| p.extend(height(p.x, p.y) - 0.25)).collect();
        let found = fit_height(&points, 3.0).unwrap();
        let gradient = found.gradient(Vec2::new(1.0, 2.0));
        assert!(gradient.distance(Vec2::new(0.5 + 0.25 - 4.0, -1.0 - 2.0 + 4.0)) < 1e-10, "{gradient}");
        let line: Vec<Vec3> = (0..12).map(|i| Vec3::X * f64::from(i)).collect();
        assert!(fit_height(&line, 6.0).is_none());
        assert!(fit_height(&points[..4], 3.0).is_none());
        assert!(fit_height(&points, 0.0).is_none());
    }
}
