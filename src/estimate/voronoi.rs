//! The area that each point stands for: its Voronoi cell among its neighbours, in their best-fit plane
//! (Barill et al. 2018, section 3.1).
//!
//! The cell is cut out of a disk by the perpendicular bisectors to the neighbours. That is the Voronoi cell of this one
//! point without the triangulation of all the others, and it defines open cells: the disk reaches a little farther than the
//! farthest neighbour. A cell within half the distance to that one is certain, since the bisector of a point that was not
//! looked at is farther away; a larger one is right but for a corner now and then. A cell that reaches the disk lies at a
//! border: it is closed by the mirror images of the neighbours, as if the surface went on as it does on the other side. That
//! gives a border point no more than an inner one; the bare disk would give it many times as much.
//!
//! Pinned by `tests/bench/areas.rs`: with a disk of half the distance many cells of points drawn by lot reached it, and the
//! areas of 3,000 on a sphere added up to 6 % too little, with a 95 % error of 42 % (now less than 0.1 % and 3 %). With the distance
//! itself unevenly sampled ones add up to 2.5 % too little (now 1 %). Larger disks give more to borders; images across the
//! border instead of through the point changed little.
use super::neighbours::{Neighbourhoods, is_same_side};
use super::sites::Sites;
use crate::data::{Cancelled, Monitor, fill_in_blocks, signed_area};
use crate::math::{Vec2, Vec3, fit_plane};
use std::f64::consts::TAU;

/// Corners of the polygon that stands for the disk; its area is 2.6 % less.
const DISK_CORNERS: usize = 16;
/// What lies on a side of that polygon is farther away than this share of its radius: cos(π/16) = 0.9808.
const SIDES: f64 = 0.98;
/// Radius of the disk over the distance to the farthest neighbour.
const REACH: f64 = 1.25;
/// Of a point with fewer neighbours on its own side it is more likely that the normal is wrong: all neighbours count then.
const LEAST_NEIGHBOURS: usize = 3;

/// Areas in the square of the points' unit, one for each place; `normals` are those of the places.
pub(super) fn voronoi_areas(
    sites: &Sites,
    normals: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    areas_of_cells(sites, normals, neighbourhoods, &Cell::area, monitor)
}

/// The areas that `area` gives the places' cells.
pub(super) fn areas_of_cells(
    sites: &Sites,
    normals: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    area: &(dyn Fn(&Cell) -> f64 + Sync),
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    let mut areas = vec![0.0; normals.len()];
    let of_place = |i: usize, (): &mut ()| {
        voronoi_cell(i, &sites.points, normals, neighbourhoods.of(i)).map_or(0.0, |cell| area(&cell))
    };
    fill_in_blocks(&mut areas, of_place, "areas", monitor)?;
    Ok(areas)
}

/// The Voronoi cell of a point among its neighbours on the same side, in the frame of their plane.
pub(super) struct Cell {
    /// Relative to the point, counter-clockwise.
    pub corners: Vec<Vec2>,
    /// The neighbours on the same side: their places in the plane, and their heights above the point.
    pub neighbours: Vec<Vec3>,
    /// That of the disk.
    pub radius: f64,
    /// How many neighbours lie in the point's own place: they share the cell with it.
    copies: usize,
}

impl Cell {
    pub fn area(&self) -> f64 {
        self.share(signed_area(&self.corners))
    }

    /// The point's share of what the cell has.
    pub fn share(&self, area: f64) -> f64 {
        area / (1 + self.copies) as f64
    }
}

