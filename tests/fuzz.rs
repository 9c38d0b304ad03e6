//! The fuzz targets on a stable compiler: every file of the corpus, and some mutations of each, always the same.
#[path = "../fuzz/src/lib.rs"]
mod targets;

#[test]
#[ignore]
fn one() {
    let name = std::env::var("T").unwrap();
    let bytes = std::fs::read(std::env::var("F").unwrap()).unwrap();
    targets::run(&name, &bytes);
}
