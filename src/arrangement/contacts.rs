//! How two triangles meet, by exact predicates: points named by what makes them, and segments between these.
use crate::data::edge_between;
use crate::math::{Sign, Vec2, Vec3, normal_signs, orient, side_of_plane};

/// What makes a point: the same for every pair of triangles that has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    Vertex(u32),
    /// Two edges that cross, each with its lower vertex first, the lower edge first.
    Edges([u32; 2], [u32; 2]),
    /// An edge that goes through the inside of a triangle.
    Face([u32; 2], u32),
}

/// What pairs of triangles have in common.
#[derive(Clone, Debug, Default)]
pub struct Contacts {
    /// Points inside edges.
    pub on_edges: Vec<([u32; 2], Key)>,
    /// Points inside triangles.
    pub inside: Vec<(u32, Key)>,
    /// What two triangles have in common, or an edge of one and the other in its plane.
    pub segments: Vec<([Key; 2], [u32; 2])>,
    /// Pairs that overlap in a plane, the lower triangle first.
    pub coplanar: Vec<[u32; 2]>,
}

/// Where on a triangle a point lies; edge k leads from corner k to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Spot {
    Corner,
    Edge(usize),
    Inside,
}

/// A point that an edge and a triangle have in common.
#[derive(Clone, Copy, Debug)]
struct Hit {
    key: Key,
    /// Whether it lies between the ends of the edge.
    is_between: bool,
    spot: Spot,
}

/// Triangles to be met.
pub struct Triangles<'a> {
    pub positions: &'a [Vec3],
    pub corners: &'a [[u32; 3]],
}

pub fn edge(corners: [u32; 3], k: usize) -> [u32; 2] {
    edge_between(corners[k], corners[(k + 1) % 3])
}

