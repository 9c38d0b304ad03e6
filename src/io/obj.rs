//! Wavefront OBJ: `v`, `vn` and `f`; everything else (groups, materials, texture coordinates) has no part in the
//! shape.
//!
//! Written here rather than taken from `tobj`, whose errors name no line and which refuses a whole file for one
//! index out of range.
use super::parsed::{Parsed, Tally, push_polygon, vertex_index};
use super::text::{Commas, Continuation, Syntax, Tokens};
use super::{Format, ReadError};
use crate::data::WarningKind;
use crate::math::Vec3;

static SYNTAX: Syntax = Syntax {
    format: Format::Obj,
    commas: Commas::Plain,
    comments: &[b"#"],
    continuation: Continuation::Backslash,
};

/// Statements that hold no triangles and no points of their own.
const IGNORED: &[&[u8]] =
    &[b"vt", b"vp", b"g", b"o", b"s", b"mg", b"mtllib", b"usemtl", b"maplib", b"usemap", b"lod", b"bevel"];

#[derive(Default)]
struct Statements {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    faces: usize,
    tally: Tally,
    /// Corners of the face being read.
    corners: Vec<u32>,
}

/// Reads faces of any number of corners; without faces the vertices are a cloud, with the normals if they are as
/// many.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut tokens = Tokens::new(bytes, &SYNTAX);
    let mut all = Statements::default();
    while let Some(keyword) = tokens.next() {
        let is_cut = match keyword {
            b"v" => push_vector(&mut all.positions, &mut tokens, "three coordinates after 'v'")?,
            b"vn" => push_vector(&mut all.normals, &mut tokens, "three components after 'vn'")?,
            b"f" => all.read_face(&mut tokens)?,
            keyword => {
                all.tally.add(WarningKind::SkippedElements, usize::from(!IGNORED.contains(&keyword)));
                false
            }
        };
        all.tally.add(WarningKind::TruncatedRecord, usize::from(is_cut));
        tokens.end_line();
    }
    let Statements { positions, normals, triangles, faces, tally, .. } = all;
    let normals = (normals.len() == positions.len()).then_some(normals);
    Ok(Parsed { positions, normals, triangles: (faces > 0).then_some(triangles), tally })
}

/// Adds the vector that follows; answers whether the end of the file cut it.
fn push_vector(to: &mut Vec<Vec3>, tokens: &mut Tokens, what: &str) -> Result<bool, ReadError> {
    let vector = tokens.numbers_in_line(what)?;
    to.extend(vector.map(Vec3::from_array));
    Ok(vector.is_none())
}

impl Statements {
    /// Adds the polygon that follows; answers whether the end of the file cut it.
    fn read_face(&mut self, tokens: &mut Tokens) -> Result<bool, ReadError> {
        self.faces += 1;
        self.corners.clear();
        while let Some(token) = tokens.next_in_line() {
            match self.corner(token) {
                Some(index) => self.corners.push(index),
                None if tokens.is_at_end() => return Ok(true),
                None => return Err(tokens.expected("a vertex index such as 7, -1 or 7/2/3", Some(token))),
            }
        }
        push_polygon(&mut self.triangles, &self.corners, &mut self.tally);
        Ok(false)
    }

    /// The vertex that `7`, `7/2`, `7//3` or `7/2/3` names: from 1, or backwards from the last with −1.
    fn corner(&self, token: &[u8]) -> Option<u32> {
        let position = token.split(|&b| b == b'/').next()?;
        let number: i64 = std::str::from_utf8(position).ok()?.parse().ok()?;
        let from_start =
            if number < 0 { number.saturating_add(self.positions.len() as i64) } else { number - 1 };
        Some(vertex_index(from_start))
    }
}

#[cfg(test)]
mod tests {
    use crate::data::{Warning, WarningKind};
    use crate::io::{Geometry, Location, ReadError, read};
    use crate::math::Vec3;

    const SQUARE: &str = "v 0 0 0\nv 2 0 0 1 0.5 0.5 0.5\nv 2 2 0\nv 0 2 0\nvt 0 0\nvn 0 0 1\n";

    fn triangles(file: &str) -> (Vec<[u32; 3]>, Vec<Warning>) {
        let imported = read(file.as_bytes()).unwrap();
        let Geometry::Soup(soup) = imported.geometry else { panic!("{file} is a soup") };
        (soup.triangles().to_vec(), imported.warnings)
    }

    #[test]
    fn polygons_of_any_index_style_become_fans() {
        for face in ["f 1 2 3 4", "f 1/1 2/1 3/1 4/1", "f 1//1 2//1 3//1 \\\n 4//1", "f -4/1/1 -3 -2 -1"] {
            let file = format!("# quad\no it\n{SQUARE}g a b\nusemtl x\ns off\n{face}\n");
            assert_eq!(triangles(&file), (vec![[0, 1, 2], [0, 2, 3]], vec![]), "{face}");
        }
    }

    #[test]
    fn faces_that_cannot_be_used_are_counted() {
        let file = format!("{SQUARE}f 1 2 3\nf 1 2\nf 0 1 2\nf 1 2 9\nf -9 1 2\nl 1 2\nf 1 2 99999999999\n");
        let expected = vec![
            Warning::new(WarningKind::SkippedElements, 2),
            Warning::new(WarningKind::IndexOutOfRange, 4),
        ];
        assert_eq!(triangles(&file), (vec![[0, 1, 2]], expected));
    }

    #[test]
    fn vertices_without_faces_are_a_cloud() {
        let Geometry::Cloud(cloud) = read(b"v 0 0 9\nvn 0 0 2\nv 1 0 9\nvn 0 3 0\n").unwrap().geometry else {
            panic!()
        };
        assert_eq!(cloud.normals(), Some(&[Vec3::Z, Vec3::Y][..]));
        let Geometry::Cloud(bare) = read(b"v 0 0 9\nvn 0 0 2\nv 1 0 9\n").unwrap().geometry else { panic!() };
        assert_eq!((bare.len(), bare.normals()), (2, None));
    }

    #[test]
    fn bad_coordinate_names_its_line() {
        let error = read(b"v 0 0 0\nv 1 O 0\nf 1 1 2\n").unwrap_err();
        let expected = "three coordinates after 'v', found 'O'".to_owned();
        assert_eq!(
            error,
            ReadError::Parse { format: crate::io::Format::Obj, at: Location::Line(2), expected }
        );
    }
}
