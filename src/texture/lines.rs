//! The field lines of a soup, kept so that another proxy needs only new intersections (Schier et al. 2018, section 12.2).
use super::Starts;
use crate::charge::{ChargeConfig, ChargeError, ElectricField, FieldLines, LineConfig, LineError, trace};
use crate::data::{Cancelled, Monitor, Parts, TriangleSoup, ascending};
use crate::math::Vec3;
use std::sync::Arc;

/// How a soup is charged and its lines are followed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SoupLinesConfig {
    pub charge: ChargeConfig,
    pub line: LineConfig,
}

/// Why there are no lines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SoupLinesError {
    #[error(transparent)]
    Charge(#[from] ChargeError),
    #[error(transparent)]
    Line(#[from] LineError),
}

impl SoupLinesConfig {
    /// Whether soups can be charged and lines followed so.
    ///
    /// # Errors
    /// If and only if an option is out of range.
    pub fn check(&self) -> Result<(), SoupLinesError> {
        self.charge.check()?;
        Ok(self.line.check()?)
    }
}

impl From<Cancelled> for SoupLinesError {
    fn from(cancelled: Cancelled) -> SoupLinesError {
        SoupLinesError::Line(cancelled.into())
    }
}

/// The lines of all corners of a soup.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SoupLines {
    pub starts: Starts,
    /// One for each start.
    pub lines: FieldLines,
    /// How strong the field is next to each start, in medians of all: near 0 in narrow places and inside.
    pub strength: Vec<f64>,
}

impl SoupLines {
    /// Charges the soup and follows the lines of the field from all its corners.
    ///
    /// # Errors
    /// If and only if no triangle has an area, an option is out of range, lines have more points than fit, or the monitor cancels.
    pub fn new(
        soup: &Arc<TriangleSoup>,
        config: &SoupLinesConfig,
        monitor: &dyn Monitor,
    ) -> Result<SoupLines, SoupLinesError> {
        config.check()?;
        let starts = Starts::new(soup);
        config.line.check_for(starts.points.len())?;
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, 0.4);
        let field = ElectricField::solve(soup.clone(), &config.charge, monitor)?;
        monitor.begin(0.4, 1.0);
        SoupLines::from(starts, &field, &config.line, monitor)
    }

    /// Follows the lines of a field that is there.
    ///
    /// # Errors
    /// If and only if an option is out of range, or the monitor cancels.
    pub fn of_field(
        field: &ElectricField,
        config: &LineConfig,
        monitor: &dyn Monitor,
    ) -> Result<SoupLines, SoupLinesError> {
        SoupLines::from(Starts::new(field.soup()), field, config, monitor)
    }

    fn from(
        starts: Starts,
        field: &ElectricField,
        config: &LineConfig,
        monitor: &dyn Monitor,
    ) -> Result<SoupLines, SoupLinesError> {
        let lines = trace(field, &starts.points, &starts.normals, config, monitor)?;
        let beside: Vec<Vec3> =
            (0..starts.points.len() as u32).map(|start| starts.beside(start, field.soup())).collect();
        let sizes: Vec<f64> = field.field(&beside).iter().map(|f| f.length()).collect();
        let order = ascending(sizes.iter().copied());
        let median = order.get(order.len() / 2).map_or(1.0, |k| sizes[*k as usize]);
        let median = if median > 0.0 { median } else { 1.0 };
        let strength = sizes.iter().map(|size| size / median).collect();
        Ok(SoupLines { starts, lines, strength })
    }
}
