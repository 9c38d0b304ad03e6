//! DXF of AutoCAD release 12 (1992), the last one that needs no tables of handles and classes around a drawing: every program for
//! cutters and mills reads it. A file is pairs of lines, a group code and its value.
use super::rings;
use crate::data::{Layer, Ring};
use crate::math::{Aabb, Vec3};
use std::fmt::Display;
use std::io::{self, BufWriter, Write};

/// `$INSUNITS` of later releases, which many programs look for in any.
const MILLIMETRES: u32 = 4;
/// `$MEASUREMENT`.
const METRIC: u32 = 1;
/// Of layers: black on white paper and white on black.
const COLOUR: u32 = 7;
/// Of a polyline: its last vertex is joined to its first.
const CLOSED: u32 = 1;
/// Of a polyline: vertices follow.
const VERTICES_FOLLOW: u32 = 1;

/// Writes layers as a DXF drawing in millimetres, exact: each ring a closed polyline at the height where its layer was sampled, on a DXF
/// layer of its own, `SLICE_0` for the first. Empty layers have a DXF layer without polylines.
///
/// # Errors
/// If and only if `out` refuses to be written to.
#[inline(never)]
pub fn write_layers_dxf(layers: &[Layer], out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    write_header(layers, &mut out)?;
    write_tables(layers.len(), &mut out)?;
    begin_section("ENTITIES", &mut out)?;
    for (number, layer) in layers.iter().enumerate() {
        for ring in rings(&layer.polygons) {
            write_ring(ring, layer.z_sample, &layer_name(number), &mut out)?;
        }
    }
    pair(0, "ENDSEC", &mut out)?;
    pair(0, "EOF", &mut out)?;
    out.flush()
}

fn pair(code: u32, value: impl Display, out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "{code:>3}\n{value}")
}

/// A point, its axes under the codes 10, 20 and 30. With a decimal point or an exponent always, as real numbers have them.
fn point(p: Vec3, out: &mut impl Write) -> io::Result<()> {
    (1..).zip(p.to_array()).try_for_each(|(axis, value)| pair(10 * axis, format_args!("{value:?}"), out))
}

fn begin_section(name: &str, out: &mut impl Write) -> io::Result<()> {
    pair(0, "SECTION", out)?;
    pair(2, name, out)
}

fn layer_name(number: usize) -> String {
    format!("SLICE_{number}")
}

fn write_header(layers: &[Layer], out: &mut impl Write) -> io::Result<()> {
    let of_layer = |layer: &Layer| {
        let z = layer.z_sample;
        Aabb::around(layer.polygons.iter().flat_map(|p| &p.outer).map(|p| p.extend(z)))
    };
    let bounds = layers.iter().map(of_layer).fold(Aabb::EMPTY, Aabb::union);
    begin_section("HEADER", out)?;
    pair(9, "$ACADVER", out)?;
    pair(1, "AC1009", out)?;
    for (name, value) in [("$INSUNITS", MILLIMETRES), ("$MEASUREMENT", METRIC)] {
        pair(9, name, out)?;
        pair(70, value, out)?;
    }
    if !bounds.is_empty() {
        for (name, corner) in [("$EXTMIN", bounds.min), ("$EXTMAX", bounds.max)] {
            pair(9, name, out)?;
            point(corner, out)?;
        }
    }
    pair(0, "ENDSEC", out)
}

fn write_tables(layers: usize, out: &mut impl Write) -> io::Result<()> {
    begin_section("TABLES", out)?;
    pair(0, "TABLE", out)?;
    pair(2, "LTYPE", out)?;
    pair(70, 1, out)?;
    for (code, value) in
        [(0, "LTYPE"), (2, "CONTINUOUS"), (70, "0"), (3, "Solid line"), (72, "65"), (73, "0")]
    {
        pair(code, value, out)?;
    }
    // The length of a dash pattern, of which a solid line has none.
    pair(40, "0.0", out)?;
    pair(0, "ENDTAB", out)?;
    pair(0, "TABLE", out)?;
    pair(2, "LAYER", out)?;
    pair(70, layers, out)?;
    for number in 0..layers {
        pair(0, "LAYER", out)?;
        pair(2, layer_name(number), out)?;
        pair(70, 0, out)?;
        pair(62, COLOUR, out)?;
        pair(6, "CONTINUOUS", out)?;
    }
    pair(0, "ENDTAB", out)?;
    pair(0, "ENDSEC", out)
}

fn write_ring(ring: &Ring, z: f64, layer: &str, out: &mut impl Write) -> io::Result<()> {
    pair(0, "POLYLINE", out)?;
    pair(8, layer, out)?;
    pair(66, VERTICES_FOLLOW, out)?;
    point(Vec3::new(0.0, 0.0, z), out)?;
    pair(70, CLOSED, out)?;
    for p in ring {
        pair(0, "VERTEX", out)?;
        pair(8, layer, out)?;
        point(p.extend(z), out)?;
    }
    pair(0, "SEQEND", out)?;
    pair(8, layer, out)
}
