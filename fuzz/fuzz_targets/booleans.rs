#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fast_winding_fuzz::run("booleans", bytes));
