//! Tells a file's format from its content.
use super::error::quote;
use super::text::{Commas, Continuation, Syntax, Tokens, number, without_mark};
use super::{Format, ReadError, off, stl};

/// Lines without meaning to any format that may come before the first with a meaning.
const STRANGE_LINES: usize = 100;

/// Statements that OBJ files begin with; those of free-form curves and surfaces come after vertices.
const OBJ_STATEMENTS: &[&[u8]] =
    &[b"v", b"vn", b"vt", b"vp", b"f", b"g", b"o", b"s", b"l", b"p", b"mg", b"mtllib", b"usemtl", b"maplib"];

static SYNTAX: Syntax = Syntax {
    format: Format::Xyz,
    commas: Commas::Separate,
    comments: &[b"#", b"//"],
    continuation: Continuation::Never,
};

/// The format whose reader should try `bytes`.
///
/// Marks that a format demands come first (3MF is a ZIP archive, PLY and OFF begin with their names); then
/// binary STL, which has no mark but whose length follows from its count; then what the first lines of text look
/// like.
pub(super) fn format_of(bytes: &[u8]) -> Result<Format, ReadError> {
    let unknown = || ReadError::UnknownFormat { found: quote(bytes) };
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(ReadError::EmptyInput { format: None, dropped: Vec::new() });
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Ok(Format::ThreeMf);
    }
    let text = without_mark(bytes);
    if let [b'p' | b'P', b'l' | b'L', b'y' | b'Y', b'\n' | b'\r' | b' ' | b'\t', ..] = text {
        return Ok(Format::Ply);
    }
    if stl::is_binary(bytes) {
        return Ok(Format::Stl);
    }
    if !is_text(bytes) {
        return Err(unknown());
    }
    text_format(bytes).ok_or_else(unknown)
}

/// Whether the first bytes hold no control characters but blanks; what is beyond ASCII may be in any encoding.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let is_control = |&b: &u8| b < 0x20 && !matches!(b, b'\t' | b'\n' | 0x0B | 0x0C | b'\r') || b == 0x7F;
    !bytes.iter().take(1024).any(is_control)
}

fn text_format(bytes: &[u8]) -> Option<Format> {
    let mut tokens = Tokens::new(bytes, &SYNTAX);
    for strange_lines in 0..STRANGE_LINES {
        let first = tokens.next()?;
        if number(first).is_some() {
            // A line of column names may come before the points, not a whole text.
            return (strange_lines <= 1).then_some(Format::Xyz);
        }
        if OBJ_STATEMENTS.contains(&first) {
            return Some(Format::Obj);
        }
        if off::is_keyword(first) {
            return Some(Format::Off);
        }
        if [&b"solid"[..], b"facet"].iter().any(|word| first.eq_ignore_ascii_case(word)) {
            return Some(Format::Stl);
        }
        tokens.end_line();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_meaningful_line_decides() {
        let cases: &[(&[u8], Format)] = &[
            (b"# made by hand\r\n\r\nmtllib a.mtl\r\nv 0 0 0", Format::Obj),
            (b"\xEF\xBB\xBF  SOLID box\nfacet", Format::Stl),
            (b"\xEF\xBB\xBFply\r\nformat ascii 1.0", Format::Ply),
            (b"# points\n1,2,3", Format::Xyz),
            (b"//X Y Z\n1 2 3", Format::Xyz),
            (b"x,y,z\n1,2,3", Format::Xyz),
            (b"12\n1 2 3", Format::Xyz),
            (b"#!\nCOFF\n8 6 12", Format::Off),
            (b"off 8 6 12", Format::Off),
            (b"PK\x03\x04rest", Format::ThreeMf),
        ];
        for (bytes, format) in cases {
            assert_eq!(format_of(bytes), Ok(*format), "{}", bytes.escape_ascii());
        }
    }

    #[test]
    fn other_files_are_unknown_and_blank_ones_empty() {
        for bytes in [&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], b"<html>\n<body>", b"{ \"asset\": 2 }"] {
            assert!(matches!(format_of(bytes), Err(ReadError::UnknownFormat { .. })));
        }
        for bytes in [&b""[..], b" \r\n"] {
            assert!(matches!(format_of(bytes), Err(ReadError::EmptyInput { format: None, .. })));
        }
    }
}
