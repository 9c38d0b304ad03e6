/// Largest error of order 2 on a lattice over the bounds: `at_two` (2 / β)⁴. Measured with a margin of 1.5 to 2 at β = 2,
/// more above, where it falls a little faster: on the Stanford bunny 3.8e-3, 6.3e-4, 1.4e-4, 2.4e-5 at β = 2, 3, 4, 6; on a
/// cloud of 35k of its barycentres 1.8e-2 (2.7e-2 with leaves of 4), 2.0e-3, 4.6e-4, 7.4e-5.
#[derive(Clone, Copy)]
pub struct ErrorModel {
    at_two: f64,
}

impl ErrorModel {
    pub fn beta(&self, error: f64) -> f64 {
        2.0 * (self.at_two / error).sqrt().sqrt().max(1.0)
    }
}

pub const SOUP_ERROR: ErrorModel = ErrorModel { at_two: 8e-3 };
pub const CLOUD_ERROR: ErrorModel = ErrorModel { at_two: 3e-2 };
