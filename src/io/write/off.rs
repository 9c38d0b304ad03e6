use super::{vertices, write_vector};
use crate::data::TriangleSoup;
use std::io::{self, Write};

pub(super) fn write(soup: &TriangleSoup, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "OFF\n{} {} 0", soup.positions().len(), soup.len())?;
    for vertex in vertices(soup) {
        write_vector(vertex, out)?;
        writeln!(out)?;
    }
    for [a, b, c] in soup.triangles() {
        writeln!(out, "3 {a} {b} {c}")?;
    }
    Ok(())
}
