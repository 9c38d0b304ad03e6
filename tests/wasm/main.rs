//! Native and WebAssembly agree: the same facts, with the same numbers, hold in both. Run by `cargo test` and, on two
//! threads in a browser's worker, by the wasm-bindgen test runner.
#[path = "../common/mod.rs"]
mod common;
mod facts;

#[cfg(target_arch = "wasm32")]
mod threads {
    use fast_winding::wasm::init_thread_pool;
    use std::cell::Cell;
    use wasm_bindgen_futures::JsFuture;

    wasm_bindgen_test::wasm_bindgen_test_configure!(run_in_dedicated_worker);

    thread_local! {
        static IS_STARTED: Cell<bool> = const { Cell::new(false) };
    }

    /// Starts the pool of two threads, once.
    pub async fn start() {
        if !IS_STARTED.replace(true) {
            JsFuture::from(init_thread_pool(2)).await.expect("two workers start");
        }
        assert_eq!(rayon::current_num_threads(), 2);
    }
}

/// Makes a test of each fact, native or in the browser.
macro_rules! hold_everywhere {
    ($($fact:ident)*) => {$(
        #[cfg(not(target_arch = "wasm32"))]
        #[test]
        fn $fact() {
            facts::$fact();
        }

        #[cfg(target_arch = "wasm32")]
        #[wasm_bindgen_test::wasm_bindgen_test]
        async fn $fact() {
            threads::start().await;
            facts::$fact();
        }
    )*};
}

hold_everywhere! {
    points_are_classified_alike
    winding_numbers_agree
    voxels_agree
    layers_agree
    surfaces_agree
    clouds_are_completed_alike
    files_are_read_alike
}
