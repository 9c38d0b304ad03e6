use super::{vertices, write_vector};
use crate::data::TriangleSoup;
use std::io::{self, Write};

pub(super) fn write(soup: &TriangleSoup, out: &mut impl Write) -> io::Result<()> {
    for vertex in vertices(soup) {
        write!(out, "v ")?;
        write_vector(vertex, out)?;
        writeln!(out)?;
    }
    for corners in soup.triangles() {
        // In u64, as the last of 2³² − 1 vertices has number 2³² − 1, counted from 1.
        let [a, b, c] = corners.map(|index| u64::from(index) + 1);
        writeln!(out, "f {a} {b} {c}")?;
    }
    Ok(())
}
