//! Where field lines begin: at each vertex of a soup, once for each side that its triangles show there.
use crate::data::{LeftOut, Topology, TriangleSoup};
use crate::math::{Vec3, area_vector};
use crate::winding::weld;
use rustc_hash::FxHashMap;

/// Starts of field lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Starts {
    pub points: Vec<Vec3>,
    /// Unit, on the side that the triangles show: lines leave into their half-spaces.
    pub normals: Vec<Vec3>,
    /// The starts of each triangle's corners.
    pub corners: Vec<[u32; 3]>,
    /// Whether a start lies on an edge that only one triangle has.
    pub on_boundary: Vec<bool>,
}

/// How far beside a start the field is asked what it is like there, in diagonals of the soup.
const BESIDE: f64 = 1e-3;

/// Triangles at a vertex whose normals have a cosine above this belong to one side of the surface there: those around a cube's corner
/// do, the two sides of a plate do not.
const SAME_SIDE: f64 = -0.2;
/// Least cosine between the normal of a start and those of its triangles; others begin at their own.
const LEAST_COSINE: f64 = 0.1;

impl Starts {
    /// All corners of all triangles: those in the same place whose triangles show the same side share a start, so that lines of
    /// neighbours are the same. One-sided soups are thus followed to the side of their normals.
    pub fn new(soup: &TriangleSoup) -> Starts {
        let welded = weld(soup.positions());
        let normals: Vec<Vec3> =
            (0..soup.len()).map(|t| area_vector(soup.corners(t)).normalize_or_zero()).collect();
        let boundary = boundary_vertices(soup, &welded);
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); soup.positions().len()];
        for (t, corners) in soup.triangles().iter().enumerate() {
            (0..3).for_each(|k| around[welded[corners[k] as usize] as usize].push(3 * t as u32 + k as u32));
        }
        let mut starts = Starts::default();
        let mut known: FxHashMap<(u32, [u64; 3]), u32> = FxHashMap::default();
        for (t, corners) in soup.triangles().iter().enumerate() {
            let corner = |k: usize| {
                let vertex = welded[corners[k] as usize];
                let normal = side_normal(soup, &normals, normals[t], &around[vertex as usize]);
                let key = (vertex, normal.to_array().map(f64::to_bits));
                *known.entry(key).or_insert_with(|| {
                    starts.points.push(soup.positions()[vertex as usize]);
                    starts.normals.push(normal);
                    starts.on_boundary.push(boundary[vertex as usize]);
                    starts.points.len() as u32 - 1
                })
            };
            let all = [0, 1, 2].map(corner);
            starts.corners.push(all);
        }
        starts
    }

    /// A point next to a start of a soup, on its side.
    pub fn beside(&self, start: u32, soup: &TriangleSoup) -> Vec3 {
        self.points[start as usize] + BESIDE * soup.bounds().diagonal() * self.normals[start as usize]
    }
}

/// The mean of the normals that show the same side as `own`, weighed by their angles at the vertex.
fn side_normal(soup: &TriangleSoup, normals: &[Vec3], own: Vec3, around: &[u32]) -> Vec3 {
    let same = around.iter().filter(|c| normals[**c as usize / 3].dot(own) > SAME_SIDE);
    let weighed = same.map(|corner| {
        let (t, k) = (*corner as usize / 3, *corner as usize % 3);
        let corners = soup.corners(t);
        let (u, v) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
        libm::atan2(u.cross(v).length(), u.dot(v)) * normals[t]
    });
    let mean = weighed.sum::<Vec3>().normalize_or_zero();
    match (mean, own) {
        (Vec3::ZERO, Vec3::ZERO) => Vec3::Z,
        (mean, Vec3::ZERO) => mean,
        (mean, own) if mean.dot(own) < LEAST_COSINE => own,
        (mean, _) => mean,
    }
}

/// Whether each welded vertex has an edge with one triangle.
fn boundary_vertices(soup: &TriangleSoup, welded: &[u32]) -> Vec<bool> {
    let topology = Topology::new(soup.triangles(), welded, LeftOut::Repeated);
    let mut is_boundary = vec![false; welded.len()];
    for edge in topology.edges.iter().filter(|edge| edge.count == 1) {
        edge.ends.iter().for_each(|v| is_boundary[*v as usize] = true);
    }
    is_boundary
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(places: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleSoup {
        TriangleSoup::new(places.iter().map(|p| Vec3::from_array(*p)).collect(), triangles.to_vec()).unwrap()
    }

    #[test]
    fn a_corner_has_one_start_and_a_plate_has_two() {
        let corner = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let three = soup(&corner, &[[0, 2, 1], [0, 1, 3], [0, 3, 2]]);
        let starts = Starts::new(&three);
        assert!(starts.corners.iter().all(|c| c[0] == starts.corners[0][0]));
        let normal = starts.normals[starts.corners[0][0] as usize];
        assert!((normal + Vec3::ONE / 3f64.sqrt()).length() < 1e-12);
        // The rim has vertices 1 to 3.
        let at = |v: usize| starts.points.iter().position(|p| *p == Vec3::from_array(corner[v])).unwrap();
        assert_eq!([0, 1, 2, 3].map(|v| starts.on_boundary[at(v)]), [false, true, true, true]);
        let plate = Starts::new(&soup(&corner[..3], &[[0, 1, 2], [0, 2, 1]]));
        assert_eq!(plate.points.len(), 6);
        assert!(plate.corners[0].iter().all(|s| plate.normals[*s as usize] == Vec3::Z));
        assert!(plate.corners[1].iter().all(|s| plate.normals[*s as usize] == -Vec3::Z));
    }

    #[test]
    fn triangles_without_area_take_the_normals_around() {
        let places = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
        let starts = Starts::new(&soup(&places, &[[0, 1, 2], [0, 1, 3]]));
        assert!(starts.normals.iter().all(|n| *n == Vec3::Z), "{:?}", starts.normals);
    }
}
