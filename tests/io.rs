//! Files as a whole: what is written is read back, and no damage to a file brings more than an error.
use fast_winding::data::{Warning, WarningKind};
use fast_winding::io::{
    CloudFormat, Format, Geometry, Imported, MeshFormat, ReadOptions, Unit, read, read_with, write_cloud,
    write_soup,
};
use fast_winding::math::Vec3;
use fast_winding::{PointCloud, TriangleSoup};
use proptest::prelude::*;
use std::io::{Cursor, Write};
use std::mem::discriminant;

/// A tetrahedron and a loose triangle, at coordinates that neither `f32` nor few decimal digits can hold.
fn awkward_soup() -> TriangleSoup {
    let positions = vec![
        Vec3::new(0.1, -1.0 / 3.0, 1e-7),
        Vec3::new(std::f64::consts::PI, 0.0, -0.0),
        Vec3::new(0.0, 1e3 + 1e-9, 2.0_f64.sqrt()),
        Vec3::new(-1e17, 5e-324, 3.0),
    ];
    TriangleSoup::new(positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2], [3, 3, 0]]).unwrap()
}

fn in_f32(soup: &TriangleSoup) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| p.as_vec3().as_dvec3()).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

fn written_soup(soup: &TriangleSoup, format: MeshFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_soup(soup, format, &mut bytes).unwrap();
    bytes
}

fn written_cloud(cloud: &PointCloud, format: CloudFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_cloud(cloud.points(), cloud.normals(), format, &mut bytes).unwrap();
    bytes
}

fn as_soup(imported: Imported) -> TriangleSoup {
    match imported.geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("faces make a soup"),
    }
}

fn as_cloud(imported: Imported) -> PointCloud {
    match imported.geometry {
        Geometry::Cloud(cloud) => cloud,
        Geometry::Soup(_) => panic!("points make a cloud"),
    }
}

#[test]
fn indexed_formats_give_back_every_bit_of_a_soup() {
    for soup in [awkward_soup(), in_f32(&awkward_soup())] {
        for format in [MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Off] {
            let again = as_soup(read(&written_soup(&soup, format)).unwrap());
            assert_eq!(again, soup, "{format:?}");
            let signs =
                |s: &TriangleSoup| s.positions().iter().map(|p| p.is_negative_bitmask()).collect::<Vec<_>>();
            assert_eq!(signs(&again), signs(&soup), "{format:?}");
        }
    }
}

#[test]
fn a_mesh_as_3mf_is_exact_and_its_triangles_share_vertices() {
    let square = [[0.1, 0.2, 0.3], [1.1, 0.2, 0.3], [1.1, 1.2, 0.3], [0.1, 1.2, 0.3]].map(Vec3::from);
    let [a, b, c, d] = square;
    let loose = TriangleSoup::new(vec![a, b, c, c, d, a], vec![[0, 1, 2], [3, 4, 5], [0, 5, 1]]).unwrap();
    let again = as_soup(read(&written_soup(&loose, MeshFormat::ThreeMf)).unwrap());
    assert_eq!(again.positions(), square);
    assert_eq!(again.triangles(), [[0, 1, 2], [2, 3, 0]], "one has two corners in one place");
}

#[test]
fn ply_takes_no_more_room_than_exactness_needs() {
    let [long, short] = [awkward_soup(), in_f32(&awkward_soup())].map(|s| written_soup(&s, MeshFormat::Ply));
    // Four vertices of three numbers, each four bytes longer, and three words "double" for "float".
    assert_eq!(long.len() - short.len(), 4 * 3 * 4 + 3);
}

#[test]
fn stl_gives_back_corners_rounded_to_f32() {
    let soup = awkward_soup();
    let again = as_soup(read(&written_soup(&soup, MeshFormat::Stl)).unwrap());
    let corners = |s: &TriangleSoup| (0..s.len()).map(|t| s.corners(t)).collect::<Vec<_>>();
    assert_eq!(corners(&again), corners(&in_f32(&soup)));
}

