//! One triangle, cut along segments: a constrained Delaunay triangulation in the triangle's own coordinates.
//!
//! These are the shares of the way to the second and third corner, as whole numbers of [`SIDE`] steps: points on the
//! triangle's edges lie on them exactly, all others strictly inside, so exact predicates see a consistent picture however
//! thin the triangle is in space.
use super::contacts::edge;
use super::edges::Edges;
use super::points::Points;
use crate::math::Place;
use rustc_hash::FxHashSet;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

/// Steps along an edge: a whole number as `f64`, and so is every coordinate.
pub const SIDE: i64 = 1 << 52;

/// Points that lie nearer to a segment than this many steps lie on it: rounding moves each by one at most.
const NEAR: f64 = 4.0;

/// What is still to be put right before a triangle is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Event {
    /// A segment runs through a point.
    Through([u32; 2], u32),
    /// Two segments cross.
    Cross([u32; 2], [u32; 2]),
}

#[derive(Clone, Debug, Default)]
pub struct Pieces {
    pub triangles: Vec<[u32; 3]>,
    pub events: Vec<Event>,
}

/// What cuts a triangle.
pub struct Cuts<'a> {
    pub corners: [u32; 3],
    /// Segments, the lower point first.
    pub segments: &'a [[u32; 2]],
    pub inside: &'a [u32],
    /// Edges that pieces are to have where nothing is in the way.
    pub wishes: &'a [[u32; 2]],
}

#[derive(Clone, Copy, Debug)]
struct Site {
    at: [i64; 2],
    point: u32,
}

impl HasPosition for Site {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.at[0] as f64, self.at[1] as f64)
    }
}

type Delaunay = ConstrainedDelaunayTriangulation<Site>;

/// Where a point lies in the coordinates of a triangle, strictly inside.
pub fn coordinates(corners: [u32; 3], point: u32, points: &Points) -> [i64; 2] {
    let [u, v] = shares(corners, points.at(point), points);
    let step = |x: f64| (x * SIDE as f64).round().clamp(1.0, (SIDE - 2) as f64) as i64;
    let u = step(u);
    [u, step(v).min(SIDE - 1 - u)]
}

/// The shares of the way to the second and third corner at which a place lies.
pub fn shares(corners: [u32; 3], place: Place, points: &Points) -> [f64; 2] {
    let [a, b, c] = corners.map(|v| points.at(v));
    let (to_b, to_c, to_q) = (b.minus(a), c.minus(a), place.minus(a));
    let normal = to_b.cross(to_c);
    let k = normal.dominant();
    let u = to_q.cross_component(to_c, k) / normal.0[k];
    let v = to_b.cross_component(to_q, k) / normal.0[k];
    [u.high, v.high]
}

impl Cuts<'_> {
    pub fn is_whole(&self, edges: &Edges) -> bool {
        self.inside.is_empty()
            && (0..3).all(|k| edges.chain(edge(self.corners, k)).is_empty())
            && self.segments.as_flattened().iter().all(|p| self.corners.contains(p))
    }

    /// The pieces of the triangle, oriented as it is.
    pub fn pieces(&self, edges: &Edges, points: &Points) -> Pieces {
        if self.is_whole(edges) {
            return Pieces { triangles: vec![self.corners], events: Vec::new() };
        }
        let sites = self.sites(edges, points);
        let mut delaunay = Delaunay::default();
        let mut handles: Vec<(u32, FixedVertexHandle)> = Vec::with_capacity(sites.len());
        for site in &sites {
            if let Ok(handle) = delaunay.insert(*site) {
                handles.push((site.point, handle));
            }
        }
        handles.sort_by_key(|(point, handle)| (*point, handle.index()));
        let handle = |point: u32| {
            let place = handles.partition_point(|(p, _)| *p < point);
            handles.get(place).filter(|(p, _)| *p == point).map(|(_, handle)| *handle)
        };
        let mut events = Vec::new();
        for ends in self.segments {
            if let (Some(from), Some(to)) = (handle(ends[0]), handle(ends[1])) {
                constrain(&mut delaunay, *ends, from, to, &mut events);
            }
        }
        if events.is_empty() {
            for ends in self.segments {
                if let (Some(from), Some(to)) = (handle(ends[0]), handle(ends[1])) {
                    near(&delaunay, *ends, from, to, &mut events);
                }
            }
        }
        for ends in self.wishes {
            if let (Some(from), Some(to)) = (handle(ends[0]), handle(ends[1])) {
                delaunay.try_add_constraint(from, to);
            }
        }
        let corners = delaunay.inner_faces().map(|face| face.vertices().map(|v| v.data().point));
        let triangles = corners.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        Pieces { triangles, events }
    }

    /// All points of the triangle: those of its rim first.
    fn sites(&self, edges: &Edges, points: &Points) -> Vec<Site> {
        let ends = [[0, 0], [SIDE, 0], [0, SIDE]];
        let mut sites: Vec<Site> =
            self.corners.iter().zip(ends).map(|(point, at)| Site { at, point: *point }).collect();
        for k in 0..3 {
            let is_upward = self.corners[k] < self.corners[(k + 1) % 3];
            for (point, step) in edges.chain(edge(self.corners, k)) {
                let step = if is_upward { *step } else { SIDE - step };
                let at = match k {
                    0 => [step, 0],
                    1 => [SIDE - step, step],
                    _ => [0, SIDE - step],
                };
                sites.push(Site { at, point: *point });
            }
        }
        let mut rim: Vec<u32> = sites.iter().map(|site| site.point).collect();
        rim.sort_unstable();
        let mut inner: Vec<u32> = self.segments.as_flattened().iter().chain(self.inside).copied().collect();
        inner.sort_unstable();
        inner.dedup();
        inner.retain(|point| rim.binary_search(point).is_err());
        let mut taken = FxHashSet::default();
        for point in inner {
            let mut at = coordinates(self.corners, point, points);
            // Beside those that rounding has put in the same place.
            while !taken.insert(at) && at[0] + at[1] < SIDE - 1 {
                at[0] += 1;
            }
            sites.push(Site { at, point });
        }
        sites
    }
}

