//! Calls that go wrong on purpose, for the tests of what the client does then.
use super::handle::Handle;
use rayon::prelude::*;
use wasm_bindgen::prelude::*;

fn fail(how: &str) {
    match how {
        "panic" => panic!("a panic on purpose"),
        _ => core::arch::wasm32::unreachable(),
    }
}

#[wasm_bindgen]
impl Handle {
    /// `how` is `panic` or `trap`; `wherever` is `caller` or `pool`.
    pub fn fault(&self, how: &str, wherever: &str) {
        match wherever {
            "caller" => fail(how),
            _ => (0..1000).into_par_iter().for_each(|i| if i == 500 { fail(how) }),
        }
    }
}
