//! Layers as files, read back by parsers that are not ours: `quick-xml`, `zip`, `serde_json`. `tests/bench/peers/roundtrip.py` hands
//! them to programs of these formats.
mod common;

use common::*;
use fast_winding::data::{Layer, Polygon, Silent, TriangleSoup};
use fast_winding::io::{
    self, Geometry, MeshResolution, SliceStackError, write_layers_3mf, write_layers_dxf, write_layers_json,
    write_layers_svg,
};
use fast_winding::math::{Aabb, Mat3, Vec2, Vec3};
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::winding::WindingField;
use quick_xml::events::{BytesStart, Event};
use std::io::{Cursor, Read};

/// A turned torus with an island in its hole and, above a gap, a box: holes, islands, empty layers, long digits.
fn model() -> TriangleSoup {
    let turn = Mat3::from_rotation_x(0.05);
    let ring = torus(3.0, 0.7, 40, 16);
    let positions = ring.positions().iter().map(|p| turn * *p).collect();
    let ring = TriangleSoup::new(positions, ring.triangles().to_vec()).unwrap();
    let above = Aabb { min: Vec3::new(-1.0, -1.0, 2.0), max: Vec3::new(1.0, 1.0, 3.0) };
    joined(&[ring, cube(0.5), cuboid(above)])
}

fn layers() -> Vec<Layer> {
    let plan = LayerPlan { layer_height: 0.15, first_layer_height: Some(1.0 / 3.0), ..LayerPlan::default() };
    let layers =
        slice(&WindingField::new(model(), Default::default()), &plan, &SliceConfig::default(), &Silent)
            .unwrap();
    let count = |test: fn(&Layer) -> bool| layers.iter().filter(|layer| test(layer)).count();
    assert!(count(|layer| layer.polygons.is_empty()) > 1);
    assert!(
        count(|layer| layer.polygons.iter().any(|p| !p.holes.is_empty()) && layer.polygons.len() > 1) > 1
    );
    layers
}

fn rings(layer: &Layer) -> Vec<Vec<Vec2>> {
    let of_polygon = |p: &Polygon| [std::slice::from_ref(&p.outer), &p.holes].concat();
    layer.polygons.iter().flat_map(of_polygon).collect()
}

/// Rings in an order that does not depend on that of a file.
fn sorted(mut rings: Vec<Vec<Vec2>>) -> Vec<Vec<Vec2>> {
    let key = |ring: &Vec<Vec2>| ring.iter().flat_map(|p| p.to_array()).collect::<Vec<f64>>();
    rings.sort_by(|a, b| key(a).partial_cmp(&key(b)).unwrap());
    rings
}

/// The elements of an XML file, each with the names of those around it and itself.
fn elements(xml: &str, mut take: impl FnMut(&[String], &BytesStart)) {
    let mut reader = quick_xml::Reader::from_str(xml);
    let mut path = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Start(element) => {
                path.push(element.name().0.to_owned());
                take(&path, &element);
            }
            Event::Empty(element) => {
                path.push(element.name().0.to_owned());
                take(&path, &element);
                path.pop();
            }
            Event::End(_) => drop(path.pop()),
            Event::Eof => break,
            _ => {}
        }
    }
    assert!(path.is_empty());
}

fn attribute(element: &BytesStart, name: &str) -> Option<String> {
    element.try_get_attribute(name).unwrap().map(|a| a.value.into_owned())
}

fn number(element: &BytesStart, name: &str) -> f64 {
    attribute(element, name).unwrap_or_else(|| panic!("no {name}")).parse().unwrap()
}

#[test]
fn svg_has_every_ring_of_every_layer_to_a_nanometre() {
    let layers = layers();
    let mut bytes = Vec::new();
    write_layers_svg(&layers, &mut bytes).unwrap();
    let (mut corner, mut size, mut found) = (Vec2::ZERO, Vec2::ZERO, Vec::new());
    elements(std::str::from_utf8(&bytes).unwrap(), |path, element| match path.last().unwrap().as_str() {
        "svg" => {
            assert_eq!(attribute(element, "xmlns:slic3r").unwrap(), "http://slic3r.org/namespaces/slic3r");
            corner = Vec2::new(number(element, "data-left"), number(element, "data-top"));
            let [width, height] = ["width", "height"].map(|name| attribute(element, name).unwrap());
            size = [width, height].map(|v| v.trim_end_matches("mm").parse().unwrap()).into();
        }
        "g" => {
            assert_eq!(attribute(element, "id").unwrap(), format!("layer{}", found.len()));
            let heights = ["z", "slice-z", "layer-height"].map(|n| number(element, &format!("slic3r:{n}")));
            found.push((heights, Vec::new()));
        }
        "polygon" => {
            let points = attribute(element, "points").unwrap();
            let point = |pair: &str| {
                let (x, y) = pair.split_once(',').unwrap();
                let p = Vec2::new(x.parse().unwrap(), y.parse().unwrap());
                assert!(p.min_element() >= 0.0 && p.cmple(size).all(), "{p} lies on the drawing");
                Vec2::new(corner.x + p.x, corner.y - p.y)
            };
            let kind = attribute(element, "slic3r:type").unwrap();
            found.last_mut().unwrap().1.push((kind, points.split(' ').map(point).collect::<Vec<Vec2>>()));
        }
        other => panic!("{other}"),
    });
    assert_eq!(found.len(), layers.len());
    for (layer, (heights, polygons)) in layers.iter().zip(found) {
        let expected = [layer.z_top, layer.z_sample, layer.z_top - layer.z_bottom];
        assert!(heights.iter().zip(expected).all(|(a, b)| (a - b).abs() < 0.6e-6));
        let of_kind = |wanted: &str| polygons.iter().filter(|(kind, _)| kind == wanted).count();
        assert_eq!(of_kind("contour"), layer.polygons.len());
        assert_eq!(of_kind("hole"), layer.polygons.iter().map(|p| p.holes.len()).sum::<usize>());
        for ring in rings(layer) {
            let is_it = |other: &Vec<Vec2>| {
                other.len() == ring.len()
                    && other.iter().zip(&ring).all(|(a, b)| (*a - *b).abs().max_element() < 0.6e-6)
            };
            assert_eq!(polygons.iter().filter(|(_, other)| is_it(other)).count(), 1);
        }
    }
}

