//! Fields as bytes: a shape and what was built for it, to be loaded rather than built again.
//!
//! A file is a mark, the version of what follows, its CRC-32 and its length, then the shape and its structure: of a soup the cycles
//! around its openings, its loose triangles, and what is known of cells if it was prepared for scattered points; of points, and of
//! loose triangles, the hierarchy with its moments. What takes about as long to read as to build is not in it: trees for single
//! points and the columns of a soup are built when they are first needed, as those of a new field are.
//!
//! The bytes may be any: they are held against their checksum, and then every number against what it has to be. What cannot be told
//! is whether a field that could be is that of the shape.
use super::cloud_field::CloudField;
use super::field::{Engine, WindingField};
use super::soup_field::SoupField;
use crate::data::{CloudError, Loader, OrientedCloud, SavedError, Saver, Shape, SoupError, TriangleSoup};
use crate::treecode::TreeConfig;
use flate2::Crc;
use std::io::{self, Write};
use std::sync::Arc;

/// Bytes that no text and no other format begins with, and that do not survive being taken for text.
const MARK: [u8; 8] = *b"\x89FWF\r\n\x1a\n";
const VERSION: u32 = 1;
/// Mark, version, checksum and length.
const HEAD: usize = 24;
const SOUP: u8 = 0;
const CLOUD: u8 = 1;

/// Why bytes are no field.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    #[error("these are no saved field: they begin with '{found}'")]
    Foreign { found: String },
    #[error("the field was saved as version {version}: only version {known} can be loaded")]
    OtherVersion { version: u32, known: u32 },
    #[error("the saved field is cut short: {needed} bytes are needed, and there are {found}")]
    Truncated { needed: u64, found: usize },
    #[error("{0} bytes follow the saved field")]
    TrailingBytes(usize),
    #[error("the saved field is damaged: its checksum is {found:08x}, not {expected:08x}")]
    Corrupt { expected: u32, found: u32 },
    #[error("the saved field cannot be one: {0}")]
    Invalid(#[from] SavedError),
    #[error("the saved field has no soup: {0}")]
    Soup(#[from] SoupError),
    #[error("the saved field has no cloud: {0}")]
    Cloud(#[from] CloudError),
}

/// Whether bytes begin as those of a saved field do.
pub fn is_saved_field(bytes: &[u8]) -> bool {
    bytes.starts_with(&MARK)
}

impl WindingField {
    /// Writes the shape and what was built for it.
    ///
    /// # Errors
    /// If and only if `out` refuses to be written to.
    pub fn save(&self, out: &mut dyn Write) -> io::Result<()> {
        let (engine, config) = self.parts();
        let mut saver = Saver::default();
        let kind = if let Shape::Soup(_) = self.shape() { SOUP } else { CLOUD };
        saver.number(kind);
        saver.number(config.leaf_size as u64);
        match self.shape() {
            Shape::Soup(soup) => {
                saver.vectors(soup.positions());
                saver.groups(soup.triangles());
            }
            Shape::Cloud(cloud) => {
                saver.vectors(cloud.points());
                saver.vectors(cloud.normals());
                saver.numbers(cloud.areas());
            }
        }
        match engine {
            Engine::Soup(soup) => soup.save(&mut saver),
            Engine::Cloud(cloud) => {
                saver.number(u8::from(cloud.is_bounded()));
                cloud.many.save(&mut saver);
            }
        }
        out.write_all(&MARK)?;
        out.write_all(&VERSION.to_le_bytes())?;
        out.write_all(&checksum(&saver.bytes).to_le_bytes())?;
        out.write_all(&(saver.bytes.len() as u64).to_le_bytes())?;
        out.write_all(&saver.bytes)
    }

    /// The field that was saved: it answers with the same bits.
    ///
    /// # Errors
    /// If and only if the bytes are none that [`WindingField::save`] writes: foreign, of another version, cut short, damaged or of
    /// no shape, or they do not fit in memory.
    pub fn load(bytes: &[u8]) -> Result<WindingField, LoadError> {
        let mut loader = Loader { rest: content(bytes)? };
        let kind: u8 = loader.number("the kind of the saved shape")?;
        let leaf_size = loader.number::<u64>("the saved leaf size")? as usize;
        if leaf_size == 0 || leaf_size > u32::MAX as usize || kind > CLOUD {
            return Err(SavedError::Inconsistent("its kind or its leaf size is none that can be").into());
        }
        let config = TreeConfig { leaf_size };
        let (shape, engine) = if kind == SOUP {
            let positions = loader.vectors("the saved vertices")?;
            let triangles = loader.groups("the saved triangles")?;
            let soup = Arc::new(TriangleSoup::new(positions, triangles)?);
            let field = SoupField::load(soup.clone(), &config, &mut loader)?;
            (Shape::Soup(soup), Engine::Soup(Box::new(field)))
        } else {
            let points = loader.vectors("the saved points")?;
            let normals = loader.vectors("the saved normals")?;
            let areas = loader.numbers("the saved areas")?;
            let cloud = Arc::new(OrientedCloud::of_unit_normals(points, normals, areas)?);
            let is_bounded = loader.number::<u8>("whether points are bounded")? != 0;
            let field = CloudField::load(cloud.clone(), config, is_bounded, &mut loader)?;
            (Shape::Cloud(cloud), Engine::Cloud(Box::new(field)))
        };
        match loader.rest.len() {
            0 => Ok(WindingField::of_engine(shape, config, engine)),
            more => Err(LoadError::TrailingBytes(more)),
        }
    }
}

/// What follows the head, if that says so.
fn content(bytes: &[u8]) -> Result<&[u8], LoadError> {
    if !is_saved_field(bytes) {
        let found = bytes[..bytes.len().min(MARK.len())].escape_ascii().to_string();
        return Err(LoadError::Foreign { found });
    }
    let Some((head, content)) = bytes.split_at_checked(HEAD) else {
        return Err(LoadError::Truncated { needed: HEAD as u64, found: bytes.len() });
    };
    let mut head = Loader { rest: &head[MARK.len()..] };
    let version = head.number("the version")?;
    if version != VERSION {
        return Err(LoadError::OtherVersion { version, known: VERSION });
    }
    let expected = head.number("the checksum")?;
    let length: u64 = head.number("the length")?;
    if length > content.len() as u64 {
        return Err(LoadError::Truncated { needed: length.saturating_add(HEAD as u64), found: bytes.len() });
    }
    if length < content.len() as u64 {
        return Err(LoadError::TrailingBytes(content.len() - length as usize));
    }
    let found = checksum(content);
    if found != expected {
        return Err(LoadError::Corrupt { expected, found });
    }
    Ok(content)
}

/// The CRC-32 of ZIP.
fn checksum(bytes: &[u8]) -> u32 {
    let mut crc = Crc::new();
    crc.update(bytes);
    crc.sum()
}
