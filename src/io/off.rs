//! OFF, as Geomview defines it: `[ST][C][N]OFF`, counts, one vertex a line, one face a line. Colours and texture
//! coordinates are passed over; normals count when there are no faces. Four-dimensional and binary files are
//! refused.
use super::error::quote;
use super::parsed::{Parsed, Tally, push_polygon, vertex_index};
use super::text::{Commas, Continuation, Syntax, Tokens, number};
use super::{Format, ReadError};
use crate::data::WarningKind;
use crate::math::Vec3;

static SYNTAX: Syntax = Syntax {
    format: Format::Off,
    commas: Commas::Plain,
    comments: &[b"#"],
    continuation: Continuation::Never,
};

/// Bytes of the shortest line of a vertex, `0 0 0`, with its end.
const SHORTEST_VERTEX: usize = 6;

struct Header {
    vertices: usize,
    faces: usize,
    has_normals: bool,
}

/// Whether `word` begins an OFF file: its name after any of the prefixes that say what a vertex holds.
pub(super) fn is_keyword(word: &[u8]) -> bool {
    let lower = word.to_ascii_lowercase();
    let Some(mut prefixes) = lower.strip_suffix(b"off") else { return false };
    for prefix in [&b"st"[..], b"c", b"n", b"4", b"n"] {
        prefixes = prefixes.strip_prefix(prefix).unwrap_or(prefixes);
    }
    prefixes.is_empty()
}

pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut tokens = Tokens::new(bytes, &SYNTAX);
    let header = read_header(&mut tokens)?;
    let mut parsed = Parsed::default();
    let is_whole = read_vertices(&mut tokens, &header, &mut parsed)?;
    if header.faces > 0 {
        let triangles =
            if is_whole { read_faces(&mut tokens, &header, &mut parsed.tally)? } else { Vec::new() };
        parsed.triangles = Some(triangles);
    }
    if let Some(token) = tokens.next() {
        parsed.tally.add(WarningKind::TrailingBytes, token.len() + tokens.remaining());
    }
    Ok(parsed)
}

/// Counts may stand in the line of the keyword or in the next; the number of edges may be missing.
fn read_header(tokens: &mut Tokens) -> Result<Header, ReadError> {
    let keyword = tokens.next().unwrap_or_default();
    // In Geomview's grammar a lower-case n before OFF is a dimension to follow, and N says normals.
    if keyword.contains(&b'4') || keyword.contains(&b'n') && keyword.ends_with(b"OFF") {
        return Err(tokens.expected("OFF in three dimensions", Some(keyword)));
    }
    let vertices = read_count(tokens, "the number of vertices")?;
    let faces = read_count(tokens, "the number of faces")?;
    tokens.end_line();
    let has_normals = keyword[..keyword.len().saturating_sub(3)].to_ascii_uppercase().contains(&b'N');
    Ok(Header { vertices, faces, has_normals })
}

fn read_count(tokens: &mut Tokens, what: &str) -> Result<usize, ReadError> {
    let token = tokens.next();
    let count = token.and_then(|token| std::str::from_utf8(token).ok()?.parse().ok());
    count.ok_or_else(|| tokens.expected(what, token))
}

/// Answers whether all vertices are there.
fn read_vertices(tokens: &mut Tokens, header: &Header, parsed: &mut Parsed) -> Result<bool, ReadError> {
    let mut normals = Vec::new();
    parsed.positions.reserve(header.vertices.min(tokens.remaining() / SHORTEST_VERTEX));
    for index in 0..header.vertices {
        let Some(position) = tokens.numbers("three coordinates")? else {
            cut(header.vertices - index, &mut parsed.tally);
            return Ok(false);
        };
        parsed.positions.push(Vec3::from_array(position));
        if header.has_normals {
            let normal = tokens.numbers_in_line("a normal of three numbers")?;
            normals.push(normal.map_or(Vec3::NAN, Vec3::from_array));
        }
        tokens.end_line();
    }
    parsed.normals = header.has_normals.then_some(normals);
    Ok(true)
}

fn cut(missing: usize, tally: &mut Tally) {
    tally.add(WarningKind::CountMismatch, missing);
    tally.add(WarningKind::TruncatedRecord, 1);
}

fn read_faces(tokens: &mut Tokens, header: &Header, tally: &mut Tally) -> Result<Vec<[u32; 3]>, ReadError> {
    let (mut triangles, mut corners) = (Vec::new(), Vec::new());
    for index in 0..header.faces {
        if !read_corners(tokens, &mut corners)? {
            cut(header.faces - index, tally);
            break;
        }
        push_polygon(&mut triangles, &corners, tally);
        tokens.end_line();
    }
    Ok(triangles)
}

