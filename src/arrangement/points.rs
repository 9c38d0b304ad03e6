//! The points of an arrangement: the given vertices, and those that are made, each once.
use super::cells::Cells;
use super::contacts::Key;
use crate::data::map_items;
use crate::math::{Place, Twofold, Vec3};

/// Vertices by number: first those given, then those made, in twice the precision. None is made next to one that was named or made.
pub struct Points {
    positions: Vec<Vec3>,
    given: usize,
    made: Vec<Place>,
    cells: Cells,
    /// Coordinates of points that are made are 0 when they are smaller.
    least: f64,
}

/// Of the largest coordinate: far below where rounding to single precision tells values apart, far above errors of twice that.
const LEAST: f64 = 1e-27;

impl Points {
    pub fn new(positions: Vec<Vec3>) -> Points {
        let largest = positions.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        Points {
            given: positions.len(),
            positions,
            made: Vec::new(),
            cells: Cells::default(),
            least: LEAST * largest,
        }
    }

    /// Makes a given vertex one that new points can fall on.
    pub fn name(&mut self, vertex: u32) {
        let place = self.positions[vertex as usize];
        if self.cells.nearest(place, &self.positions).is_none_or(|(off, _)| off > 0.0) {
            self.cells.insert(place, vertex);
        }
    }

    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    pub fn into_positions(self) -> Vec<Vec3> {
        self.positions
    }

    #[inline]
    pub fn at(&self, point: u32) -> Place {
        match (point as usize).checked_sub(self.given) {
            Some(made) => self.made[made],
            None => self.positions[point as usize].into(),
        }
    }

    /// The point next to that place, made if there is none; nothing if the place is not finite.
    pub fn add(&mut self, place: Place) -> Option<u32> {
        if !place.is_finite() {
            return None;
        }
        let cleared = |x: Twofold| if x.high.abs() < self.least { Twofold::default() } else { x };
        let place = Place(place.0.map(cleared));
        let rounded = place.rounded();
        if let Some((_, number)) = self.cells.nearest(rounded, &self.positions) {
            return Some(number);
        }
        let number = self.positions.len() as u32;
        self.positions.push(rounded);
        self.made.push(place);
        self.cells.insert(rounded, number);
        Some(number)
    }

    /// The points of sorted keys.
    pub fn resolve(&mut self, keys: &[Key], corners: &[[u32; 3]]) -> Vec<Option<u32>> {
        let places = map_items(keys.len(), |i| match keys[i] {
            Key::Vertex(_) => Place::default(),
            Key::Edges(e, f) => self.crossing(e, f),
            Key::Face(e, triangle) => self.piercing(e, corners[triangle as usize]),
        });
        let add = |(key, place): (&Key, Place)| match key {
            Key::Vertex(v) => Some(*v),
            _ => self.add(place),
        };
        keys.iter().zip(places).map(add).collect()
    }

    /// Where the segments between two pairs of points of one plane cross: a share of the way along the first.
    pub fn share(&self, e: [u32; 2], f: [u32; 2]) -> Twofold {
        let ([a, b], [c, d]) = (e.map(|v| self.at(v)), f.map(|v| self.at(v)));
        let (along, other, between) = (b.minus(a), d.minus(c), c.minus(a));
        let normal = along.cross(other);
        let k = normal.dominant();
        between.cross_component(other, k) / normal.0[k]
    }

    fn crossing(&self, e: [u32; 2], f: [u32; 2]) -> Place {
        self.between(e, self.share(e, f))
    }

    pub fn between(&self, [a, b]: [u32; 2], share: Twofold) -> Place {
        let [a, b] = [a, b].map(|v| self.at(v));
        a.plus_scaled(share, b.minus(a))
    }

    /// Where an edge goes through the plane of a triangle.
    fn piercing(&self, e: [u32; 2], corners: [u32; 3]) -> Place {
        let mut corners = corners;
        corners.sort();
        let [p, q, r] = corners.map(|v| self.at(v));
        let [a, b] = e.map(|v| self.at(v));
        let normal = q.minus(p).cross(r.minus(p));
        let along = b.minus(a);
        a.plus_scaled(normal.dot(p.minus(a)) / normal.dot(along), along)
    }

    /// The share of the way from a to b at which a point of the line through them lies.
    pub fn share_at(&self, [a, b]: [u32; 2], point: u32) -> Twofold {
        let [a, b, p] = [a, b, point].map(|v| self.at(v));
        let along = b.minus(a);
        let k = along.dominant();
        p.minus(a).0[k] / along.0[k]
    }
}
