//! What is traced: the shape grown, shrunk or hollowed, as a function of space that is positive within.
use super::cylinder::Cylinder;
use crate::data::{Monitor, fill_blocks, fill_in_blocks};
use crate::distance::{DistanceTree, Search};
use crate::levelset::{Edge, LevelSet, TraceError};
use crate::math::Vec3;
use crate::winding::{Scratch, THRESHOLD, WindingField};

/// Nodes that make a task.
const RUN: usize = 64;
/// A vertex serves where the function is as small as this, in cells.
const CLOSE: f64 = 1e-5;
/// Steps toward it: half of them halve the interval, as the distance jumps where openings are.
const STEPS: usize = 40;
/// What is this near to the surface, in cells, takes its normal from there.
const ON_SURFACE: f64 = 1e-4;

/// What of the shape is kept.
#[derive(Clone, Copy, Debug)]
pub enum Kept {
    /// Where the signed distance is at most this.
    UpTo(f64),
    /// What is inside, no deeper than this.
    Shell(f64),
    /// Where the distance, without a sign, is at most this.
    Near(f64),
}

impl Kept {
    /// The value at an unsigned distance; nothing if it depends on the side.
    fn value(self, distance: f64) -> Option<f64> {
        match self {
            Kept::UpTo(limit) if distance <= limit.abs() => {
                Some(if limit < 0.0 { limit + distance } else { limit - distance })
            }
            Kept::Near(limit) => Some(limit - distance),
            _ => None,
        }
    }

    /// The value inside or outside.
    fn value_of_side(self, distance: f64, inside: bool) -> f64 {
        match (self, inside) {
            (Kept::UpTo(limit), true) => limit + distance,
            (Kept::UpTo(limit), false) => limit - distance,
            (Kept::Shell(depth), true) => distance.min(depth - distance),
            (Kept::Shell(_), false) => 0.0 - distance,
            (Kept::Near(limit), _) => limit - distance,
        }
    }

    /// Whether its surface away from the shape is inside.
    pub fn is_within(self) -> bool {
        match self {
            Kept::UpTo(limit) => limit < 0.0,
            Kept::Shell(_) => true,
            Kept::Near(_) => false,
        }
    }

    /// Whether its surface away from the shape is on one side alone.
    pub fn has_one_side(self) -> bool {
        !matches!(self, Kept::Near(_))
    }

    /// Distances at which it begins or ends.
    pub fn distances(self) -> Vec<f64> {
        match self {
            Kept::UpTo(limit) => vec![limit.abs()],
            Kept::Shell(depth) => vec![0.0, depth],
            Kept::Near(limit) => vec![limit],
        }
    }
}

/// The part of space that is traced.
pub struct Region<'a> {
    pub field: &'a WindingField,
    pub tree: DistanceTree,
    pub kept: Kept,
    /// What is taken away.
    pub drains: Vec<Cylinder>,
    /// Edge of a cell.
    pub spacing: f64,
}

/// Scratch space.
#[derive(Default)]
pub struct Probe {
    pub search: Search,
    pub scratch: Scratch,
}

impl Region<'_> {
    fn distance(&self, q: Vec3, search: &mut Search) -> f64 {
        self.tree.distance_within(q, f64::INFINITY, search).unwrap_or(f64::INFINITY)
    }

    fn without_drains(&self, q: Vec3, value: f64) -> f64 {
        self.drains.iter().fold(value, |value, drain| value.min(drain.distance(q)))
    }

    /// Positive within: near the surface of the region, how deep.
    pub fn value(&self, q: Vec3, probe: &mut Probe) -> f64 {
        let distance = self.distance(q, &mut probe.search);
        let value = self.kept.value(distance).unwrap_or_else(|| {
            let inside = self.field.is_nearly_above(q, THRESHOLD, &mut probe.scratch);
            self.kept.value_of_side(distance, inside)
        });
        self.without_drains(q, value)
    }

    /// The unit normal, outward, of the region's surface next to `q`; of unknown sign right next to the shape's own triangles. Zero
    /// where there is none.
    pub fn normal(&self, q: Vec3, probe: &mut Probe) -> Vec3 {
        let Some(found) = self.tree.closest_within(q, f64::INFINITY, &mut probe.search) else {
            return Vec3::ZERO;
        };
        let value = self.value(q, probe);
        if let Some(drain) = self.drains.iter().find(|drain| drain.distance(q) <= value) {
            return drain.normal(q);
        }
        if found.distance <= ON_SURFACE * self.spacing {
            return self.tree.normal(found.element);
        }
        let away = (q - found.point).normalize_or_zero();
        let is_outward = match self.kept {
            Kept::UpTo(limit) => limit >= 0.0,
            Kept::Near(_) => true,
            // Its inner side faces what is deeper, its outer one is met from either side.
            Kept::Shell(depth) => {
                found.distance > 0.5 * depth || !self.field.is_nearly_above(q, THRESHOLD, &mut probe.scratch)
            }
        };
        if is_outward { away } else { -away }
    }

    /// Where between 0 and 1 on an edge the value vanishes: by false position and halving in turns.
    fn crossing(&self, edge: &Edge, probe: &mut Probe) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let [mut at_low, mut at_high] = edge.ends.map(f64::from);
        let mut guess = edge.interpolated();
        for step in 0..STEPS {
            let value = self.value(edge.at(guess), probe);
            if value.abs() <= CLOSE * self.spacing || high - low <= CLOSE {
                break;
            }
            if value.is_sign_positive() == at_low.is_sign_positive() {
                (low, at_low) = (guess, value);
            } else {
                (high, at_high) = (guess, value);
            }
            let share = if step % 2 == 1 || at_low == at_high { 0.5 } else { at_low / (at_low - at_high) };
            guess = low + share.clamp(0.0, 1.0) * (high - low);
        }
        guess
    }
}

impl LevelSet for Region<'_> {
    fn takes_bricks(&self) -> bool {
        false
    }

    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        let mut distances = vec![0.0; points.len()];
        let measure = |first: usize, run: &mut [f64], search: &mut Search| {
            run.iter_mut().zip(&points[first..]).for_each(|(d, q)| *d = self.distance(*q, search));
        };
        fill_blocks(&mut distances, RUN, measure, "surface cells", monitor)?;
        let asked: Vec<Vec3> = points
            .iter()
            .zip(&distances)
            .filter(|(_, d)| self.kept.value(**d).is_none())
            .map(|(q, _)| *q)
            .collect();
        let inside = self.field.classify(&asked, THRESHOLD, monitor)?;
        let mut inside = inside.into_iter();
        let value = |(q, d): (&Vec3, &f64)| {
            let side = || self.kept.value_of_side(*d, inside.next().unwrap_or(false));
            let value = self.kept.value(*d).unwrap_or_else(side);
            self.without_drains(*q, value) as f32
        };
        Ok(points.iter().zip(&distances).map(value).collect())
    }

    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        let mut crossings = vec![0.0; edges.len()];
        let find = |i: usize, probe: &mut Probe| self.crossing(&edges[i], probe);
        fill_in_blocks(&mut crossings, find, "surface vertices", monitor)?;
        Ok(crossings)
    }
}
