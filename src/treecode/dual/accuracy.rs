/// How exactly a [`super::DualTree`] answers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DualAccuracy {
    /// Of the multipole series, 0 to 3: degrees 1 to `order` + 1 are summed.
    pub order: usize,
    /// Of the Taylor polynomials, 1 to 5.
    pub degree: usize,
    /// Distance, in radii of a cluster, from which its multipole series is used.
    pub beta: f64,
    /// Distance, in radii of a block of queries, from which a Taylor polynomial serves all of it.
    pub eta: f64,
}

impl DualAccuracy {
    pub const FAST: DualAccuracy = DualAccuracy { order: 2, degree: 4, beta: 1.5, eta: 1.5 };
    pub const DEFAULT: DualAccuracy = DualAccuracy { order: 2, degree: 4, beta: 2.0, eta: 2.0 };
    pub const FINE: DualAccuracy = DualAccuracy { order: 2, degree: 4, beta: 2.5, eta: 3.0 };
    pub const FINER: DualAccuracy = DualAccuracy { order: 3, degree: 5, beta: 3.0, eta: 3.5 };

    /// The nearest parameters that make sense: the series converge for β and η above 1.
    pub(super) fn sane(self) -> DualAccuracy {
        let at_least = |x: f64| if x >= NEAREST { x } else { NEAREST };
        DualAccuracy {
            order: self.order.min(super::MAX_ORDER),
            degree: self.degree.clamp(1, super::MAX_DEGREE),
            beta: at_least(self.beta),
            eta: at_least(self.eta),
        }
    }
}

/// Closer to 1 the error bounds become useless.
const NEAREST: f64 = 1.05;

impl Default for DualAccuracy {
    fn default() -> Self {
        DualAccuracy::DEFAULT
    }
}
