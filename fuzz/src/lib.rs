//! What is fuzzed: each target takes any bytes, makes a file or a shape with settings of them, and asserts what has to hold of the
//! results. The fuzzer runs them, and so does `tests/fuzz.rs` with the committed corpus.
mod charges;
mod clouds;
mod facts;
mod fields;
mod readers;
mod repairs;
mod shapes;
mod slices;
mod solids;
mod source;
mod surfaces;

/// A name, which is that of the corpus's folder too, and what it runs.
pub type Target = (&'static str, fn(&[u8]));

pub const TARGETS: &[Target] = &[
    ("stl", readers::stl),
    ("obj", readers::obj),
    ("ply", readers::ply),
    ("off", readers::off),
    ("xyz", readers::xyz),
    ("threemf", readers::threemf),
    ("saved", readers::saved),
    ("soups", fields::soups),
    ("clouds", fields::clouds),
    ("planar", clouds::planar),
    ("distances", fields::distances),
    ("layers", slices::layers),
    ("prints", slices::prints),
    ("level_sets", surfaces::level_sets),
    ("offsets", surfaces::offsets),
    ("voxels", solids::voxels),
    ("booleans", solids::booleans),
    ("arrangements", repairs::arrangements),
    ("checks", repairs::checks),
    ("repairs", repairs::repairs),
    ("faces", repairs::faces),
    ("normals", clouds::normals),
    ("charges", charges::fields),
    ("textures", charges::textures),
];

/// Runs a target.
///
/// # Panics
/// If there is none of that name, or if it has found a fault.
pub fn run(name: &str, bytes: &[u8]) {
    let (_, target) = TARGETS.iter().find(|(known, _)| *known == name).expect("the target is in the list");
    target(bytes);
}
