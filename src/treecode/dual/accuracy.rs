use std::f64::consts::PI;

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
    /// What the series of one cluster may leave out at a query, and a Taylor polynomial of it: an estimate from above.
    /// Clusters nearer than that allows are opened. Errors of many clusters have many signs: their sum is some times this.
    pub error: f64,
}

impl DualAccuracy {
    pub const FAST: DualAccuracy = DualAccuracy { order: 2, degree: 4, error: 1e-2 };
    pub const DEFAULT: DualAccuracy = DualAccuracy { order: 3, degree: 5, error: 2e-3 };
    pub const FINE: DualAccuracy = DualAccuracy { order: 3, degree: 5, error: 2e-4 };
    pub const FINER: DualAccuracy = DualAccuracy { order: 3, degree: 5, error: 1e-5 };

    /// The fastest parameters whose largest error, as measured on scans, is below a tolerance; none if only the direct sum is
    /// that exact. Not a guarantee: that is what the bounds of results are for.
    pub fn within(tolerance: f64) -> Option<DualAccuracy> {
        if tolerance.is_nan() || tolerance < FINEST {
            return None;
        }
        let error = ERROR_OF_TOLERANCE * libm::pow(1e3 * tolerance, POWER_OF_TOLERANCE);
        Some(if tolerance > COARSE {
            DualAccuracy { order: 2, degree: 4, error: 0.4 * error }
        } else {
            DualAccuracy { order: 3, degree: 5, error }
        })
    }

    /// The tolerance that this is for, and what bounded points, which act as dipoles on what is farther than `least` times
    /// their extents, may lack.
    pub(super) fn of_bounded_points(&self) -> BoundedPoints {
        let tolerance = 1e-3 * libm::pow(self.error / ERROR_OF_TOLERANCE, 1.0 / POWER_OF_TOLERANCE);
        let square = EXTENTS / tolerance;
        BoundedPoints { least: square.sqrt() as f32, lacking: (3.01 / (4.0 * PI * square)) as f32 }
    }

    /// What the field of a source near a block may lack.
    pub(super) fn of_source(&self) -> f32 {
        (SHARE_OF_SOURCE * self.error) as f32
    }

    /// The nearest parameters that make sense.
    pub(super) fn sane(self) -> DualAccuracy {
        DualAccuracy {
            order: self.order.min(super::MAX_ORDER),
            degree: self.degree.clamp(1, super::MAX_DEGREE),
            error: if self.error >= LEAST_ERROR { self.error } else { LEAST_ERROR },
        }
    }
}

/// From where on bounded points act as dipoles.
#[derive(Clone, Copy)]
pub(super) struct BoundedPoints {
    /// Distance in extents, √a.
    pub least: f32,
    /// What each lacks there, a share of a / 4πd² of its field: 3x² at most.
    pub lacking: f32,
}

const ERROR_OF_TOLERANCE: f64 = 1.6e-4;
const POWER_OF_TOLERANCE: f64 = 1.4;
/// Square of the distance in extents, over the tolerance: what bounded points lack altogether, up to 3a/4πd² (see the tree of
/// single points), is then no more than 0.7 of the tolerance.
const EXTENTS: f64 = 0.35;

/// Share of the error of a cluster that a single source may have. With 0.3 the largest error at a tolerance of 1e-3 is a fifth
/// larger, and no time is saved.
const SHARE_OF_SOURCE: f64 = 0.1;
/// 32-bit floats lose more.
const LEAST_ERROR: f64 = 1e-9;

// Largest errors on a lattice of 100³ over the bunny's triangles, over the same moved apart, and over its barycentres as
// dipoles (tests/bench/dual.rs); what is fitted above leaves a margin of 1.2 to 1.5:
//   order 3, degree 5: 8.8e-3, 7.1e-3 and 1.1e-2 for an error of 5.6e-3, 3.8e-3, 4.3e-3 and 4.9e-3 for 2e-3, 1.4e-3, 1.5e-3
//     and 1.5e-3 for 5e-4, 4.5e-4, 4.7e-4 and 5.1e-4 for 1e-4, 2.2e-4, 2.1e-4 and 1.9e-4 for 3e-5, 9.5e-5, 1.1e-4 and 9.8e-5
//     for 1e-5, 1.9e-5, 2.0e-5 and 1.8e-5 for 1e-6, 8.3e-6, 8.3e-6 and 7.7e-6 for 3e-7;
//   order 2, degree 4: 2.7e-2, 2.9e-2 and 3.5e-2 for 2e-2, 1.7e-2, 1.8e-2 and 1.9e-2 for 1e-2, 1.5e-2, 1.2e-2 and 1.3e-2 for
//     5e-3; over the barycentres of a knotted tube 2.9e-2 for 1e-2, so that the margin there is 1.05 for a tolerance of 3e-2.

/// Below this tolerance 32-bit floats, which lose some 3e-6, are not good enough.
const FINEST: f64 = 1e-5;
/// Above this tolerance short series are fastest.
const COARSE: f64 = 1.5e-2;

impl Default for DualAccuracy {
    fn default() -> Self {
        DualAccuracy::DEFAULT
    }
}