/// Adds a segment; what is in its way is told instead.
fn constrain(
    delaunay: &mut Delaunay,
    ends: [u32; 2],
    from: FixedVertexHandle,
    to: FixedVertexHandle,
    events: &mut Vec<Event>,
) {
    if from == to {
        return;
    }
    let path = delaunay.try_add_constraint(from, to);
    let on_the_way = path.iter().map(|e| delaunay.directed_edge(*e).to()).filter(|v| v.fix() != to);
    events.extend(on_the_way.map(|v| Event::Through(ends, v.data().point)));
    if path.is_empty() {
        let own = [from, to].map(|v| *delaunay.vertex(v).data());
        for edge in delaunay.get_conflicting_edges_between_vertices(from, to) {
            let other = edge.vertices().map(|v| *v.data());
            // Segments of one line seem to cross, too.
            let mut is_touched = false;
            for (line, tips) in [(own, other), (other, own)] {
                for tip in tips.iter().filter(|tip| is_near(line.map(|site| site.at), tip.at)) {
                    events.push(Event::Through(sorted(line), tip.point));
                    is_touched = true;
                }
            }
            if !is_touched {
                let (e, f) = (sorted(own), sorted(other));
                events.push(Event::Cross(e.min(f), e.max(f)));
            }
        }
    }
}

fn sorted([a, b]: [Site; 2]) -> [u32; 2] {
    [a.point.min(b.point), a.point.max(b.point)]
}

/// Tells the points that lie next to a segment.
fn near(
    delaunay: &Delaunay,
    ends: [u32; 2],
    from: FixedVertexHandle,
    to: FixedVertexHandle,
    events: &mut Vec<Event>,
) {
    let Some(edge) = delaunay.get_edge_from_neighbors(from, to) else { return };
    for side in [edge, edge.rev()] {
        let Some(opposite) = side.opposite_vertex() else { continue };
        if is_near([side.from().data().at, side.to().data().at], opposite.data().at) {
            events.push(Event::Through(ends, opposite.data().point));
        }
    }
}

/// Whether a place lies next to a segment, and between its ends.
fn is_near([a, b]: [[i64; 2]; 2], c: [i64; 2]) -> bool {
    let (along, off) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let length_squared = dot(along, along);
    let [x, y, u, v] = [along[0], along[1], off[0], off[1]].map(i128::from);
    let cross = (x * v - y * u) as f64;
    let share = dot(along, off);
    share > 0.0 && share < length_squared && cross * cross <= NEAR * NEAR * length_squared
}

fn dot(a: [i64; 2], b: [i64; 2]) -> f64 {
    (i128::from(a[0]) * i128::from(b[0]) + i128::from(a[1]) * i128::from(b[1])) as f64
}
