use crate::data::Cancelled;
use crate::math::{Aabb, Vec3};

/// Polylines along the field, kept so that another surface around the soup needs only new intersections (section 12.2).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldLines {
    /// The points of all lines, one line after the other.
    pub points: Vec<Vec3>,
    /// Line i is `points[offsets[i]..offsets[i + 1]]`: one more than there are lines, or none where there are no lines.
    pub offsets: Vec<u32>,
}

impl FieldLines {
    /// Number of lines.
    pub fn len(&self) -> usize {
        self.offsets.len().saturating_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The points of a line, from its start.
    pub fn line(&self, index: usize) -> &[Vec3] {
        &self.points[self.offsets[index] as usize..self.offsets[index + 1] as usize]
    }

    /// Adds a line.
    pub fn push(&mut self, points: &[Vec3]) {
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
        self.points.extend_from_slice(points);
        self.offsets.push(self.points.len() as u32);
    }
}

/// How a line is followed from a point to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Integrator {
    /// Explicit Euler (eq. 10), of order 1.
    Euler,
    /// The midpoint method, of order 2: two fields for each step.
    #[default]
    Midpoint,
}

/// How lines are followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineConfig {
    pub integrator: Integrator,
    /// Steps of a line, if nothing stops it before.
    pub steps: usize,
    /// Length of a step; `None`: such that all steps lead a tenth of the soup's diagonal away.
    pub step: Option<f64>,
    /// How far the second point of a line, where the field is first asked for, is from the start, along the direction that
    /// is given; `None`: a tenth of a step.
    pub start_offset: Option<f64>,
    /// Steps are shortened, down to 1/16, where the field turns more than this from one to the next, in radians. Lines get as far
    /// as by as many whole steps, and have more points. `None`: all steps are the same.
    pub largest_turn: Option<f64>,
    /// Lines end outside.
    pub bounds: Option<Aabb>,
}

impl Default for LineConfig {
    fn default() -> Self {
        LineConfig {
            integrator: Integrator::default(),
            steps: 100,
            step: None,
            start_offset: None,
            largest_turn: None,
            bounds: None,
        }
    }
}

/// Why lines cannot be followed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LineError {
    #[error("{starts} starts have {directions} directions: there has to be one for each")]
    Lengths { starts: usize, directions: usize },
    #[error("start {0} or its direction is not finite")]
    NonFinite(usize),
    #[error("{name} is {value}: it has to be finite and greater than 0")]
    BadLength { name: &'static str, value: f64 },
    #[error("{points} points are too many: at most 4,294,967,295 can be indexed")]
    TooManyPoints { points: usize },
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
