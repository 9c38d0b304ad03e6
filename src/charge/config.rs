use super::elements::Refinement;
use super::influence::Integration;
use super::walk::Opening;
use crate::data::{Cancelled, OutOfMemory};

/// How charges are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Solver {
    /// GMRES (Saad & Schultz 1986).
    #[default]
    Krylov,
    /// Exchanges between the two triangles with the highest and the lowest potential (Lazić et al. 2006): the paper's.
    RobinHood,
}

/// How a conductor is charged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChargeConfig {
    pub solver: Solver,
    /// Largest deviation of the potential at a barycentre from the mean, relative to that, at which the solver stops.
    pub tolerance: f64,
    /// Most steps of the Robin Hood method.
    pub most_steps: usize,
    pub integration: Integration,
    /// How triangles are cut up; `None`: not at all.
    pub refinement: Option<Refinement>,
    /// What of the field is summed by clusters.
    pub opening: Opening,
    /// The charge of the whole soup. Only the size of the field depends on it.
    pub total: f64,
}

impl Default for ChargeConfig {
    fn default() -> Self {
        ChargeConfig {
            solver: Solver::default(),
            tolerance: 1e-6,
            most_steps: 1_000_000,
            integration: Integration::default(),
            refinement: Some(Refinement::default()),
            opening: Opening::default(),
            total: 1.0,
        }
    }
}

/// Why a soup cannot be charged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ChargeError {
    #[error("none of the {triangles} triangles of the soup has an area")]
    NoArea { triangles: usize },
    #[error("{name} is {value}: it has to be {accepted}")]
    BadNumber { name: &'static str, value: f64, accepted: &'static str },
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl ChargeConfig {
    /// Whether a soup can be charged so.
    ///
    /// # Errors
    /// If and only if a number is out of its range.
    pub fn check(&self) -> Result<(), ChargeError> {
        let within = |name, value: f64, is_good: bool, accepted| {
            if is_good { Ok(()) } else { Err(ChargeError::BadNumber { name, value, accepted }) }
        };
        let Opening { beta, near } = self.opening;
        // From 1 on no charge at all would do.
        let is_share = self.tolerance > 0.0 && self.tolerance < 1.0;
        within("tolerance", self.tolerance, is_share, "greater than 0 and less than 1")?;
        within("total", self.total, self.total.is_finite() && self.total != 0.0, "finite and not 0")?;
        within("beta", beta, beta >= 1.0, "1 or more")?;
        within("near", near, near >= 1.0, "1 or more")
    }
}

/// How the charges were found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ChargeReport {
    /// Elements that were charged: triangles with an area and the parts of large ones.
    pub elements: usize,
    /// Triangles without an area, which have no charge.
    pub flat: usize,
    /// Steps of the solver.
    pub steps: usize,
    /// Largest deviation of the potential at a barycentre from the mean, relative to that.
    pub deviation: f64,
    /// Whether that is as small as [`ChargeConfig::tolerance`] asks for. The solver stops before where further steps do not
    /// lessen it: by the tree at what potentials by the tree are wrong, and after the most steps.
    pub reached: bool,
    /// The potential of the surface.
    pub potential: f64,
}
