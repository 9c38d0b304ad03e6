//! 3MF: a ZIP archive of XML models. Reads every object of the build, wherever components and transforms put it,
//! in the unit of the root model; other model files that objects name (the production extension) are followed.
//! Objects with a mirroring transform are turned over, so that they stay solid.
//!
//! Written over `flate2` and `quick-xml` rather than taken from `threemf2`, which unpacks an archive whole, whatever
//! its size becomes. Here a model is parsed as it is unpacked, and what comes out is bounded: see `package.rs` for
//! the unpacked size and `place.rs` for copies of copies.
mod archive;
mod checksum;
mod model;
mod package;
mod packer;
mod place;
mod transform;
mod xml;

pub(super) use packer::Packer;

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
fn read_parts(package: &mut Package, root: usize) -> Result<Vec<Part>, ReadError> {
    let mut parts: Vec<Part> = Vec::new();
    let mut places = vec![root];
    let mut numbers = FxHashMap::from_iter([(root, 0)]);
    while let Some(&place) = places.get(parts.len()) {
        let name = package.name(place);
        let model = Model::read(package.unpack(place)?, &name)?;
        let mut links = Vec::with_capacity(model.paths.len());
        for path in &model.paths {
            let place = package.find(path)?;
            links.push(*numbers.entry(place).or_insert_with(|| {
                places.push(place);
                places.len() - 1
            }));
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
