//! Progress and cancel of the call that runs now.
use super::convert::vectors_to;
use crate::data::{Cancelled, Monitor};
use crate::math::Vec3;
use js_sys::Function;
use std::{
    cell::RefCell,
    panic::AssertUnwindSafe,
    sync::atomic::{AtomicU32, Ordering},
};
use wasm_bindgen::prelude::*;

/// What a long call listens to and reports to; one serves call after call.
#[wasm_bindgen]
pub struct Job {
    /// Boxed: its address stays. A page that shares this memory stores 1 to cancel, and 0 before the next call.
    cancelled: Box<AtomicU32>,
    /// A panic during a call leaves at most an old function here: nothing is half done.
    progress: AssertUnwindSafe<RefCell<Option<Function>>>,
    watcher: AssertUnwindSafe<RefCell<Option<Function>>>,
}

#[wasm_bindgen]
impl Job {
    #[wasm_bindgen(constructor)]
    #[allow(clippy::new_without_default)]
    pub fn new() -> Job {
        Job { cancelled: Box::default(), progress: Default::default(), watcher: Default::default() }
    }

    /// Byte address of the cancel flag, an aligned 32-bit integer in the memory of this instance.
    pub fn address(&self) -> usize {
        std::ptr::from_ref(&*self.cancelled).addr()
    }

    /// Sets the function `(fraction, stage)` that hears of progress, or none.
    #[wasm_bindgen(js_name = listen)]
    pub fn listen(&self, progress: Option<Function>) {
        self.progress.replace(progress);
    }

    /// Sets the function that sees unit vectors xyzxyz… while they settle, or none. Asked without an argument, it says whether
    /// it wants to see those of now.
    #[wasm_bindgen(js_name = watch)]
    pub fn watch(&self, watcher: Option<Function>) {
        self.watcher.replace(watcher);
    }
}

impl Job {
    /// Shows the directions of vectors to who watches. Whether that fails is no matter of the call.
    pub fn show(&self, vectors: &[Vec3]) {
        if let Some(watcher) = &*self.watcher.borrow()
            && watcher.call0(&JsValue::NULL).is_ok_and(|wanted| wanted.is_truthy())
            && let Ok(array) = vectors_to(&directions(vectors), Vec3::ZERO)
        {
            let _ = watcher.call1(&JsValue::NULL, &array);
        }
    }
}

fn directions(vectors: &[Vec3]) -> Vec<Vec3> {
    vectors.iter().map(|v| v.normalize_or_zero()).collect()
}

impl Monitor for Job {
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled> {
        if self.cancelled.load(Ordering::Relaxed) != 0 {
            return Err(Cancelled);
        }
        match &*self.progress.borrow() {
            None => Ok(()),
            // A function that throws ends the call: the client keeps what it threw.
            Some(progress) => progress
                .call2(&JsValue::NULL, &fraction.into(), &stage.into())
                .map_or(Err(Cancelled), |_| Ok(())),
        }
    }
}
