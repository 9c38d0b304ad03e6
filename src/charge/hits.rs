//! Where field lines meet a surface first.
use super::FieldLines;
use crate::bvh::{Bvh, FirstHit};
use crate::data::{Cancelled, Monitor, Silent, TriangleSoup, map_items, map_tasks};
use crate::math::{Aabb, Ray, Vec3, area_vector};

/// Most triangles in a leaf of the tree.
const LEAF_SIZE: usize = 4;
/// Lines that make a task.
const LINES_PER_TASK: usize = 64;
/// Tasks between two reports to the monitor.
const TASKS_PER_REPORT: usize = 16;
const STAGE: &str = "meeting the proxy";
/// How much farther than its end a segment reaches, in its lengths: rounding must not lose what lies between two of them.
const OVERLAP: f64 = 1e-9;

/// Where a line meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    pub face: u32,
    /// Weights of the corners of the face: none is negative, their sum is 1.
    pub barycentric: [f64; 3],
    /// Which of the line's segments meets it: that from its point `segment` to the next.
    pub segment: u32,
    pub point: Vec3,
}

/// Where each line meets `mesh` first, if it does: from either side of a face. Of equal places the lowest face counts; a
/// segment in the plane of a face does not meet it.
///
/// Lines are cheap to follow again: for another surface around the same soup only this is to be called.
pub fn first_hits(lines: &FieldLines, mesh: &TriangleSoup) -> Vec<Option<Hit>> {
    first_hits_with(lines, mesh, &Silent).expect("nobody cancels")
}

/// [`first_hits`], with reports to a monitor.
///
/// # Errors
/// If and only if `monitor` cancels.
pub fn first_hits_with(
    lines: &FieldLines,
    mesh: &TriangleSoup,
    monitor: &dyn Monitor,
) -> Result<Vec<Option<Hit>>, Cancelled> {
    monitor.report(0.0, STAGE)?;
    let boxes = map_items(mesh.len(), |t| Aabb::around(mesh.corners(t)));
    let bvh = Bvh::build(&boxes, LEAF_SIZE);
    let tasks = lines.len().div_ceil(LINES_PER_TASK);
    let mut hits = Vec::with_capacity(lines.len());
    for begun in (0..tasks).step_by(TASKS_PER_REPORT) {
        monitor.report(begun as f64 / tasks as f64, STAGE)?;
        let found = map_tasks(TASKS_PER_REPORT.min(tasks - begun), |task| {
            let mut search = FirstHit::default();
            let first = (begun + task) * LINES_PER_TASK;
            (first..lines.len().min(first + LINES_PER_TASK))
                .map(|line| along(lines.line(line), mesh, &bvh, &mut search))
                .collect::<Vec<_>>()
        });
        hits.extend(found.into_iter().flatten());
    }
    monitor.report(1.0, STAGE)?;
    Ok(hits)
}

fn along(points: &[Vec3], mesh: &TriangleSoup, bvh: &Bvh, search: &mut FirstHit) -> Option<Hit> {
    points.windows(2).enumerate().find_map(|(segment, ends)| {
        let direction = ends[1] - ends[0];
        if direction == Vec3::ZERO {
            return None;
        }
        let ray = Ray::new(ends[0], direction);
        let meet = |t: usize| ray.meet(mesh.corners(t)).map(|hit| hit.0);
        let (distance, face) = search.find(bvh, &ray, 1.0 + OVERLAP, meet)?;
        let point = ray.at(distance.min(1.0));
        let barycentric = weights(point, mesh.corners(face));
        Some(Hit { face: face as u32, barycentric, segment: segment as u32, point })
    })
}

/// Barycentric coordinates of a point next to a triangle, as those of the nearest point of its plane, within the triangle.
fn weights(point: Vec3, corners: [Vec3; 3]) -> [f64; 3] {
    let normal = area_vector(corners);
    let [a, b, c] = corners.map(|corner| corner - point);
    let areas = [b.cross(c), c.cross(a), a.cross(b)].map(|area| area.dot(normal).max(0.0));
    let sum: f64 = areas.iter().sum();
    if sum > 0.0 { areas.map(|area| area / sum) } else { [1.0 / 3.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two layers of a square of side 4 about the z axis, at z = 1 and z = 2.
    fn layers() -> TriangleSoup {
        let corner = |k: usize| {
            let (x, y) = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)][k % 4];
            Vec3::new(x, y, 1.0 + (k / 4) as f64)
        };
        let triangles = vec![[4, 5, 6], [4, 6, 7], [0, 1, 2], [0, 2, 3]];
        TriangleSoup::new((0..8).map(corner).collect(), triangles).unwrap()
    }

    fn lines(of: &[&[Vec3]]) -> FieldLines {
        of.iter().fold(FieldLines::default(), |mut lines, points| {
            lines.push(points);
            lines
        })
    }

    #[test]
    fn the_first_of_two_layers_is_met_from_either_side() {
        let up = |x: f64, y: f64| [0.0, 0.4, 0.4, 0.9, 3.0].map(|z| Vec3::new(x, y, z));
        let mut down = up(1.0, 0.5);
        down.reverse();
        let lines = lines(&[&up(1.0, 0.5), &down, &up(3.0, 0.0), &[], &[Vec3::ZERO], &up(-1.0, 1.0)]);
        let hits = first_hits(&lines, &layers());
        let met = |k: usize| hits[k].map(|hit| (hit.face, hit.segment));
        assert_eq!([0, 1, 2, 3, 4, 5].map(met), [Some((2, 3)), Some((0, 0)), None, None, None, Some((3, 3))]);
        let mesh = layers();
        for (hit, place) in [(hits[0], Vec3::new(1.0, 0.5, 1.0)), (hits[1], Vec3::new(1.0, 0.5, 2.0))] {
            let hit = hit.unwrap();
            let corners = mesh.corners(hit.face as usize);
            let found: Vec3 = (0..3).map(|k| hit.barycentric[k] * corners[k]).sum();
            assert!(found.distance(place) < 1e-14 && hit.point.distance(place) < 1e-14, "{hit:?}");
        }
    }

    #[test]
    fn a_line_with_a_point_on_the_surface_meets_it_there() {
        let mesh = layers();
        for k in 0..100 {
            let t = f64::from(k);
            let on = Vec3::new(1.9 * (1.7 * t).sin(), 1.9 * (2.3 * t).sin(), 1.0);
            let lean = Vec3::new((0.3 * t).cos(), (0.9 * t).sin(), 1.0);
            let hits = first_hits(&lines(&[&[on - 0.1 * lean, on, on + 0.3 * lean]]), &mesh);
            assert!(hits[0].is_some_and(|hit| hit.point.distance(on) < 1e-8), "{k}: {hits:?}");
        }
    }
}
