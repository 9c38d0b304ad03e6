//! The archive: which file is the model, and how much of it may be unpacked.
use super::archive::Archive;
use super::error;
use super::xml::Events;
use crate::io::ReadError;
use quick_xml::events::Event;
use rustc_hash::FxHashMap;
use std::io::{self, BufRead, BufReader, Read};

/// Bytes of model text that an archive may unpack to for each of its own. Text of meshes shrinks to between a
/// quarter and a twentieth; a ZIP bomb to a thousandth.
const UNPACKED_PER_BYTE: u64 = 64;
/// What may be unpacked in any case: small files shrink better than large ones.
const UNPACKED_ANYWAY: u64 = 1 << 20;

/// How OPC, the packaging of 3MF, names what relates to the package as a whole.
const RELATIONSHIPS: &str = "_rels/.rels";
const USUAL_MODEL: &str = "3D/3dmodel.model";

pub(super) struct Package<'a> {
    archive: Archive<'a>,
    /// Places of the files in the archive by name, in lower case: letter case does not count in OPC.
    places: FxHashMap<String, usize>,
    /// Bytes that may still be unpacked.
    left: u64,
}

impl<'a> Package<'a> {
    pub fn open(bytes: &'a [u8]) -> Result<Package<'a>, ReadError> {
        let archive =
            Archive::open(bytes).map_err(|found| error(0, format!("a whole ZIP archive, found {found}")))?;
        let names = archive.names().enumerate();
        let places = names.map(|(place, name)| (name.to_ascii_lowercase(), place)).collect();
        Ok(Package { archive, places, left: UNPACKED_ANYWAY + UNPACKED_PER_BYTE * bytes.len() as u64 })
    }

    /// The place in the archive of the file that `path` means.
    pub fn find(&self, path: &str) -> Result<usize, ReadError> {
        let name = path.trim_start_matches('/');
        let place = self.places.get(&name.to_ascii_lowercase());
        place.copied().ok_or_else(|| error(0, format!("a file '{name}' in the archive, found none")))
    }

    /// The place of the model that the package is about.
    pub fn root_model(&mut self) -> Result<usize, ReadError> {
        let related = match self.find(RELATIONSHIPS) {
            Ok(place) => model_target(self.unpack(place)?),
            Err(_) => None,
        };
        match related.map(|target| self.find(&target)) {
            Some(Ok(place)) => Ok(place),
            _ => self.find(USUAL_MODEL),
        }
    }

    /// The name of the file at `place`, for messages.
    pub fn name(&self, place: usize) -> String {
        self.archive.names().nth(place).unwrap_or_default().to_owned()
    }

    /// The content of the file at `place`.
    pub fn unpack(&mut self, place: usize) -> Result<impl BufRead + '_, ReadError> {
        let name = self.name(place);
        let left = &mut self.left;
        let file = self.archive.unpack(place);
        let file = file.map_err(|found| error(0, format!("a readable file '{name}', found {found}")))?;
        Ok(BufReader::new(Bounded { file, left }))
    }
}

/// The target of the relationship that names a 3MF model.
fn model_target(content: impl BufRead) -> Option<String> {
    let mut events = Events::new(content);
    let mut buffer = Vec::new();
    loop {
        match events.next(&mut buffer).ok()? {
            Event::Start(element) | Event::Empty(element) => {
                let attribute = |name| element.try_get_attribute(name).ok()?.map(|found| found.value);
                if attribute("Type").is_some_and(|kind| kind.ends_with("/3dmodel")) {
                    return attribute("Target").map(|target| target.into_owned());
                }
            }
            Event::Eof => return None,
            _ => {}
        }
    }
}

/// A file that fails when it unpacks to more than is left.
struct Bounded<'l, R> {
    file: R,
    left: &'l mut u64,
}

impl<R: Read> Read for Bounded<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.file.read(buffer)? as u64;
        if length > *self.left {
            let message = format!("a file that unpacks to more than {UNPACKED_PER_BYTE} times the archive");
            return Err(io::Error::other(message));
        }
        *self.left -= length;
        Ok(length as usize)
    }
}