#[test]
fn clouds_come_back_with_their_normals() {
    let points = awkward_soup().positions().to_vec();
    let normals: Vec<Vec3> = points.iter().map(|p| (*p + Vec3::Y).normalize()).collect();
    for normals in [None, Some(normals)] {
        let (cloud, _) = PointCloud::cleaned(points.clone(), normals, None).unwrap();
        for format in [CloudFormat::Ply, CloudFormat::Xyz] {
            let again = as_cloud(read(&written_cloud(&cloud, format)).unwrap());
            assert_eq!(again.points(), cloud.points(), "{format:?}");
            // Normalised again on the way in, which may move the last bit.
            let pairs = again.normals().into_iter().flatten().zip(cloud.normals().into_iter().flatten());
            assert!(pairs.into_iter().all(|(a, b)| a.distance(*b) < 1e-15), "{format:?}");
            assert_eq!(again.normals().is_some(), cloud.normals().is_some());
        }
    }
}

#[test]
fn lengths_are_scaled_to_millimetres_and_unusual_ones_reported() {
    let file = b"0 0 0\n1 2 2\n";
    let diagonal_in = |unit| {
        let imported = read_with(file, &ReadOptions { unit }).unwrap();
        (imported.geometry.bounds().diagonal(), imported.warnings)
    };
    let near = |(diagonal, warnings): (f64, Vec<Warning>), length: f64, kind: Option<WarningKind>| {
        assert!((diagonal - length).abs() < 1e-9 * length, "{diagonal} {length}");
        assert_eq!(warnings, kind.map(|kind| Warning::new(kind, 1)).into_iter().collect::<Vec<_>>());
    };
    near(diagonal_in(Unit::Micron), 0.003, Some(WarningKind::TinyModel));
    near(diagonal_in(Unit::Millimeter), 3.0, None);
    near(diagonal_in(Unit::Centimeter), 30.0, None);
    near(diagonal_in(Unit::Inch), 76.2, None);
    near(diagonal_in(Unit::Foot), 914.4, None);
    near(diagonal_in(Unit::Meter), 3000.0, Some(WarningKind::HugeModel));
}

fn archive(model: &str) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    writer.start_file("3D/3dmodel.model", zip::write::SimpleFileOptions::default()).unwrap();
    writer.write_all(model.as_bytes()).unwrap();
    writer.finish().unwrap().into_inner()
}

/// A small whole file of each kind a reader has a path for.
fn samples() -> Vec<(Format, Vec<u8>)> {
    let soup = awkward_soup();
    let ply = |encoding: &str, body: &[u8]| {
        let header = format!(
            "ply\nformat {encoding} 1.0\nelement vertex 3\nproperty uchar x\nproperty short y\nproperty float z\n\
             element face 1\nproperty list uchar ushort vertex_indices\nend_header\n"
        );
        [header.as_bytes(), body].concat()
    };
    let big_endian = [
        &[0, 0, 0, 0, 0, 0, 0][..],
        &[2, 0, 0, 0, 0, 0, 0],
        &[0, 0, 2, 64, 64, 0, 0],
        &[3, 0, 0, 0, 1, 0, 2],
    ];
    let model = "<model unit=\"inch\"><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/>\
        <vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>\
        <triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object></resources><build>\
        <item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 5 5\"/></build></model>";
    vec![
        (Format::Stl, written_soup(&soup, MeshFormat::Stl)),
        (
            Format::Stl,
            b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.5e0 0 0\nvertex 0 -2 0\nendloop\n\
              endfacet\nendsolid a\n"
                .to_vec(),
        ),
        (Format::Obj, b"# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nusemtl m\nf 1//1 2//1 -1//1\n".to_vec()),
        (Format::Ply, written_soup(&soup, MeshFormat::Ply)),
        (Format::Ply, ply("ascii", b"0 0 0\n2 0 0\n0 2 3\n3 0 1 2\n")),
        (Format::Ply, ply("binary_big_endian", &big_endian.concat())),
        (Format::Xyz, b"# a\nx,y,z,nx,ny,nz\n1,2,3,0,0,1\n4,5,6,0,1,0\n".to_vec()),
        (Format::Off, written_soup(&soup, MeshFormat::Off)),
        (Format::Off, b"NOFF\n2 0 0\n0 0 0 0 0 1\n4 5 6 0 1 0\n".to_vec()),
        (Format::ThreeMf, archive(model)),
    ]
}

/// What every success must be: finite, in range, not empty.
fn assert_sound(imported: &Imported) {
    assert!(!imported.geometry.is_empty());
    match &imported.geometry {
        Geometry::Soup(soup) => {
            let again = TriangleSoup::new(soup.positions().to_vec(), soup.triangles().to_vec());
            assert_eq!(again.err(), None);
        }
        Geometry::Cloud(cloud) => {
            assert!(cloud.points().iter().all(|p| p.is_finite()));
            assert!(cloud.normals().into_iter().flatten().all(|n| (n.length() - 1.0).abs() < 1e-12));
            assert!(cloud.normals().is_none_or(|n| n.len() == cloud.len()));
        }
    }
}

