use super::Shortest;
use crate::data::{Layer, Ring};
use std::io::{self, BufWriter, Write};

/// Writes layers as plain JSON, one a line, in millimetres and exact:
/// `[{"zBottom":0,"zTop":0.2,"zSample":0.1,"polygons":[{"outer":[[0,0],[1,0],[1,1]],"holes":[]}]}]`.
///
/// Outer rings run counter-clockwise, holes clockwise, and no ring repeats its first point. Every number of the layers is to be
/// finite, as those of slicing are: JSON has no others.
///
/// # Errors
/// If and only if `out` refuses to be written to.
#[inline(never)]
pub fn write_layers_json(layers: &[Layer], out: &mut impl Write) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    write!(out, "[")?;
    write_list(layers, ",\n", &mut out, |layer, out| {
        let [bottom, top, sample] = [layer.z_bottom, layer.z_top, layer.z_sample].map(Shortest);
        write!(out, r#"{{"zBottom":{bottom},"zTop":{top},"zSample":{sample},"polygons":["#)?;
        write_list(&layer.polygons, ",", out, |polygon, out| {
            write!(out, r#"{{"outer":"#)?;
            write_ring(&polygon.outer, out)?;
            write!(out, r#","holes":["#)?;
            write_list(&polygon.holes, ",", out, write_ring)?;
            write!(out, "]}}")
        })?;
        write!(out, "]}}")
    })?;
    writeln!(out, "]")?;
    out.flush()
}

fn write_ring<W: Write>(ring: &Ring, out: &mut W) -> io::Result<()> {
    write!(out, "[")?;
    write_list(ring, ",", out, |p, out| write!(out, "[{},{}]", Shortest(p.x), Shortest(p.y)))?;
    write!(out, "]")
}

fn write_list<T, W: Write>(
    items: &[T],
    between: &str,
    out: &mut W,
    write_item: impl Fn(&T, &mut W) -> io::Result<()>,
) -> io::Result<()> {
    for (index, item) in items.iter().enumerate() {
        if index > 0 {
            write!(out, "{between}")?;
        }
        write_item(item, out)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Polygon;
    use crate::math::Vec2;

    #[test]
    fn layers_are_arrays_of_rings() {
        let outer = vec![Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(0.1, 1e-9)];
        let hole = vec![Vec2::new(0.5, 0.25), Vec2::new(1.0, 0.5), Vec2::new(1.0, 0.25)];
        let polygons = vec![Polygon { outer, holes: vec![hole] }];
        let layers = [
            Layer { z_bottom: 0.0, z_top: 0.2, z_sample: 0.1, polygons },
            Layer { z_bottom: 0.2, z_top: 0.4, z_sample: 0.3, polygons: vec![] },
        ];
        let mut bytes = Vec::new();
        write_layers_json(&layers, &mut bytes).unwrap();
        let expected = r#"[{"zBottom":0,"zTop":0.2,"zSample":0.1,"polygons":[{"outer":[[0,0],[3,0],[0.1,1e-9]],"holes":[[[0.5,0.25],[1,0.5],[1,0.25]]]}]},
{"zBottom":0.2,"zTop":0.4,"zSample":0.3,"polygons":[]}]
"#;
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
        let mut none = Vec::new();
        write_layers_json(&[], &mut none).unwrap();
        assert_eq!(none, b"[]\n");
    }
}
