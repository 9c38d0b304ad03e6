use crate::data::{Cancelled, OutOfMemory};
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
    /// Steps of a line, if nothing stops it before: [`LineConfig::MOST_STEPS`] at most.
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
    #[error("the {name} of lines is {value} mm: it has to be finite and greater than 0")]
    BadLength { name: &'static str, value: f64 },
    #[error("lines cannot turn by {} degrees: a finite angle greater than 0 is needed", .radians.to_degrees())]
    BadTurn { radians: f64 },
    #[error("lines of {0} steps are too long: {most} are possible at most", most = LineConfig::MOST_STEPS)]
    TooManySteps(usize),
    #[error("{points} points are too many: at most 4,294,967,295 can be indexed")]
    TooManyPoints { points: usize },
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl LineConfig {
    pub const MOST_STEPS: usize = 1_000_000;

    /// Whether lines can be followed so.
    ///
    /// # Errors
    /// If and only if a length or the turn is not finite and greater than 0, or there are too many steps.
    pub fn check(&self) -> Result<(), LineError> {
        let is_good = |value: f64| value.is_finite() && value > 0.0;
        for (name, length) in [("step", self.step), ("start offset", self.start_offset)] {
            if let Some(value) = length.filter(|length| !is_good(*length)) {
                return Err(LineError::BadLength { name, value });
            }
        }
        match (self.largest_turn, self.steps) {
            (Some(radians), _) if !is_good(radians) => Err(LineError::BadTurn { radians }),
            (_, steps) if steps > LineConfig::MOST_STEPS => Err(LineError::TooManySteps(steps)),
            _ => Ok(()),
        }
    }

    /// Whether so many lines can be followed so to the end: [`LineConfig::check`], and whether their points can be counted and kept.
    ///
    /// # Errors
    /// Those of [`LineConfig::check`], and if there are too many points or memory does not suffice for them.
    pub fn check_for(&self, lines: usize) -> Result<(), LineError> {
        self.check()?;
        let points = lines.saturating_mul(self.steps.saturating_add(2));
        if u32::try_from(points).is_err() {
            return Err(LineError::TooManyPoints { points });
        }
        // Refused now rather than after most of them have been found.
        let bytes = points.saturating_mul(size_of::<Vec3>());
        Vec::<Vec3>::new().try_reserve_exact(points).map_err(|_| OutOfMemory { bytes })?;
        Ok(())
    }
}