/// Reads a number of corners and so many indices; answers whether the file did not end before.
fn read_corners(tokens: &mut Tokens, corners: &mut Vec<u32>) -> Result<bool, ReadError> {
    corners.clear();
    let Some([length]) = tokens.numbers("the number of corners of a face")? else { return Ok(false) };
    if length < 0.0 || length.fract() != 0.0 {
        return Err(tokens.error(format!("the number of corners of a face, found {length}")));
    }
    for _ in 0..length as u64 {
        let token = tokens.next_in_line();
        match token.and_then(number) {
            Some(index) if index.fract() == 0.0 => corners.push(vertex_index(index as i64)),
            _ if tokens.is_at_end() => return Ok(false),
            _ => {
                let found = token.map_or("the end of the line".to_owned(), quote);
                return Err(tokens
                    .error(format!("{length} vertex indices after the number of corners, found {found}")));
            }
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::is_keyword;
    use crate::data::{Warning, WarningKind};
    use crate::io::{Format, Geometry, Imported, Location, ReadError, read};
    use crate::math::Vec3;

    fn soup(file: &str) -> (Vec<[u32; 3]>, Vec<Warning>) {
        match read(file.as_bytes()).unwrap() {
            Imported { geometry: Geometry::Soup(soup), warnings, format: Format::Off } => {
                (soup.triangles().to_vec(), warnings)
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn keywords_are_told_from_other_words() {
        assert!(
            ["OFF", "off", "COFF", "NOFF", "STCN4nOFF", "CNOFF"].iter().all(|w| is_keyword(w.as_bytes()))
        );
        assert!(!["offset", "kickoff", "FF", "O"].iter().any(|w| is_keyword(w.as_bytes())));
    }

    #[test]
    fn colours_comments_and_layouts_make_no_difference() {
        let expected = (vec![[0, 1, 2], [0, 2, 3]], vec![]);
        let vertices = "0 0 0\n2 0 0\n# hand\n\n2 2 0 # two\n0 2 0\n";
        for header in ["OFF\n4 1 4\n", "# a\nOFF 4 1 0\r\n", "off\n4 1\n"] {
            assert_eq!(soup(&format!("{header}{vertices}4 0 1 2 3 255 0 0\n")), expected, "{header}");
        }
        let coloured = "COFF\n4 1 0\n0 0 0 9 9 9 9\n2 0 0 9 9 9 9\n2 2 0 1 1 1 1\n0 2 0 1 0 0 1\n4 0 1 2 3";
        assert_eq!(soup(coloured), expected);
    }

    #[test]
    fn vertices_with_normals_and_no_faces_are_a_cloud() {
        let file = b"NOFF\n2 0 0\n0 0 9 0 0 2\n1 0 9 0 3 0\n";
        let Geometry::Cloud(cloud) = read(file).unwrap().geometry else { panic!() };
        assert_eq!(cloud.normals(), Some(&[Vec3::Z, Vec3::Y][..]));
    }

    #[test]
    fn lying_counts_give_what_is_there() {
        let file = "OFF\n3 1000000000 0\n0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n3 0 1 7\n4000000000 1 2";
        let warnings = vec![
            Warning::new(WarningKind::CountMismatch, 1_000_000_000 - 2),
            Warning::new(WarningKind::TruncatedRecord, 1),
            Warning::new(WarningKind::IndexOutOfRange, 1),
        ];
        assert_eq!(soup(file), (vec![[0, 1, 2]], warnings));
        let cut = read(b"OFF\n1000000000 1 0\n0 0 0\n2 0 0\n").unwrap_err();
        assert!(matches!(cut, ReadError::EmptyInput { format: Some(Format::Off), .. }));
    }

    #[test]
    fn errors_name_the_line() {
        let cases = [
            ("OFF\n3 -1 0\n", 2, "'-1'"),
            ("OFF\n3 1 0\n0 0 0\n0 x 0\n0 0 0\n", 4, "'x'"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0\n9", 4, "the end of the line"),
            ("4OFF\n1 1 0\n", 1, "'4OFF'"),
        ];
        for (file, line, part) in cases {
            match read(file.as_bytes()) {
                Err(ReadError::Parse { format: Format::Off, at, expected }) => {
                    assert_eq!(at, Location::Line(line), "{file}");
                    assert!(expected.contains(part), "{expected}");
                }
                other => panic!("{file}: {other:?}"),
            }
        }
    }
}
