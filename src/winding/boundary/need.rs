//! What the field of a boundary is needed for, and which errors that allows.

/// The tolerance that an "exact" field is interpolated to. On wavy circles its largest error is 4e-13.
const EXACT: f64 = 4e-12;
/// Bounds of interpolation errors are at least this many times what is seen, 2 to 8 times more on wavy circles and bunny: used
/// where an error is promised but no proof.
const MARGIN: f64 = 100.0;
/// The same of rounding to 32 bits, which is to different sides for different edges.
const ROUNDING_MARGIN: f64 = 1000.0;
/// Where less is asked for, 32-bit floats are not considered.
const LEAST_ROUNDING: f64 = 1e-6;
/// The share of a proven error that is left to 32-bit floats: bounds of interpolation fall fast with more nodes, those of
/// rounding do not; and the least error for which they are considered.
const ROUNDING_OF_SIDES: f64 = 0.75;
const LEAST_ROUNDING_OF_SIDES: f64 = 1e-4;

/// What fractions are needed for.
#[derive(Clone, Copy, Debug)]
pub enum Need {
    /// Values, to a tolerance.
    Value { tolerance: f64 },
    /// Which numbers added to them reach a threshold: where it matters to within an error, which is proven.
    Side { threshold: f64, error: f64 },
}

impl Need {
    pub fn allowance(self) -> Allowance {
        match self {
            Need::Value { tolerance } => Allowance {
                interpolation: MARGIN * tolerance.max(EXACT),
                rounding: if tolerance < LEAST_ROUNDING { 0.0 } else { ROUNDING_MARGIN * tolerance },
            },
            Need::Side { error, .. } => {
                let rounding = if error < LEAST_ROUNDING_OF_SIDES { 0.0 } else { ROUNDING_OF_SIDES * error };
                Allowance { interpolation: error - rounding - 1e-9, rounding }
            }
        }
    }

    /// Whether values known to within `spread` may be good enough.
    pub fn may_be_met(self, spread: f64) -> bool {
        match self {
            Need::Value { tolerance } => spread <= 1e-3 * tolerance,
            Need::Side { .. } => spread < 0.5,
        }
    }

    /// Whether these values of a block, for which [`Need::may_be_met`] holds, are.
    pub fn is_met(self, values: &[f64], spread: f64) -> bool {
        let Need::Side { threshold, error } = self else { return true };
        let spread = spread + error;
        let both = |(low, high): (f64, f64), v: &f64| (low.min(*v), high.max(*v));
        let (low, high) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), both);
        (threshold - low + spread).ceil() == (threshold - high - spread).ceil()
    }
}

/// Bounds of errors that may still be made at the samples of a region: of interpolation, and of 32-bit floats.
#[derive(Clone, Copy)]
pub struct Allowance {
    pub interpolation: f64,
    pub rounding: f64,
}