/// Nothing if there are no neighbours.
fn voronoi_cell(i: usize, points: &[Vec3], normals: &[Vec3], neighbours: &[u32]) -> Option<Cell> {
    let farthest = *neighbours.last()?;
    let radius = REACH * points[i].distance(points[farthest as usize]);
    // The other side of a thin sheet is near in space and far on the surface.
    let faces_own_side = |j: &&u32| is_same_side(normals, i as u32, **j);
    let is_alone = neighbours.iter().filter(faces_own_side).count() < LEAST_NEIGHBOURS;
    let same_side = neighbours.iter().filter(|j| is_alone || faces_own_side(j));
    let mut patch = vec![points[i]];
    patch.extend(same_side.map(|&j| points[j as usize]));
    let plane = fit_plane(&patch);
    let (u, v) = (plane.tangent, plane.normal.cross(plane.tangent));
    let flat = |d: Vec3| Vec3::new(d.dot(u), d.dot(v), d.dot(plane.normal));
    let neighbours: Vec<Vec3> = patch[1..].iter().map(|p| flat(*p - points[i])).collect();
    let mut corners: Vec<Vec2> =
        (0..DISK_CORNERS).map(|k| radius * Vec2::from_angle(TAU * k as f64 / DISK_CORNERS as f64)).collect();
    let in_plane = neighbours.iter().map(|p| p.truncate());
    let (sites, copies): (Vec<Vec2>, Vec<Vec2>) = in_plane.partition(|site| site.length() > 1e-9 * radius);
    for &site in &sites {
        corners = closer_to_origin(&corners, site);
    }
    let reaches_disk = |p: &Vec2| p.length() > SIDES * radius;
    if corners.iter().any(reaches_disk) {
        for &site in &sites {
            corners = closer_to_origin(&corners, -site);
        }
    }
    Some(Cell { corners, neighbours, radius, copies: copies.len() })
}

/// The part of a convex polygon that is closer to the origin than to `site`.
fn closer_to_origin(polygon: &[Vec2], site: Vec2) -> Vec<Vec2> {
    let limit = 0.5 * site.length_squared();
    let excess = |p: Vec2| p.dot(site) - limit;
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, &p) in polygon.iter().enumerate() {
        let next = polygon[(k + 1) % polygon.len()];
        let (a, b) = (excess(p), excess(next));
        if a <= 0.0 {
            kept.push(p);
        }
        if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
            kept.push(p + (next - p) * (a / (a - b)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    fn areas(points: &[Vec3], normals: &[Vec3]) -> Vec<f64> {
        let sites = Sites::find(points, normals);
        let neighbourhoods = Neighbourhoods::find(&sites.points, &sites.normals, 20, &Silent).unwrap();
        sites.share(voronoi_areas(&sites, &sites.normals, &neighbourhoods, &Silent).unwrap())
    }

    #[test]
    fn inner_points_of_a_grid_stand_for_one_cell_and_copies_share_it() {
        let mut points: Vec<Vec3> =
            (0..121).map(|i| Vec3::new((i % 11) as f64, 2.0, 1.5 * (i / 11) as f64)).collect();
        let inner = 60;
        points.push(points[inner]);
        let areas = areas(&points, &vec![Vec3::Y; points.len()]);
        assert!((areas[inner - 2] - 1.5).abs() < 1e-12);
        assert!((areas[inner] - 0.75).abs() < 1e-12);
        assert!(areas[..121].iter().all(|a| *a > 0.7 && *a < 1.8), "{areas:?}");
    }

    #[test]
    fn areas_of_a_sphere_add_up_to_its_own() {
        let count = 2000;
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        let points: Vec<Vec3> = (0..count)
            .map(|i| {
                let z = 1.0 - (2 * i + 1) as f64 / count as f64;
                let (sin, cos) = (golden * i as f64).sin_cos();
                let r = (1.0 - z * z).sqrt();
                Vec3::new(r * cos, r * sin, z)
            })
            .collect();
        let total: f64 = areas(&points, &points).iter().sum();
        let exact = 2.0 * TAU;
        assert!((total / exact - 1.0).abs() < 5e-3, "{total} instead of {exact}");
    }

    #[test]
    fn a_wrong_normal_amid_right_ones_takes_no_more_area() {
        let points: Vec<Vec3> = (0..121).map(|i| Vec3::new((i % 11) as f64, (i / 11) as f64, 0.0)).collect();
        let mut normals = vec![Vec3::Z; 121];
        normals[60] = -Vec3::Z;
        assert!((areas(&points, &normals)[60] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_other_side_of_a_sheet_takes_no_area() {
        let grid = |z: f64| (0..100).map(move |i| Vec3::new((i % 10) as f64, (i / 10) as f64, z));
        let points: Vec<Vec3> = grid(0.0).chain(grid(0.01)).collect();
        let normals: Vec<Vec3> = (0..200).map(|i| if i < 100 { -Vec3::Z } else { Vec3::Z }).collect();
        let areas = areas(&points, &normals);
        assert!((areas[44] - 1.0).abs() < 1e-12 && (areas[144] - 1.0).abs() < 1e-12, "{}", areas[44]);
    }
}
