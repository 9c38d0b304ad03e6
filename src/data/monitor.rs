use std::cell::Cell;

/// A job was stopped by its [`Monitor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled by the caller")]
pub struct Cancelled;

/// Hears how far a long job is and may stop it.
///
/// Jobs call it between blocks, always on the thread that started the job.
pub trait Monitor {
    /// `fraction` is in [0, 1] and never falls within one call of a feature. `Err` stops the job, which returns [`Cancelled`].
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled>;
}

/// Hears nothing and never stops a job.
pub struct Silent;

impl Monitor for Silent {
    fn report(&self, _: f64, _: &str) -> Result<(), Cancelled> {
        Ok(())
    }
}

/// Hears the parts of a job as one, in which progress never falls: what a part tells counts within the share of the whole that is
/// its own, and what begins anew in it waits until it is farther than what was told.
pub struct Parts<'a> {
    whole: &'a dyn Monitor,
    /// Where the part begins that runs now, and where it ends.
    part: Cell<[f64; 2]>,
    told: Cell<f64>,
}

impl<'a> Parts<'a> {
    pub fn new(whole: &'a dyn Monitor) -> Parts<'a> {
        Parts { whole, part: Cell::new([0.0, 1.0]), told: Cell::new(0.0) }
    }

    /// What is told from now on is of the part of the whole between two fractions; this itself tells nothing.
    pub fn begin(&self, from: f64, to: f64) {
        self.part.set([from, to]);
    }

    /// The part of the remaining whole that is given to the next of as many attempts as it may take.
    pub fn begin_attempt(&self, share: f64) {
        let told = self.told.get();
        self.begin(told, told + share * (1.0 - told));
    }
}

impl Monitor for Parts<'_> {
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled> {
        let [from, to] = self.part.get();
        self.told.set(self.told.get().max(from + (to - from) * fraction));
        self.whole.report(self.told.get(), stage)
    }
}

/// A closure `|fraction, stage| -> bool` that answers whether to go on.
impl<F: Fn(f64, &str) -> bool> Monitor for F {
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled> {
        if self(fraction, stage) { Ok(()) } else { Err(Cancelled) }
    }
}
