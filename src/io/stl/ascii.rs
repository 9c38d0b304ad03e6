//! Text STL: `facet normal … outer loop vertex … vertex … vertex … endloop endfacet`, in any letter case.
use crate::data::WarningKind;
use crate::io::parsed::{Parsed, Tally, push_polygon};
use crate::io::text::{Commas, Continuation, Syntax, Tokens};
use crate::io::{Format, ReadError};
use crate::math::Vec3;

static SYNTAX: Syntax =
    Syntax { format: Format::Stl, commas: Commas::Plain, comments: &[], continuation: Continuation::Never };

enum Word {
    /// `solid` and `endsolid`, after which comes a name.
    Named,
    Normal,
    Vertex,
    EndLoop,
    /// The words that only frame the others.
    Frame,
}

fn word(token: &[u8]) -> Option<Word> {
    let is = |word: &str| token.eq_ignore_ascii_case(word.as_bytes());
    if is("vertex") {
        Some(Word::Vertex)
    } else if is("facet") || is("outer") || is("loop") || is("endfacet") {
        Some(Word::Frame)
    } else if is("normal") {
        Some(Word::Normal)
    } else if is("endloop") {
        Some(Word::EndLoop)
    } else if is("solid") || is("endsolid") {
        Some(Word::Named)
    } else {
        None
    }
}

/// Moves past what stands for a normal, up to three tokens: it is not used, so it need not be right.
fn skip_normal(tokens: &mut Tokens) {
    let mut ahead = tokens.clone();
    for _ in 0..3 {
        if ahead.next().is_none_or(|token| word(token).is_some()) {
            return;
        }
        *tokens = ahead.clone();
    }
}

/// Reads any number of solids; a facet that the end of the file cuts is dropped and counted.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut tokens = Tokens::new(bytes, &SYNTAX);
    let (mut positions, mut triangles, mut tally) = (Vec::new(), Vec::new(), Tally::default());
    let mut corners: Vec<u32> = Vec::new();
    let mut is_cut = false;
    while let Some(token) = tokens.next() {
        match word(token) {
            Some(Word::Named) => tokens.end_line(),
            Some(Word::Frame) => {}
            Some(Word::Normal) => skip_normal(&mut tokens),
            Some(Word::Vertex) => match tokens.numbers("a vertex of three numbers")? {
                Some(position) => {
                    corners.push(positions.len() as u32);
                    positions.push(Vec3::from_array(position));
                }
                None => is_cut = true,
            },
            Some(Word::EndLoop) => {
                push_polygon(&mut triangles, &corners, &mut tally);
                corners.clear();
            }
            None if tokens.is_at_end() => is_cut = true,
            None => {
                return Err(tokens.expected(
                    "'facet', 'outer loop', 'vertex', 'endloop', 'endfacet' or 'endsolid'",
                    Some(token),
                ));
            }
        }
    }
    tally.add(WarningKind::TruncatedRecord, usize::from(is_cut || !corners.is_empty()));
    Ok(Parsed { positions, triangles: Some(triangles), tally, ..Parsed::default() })
}

#[cfg(test)]
mod tests {
    use crate::data::{Warning, WarningKind};
    use crate::io::{Geometry, Location, ReadError, read};
    use crate::math::Vec3;

    const FACET: &str = "facet normal 0 0 1\r\n outer loop\r\n  vertex 0 0 0\r\n  vertex 1.5 0 0\r\n  \
        vertex 0 2e0 0\r\n endloop\r\nendfacet\r\n";

    #[test]
    fn solids_of_any_letter_case_are_joined() {
        let file =
            format!("solid facet one\r\n{FACET}endsolid\r\n{}", format!("solid\n{FACET}").to_uppercase());
        let imported = read(file.as_bytes()).unwrap();
        let Geometry::Soup(soup) = imported.geometry else { panic!() };
        assert_eq!(soup.len(), 2);
        assert_eq!(soup.corners(1), [Vec3::ZERO, Vec3::X * 1.5, Vec3::Y * 2.0]);
        assert_eq!(imported.warnings, []);
    }

    #[test]
    fn normal_may_be_nonsense_or_missing() {
        for normal in ["", "nan nan nan", "0 0", "a b c"] {
            let file = format!("solid\n{FACET}").replace("0 0 1", normal);
            assert_eq!(read(file.as_bytes()).unwrap().geometry.len(), 1, "{normal}");
        }
    }

    #[test]
    fn cut_facet_is_dropped_with_a_warning() {
        let file = format!("solid\n{FACET}{FACET}");
        let imported = read(&file.as_bytes()[..file.len() - 40]).unwrap();
        assert_eq!(imported.geometry.len(), 1);
        assert_eq!(imported.warnings, [Warning::new(WarningKind::TruncatedRecord, 1)]);
    }

    #[test]
    fn strange_word_is_named_with_its_line() {
        let file = format!("solid\n{FACET}fazet normal 0 0 1\n{FACET}");
        match read(file.as_bytes()).unwrap_err() {
            ReadError::Parse { at, expected, .. } => {
                assert_eq!(at, Location::Line(9));
                assert!(expected.ends_with("found 'fazet'"), "{expected}");
            }
            other => panic!("{other:?}"),
        }
    }
}
