//! Wavefront OBJ with texture coordinates, and the material library that names the picture.
use super::{Shortest, vertices, write_vector};
use crate::data::TriangleSoup;
use crate::math::Vec2;
use std::io::{self, BufWriter, Write};

/// The name of the only material.
const MATERIAL: &str = "texture";

/// Writes triangles with the texture coordinates of their corners, v upward, as OBJ; `library` is the name of the file that
/// [`write_material_library`] writes. Coordinates that follow each other and are the same are written once.
///
/// # Panics
/// If there are not as many triples of coordinates as triangles.
///
/// # Errors
/// If and only if `out` refuses to be written to, or a name has a line break.
pub fn write_textured_obj(
    soup: &TriangleSoup,
    uv: &[[Vec2; 3]],
    library: &str,
    out: &mut impl Write,
) -> io::Result<()> {
    assert_eq!(uv.len(), soup.len(), "each triangle needs three texture coordinates");
    let mut out = BufWriter::new(out);
    writeln!(out, "mtllib {}\nusemtl {MATERIAL}", one_line(library)?)?;
    for vertex in vertices(soup) {
        write!(out, "v ")?;
        write_vector(vertex, &mut out)?;
        writeln!(out)?;
    }
    let mut numbers = rustc_hash::FxHashMap::default();
    let mut places = Vec::with_capacity(uv.len());
    for corners in uv {
        let mut place = |p: &Vec2| -> io::Result<usize> {
            let next = numbers.len() + 1;
            let number = *numbers.entry(p.to_array().map(f64::to_bits)).or_insert(next);
            if number == next {
                writeln!(out, "vt {} {}", Shortest(p.x), Shortest(p.y))?;
            }
            Ok(number)
        };
        places.push([place(&corners[0])?, place(&corners[1])?, place(&corners[2])?]);
    }
    for (corners, uv) in soup.triangles().iter().zip(places) {
        let [a, b, c] = corners.map(|index| u64::from(index) + 1);
        writeln!(out, "f {a}/{} {b}/{} {c}/{}", uv[0], uv[1], uv[2])?;
    }
    out.flush()
}

/// Writes the library of a white material with a picture, given by its file name.
///
/// # Errors
/// If and only if `out` refuses to be written to, or the name has a line break.
pub fn write_material_library(picture: &str, out: &mut impl Write) -> io::Result<()> {
    let picture = one_line(picture)?;
    write!(out, "newmtl {MATERIAL}\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd {picture}\n")
}

fn one_line(name: &str) -> io::Result<&str> {
    match name.contains(['\n', '\r']) {
        true => Err(io::Error::new(io::ErrorKind::InvalidInput, "a file name cannot have a line break")),
        false => Ok(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn shared_coordinates_are_written_once() {
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE];
        let soup = TriangleSoup::new(corners, vec![[0, 1, 2], [1, 3, 2]]).unwrap();
        let [a, b, c, d] = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]].map(Vec2::from_array);
        let mut text = Vec::new();
        write_textured_obj(&soup, &[[a, b, c], [b, d, c]], "m.mtl", &mut text).unwrap();
        let expected = "mtllib m.mtl\nusemtl texture\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\n\
            vt 0 0\nvt 0.5 0\nvt 0 0.5\nvt 0.5 0.5\nf 1/1 2/2 3/3\nf 2/2 4/4 3/3\n";
        assert_eq!(String::from_utf8(text).unwrap(), expected);
        assert!(write_material_library("a\nb.png", &mut Vec::new()).is_err());
        let read = crate::io::read(expected.as_bytes()).unwrap();
        assert!(matches!(read.geometry, crate::io::Geometry::Soup(read) if read == soup));
    }
}