#[test]
fn samples_are_what_they_claim_and_whole() {
    for (format, bytes) in samples() {
        let imported = read(&bytes).unwrap_or_else(|error| panic!("{format}: {error}"));
        assert_eq!(imported.format, format);
        assert_sound(&imported);
        let damage = |w: &&Warning| !matches!(w.kind, WarningKind::TinyModel | WarningKind::HugeModel);
        assert_eq!(imported.warnings.iter().find(damage), None, "{format}");
    }
}

#[test]
fn files_cut_at_any_byte_give_sound_parts_or_errors() {
    for (format, bytes) in samples() {
        let whole = read(&bytes).unwrap().geometry;
        for length in 0..bytes.len() {
            if let Ok(imported) = read(&bytes[..length]) {
                assert_sound(&imported);
                // An OBJ file cut before its faces cannot be told from a cloud.
                let is_same_kind = discriminant(&imported.geometry) == discriminant(&whole);
                assert!(is_same_kind || format == Format::Obj, "{format} cut at byte {length}");
                assert!(
                    !is_same_kind || imported.geometry.len() <= whole.len(),
                    "{format} cut at byte {length}"
                );
            }
        }
    }
}

/// What happens to a byte.
#[derive(Clone, Debug)]
enum Damage {
    Replace(u8),
    FlipBit(u8),
    Insert(u8),
    Remove,
}

fn damage() -> impl Strategy<Value = Damage> {
    let telling = proptest::sample::select(b"\0\n\r \t-+.,;/\\#eE019<>\"&\x7f\xff".to_vec());
    prop_oneof![
        telling.clone().prop_map(Damage::Replace),
        (0_u8..8).prop_map(Damage::FlipBit),
        telling.prop_map(Damage::Insert),
        Just(Damage::Remove),
    ]
}

fn apply(bytes: &mut Vec<u8>, place: prop::sample::Index, damage: &Damage) {
    if bytes.is_empty() {
        return;
    }
    let place = place.index(bytes.len());
    match damage {
        Damage::Replace(byte) => bytes[place] = *byte,
        Damage::FlipBit(bit) => bytes[place] ^= 1 << bit,
        Damage::Insert(byte) => bytes.insert(place, *byte),
        Damage::Remove => drop(bytes.remove(place)),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn damaged_files_give_sound_parts_or_errors(
        sample in 0..samples().len(),
        damages in prop::collection::vec((any::<prop::sample::Index>(), damage()), 1..6),
    ) {
        let (_, mut bytes) = samples().swap_remove(sample);
        damages.iter().for_each(|(place, damage)| apply(&mut bytes, *place, damage));
        if let Ok(imported) = read(&bytes) {
            assert_sound(&imported);
        }
    }

    /// The archive's checksum would hide the model's reader from damage, so this one damages the text inside.
    #[test]
    fn damaged_models_in_archives_give_sound_parts_or_errors(
        damages in prop::collection::vec((any::<prop::sample::Index>(), damage()), 1..6),
    ) {
        let mut text = b"<model unit=\"inch\"><resources><object id=\"1\"><mesh><vertices><vertex x=\"0\" y=\"0\" \
            z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>\
            <triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh></object><object id=\"2\"><components>\
            <component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 5 5\"/></components></object></resources>\
            <build><item objectid=\"2\"/></build></model>".to_vec();
        damages.iter().for_each(|(place, damage)| apply(&mut text, *place, damage));
        if let Ok(imported) = read(&archive(&String::from_utf8_lossy(&text))) {
            assert_sound(&imported);
        }
    }

    #[test]
    fn noise_after_any_beginning_gives_sound_parts_or_errors(
        beginning in prop::sample::select(vec![
            "", "solid ", "ply\nformat binary_little_endian 1.0\n", "ply\nformat ascii 1.0\n", "OFF\n3 1 0\n", "v 1 1 1\n",
            "1 2 3\n", "PK\x03\x04",
        ]),
        noise in prop::collection::vec(any::<u8>(), 0..400),
    ) {
        if let Ok(imported) = read(&[beginning.as_bytes(), &noise].concat()) {
            assert_sound(&imported);
        }
    }
}
