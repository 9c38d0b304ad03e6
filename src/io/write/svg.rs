use crate::data::{Layer, Polygon, Ring, signed_area};
use crate::math::{Aabb, Vec2, Vec3};
use std::io::{self, BufWriter, Write};

/// Writes one layer as a drawing at its true size in millimetres, y up: one path for each polygon, whose holes
/// are left open under either fill rule.
///
/// # Errors
/// If and only if `out` refuses to be written to.
#[inline(never)]
pub fn write_layer_svg(layer: &Layer, out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let outlines = layer.polygons.iter().flat_map(|polygon| &polygon.outer);
    let bounds = Aabb::around(outlines.map(|p| on_paper(*p).extend(0.0)));
    let size = bounds.size();
    let corner = if bounds.is_empty() { Vec3::ZERO } else { bounds.min };
    let [x, y, width, height] = [corner.x, corner.y, size.x, size.y].map(rounded);
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="{width}mm" height="{height}mm" viewBox="{x} {y} {width} {height}">"#
    )?;
    writeln!(
        out,
        "<title>layer from z = {} to {} mm</title>",
        rounded(layer.z_bottom),
        rounded(layer.z_top)
    )?;
    for polygon in &layer.polygons {
        write!(out, r#"<path fill-rule="evenodd" d=""#)?;
        write_ring(&polygon.outer, &mut out)?;
        polygon.holes.iter().try_for_each(|hole| write_ring(hole, &mut out))?;
        writeln!(out, r#""/>"#)?;
    }
    writeln!(out, "</svg>")?;
    out.flush()
}

/// Writes layers into one drawing as Slic3r's `--export-svg` does, which programs for projectors read: a group for each layer, in their
/// order and empty ones too, with `slic3r:z` its top, `slic3r:slice-z` where it was sampled and `slic3r:layer-height`; in it a white
/// polygon of `slic3r:type` `contour` for each outline and a black `hole` for each hole, to be painted in their order.
///
/// As those programs expect, the drawing begins at (0, 0): what it has at (x, y) lies at (`data-left` + x, `data-top` − y) of
/// the model. All numbers are in millimetres, to a nanometre.
///
/// # Errors
/// If and only if `out` refuses to be written to.
#[inline(never)]
pub fn write_layers_svg(layers: &[Layer], out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let outlines = layers.iter().flat_map(|layer| &layer.polygons).flat_map(|polygon| &polygon.outer);
    let bounds = Aabb::around(outlines.map(|p| p.extend(0.0)));
    let (min, max) = if bounds.is_empty() { (Vec3::ZERO, Vec3::ZERO) } else { (bounds.min, bounds.max) };
    // Rounded outward, and before it is taken off: it can be added back, and nothing is rounded off the drawing.
    let [left, top] = [-rounded_up(-min.x), rounded_up(max.y)].map(|v| v + 0.0);
    let [width, height] = [rounded_up(max.x - left), rounded_up(top - min.y)];
    let corner = Vec2::new(left, top);
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(
        out,
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:slic3r="http://slic3r.org/namespaces/slic3r" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}" data-left="{left}" data-top="{top}" style="background-color: black">"#
    )?;
    for (number, layer) in layers.iter().enumerate() {
        let [z, sample] = [layer.z_top, layer.z_sample].map(rounded);
        let thickness = rounded(layer.z_top - layer.z_bottom);
        writeln!(
            out,
            r#"<g id="layer{number}" slic3r:z="{z}" slic3r:slice-z="{sample}" slic3r:layer-height="{thickness}">"#
        )?;
        for polygon in outermost_first(&layer.polygons) {
            write_polygon(&polygon.outer, "contour", "white", corner, &mut out)?;
            for hole in &polygon.holes {
                write_polygon(hole, "hole", "black", corner, &mut out)?;
            }
        }
        writeln!(out, "</g>")?;
    }
    writeln!(out, "</svg>")?;
    out.flush()
}