#[test]
fn json_gives_back_every_bit() {
    let layers = layers();
    let mut bytes = Vec::new();
    write_layers_json(&layers, &mut bytes).unwrap();
    let found: Vec<serde_json::Value> = serde_json::from_slice(&bytes).unwrap();
    let ring = |value: &serde_json::Value| -> Vec<Vec2> {
        let points: Vec<[f64; 2]> = serde_json::from_value(value.clone()).unwrap();
        points.into_iter().map(Vec2::from).collect()
    };
    let layer = |value: &serde_json::Value| {
        let polygon = |value: &serde_json::Value| Polygon {
            outer: ring(&value["outer"]),
            holes: value["holes"].as_array().unwrap().iter().map(ring).collect(),
        };
        let [z_bottom, z_top, z_sample] = ["zBottom", "zTop", "zSample"].map(|n| value[n].as_f64().unwrap());
        let polygons = value["polygons"].as_array().unwrap().iter().map(polygon).collect();
        Layer { z_bottom, z_top, z_sample, polygons }
    };
    assert_eq!(found.iter().map(layer).collect::<Vec<Layer>>(), layers);
}

#[test]
fn dxf_has_closed_polylines_at_the_heights_of_their_layers() {
    let layers = layers();
    let mut bytes = Vec::new();
    write_layers_dxf(&layers, &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let pairs: Vec<(u32, &str)> = lines.chunks(2).map(|p| (p[0].trim().parse().unwrap(), p[1])).collect();
    assert_eq!(pairs.last(), Some(&(0, "EOF")));
    let declared = pairs.windows(2).filter(|w| w[0] == (0, "LAYER") && w[1].0 == 2).count();
    assert_eq!(declared, layers.len());
    // Groups that begin with a 0, each with what follows it.
    let starts: Vec<usize> = (0..pairs.len()).filter(|k| pairs[*k].0 == 0).collect();
    let mut found = vec![Vec::new(); layers.len()];
    for (k, start) in starts.iter().enumerate() {
        let group = &pairs[*start..starts.get(k + 1).copied().unwrap_or(pairs.len())];
        let value = |code: u32| group.iter().find(|(c, _)| *c == code).unwrap().1;
        let real = |code: u32| value(code).parse::<f64>().unwrap();
        let place = || value(8).strip_prefix("SLICE_").unwrap().parse::<usize>().unwrap();
        match group[0].1 {
            "POLYLINE" => {
                assert_eq!((value(66), value(70), real(30)), ("1", "1", layers[place()].z_sample));
                found[place()].push(Vec::new());
            }
            "VERTEX" => {
                assert_eq!(real(30), layers[place()].z_sample);
                found[place()].last_mut().unwrap().push(Vec2::new(real(10), real(20)));
            }
            _ => {}
        }
    }
    assert_eq!(found, layers.iter().map(rings).collect::<Vec<_>>());
}

fn package(layers: &[Layer], mesh: &TriangleSoup, resolution: MeshResolution) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_layers_3mf(layers, mesh, resolution, &mut bytes).unwrap();
    bytes
}

fn model_text(package: &[u8]) -> String {
    let mut archive = zip::ZipArchive::new(Cursor::new(package)).unwrap();
    let mut text = String::new();
    archive.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
    text
}

/// A slice: its top, its vertices, and its polygons as indices, the first one again at the end.
#[derive(Default)]
struct Slice {
    top: f64,
    vertices: Vec<Vec2>,
    polygons: Vec<Vec<usize>>,
}

