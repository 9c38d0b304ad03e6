use super::Format;
use crate::data::Warning;
use std::fmt;

/// Where in a file something is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// Bytes from the start of the file, or of the unpacked model of a 3MF archive.
    Byte(usize),
    /// Line of a text file; the first is 1.
    Line(usize),
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Location::Byte(offset) => write!(f, "at byte {offset}"),
            Location::Line(line) => write!(f, "in line {line}"),
        }
    }
}

/// Why a file gives no geometry.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReadError {
    #[error("the {format} file cannot be read {at}: expected {expected}")]
    Parse {
        format: Format,
        at: Location,
        /// What was expected and what was found.
        expected: String,
    },
    #[error("the file{} holds no usable triangle or point{}", named(format), listed(dropped))]
    EmptyInput {
        /// `None` when the file is too empty to tell.
        format: Option<Format>,
        /// What the file did hold, and why it was left out.
        dropped: Vec<Warning>,
    },
    #[error(
        "the format is unknown: the file begins with {found}; STL, OBJ, PLY, XYZ, OFF and 3MF can be read"
    )]
    UnknownFormat { found: String },
}

fn named(format: &Option<Format>) -> String {
    format.map_or(String::new(), |format| format!(" ({format})"))
}

fn listed(dropped: &[Warning]) -> String {
    let reasons: Vec<String> = dropped.iter().map(Warning::to_string).collect();
    if reasons.is_empty() { String::new() } else { format!(": {}", reasons.join("; ")) }
}

/// `bytes` in quotes for a message, shortened, with what cannot be printed escaped.
pub(super) fn quote(bytes: &[u8]) -> String {
    const SHOWN: usize = 24;
    let shown = bytes[..bytes.len().min(SHOWN)].escape_ascii();
    let more = if bytes.len() > SHOWN { "…" } else { "" };
    format!("'{shown}{more}'")
}
