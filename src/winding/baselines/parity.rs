//! Inside by ray stabbing, the baseline that winding numbers replace: a point is inside when a ray from it crosses the
//! surface an odd number of times (Barill et al. 2018, fig. 4; the first method of Pimentel, Scrivener & To 2022).
//!
//! Right off a closed surface without overlaps. Elsewhere it is wrong along whole rays: behind a hole, and where parts
//! overlap or come twice; orientation does not matter to it.
use crate::bvh::{Bvh, Child, Stack, WIDTH};
use crate::data::{Monitor, TriangleSoup, fill_in_blocks, zeroed};
use crate::math::{Aabb, Random, Vec3};
use crate::winding::FieldError;

/// Which rays are asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rays {
    /// One, along +x.
    #[default]
    Axis,
    /// `count` in pseudo-random directions, the same for the same seed and for all queries; inside is what more than half
    /// of them say.
    Majority { count: usize, seed: u64 },
}

/// A soup to be stabbed: built once, asked many times.
pub struct RayParity {
    bvh: Bvh,
    /// In the order of the tree.
    triangles: Vec<[Vec3; 3]>,
    rays: Vec<Ray>,
}

/// Triangles in a leaf.
const LEAF_SIZE: usize = 8;

impl RayParity {
    /// Builds the tree of boxes, in parallel.
    pub fn new(soup: &TriangleSoup, rays: Rays) -> RayParity {
        let boxes: Vec<Aabb> = (0..soup.len()).map(|t| Aabb::around(soup.corners(t))).collect();
        let bvh = Bvh::build(&boxes, LEAF_SIZE);
        let triangles = bvh.items().iter().map(|&t| soup.corners(t as usize)).collect();
        let rays = match rays {
            Rays::Axis => vec![Ray { forward: Vec3::X, aside: Vec3::Y, up: Vec3::Z }],
            Rays::Majority { count, seed } => {
                let mut random = Random::new(seed);
                (0..count).map(|_| Ray::towards(random_direction(&mut random))).collect()
            }
        };
        RayParity { bvh, triangles, rays }
    }

    /// Whether most rays from `q` cross the surface an odd number of times; false where `q` is not finite. On the surface
    /// itself either answer may come.
    pub fn contains(&self, q: Vec3) -> bool {
        self.contains_with(q, &mut Stack::new())
    }

    /// Whether each of `points` is inside, in parallel.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn contains_all(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<bool>, FieldError> {
        let mut inside = zeroed(points.len())?;
        let value = |i: usize, stack: &mut Stack| self.contains_with(points[i], stack);
        fill_in_blocks(&mut inside, value, "ray parity", monitor)?;
        Ok(inside)
    }

    fn contains_with(&self, q: Vec3, stack: &mut Stack) -> bool {
        let votes = self.rays.iter().filter(|ray| self.crossings(ray, q, stack) % 2 == 1).count();
        q.is_finite() && 2 * votes > self.rays.len()
    }

    fn crossings(&self, ray: &Ray, q: Vec3, stack: &mut Stack) -> usize {
        let mut count = 0;
        let visit = |node: usize, ()| {
            let bounds = &self.bvh.nodes()[node].bounds;
            ((0..WIDTH).fold(0, |open, k| open | u32::from(ray.may_meet(&bounds[k], q)) << k), [(); WIDTH])
        };
        let leaf = |node: usize, k: usize, ()| {
            let child: Child = self.bvh.nodes()[node].children[k];
            let triangles = &self.triangles[self.bvh.places(child)];
            count += triangles.iter().filter(|t| ray.crosses(**t, q)).count();
        };
        self.bvh.traverse(stack, (), visit, leaf);
        count
    }
}

/// A direction and two that complete it to a right-handed frame.
struct Ray {
    forward: Vec3,
    aside: Vec3,
    up: Vec3,
}

impl Ray {
    fn towards(forward: Vec3) -> Ray {
        let (aside, up) = forward.any_orthonormal_pair();
        Ray { forward, aside, up }
    }

    /// Whether the ray from `q` may meet a box: it is held against the box around the box in the ray's own frame, with
    /// room for rounding.
    fn may_meet(&self, bounds: &Aabb, q: Vec3) -> bool {
        const ROOM: f64 = 8.0 * f64::EPSILON;
        if bounds.is_empty() {
            return false;
        }
        let (center, half) = (0.5 * (bounds.min + bounds.max) - q, 0.5 * (bounds.max - bounds.min));
        let room = ROOM * (bounds.min.abs().max(bounds.max.abs()) + q.abs()).element_sum();
        let reach = |axis: Vec3| half.dot(axis.abs()) + room;
        center.dot(self.aside).abs() <= reach(self.aside)
            && center.dot(self.up).abs() <= reach(self.up)
            && center.dot(self.forward) >= -reach(self.forward)
    }

    /// Whether the ray from `q` crosses a triangle.
    ///
    /// Seen along the ray, the triangle holds the query when an odd number of its edges pass on one side of it, with one
    /// expression for an edge whichever triangle it is of: no ray slips through between two triangles, nor is counted twice.
    fn crosses(&self, triangle: [Vec3; 3], q: Vec3) -> bool {
        let [a, b, c] = triangle.map(|p| {
            let r = p - q;
            [r.dot(self.aside), r.dot(self.up)]
        });
        let odd = passes_aside(a, b) ^ passes_aside(b, c) ^ passes_aside(c, a);
        odd && self.is_ahead(triangle, q)
    }

    /// Whether the plane of a triangle that holds `q`, seen along the ray, lies before it.
    fn is_ahead(&self, [a, b, c]: [Vec3; 3], q: Vec3) -> bool {
        let normal = (b - a).cross(c - a);
        (a - q).dot(normal) * self.forward.dot(normal) > 0.0
    }
}

/// Whether the edge crosses the half-line from the origin to the right: half-open at its ends.
fn passes_aside(a: [f64; 2], b: [f64; 2]) -> bool {
    let (low, high) = if a[1] <= b[1] { (a, b) } else { (b, a) };
    low[1] <= 0.0 && high[1] > 0.0 && low[0] * high[1] - low[1] * high[0] > 0.0
}

/// A unit vector, evenly distributed (Archimedes' cylinder).
fn random_direction(random: &mut Random) -> Vec3 {
    let z = 2.0 * random.below_one() - 1.0;
    let angle = std::f64::consts::TAU * random.below_one();
    let radius = (1.0 - z * z).sqrt();
    Vec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z)
}
