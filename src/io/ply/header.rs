use crate::io::error::quote;
use crate::io::text::without_mark;
use crate::io::{Format, Location, ReadError};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number in a binary file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    One(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Debug, PartialEq)]
pub(super) struct Property<'a> {
    pub name: &'a [u8],
    pub kind: Kind,
}

#[derive(Debug, PartialEq)]
pub(super) struct Element<'a> {
    pub name: &'a [u8],
    pub count: usize,
    pub properties: Vec<Property<'a>>,
    /// Line of the header that declares it.
    pub line: usize,
}

pub(super) struct Header<'a> {
    pub encoding: Encoding,
    pub elements: Vec<Element<'a>>,
    /// First byte after the header.
    pub body: usize,
    /// Line in which the body begins.
    pub body_line: usize,
}

impl Scalar {
    /// Bytes in a binary file.
    pub fn size(self) -> usize {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    fn from_name(name: &[u8]) -> Option<Scalar> {
        match name {
            b"char" | b"int8" => Some(Scalar::I8),
            b"uchar" | b"uint8" => Some(Scalar::U8),
            b"short" | b"int16" => Some(Scalar::I16),
            b"ushort" | b"uint16" => Some(Scalar::U16),
            b"int" | b"int32" => Some(Scalar::I32),
            b"uint" | b"uint32" => Some(Scalar::U32),
            b"float" | b"float32" => Some(Scalar::F32),
            b"double" | b"float64" => Some(Scalar::F64),
            _ => None,
        }
    }
}

/// Words of a line that are looked at: `property list uchar int vertex_indices` has five.
const MOST_WORDS: usize = 6;

/// Lines of the header. They all end as the first does, so that a binary body that happens to begin with the
/// other line end loses no byte to it.
struct Lines<'a> {
    bytes: &'a [u8],
    end: &'static [u8],
    at: usize,
    line: usize,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Lines<'a> {
        let first = bytes.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(bytes.len());
        let end: &[u8] = match &bytes[first..] {
            [b'\r', b'\n', ..] => b"\r\n",
            [b'\r', ..] => b"\r",
            _ => b"\n",
        };
        Lines { bytes, end, at: bytes.len() - without_mark(bytes).len(), line: 0 }
    }

    /// The words of the next line; `None` when the file ends before that line does.
    fn next(&mut self) -> Option<Vec<&'a [u8]>> {
        self.line += 1;
        let rest = &self.bytes[self.at..];
        let length = rest.windows(self.end.len()).position(|w| w == self.end)?;
        self.at += length + self.end.len();
        Some(
            rest[..length]
                .split(u8::is_ascii_whitespace)
                .filter(|word| !word.is_empty())
                .take(MOST_WORDS)
                .collect(),
        )
    }

    fn error(&self, expected: String) -> ReadError {
        error(self.line, expected)
    }
}

pub(super) fn error(line: usize, expected: String) -> ReadError {
    ReadError::Parse { format: Format::Ply, at: Location::Line(line), expected }
}

/// Reads up to and with `end_header`.
pub(super) fn read(bytes: &[u8]) -> Result<Header<'_>, ReadError> {
    let mut lines = Lines::new(bytes);
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let words =
            lines.next().ok_or_else(|| lines.error("'end_header', found the end of the file".to_owned()))?;
        match words[..] {
            [b"end_header"] => break,
            [] | [b"ply" | b"PLY" | b"comment" | b"obj_info", ..] => {}
            [b"format", name, _] => encoding = Some(encoding_of(name, &lines)?),
            [b"element", name, count] => elements.push(element(name, count, &lines)?),
            [b"property", ref kind @ .., name] => {
                let property = Property { name, kind: kind_of(kind, &lines)? };
                let element = elements.last_mut();
                element
                    .ok_or_else(|| lines.error("'element' before 'property'".to_owned()))?
                    .properties
                    .push(property);
            }
            [word, ..] => {
                let expected = "'format', 'element', 'property', 'comment' or 'end_header' with their values";
                return Err(lines.error(format!("{expected}, found {}", quote(word))));
            }
        }
    }
    let encoding = encoding.ok_or_else(|| lines.error("a line 'format' before 'end_header'".to_owned()))?;
    Ok(Header { encoding, elements, body: lines.at, body_line: lines.line + 1 })
}

fn encoding_of(name: &[u8], lines: &Lines) -> Result<Encoding, ReadError> {
    match name {
        b"ascii" => Ok(Encoding::Ascii),
        b"binary_little_endian" => Ok(Encoding::LittleEndian),
        b"binary_big_endian" => Ok(Encoding::BigEndian),
        _ => {
            Err(lines
                .error(format!("ascii, binary_little_endian or binary_big_endian, found {}", quote(name))))
        }
    }
}

fn element<'a>(name: &'a [u8], count: &[u8], lines: &Lines) -> Result<Element<'a>, ReadError> {
    let parsed = std::str::from_utf8(count).ok().and_then(|text| text.parse().ok());
    let count = parsed.ok_or_else(|| lines.error(format!("a count of elements, found {}", quote(count))))?;
    Ok(Element { name, count, properties: Vec::new(), line: lines.line })
}

fn kind_of(words: &[&[u8]], lines: &Lines) -> Result<Kind, ReadError> {
    let scalar = |name: &[u8]| {
        let expected = || format!("a type from char to double, found {}", quote(name));
        Scalar::from_name(name).ok_or_else(|| lines.error(expected()))
    };
    match words {
        [b"list", count, item] => Ok(Kind::List { count: scalar(count)?, item: scalar(item)? }),
        [kind] => Ok(Kind::One(scalar(kind)?)),
        _ => Err(lines.error("'property TYPE NAME' or 'property list TYPE TYPE NAME'".to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn header_ends_where_its_own_line_end_says() {
        for end in ["\n", "\r", "\r\n"] {
            let lines = [
                "ply",
                "format binary_big_endian 1.0",
                "comment by hand",
                "element vertex 2",
                "property int8 x",
                "end_header",
                "",
            ];
            let text = lines.join(end);
            let bytes = [text.as_bytes(), b"\n\r"].concat();
            let header = read(&bytes).unwrap();
            assert_eq!((header.body, header.body_line), (text.len(), 7));
            assert_eq!(header.encoding, Encoding::BigEndian);
            let properties = vec![Property { name: b"x", kind: Kind::One(Scalar::I8) }];
            assert_eq!(header.elements, [Element { name: b"vertex", count: 2, properties, line: 4 }]);
        }
    }

    #[test]
    fn bad_headers_are_refused_with_their_line() {
        let cases = [
            ("ply\nformat ascii 1.0\nelement vertex -1\n", 3, "'-1'"),
            ("ply\nformat text 1.0\n", 2, "'text'"),
            ("ply\nproperty float x\n", 2, "'element'"),
            ("ply\nelement vertex 1\nproperty half x\n", 3, "'half'"),
            ("ply\nelement vertex 1\nproperty list uchar x\n", 3, "property list"),
            ("ply\nend_header\n", 2, "'format'"),
            ("ply\nformat ascii 1.0\nend_head", 3, "end of the file"),
            ("ply\nformat ascii 1.0\nwhat is this\n", 3, "'what'"),
        ];
        for (text, line, part) in cases {
            match read(text.as_bytes()).err() {
                Some(ReadError::Parse { format: Format::Ply, at, expected }) => {
                    assert_eq!(at, Location::Line(line), "{text}");
                    assert!(expected.contains(part), "{expected}");
                }
                other => panic!("{text}: {other:?}"),
            }
        }
    }
}
