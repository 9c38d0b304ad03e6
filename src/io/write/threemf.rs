//! 3MF (3MF Consortium, *Core Specification* 1.2): a mesh; and with the slice extension (*Slice Extension* 1.0) the layers as a stack
//! of slices, and beside it the mesh that every object has to have.
use super::{Shortest, rings, vertices};
use crate::data::{Layer, Ring, TriangleSoup};
use crate::io::threemf::Packer;
use crate::math::{Vec2, Vec3};
use rustc_hash::FxHashMap;
use std::io::{self, BufWriter, Write};

const CONTENT_TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"#;
const RELATIONSHIPS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Id="model" Target="/3D/3dmodel.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"#;
const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const SLICE: &str = "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07";

/// What the mesh beside slices is good for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MeshResolution {
    /// The slices could be made of it again.
    #[default]
    Full,
    /// To look at only: who does not know slices has to refuse the file.
    Low,
}

/// Why layers could not be written as 3MF.
#[derive(Debug, thiserror::Error)]
pub enum SliceStackError {
    #[error("layer {layer} ends at {top} mm: its top must lie above {below} mm, where it begins")]
    NotRising { layer: usize, top: f64, below: f64 },
    #[error("a coordinate of layer {layer} is not finite: 3MF has no such numbers")]
    NonFinite { layer: usize },
    #[error("there is no triangle: 3MF requires a mesh beside the slices")]
    NoMesh,
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Writes layers as the slices of a 3MF package, in millimetres and exact, with the mesh that 3MF requires beside them.
///
/// Slices lie on one another: each begins where the one before ends, the first at its own bottom. Empty ones are kept. All
/// rings are written, outer ones counter-clockwise and holes clockwise, which 3MF's positive fill rule fills as they are meant; those
/// of fewer than three points have no inside and are left out, as triangles that use a vertex twice are. Vertices are shared among
/// the rings of a slice.
///
/// # Errors
/// If and only if a layer's top is not above the one before (the first's: above its own bottom), so also for planes without thickness;
/// if a coordinate is not finite; if there is no triangle; or if `out` refuses to be written to or the package is larger than 4 GiB.
/// Nothing is written unless it is one of the last two.
#[inline(never)]
pub fn write_layers_3mf(
    layers: &[Layer],
    mesh: &TriangleSoup,
    resolution: MeshResolution,
    out: &mut impl Write,
) -> Result<(), SliceStackError> {
    check(layers)?;
    if !mesh.triangles().iter().any(is_written) {
        return Err(SliceStackError::NoMesh);
    }
    Ok(pack(out, |out| write_model(layers, mesh, resolution, out))?)
}

/// Writes triangles as a 3MF package, in millimetres and exact. Vertices in the same place are one; triangles that use one twice
/// are left out.
#[inline(never)]
pub(super) fn write_mesh_3mf(mesh: &TriangleSoup, out: &mut impl Write) -> io::Result<()> {
    pack(out, |out| {
        writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
        writeln!(out, r#"<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}">"#)?;
        writeln!(out, "<resources>\n<object id=\"1\" type=\"model\">")?;
        write_mesh(mesh, out)?;
        writeln!(out, "</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n</model>")
    })
}

/// The package around what `write_model` writes.
fn pack(out: &mut impl Write, write_model: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut packer = Packer::new(BufWriter::new(out));
    packer.file("[Content_Types].xml", |out| out.write_all(CONTENT_TYPES.as_bytes()))?;
    packer.file("_rels/.rels", |out| out.write_all(RELATIONSHIPS.as_bytes()))?;
    packer.file("3D/3dmodel.model", |out| {
        // Packing takes its time for each piece, however short.
        let mut out = BufWriter::new(out);
        write_model(&mut out)?;
        out.flush()
    })?;
    packer.finish()
}

fn check(layers: &[Layer]) -> Result<(), SliceStackError> {
    let mut below = layers.first().map_or(0.0, |layer| layer.z_bottom);
    for (index, layer) in layers.iter().enumerate() {
        let is_finite = [below, layer.z_top].iter().all(|z| z.is_finite());
        if !is_finite || rings(&layer.polygons).flatten().any(|p| !p.is_finite()) {
            return Err(SliceStackError::NonFinite { layer: index });
        }
        if layer.z_top <= below {
            return Err(SliceStackError::NotRising { layer: index, top: layer.z_top, below });
        }
        below = layer.z_top;
    }
    Ok(())
}

/// Whether a triangle has three different vertices: 3MF allows no others.
fn is_written([a, b, c]: &[u32; 3]) -> bool {
    a != b && b != c && c != a
}

fn write_model(
    layers: &[Layer],
    mesh: &TriangleSoup,
    resolution: MeshResolution,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (required, resolution) = match resolution {
        MeshResolution::Full => ("", "fullres"),
        MeshResolution::Low => (r#" requiredextensions="s""#, "lowres"),
    };
    writeln!(out, r#"<?xml version="1.0" encoding="UTF-8"?>"#)?;
    writeln!(
        out,
        r#"<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}" xmlns:s="{SLICE}"{required}>"#
    )?;
    writeln!(out, "<resources>")?;
    write_stack(layers, out)?;
    writeln!(out, r#"<object id="2" type="model" s:slicestackid="1" s:meshresolution="{resolution}">"#)?;
    write_mesh(mesh, out)?;
    writeln!(out, "</object>\n</resources>\n<build>\n<item objectid=\"2\"/>\n</build>\n</model>")
}

fn write_stack(layers: &[Layer], out: &mut dyn Write) -> io::Result<()> {
    let bottom = layers.first().map_or(0.0, |layer| layer.z_bottom);
    writeln!(out, r#"<s:slicestack id="1" zbottom="{}">"#, Shortest(bottom))?;
    for layer in layers {
        write!(out, r#"<s:slice ztop="{}""#, Shortest(layer.z_top))?;
        let slice = Slice::of(rings(&layer.polygons));
        if slice.rings.is_empty() {
            writeln!(out, "/>")?;
            continue;
        }
        writeln!(out, ">\n<s:vertices>")?;
        for p in &slice.vertices {
            writeln!(out, r#"<s:vertex x="{}" y="{}"/>"#, Shortest(p.x), Shortest(p.y))?;
        }
        writeln!(out, "</s:vertices>")?;
        for ring in &slice.rings {
            writeln!(out, r#"<s:polygon startv="{}">"#, ring[0])?;
            for vertex in ring[1..].iter().chain(&ring[..1]) {
                writeln!(out, r#"<s:segment v2="{vertex}"/>"#)?;
            }
            writeln!(out, "</s:polygon>")?;
        }
        writeln!(out, "</s:slice>")?;
    }
    writeln!(out, "</s:slicestack>")
}

fn write_mesh(mesh: &TriangleSoup, out: &mut dyn Write) -> io::Result<()> {
    let (places, numbers) = places_of(mesh);
    writeln!(out, "<mesh>\n<vertices>")?;
    for p in places {
        let [x, y, z] = p.to_array().map(Shortest);
        writeln!(out, r#"<vertex x="{x}" y="{y}" z="{z}"/>"#)?;
    }
    writeln!(out, "</vertices>\n<triangles>")?;
    for [a, b, c] in mesh.triangles().iter().map(|t| t.map(|v| numbers[v as usize])).filter(is_written) {
        writeln!(out, r#"<triangle v1="{a}" v2="{b}" v3="{c}"/>"#)?;
    }
    writeln!(out, "</triangles>\n</mesh>")
}

/// The different places of vertices, in the order of their first, and the number of each vertex's: by their vertices alone readers
/// know what is connected.
fn places_of(mesh: &TriangleSoup) -> (Vec<Vec3>, Vec<u32>) {
    let (mut places, mut known) = (Vec::new(), FxHashMap::default());
    let numbers = vertices(mesh).map(|p| {
        let next = places.len() as u32;
        // 0 is −0.
        let number = *known.entry((p + Vec3::ZERO).to_array().map(f64::to_bits)).or_insert(next);
        if number == next {
            places.push(p);
        }
        number
    });
    let numbers = numbers.collect();
    (places, numbers)
}

/// Rings as indices of vertices that they share.
#[derive(Default)]
struct Slice {
    vertices: Vec<Vec2>,
    rings: Vec<Vec<usize>>,
}

impl Slice {
    fn of<'a>(rings: impl Iterator<Item = &'a Ring>) -> Slice {
        let mut slice = Slice::default();
        let mut numbers = FxHashMap::default();
        for ring in rings {
            // Neighbours must differ, also the last and the first; equal as numbers are, so that 0 is −0.
            let mut corners = ring.clone();
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            if corners.len() < 3 {
                continue;
            }
            let number = |p: Vec2| {
                let next = slice.vertices.len();
                let number = *numbers.entry((p + Vec2::ZERO).to_array().map(f64::to_bits)).or_insert(next);
                if number == next {
                    slice.vertices.push(p);
                }
                number
            };
            slice.rings.push(corners.into_iter().map(number).collect());
        }
        slice
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rings_share_vertices_and_none_is_repeated() {
        let [a, b, c, d, e] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (2.0, 1.0), (2.0, 2.0)].map(Vec2::from);
        let rings = [vec![a, b, b, c, a], vec![c, d, e], vec![d, e], vec![Vec2::new(-0.0, 0.0), c, e]];
        let slice = Slice::of(rings.iter());
        assert_eq!(slice.vertices, [a, b, c, d, e]);
        assert_eq!(slice.rings, [vec![0, 1, 2], vec![2, 3, 4], vec![0, 2, 4]]);
    }

    #[test]
    fn stacks_that_do_not_rise_are_refused_by_the_layer() {
        let layer = |bottom: f64, top: f64| Layer { z_bottom: bottom, z_top: top, ..Layer::default() };
        let error = |layers: &[Layer]| check(layers).unwrap_err();
        let falls = error(&[layer(0.0, 0.2), layer(0.2, 0.4), layer(0.4, 0.4)]);
        assert!(matches!(falls, SliceStackError::NotRising { layer: 2, top: 0.4, below: 0.4 }), "{falls}");
        let plane = error(&[layer(0.5, 0.5)]);
        assert_eq!(
            plane.to_string(),
            "layer 0 ends at 0.5 mm: its top must lie above 0.5 mm, where it begins"
        );
        assert!(matches!(error(&[layer(0.0, f64::NAN)]), SliceStackError::NonFinite { layer: 0 }));
        assert!(check(&[]).is_ok());
    }
}