#[test]
fn slices_of_3mf_give_back_every_bit() {
    let layers = layers();
    let text = model_text(&package(&layers, &model(), MeshResolution::Full));
    let (mut bottom, mut slices) = (f64::NAN, Vec::<Slice>::new());
    elements(&text, |path, element| match path.last().unwrap().as_str() {
        "model" => assert_eq!(attribute(element, "unit").unwrap(), "millimeter"),
        "object" => {
            assert_eq!(attribute(element, "s:slicestackid").unwrap(), "1");
            assert_eq!(attribute(element, "s:meshresolution").unwrap(), "fullres");
        }
        "s:slicestack" => bottom = number(element, "zbottom"),
        "s:slice" => slices.push(Slice { top: number(element, "ztop"), ..Slice::default() }),
        "s:vertex" => {
            let p = Vec2::new(number(element, "x"), number(element, "y"));
            slices.last_mut().unwrap().vertices.push(p);
        }
        "s:polygon" => slices.last_mut().unwrap().polygons.push(vec![number(element, "startv") as usize]),
        "s:segment" => {
            let polygon = slices.last_mut().unwrap().polygons.last_mut().unwrap();
            polygon.push(number(element, "v2") as usize);
        }
        _ => {}
    });
    assert_eq!((bottom, slices.len()), (layers[0].z_bottom, layers.len()));
    for (layer, slice) in layers.iter().zip(slices) {
        assert_eq!(slice.top, layer.z_top);
        let ring = |polygon: &Vec<usize>| -> Vec<Vec2> {
            assert_eq!(polygon.first(), polygon.last(), "polygons are closed");
            polygon[1..].iter().map(|v| slice.vertices[*v]).collect()
        };
        let mut expected = rings(layer);
        // The segments end where the ring began.
        expected.iter_mut().for_each(|ring| ring.rotate_left(1));
        let found: Vec<_> = slice.polygons.iter().map(ring).collect();
        assert_eq!(sorted(found), sorted(expected));
        let used: std::collections::BTreeSet<usize> = slice.polygons.iter().flatten().copied().collect();
        assert!(used.into_iter().eq(0..slice.vertices.len()), "every vertex is used");
    }
}

#[test]
fn the_mesh_beside_slices_is_read_back() {
    let mesh = model();
    let bytes = package(&layers(), &mesh, MeshResolution::Low);
    match io::read(&bytes).unwrap().geometry {
        Geometry::Soup(soup) => assert_eq!(soup, mesh),
        Geometry::Cloud(_) => panic!("a mesh was written"),
    }
    let text = model_text(&bytes);
    assert!(text.contains(r#"requiredextensions="s""#) && text.contains(r#"s:meshresolution="lowres""#));
    assert_eq!(bytes, package(&layers(), &mesh, MeshResolution::Low), "the same layers give the same bytes");
    // Without layers, and with triangles that 3MF does not allow.
    let odd = TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 0, 1], [0, 1, 2]]).unwrap();
    match io::read(&package(&[], &odd, MeshResolution::Full)).unwrap().geometry {
        Geometry::Soup(soup) => assert_eq!(soup.triangles(), [[0, 1, 2]]),
        Geometry::Cloud(_) => panic!("a mesh was written"),
    }
}

#[test]
fn what_3mf_cannot_hold_is_refused_before_anything_is_written() {
    let mut bytes = Vec::new();
    let mut reversed = layers();
    reversed.reverse();
    let error = write_layers_3mf(&reversed, &model(), MeshResolution::Full, &mut bytes).unwrap_err();
    assert!(matches!(error, SliceStackError::NotRising { layer: 1, .. }), "{error}");
    let none = TriangleSoup::default();
    let error = write_layers_3mf(&layers(), &none, MeshResolution::Full, &mut bytes).unwrap_err();
    assert!(matches!(error, SliceStackError::NoMesh), "{error}");
    let mut broken = layers();
    broken[1].polygons[0].outer[0].x = f64::INFINITY;
    let error = write_layers_3mf(&broken, &model(), MeshResolution::Full, &mut bytes).unwrap_err();
    assert!(matches!(error, SliceStackError::NonFinite { layer: 1 }), "{error}");
    assert!(bytes.is_empty());
}

/// A place that takes some bytes and no more.
struct Full(usize);

impl std::io::Write for Full {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        let taken = bytes.len().min(self.0);
        self.0 -= taken;
        if taken == 0 { Err(std::io::ErrorKind::StorageFull.into()) } else { Ok(taken) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_heard_of() {
    let (layers, mesh) = (layers(), model());
    let whole = package(&layers, &mesh, MeshResolution::Full).len();
    for room in [0, 100, whole - 1] {
        let room_of_text = room.min(20_000);
        assert!(write_layers_svg(&layers, &mut Full(room_of_text)).is_err());
        assert!(write_layers_json(&layers, &mut Full(room_of_text)).is_err());
        assert!(write_layers_dxf(&layers, &mut Full(room_of_text)).is_err());
        let error = write_layers_3mf(&layers, &mesh, MeshResolution::Full, &mut Full(room)).unwrap_err();
        assert!(matches!(error, SliceStackError::Io(_)), "{error}");
    }
    assert!(write_layers_3mf(&layers, &mesh, MeshResolution::Full, &mut Full(whole)).is_ok());
}
