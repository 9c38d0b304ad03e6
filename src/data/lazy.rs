use std::sync::OnceLock;

/// A value that is built when it is first asked for.
///
/// Several threads may build it, of which one keeps what it built: if they waited for each other, as in
/// [`OnceLock::get_or_init`], the one that waits could be the one whose help the other needs to get done.
pub(crate) struct Lazy<T>(OnceLock<T>);

impl<T> Lazy<T> {
    pub const fn new() -> Lazy<T> {
        Lazy(OnceLock::new())
    }

    /// The value, if it was asked for.
    pub fn get(&self) -> Option<&T> {
        self.0.get()
    }

    pub fn get_or_build(&self, build: impl FnOnce() -> T) -> &T {
        if let Some(value) = self.get() {
            return value;
        }
        let value = build();
        self.0.get_or_init(|| value)
    }

    /// # Errors
    /// If and only if the value is not there yet and `build` fails.
    pub fn get_or_try_build<E>(&self, build: impl FnOnce() -> Result<T, E>) -> Result<&T, E> {
        if let Some(value) = self.get() {
            return Ok(value);
        }
        let value = build()?;
        Ok(self.0.get_or_init(|| value))
    }
}