/// What lies in a hole comes after what has the hole, not to be painted over: it is smaller.
fn outermost_first(polygons: &[Polygon]) -> Vec<&Polygon> {
    let mut order: Vec<(f64, &Polygon)> = polygons.iter().map(|p| (signed_area(&p.outer), p)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    order.into_iter().map(|(_, polygon)| polygon).collect()
}

fn write_polygon(
    ring: &Ring,
    kind: &str,
    colour: &str,
    corner: Vec2,
    out: &mut impl Write,
) -> io::Result<()> {
    write!(out, r#"<polygon slic3r:type="{kind}" points=""#)?;
    for (index, point) in ring.iter().enumerate() {
        let [x, y] = on_paper(*point - corner).to_array().map(rounded);
        write!(out, "{}{x},{y}", if index == 0 { "" } else { " " })?;
    }
    writeln!(out, r#"" style="fill: {colour}"/>"#)
}

/// SVG's y runs down.
fn on_paper(p: Vec2) -> Vec2 {
    Vec2::new(p.x, -p.y)
}

/// To a nanometre, far below what any machine follows; without a minus before zero.
fn rounded(millimetres: f64) -> f64 {
    (millimetres * 1e6).round() / 1e6 + 0.0
}

fn rounded_up(millimetres: f64) -> f64 {
    (millimetres * 1e6).ceil() / 1e6
}

fn write_ring(ring: &[Vec2], out: &mut impl Write) -> io::Result<()> {
    for (index, point) in ring.iter().enumerate() {
        let [x, y] = on_paper(*point).to_array().map(rounded);
        write!(out, "{}{x} {y}", if index == 0 { "M" } else { "L" })?;
    }
    if ring.is_empty() { Ok(()) } else { write!(out, "Z") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Polygon;

    fn rectangle(min: [f64; 2], max: [f64; 2]) -> Vec<Vec2> {
        let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
        corners.map(Vec2::from_array).to_vec()
    }

    fn text(layer: &Layer) -> String {
        let mut bytes = Vec::new();
        write_layer_svg(layer, &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn layer_is_drawn_to_scale_with_y_up() {
        let mut hole = rectangle([2.0, 4.0], [3.0, 5.0]);
        hole.reverse();
        let polygon = Polygon { outer: rectangle([1.0, 3.0], [5.0, 6.5]), holes: vec![hole] };
        let layer = Layer { z_bottom: 0.2, z_top: 0.4, z_sample: 0.3, polygons: vec![polygon] };
        assert_eq!(
            text(&layer),
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="4mm" height="3.5mm" viewBox="1 -6.5 4 3.5">
<title>layer from z = 0.2 to 0.4 mm</title>
<path fill-rule="evenodd" d="M1 -3L5 -3L5 -6.5L1 -6.5ZM2 -5L3 -5L3 -4L2 -4Z"/>
</svg>
"#
        );
    }

    #[test]
    fn islands_are_painted_after_the_holes_they_lie_in() {
        let mut hole = rectangle([1.0, 1.0], [9.0, 9.0]);
        hole.reverse();
        let ring = Polygon { outer: rectangle([0.0, 0.0], [10.0, 10.0]), holes: vec![hole] };
        let island = Polygon { outer: rectangle([4.0, 4.0], [6.0, 7.0]), holes: vec![] };
        let layer = Layer { z_bottom: 0.0, z_top: 0.25, z_sample: 0.125, polygons: vec![island, ring] };
        let above = Layer { z_bottom: 0.25, z_top: 0.5, z_sample: 0.375, polygons: vec![] };
        let mut bytes = Vec::new();
        write_layers_svg(&[layer, above], &mut bytes).unwrap();
        assert_eq!(
            String::from_utf8(bytes).unwrap(),
            r#"<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:slic3r="http://slic3r.org/namespaces/slic3r" width="10mm" height="10mm" viewBox="0 0 10 10" data-left="0" data-top="10" style="background-color: black">
<g id="layer0" slic3r:z="0.25" slic3r:slice-z="0.125" slic3r:layer-height="0.25">
<polygon slic3r:type="contour" points="0,10 10,10 10,0 0,0" style="fill: white"/>
<polygon slic3r:type="hole" points="1,1 9,1 9,9 1,9" style="fill: black"/>
<polygon slic3r:type="contour" points="4,6 6,6 6,3 4,3" style="fill: white"/>
</g>
<g id="layer1" slic3r:z="0.5" slic3r:slice-z="0.375" slic3r:layer-height="0.25">
</g>
</svg>
"#
        );
    }

    #[test]
    fn empty_layer_is_a_valid_drawing() {
        assert!(text(&Layer::default()).contains(r#"viewBox="0 0 0 0""#));
    }
}
