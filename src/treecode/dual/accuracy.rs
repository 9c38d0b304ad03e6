/// What sources are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SourceKind {
    Triangles,
    Points,
}

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

    /// The fastest parameters whose largest error, as measured on scans, is below a tolerance: for triangles, or for points.
    /// None if only the direct sum is that exact. Not a guarantee: that is what the bounds of results are for.
    pub fn within(tolerance: f64, kind: SourceKind) -> Option<DualAccuracy> {
        let error = |(_, triangles, points): &(DualAccuracy, f64, f64)| match kind {
            SourceKind::Triangles => *triangles,
            SourceKind::Points => *points,
        };
        LADDER.iter().find(|step| MARGIN * error(step) <= tolerance).map(|step| step.0)
    }

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

/// Parameters and the largest errors seen with them, of triangles and of points: of the Stanford bunny with its triangles as
/// they are and moved apart, and of every second of its barycentres, against the last step at all samples of lattices of 32 to 100
/// cells; of the last step, against direct sums at 200 samples, of which the largest is doubled. Dipoles are worse as their fields have poles. What 32-bit floats cost is some 3e-6.
const LADDER: [(DualAccuracy, f64, f64); 8] = [
    (DualAccuracy::FAST, 1.7e-2, 2.4e-1),
    (DualAccuracy::DEFAULT, 5.6e-3, 1.3e-1),
    (DualAccuracy::FINE, 1.2e-3, 1.7e-2),
    (DualAccuracy::FINER, 2.7e-4, 5.1e-3),
    (DualAccuracy { order: 3, degree: 5, beta: 4.0, eta: 4.5 }, 7.6e-5, 9.5e-4),
    (DualAccuracy { order: 3, degree: 5, beta: 5.0, eta: 6.0 }, 3.1e-5, 2.5e-4),
    (DualAccuracy { order: 3, degree: 5, beta: 7.0, eta: 9.0 }, 8e-6, 4.5e-5),
    (DualAccuracy { order: 3, degree: 5, beta: 10.0, eta: 12.0 }, 6e-6, 6e-6),
];
/// How much larger errors are allowed for than those seen.
const MARGIN: f64 = 1.5;

/// Closer to 1 the error bounds become useless.
const NEAREST: f64 = 1.05;

impl Default for DualAccuracy {
    fn default() -> Self {
        DualAccuracy::DEFAULT
    }
}
