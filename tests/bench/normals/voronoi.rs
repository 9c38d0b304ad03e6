//! The Voronoi diagram of a cloud, as globally consistent normal orientation samples it.
use fast_winding::math::{Vec2, Vec3};
use meshless_voronoi::{Dimensionality, HalfSpace, VoronoiIntegrator};
use std::collections::HashMap;

/// The box that bounds the diagram, in boxes of the cloud.
const BOX: f64 = 1.3;
/// A cell begins with the six planes of that box.
const BOX_PLANES: usize = 6;

pub struct Diagram {
    pub vertices: Vec<Vec3>,
    /// The vertices of the cell of each point.
    pub cells: Vec<Vec<u32>>,
    /// The area of each cell where the plane through its point cuts it that is perpendicular to its longest direction.
    pub areas: Vec<f64>,
}

impl Diagram {
    /// The diagram of distinct points in [−1, 1]³. Samples of meshes at random are no trouble; the crate panics where all
    /// points lie on one sphere.
    pub fn of(points: &[Vec3]) -> Diagram {
        // The crate's vectors are those of another version of glam.
        let generators: Vec<_> = points.iter().map(|p| p.to_array().into()).collect();
        let (corner, size) = ([-BOX; 3].into(), [2.0 * BOX; 3].into());
        let integrator =
            VoronoiIntegrator::build(&generators, None, corner, size, Dimensionality::ThreeD, false);
        let mut diagram = Diagram { vertices: vec![], cells: vec![], areas: vec![] };
        let mut numbers = HashMap::new();
        for cell in integrator.cells_iter() {
            let mut own = Vec::with_capacity(cell.vertices.len());
            for vertex in &cell.vertices {
                // A vertex is where four cells meet, or fewer and planes of the box.
                let other = |plane: usize| match cell.clipping_planes[plane].right_idx {
                    Some(point) => point,
                    None => points.len() + plane.min(BOX_PLANES),
                };
                let [a, b, c] = vertex.dual.map(other);
                let mut key = [cell.idx, a, b, c];
                key.sort_unstable();
                let number = *numbers.entry(key).or_insert(diagram.vertices.len() as u32);
                if number as usize == diagram.vertices.len() {
                    diagram.vertices.push(Vec3::from_array(vertex.loc.to_array()));
                }
                own.push(number);
            }
            let place = |k: &u32| diagram.vertices[*k as usize];
            let point = points[cell.idx];
            let farthest = own
                .iter()
                .map(place)
                .max_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)));
            let longest = farthest.map_or(Vec3::Z, |pole| (pole - point).normalize());
            diagram.areas.push(cut(&cell.clipping_planes, point, longest));
            diagram.cells.push(own);
        }
        diagram
    }
}

/// The area of the cut through a cell at `point`, perpendicular to `normal`.
fn cut(planes: &[HalfSpace], point: Vec3, normal: Vec3) -> f64 {
    let (across, along) = normal.any_orthonormal_pair();
    let far = 4.0 * BOX;
    let mut polygon =
        vec![Vec2::new(-far, -far), Vec2::new(far, -far), Vec2::new(far, far), Vec2::new(-far, far)];
    for plane in planes {
        let inward = Vec3::from_array(plane.plane.n.to_array());
        let on = Vec3::from_array(plane.plane.p.to_array());
        let depth = |q: Vec2| inward.dot(point + q.x * across + q.y * along - on);
        polygon = clipped(&polygon, depth);
    }
    let next = polygon.iter().cycle().skip(1);
    0.5 * polygon.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs()
}

/// The part of a convex polygon where `depth`, which is linear, is positive.
fn clipped(polygon: &[Vec2], depth: impl Fn(Vec2) -> f64) -> Vec<Vec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (k, a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (da, db) = (depth(*a), depth(b));
        if da >= 0.0 {
            kept.push(*a);
        }
        if (da >= 0.0) != (db >= 0.0) {
            kept.push(a.lerp(b, da / (da - db)));
        }
    }
    kept
}
