//! Charges by the Robin Hood method: Lazić, Štefančić & Abraham 2006, and section 7.5 of the paper.
//!
//! Again and again the elements with the highest and the lowest potential exchange the charge that makes their potentials equal
//! (eq. 6), and all potentials follow (eq. 8).
use super::krylov::Solution;
use super::system::System;
use crate::data::{Cancelled, Monitor};

/// Steps between two reports to the monitor.
const STEPS_PER_REPORT: usize = 64;
/// Potentials are found anew when the deviation has fallen to this share: roundings add up.
const ANEW: f64 = 1e-6;

/// A gap between potentials that is so many times that of the start tells that the exchanges lead away.
const ASTRAY: f64 = 1e3;

/// Charges, of 1 in all, that give the same potential at all barycentres but for `tolerance`, from `charges` on, of 1 too.
pub fn solve(
    system: &dyn System,
    mut charges: Vec<f64>,
    tolerance: f64,
    most_steps: usize,
    monitor: &dyn Monitor,
) -> Result<Solution, Cancelled> {
    let start = charges.clone();
    let mut potentials = system.potentials(&charges);
    let (first, lowest, highest) = deviation(&potentials);
    let widest = ASTRAY * (potentials[highest] - potentials[lowest]);
    let mut fresh = first;
    let mut steps = 0;
    loop {
        let (mut worst, mut lowest, mut highest) = deviation(&potentials);
        if worst <= tolerance || worst < ANEW * fresh {
            potentials = system.potentials(&charges);
            (worst, lowest, highest) = deviation(&potentials);
            fresh = worst;
        }
        let gap = potentials[highest] - potentials[lowest];
        // By the paper's rule a triangle's own potential is too low: those next to others may give and take without end.
        if worst.is_nan() || gap > widest {
            return Ok(Solution { charges: start, steps });
        }
        if worst <= tolerance || steps >= most_steps || lowest == highest {
            return Ok(Solution { charges, steps });
        }
        if steps % STEPS_PER_REPORT == 0 {
            let done = libm::log(worst / first) / libm::log((tolerance / first).min(0.5));
            monitor.report(done.clamp(0.0, 1.0), "charges")?;
        }
        let (of_highest, of_lowest) = (system.column(highest), system.column(lowest));
        let own = of_highest[highest] + of_lowest[lowest];
        let change = gap / (own - of_lowest[highest] - of_highest[lowest]);
        if !change.is_finite() {
            return Ok(Solution { charges, steps });
        }
        charges[highest] -= change;
        charges[lowest] += change;
        let of_both = of_lowest.iter().zip(of_highest.iter());
        potentials.iter_mut().zip(of_both).for_each(|(p, (low, high))| *p += change * (low - high));
        steps += 1;
    }
}

/// The largest deviation from the mean, relative to that, and where potentials are lowest and highest.
pub fn deviation(potentials: &[f64]) -> (f64, usize, usize) {
    let (mut lowest, mut highest, mut sum) = (0, 0, 0.0);
    for (i, p) in potentials.iter().enumerate() {
        sum += p;
        if *p < potentials[lowest] {
            lowest = i;
        }
        if *p > potentials[highest] {
            highest = i;
        }
    }
    let mean = sum / potentials.len() as f64;
    ((potentials[highest] - mean).max(mean - potentials[lowest]) / mean.abs(), lowest, highest)
}
