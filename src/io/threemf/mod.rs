//! 3MF: a ZIP archive of XML models. Reads every object of the build, wherever components and transforms put it,
//! in the unit of the root model; other model files that objects name (the production extension) are followed.
//! Objects with a mirroring transform are turned over, so that they stay solid.
//!
//! Written over `zip` and `quick-xml` rather than taken from `threemf2`, which unpacks an archive whole, whatever
//! its size becomes. Here a model is parsed as it is unpacked, and what comes out is bounded: see `package.rs` for
//! the unpacked size and `place.rs` for copies of copies.
mod model;
mod package;
mod place;
mod transform;
mod xml;

use super::parsed::Parsed;
use super::{Format, Location, ReadError};
use model::Model;
use package::Package;
use rustc_hash::FxHashMap;

/// A model file of the archive, and which of the parts each of its paths names.
struct Part {
    model: Model,
    links: Vec<usize>,
}

pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut package = Package::open(bytes)?;
    let root = package.root_model()?;
    let parts = read_parts(&mut package, root)?;
    place::build(&parts, bytes.len())
}

/// Reads the root model and those that it names, and so on, each once.
fn read_parts(package: &mut Package, root: String) -> Result<Vec<Part>, ReadError> {
    let mut parts = Vec::new();
    let mut numbers = FxHashMap::from_iter([(root.clone(), 0)]);
    let mut names = vec![root];
    while let Some(name) = names.get(parts.len()) {
        let model = Model::read(package.unpack(name)?, name)?;
        let mut links = Vec::with_capacity(model.paths.len());
        for path in &model.paths {
            let path = package.find(path)?;
            let next = names.len();
            let number = *numbers.entry(path.clone()).or_insert(next);
            if number == next {
                names.push(path);
            }
            links.push(number);
        }
        parts.push(Part { model, links });
    }
    Ok(parts)
}

/// An error at a byte of the archive, or of the unpacked file that `expected` names.
fn error(byte: usize, expected: String) -> ReadError {
    ReadError::Parse { format: Format::ThreeMf, at: Location::Byte(byte), expected }
}

#[cfg(test)]
mod tests;
