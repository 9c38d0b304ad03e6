//! The numbers of a body, one after another.
use super::header::{Element, Encoding, Kind, Scalar};
use crate::io::text::{Commas, Continuation, Syntax, Tokens};
use crate::io::{Format, Location, ReadError};

/// A source of numbers. `None` stands for the end of the file.
pub(super) trait Values {
    fn number(&mut self, kind: Scalar) -> Result<Option<f64>, ReadError>;

    /// Bytes that are still to be read.
    fn remaining(&self) -> usize;

    /// Bytes of the shortest number of type `kind`.
    fn least_size(&self, kind: Scalar) -> usize;

    /// Bytes after the last element that are more than white space.
    fn trailing(&mut self) -> usize;

    /// The error that a list cannot have `length` items.
    fn bad_length(&self, length: f64) -> ReadError;

    /// The length of a list; `None` when so many items do not fit into the rest of the file.
    fn list_length(&mut self, count: Scalar, item: Scalar) -> Result<Option<usize>, ReadError> {
        let Some(length) = self.number(count)? else { return Ok(None) };
        if length < 0.0 || length.fract() != 0.0 {
            return Err(self.bad_length(length));
        }
        let fits = length * self.least_size(item) as f64 <= self.remaining() as f64;
        Ok(fits.then_some(length as usize))
    }

    /// How many records of `element` the rest of the file can hold at most.
    fn most_records(&self, element: &Element) -> usize {
        let least = |kind: Kind| match kind {
            Kind::One(kind) => self.least_size(kind),
            Kind::List { count, .. } => self.least_size(count),
        };
        let size: usize = element.properties.iter().map(|property| least(property.kind)).sum();
        self.remaining() / size.max(1)
    }
}

static SYNTAX: Syntax =
    Syntax { format: Format::Ply, commas: Commas::Plain, comments: &[], continuation: Continuation::Never };

/// Numbers as text, whatever the lines are.
pub(super) struct AsciiValues<'a>(Tokens<'a>);

impl<'a> AsciiValues<'a> {
    pub fn new(bytes: &'a [u8], at: usize, line: usize) -> AsciiValues<'a> {
        // Without blanks at the end, bytes remain if and only if numbers do.
        let end = bytes.trim_ascii_end().len().max(at);
        AsciiValues(Tokens::starting_at(&bytes[..end], at, line, &SYNTAX))
    }
}

impl Values for AsciiValues<'_> {
    #[inline]
    fn number(&mut self, _: Scalar) -> Result<Option<f64>, ReadError> {
        Ok(self.0.numbers("a number")?.map(|[number]| number))
    }

    fn remaining(&self) -> usize {
        self.0.remaining()
    }

    /// A digit and what parts it from the one before.
    fn least_size(&self, _: Scalar) -> usize {
        2
    }

    fn trailing(&mut self) -> usize {
        self.0.next().map_or(0, |token| token.len() + self.0.remaining())
    }

    fn bad_length(&self, length: f64) -> ReadError {
        self.0.error(format!("the length of a list, found {length}"))
    }
}

/// Numbers in binary.
pub(super) struct BinaryValues<'a> {
    bytes: &'a [u8],
    at: usize,
    encoding: Encoding,
}

impl<'a> BinaryValues<'a> {
    pub fn new(bytes: &'a [u8], at: usize, encoding: Encoding) -> BinaryValues<'a> {
        BinaryValues { bytes, at, encoding }
    }

    #[inline]
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let mut bytes: [u8; N] = *self.bytes.get(self.at..)?.first_chunk()?;
        self.at += N;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Some(bytes)
    }
}

impl Values for BinaryValues<'_> {
    #[inline]
    fn number(&mut self, kind: Scalar) -> Result<Option<f64>, ReadError> {
        Ok(match kind {
            Scalar::I8 => self.take().map(i8::from_le_bytes).map(f64::from),
            Scalar::U8 => self.take().map(u8::from_le_bytes).map(f64::from),
            Scalar::I16 => self.take().map(i16::from_le_bytes).map(f64::from),
            Scalar::U16 => self.take().map(u16::from_le_bytes).map(f64::from),
            Scalar::I32 => self.take().map(i32::from_le_bytes).map(f64::from),
            Scalar::U32 => self.take().map(u32::from_le_bytes).map(f64::from),
            Scalar::F32 => self.take().map(f32::from_le_bytes).map(f64::from),
            Scalar::F64 => self.take().map(f64::from_le_bytes),
        })
    }

    fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn least_size(&self, kind: Scalar) -> usize {
        kind.size()
    }

    fn trailing(&mut self) -> usize {
        self.remaining()
    }

    fn bad_length(&self, length: f64) -> ReadError {
        let expected = format!("the length of a list, found {length}");
        ReadError::Parse { format: Format::Ply, at: Location::Byte(self.at), expected }
    }
}