impl Triangles<'_> {
    fn at(&self, vertex: u32) -> Vec3 {
        self.positions[vertex as usize]
    }

    fn places(&self, triangle: u32) -> [Vec3; 3] {
        self.corners[triangle as usize].map(|v| self.at(v))
    }

    /// Adds what two triangles, neither without area, have in common beside whole vertices and edges. An edge that they share is a segment
    /// where `keeps_shared_edges`.
    pub fn meet(&self, pair: [u32; 2], keeps_shared_edges: bool, contacts: &mut Contacts) {
        let corners = pair.map(|t| self.corners[t as usize]);
        let places = pair.map(|t| self.places(t));
        let sides = [1, 0].map(|of| places[1 - of].map(|p| side_of_plane(p, places[of])));
        // sides[0]: of the first triangle's corners to the second's plane; sides[1] the other way round.
        if sides.iter().any(|s| s.iter().all(|side| *side > 0) || s.iter().all(|side| *side < 0)) {
            return;
        }
        let shared: Vec<u32> = corners[0].into_iter().filter(|v| corners[1].contains(v)).collect();
        let is_coplanar = sides[0] == [0; 3] && sides[1] == [0; 3];
        if shared.len() == 3 {
            contacts.coplanar.push(pair);
            if keeps_shared_edges {
                (0..3).for_each(|k| contacts.segment(edge(corners[0], k).map(Key::Vertex), pair));
            }
            return;
        }
        if shared.len() == 2 && keeps_shared_edges {
            contacts.segment([Key::Vertex(shared[0]), Key::Vertex(shared[1])], pair);
        }
        if shared.len() == 2 && !is_coplanar {
            return;
        }
        let is_shared = |key: Key| matches!(key, Key::Vertex(v) if shared.contains(&v));
        let mut common: Vec<Key> = Vec::new();
        let mut touches = false;
        for (of, other) in [(0, 1), (1, 0)] {
            for k in 0..3 {
                let ends = [k, (k + 1) % 3];
                let hits = self.hits(ends.map(|k| corners[of][k]), ends.map(|k| sides[of][k]), pair[other]);
                let hits: Vec<Hit> = hits.into_iter().flatten().collect();
                for hit in &hits {
                    if hit.is_between {
                        contacts.on_edges.push((edge(corners[of], k), hit.key));
                    }
                    match hit.spot {
                        Spot::Edge(m) => contacts.on_edges.push((edge(corners[other], m), hit.key)),
                        Spot::Inside => contacts.inside.push((pair[other], hit.key)),
                        Spot::Corner => {}
                    }
                    touches |= !is_shared(hit.key);
                    common.push(hit.key);
                }
                if is_coplanar && hits.len() == 2 && !(is_shared(hits[0].key) && is_shared(hits[1].key)) {
                    contacts.segment([hits[0].key, hits[1].key], pair);
                }
            }
        }
        if is_coplanar && touches {
            contacts.coplanar.push(pair);
        }
        common.sort();
        common.dedup();
        if !is_coplanar && common.len() == 2 && !(is_shared(common[0]) && is_shared(common[1])) {
            contacts.segment([common[0], common[1]], pair);
        }
    }

    /// The ends of what an edge and a triangle have in common: none, one point or two. `sides` are those of the ends to
    /// the triangle's plane.
    fn hits(&self, [a, b]: [u32; 2], sides: [Sign; 2], triangle: u32) -> [Option<Hit>; 2] {
        match sides {
            [0, 0] => self.hits_in_plane([a, b], triangle),
            [0, _] => [self.end_hit(a, triangle), None],
            [_, 0] => [self.end_hit(b, triangle), None],
            [s, t] if s == t => [None; 2],
            _ => [self.crossing(edge_between(a, b), triangle), None],
        }
    }

    /// Where an edge goes through a triangle; its ends lie on different sides.
    fn crossing(&self, ends: [u32; 2], triangle: u32) -> Option<Hit> {
        let corners = self.corners[triangle as usize];
        let [a, b] = ends.map(|v| self.at(v));
        let side = |k: usize| side_of_plane(self.at(corners[(k + 1) % 3]), [a, b, self.at(corners[k])]);
        let sides = [side(0), side(1), side(2)];
        if sides.contains(&1) && sides.contains(&-1) {
            return None;
        }
        let on: Vec<usize> = (0..3).filter(|k| sides[*k] == 0).collect();
        let (key, spot) = match on[..] {
            [] => (Key::Face(ends, triangle), Spot::Inside),
            [k] => (crossed(ends, edge(corners, k)), Spot::Edge(k)),
            // Edges 0 and 1 share corner 1, 1 and 2 corner 2, 2 and 0 corner 0.
            [0, 1] => (Key::Vertex(corners[1]), Spot::Corner),
            [1, 2] => (Key::Vertex(corners[2]), Spot::Corner),
            _ => (Key::Vertex(corners[0]), Spot::Corner),
        };
        Some(Hit { key, is_between: true, spot })
    }

    /// A vertex in the plane of a triangle, if the triangle holds it.
    fn end_hit(&self, vertex: u32, triangle: u32) -> Option<Hit> {
        let corners = self.corners[triangle as usize];
        let key = Key::Vertex(vertex);
        if corners.contains(&vertex) {
            return Some(Hit { key, is_between: false, spot: Spot::Corner });
        }
        let (flat, facing) = self.flattened(triangle)?;
        let q = flat(self.at(vertex));
        let side =
            |k: usize| facing * orient(flat(self.at(corners[k])), flat(self.at(corners[(k + 1) % 3])), q);
        let sides = [side(0), side(1), side(2)];
        if sides.contains(&-1) {
            return None;
        }
        let spot = match (0..3).find(|k| sides[*k] == 0) {
            Some(k) => Spot::Edge(k),
            None => Spot::Inside,
        };
        Some(Hit { key, is_between: false, spot })
    }

    fn hits_in_plane(&self, ends: [u32; 2], triangle: u32) -> [Option<Hit>; 2] {
        let mut found = [None, None];
        let mut add = |hit: Option<Hit>| match (hit, &found) {
            (Some(new), [None, _]) => found[0] = Some(new),
            (Some(new), [Some(first), None]) if first.key != new.key => found[1] = Some(new),
            _ => {}
        };
        ends.into_iter().for_each(|v| add(self.end_hit(v, triangle)));
        let Some((flat, _)) = self.flattened(triangle) else { return found };
        let corners = self.corners[triangle as usize];
        let [a, b] = ends.map(|v| flat(self.at(v)));
        let tips = corners.map(|v| flat(self.at(v)));
        let sides = tips.map(|tip| orient(a, b, tip));
        for k in (0..3).filter(|k| sides[*k] == 0 && !ends.contains(&corners[*k])) {
            let [low, middle, high] = [ends[0], corners[k], ends[1]].map(|v| self.at(v).to_array());
            if (low < middle) == (middle < high) {
                add(Some(Hit { key: Key::Vertex(corners[k]), is_between: true, spot: Spot::Corner }));
            }
        }
        for k in 0..3 {
            let next = (k + 1) % 3;
            let is_crossed = sides[k] * sides[next] < 0
                && orient(tips[k], tips[next], a) * orient(tips[k], tips[next], b) < 0;
            if is_crossed {
                let key = crossed(edge_between(ends[0], ends[1]), edge(corners, k));
                add(Some(Hit { key, is_between: true, spot: Spot::Edge(k) }));
            }
        }
        found
    }

    /// A projection of a triangle to a plane in which it has an area, and the sign of that.
    fn flattened(&self, triangle: u32) -> Option<(impl Fn(Vec3) -> Vec2, Sign)> {
        let normal = normal_signs(self.places(triangle));
        let axis = (0..3).find(|axis| normal[*axis] != 0)?;
        Some((move |p: Vec3| Vec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]), normal[axis]))
    }
}

fn crossed(e: [u32; 2], f: [u32; 2]) -> Key {
    Key::Edges(e.min(f), e.max(f))
}

impl Contacts {
    fn segment(&mut self, mut ends: [Key; 2], pair: [u32; 2]) {
        ends.sort();
        self.segments.push((ends, pair));
    }

    pub fn is_empty(&self) -> bool {
        self.on_edges.is_empty()
            && self.inside.is_empty()
            && self.segments.is_empty()
            && self.coplanar.is_empty()
    }

    pub fn extend(&mut self, other: Contacts) {
        self.on_edges.extend(other.on_edges);
        self.inside.extend(other.inside);
        self.segments.extend(other.segments);
        self.coplanar.extend(other.coplanar);
    }
}
