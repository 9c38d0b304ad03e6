/// A job was stopped by its [`Monitor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled by the caller")]
pub struct Cancelled;

/// Hears how far a long job is and may stop it.
///
/// Jobs call it between blocks, always on the thread that started the job.
pub trait Monitor {
    /// `fraction` is in [0, 1] and never falls within one stage. `Err` stops the job, which returns [`Cancelled`].
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled>;
}

/// Hears nothing and never stops a job.
pub struct Silent;

impl Monitor for Silent {
    fn report(&self, _: f64, _: &str) -> Result<(), Cancelled> {
        Ok(())
    }
}

/// A closure `|fraction, stage| -> bool` that answers whether to go on.
impl<F: Fn(f64, &str) -> bool> Monitor for F {
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled> {
        if self(fraction, stage) { Ok(()) } else { Err(Cancelled) }
    }
}
