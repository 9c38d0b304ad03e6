use crate::data::Layer;
use crate::math::{Aabb, Vec2, Vec3};
use std::io::{self, BufWriter, Write};

/// Writes one layer as a drawing at its true size in millimetres, y up: one path for each polygon, whose holes
/// are left open under either fill rule.
///
/// # Errors
/// If and only if `out` refuses to be written to.
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

/// SVG's y runs down.
fn on_paper(p: Vec2) -> Vec2 {
    Vec2::new(p.x, -p.y)
}

/// To a nanometre, far below what any machine follows; without a minus before zero.
fn rounded(millimetres: f64) -> f64 {
    (millimetres * 1e6).round() / 1e6 + 0.0
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
    fn empty_layer_is_a_valid_drawing() {
        assert!(text(&Layer::default()).contains(r#"viewBox="0 0 0 0""#));
    }
}
