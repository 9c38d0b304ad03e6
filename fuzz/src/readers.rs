//! Files and saved fields.
use super::facts::place;
use super::source::Source;
use fast_winding::io::{
    CloudFormat, Format, Geometry, MeshFormat, ReadOptions, Unit, read, read_with, write_cloud, write_soup,
};
use fast_winding::math::Vec3;
use fast_winding::winding::{Accuracy, WindingField};
use flate2::Crc;

/// Reads a file of a format, which is what it is taken for or an error. What was read is written and read again.
fn read_as(format: Format, bytes: &[u8]) {
    let Ok(imported) = read(bytes) else { return };
    assert!(!imported.geometry.is_empty(), "an empty shape is no error");
    assert!(imported.warnings.iter().all(|warning| warning.count > 0), "a warning of nothing");
    if imported.format != format {
        return;
    }
    match &imported.geometry {
        Geometry::Soup(soup) => {
            let corners = |t: usize| soup.corners(t).map(place);
            for format in [MeshFormat::Ply, MeshFormat::Obj, MeshFormat::Off] {
                let mut written = Vec::new();
                write_soup(soup, format, &mut written).expect("memory takes what is written");
                let again =
                    read(&written).unwrap_or_else(|error| panic!("{format:?} that was written: {error}"));
                let Geometry::Soup(again) = again.geometry else { panic!("{format:?} lost its triangles") };
                assert_eq!(again.len(), soup.len(), "{format:?} lost triangles");
                let all_equal = (0..soup.len()).all(|t| again.corners(t).map(place) == corners(t));
                assert!(all_equal, "{format:?} moved vertices");
            }
            for format in [MeshFormat::Stl, MeshFormat::ThreeMf] {
                let mut written = Vec::new();
                write_soup(soup, format, &mut written).expect("memory takes what is written");
                // Of coordinates beyond 32-bit floats, and of triangles without three places, nothing may be left.
                let _ = read(&written);
            }
        }
        Geometry::Cloud(cloud) => {
            let places: Vec<[u64; 3]> = cloud.points().iter().copied().map(place).collect();
            for format in [CloudFormat::Ply, CloudFormat::Xyz] {
                let mut written = Vec::new();
                write_cloud(cloud.points(), cloud.normals(), format, &mut written)
                    .expect("memory takes what is written");
                let again =
                    read(&written).unwrap_or_else(|error| panic!("{format:?} that was written: {error}"));
                let Geometry::Cloud(again) = again.geometry else { panic!("{format:?} became triangles") };
                let found: Vec<[u64; 3]> = again.points().iter().copied().map(place).collect();
                assert_eq!(found, places, "{format:?} moved points");
            }
        }
    }
    let inches = ReadOptions { unit: Unit::Inch };
    if let Ok(scaled) = read_with(bytes, &inches) {
        assert!(scaled.geometry.len() <= imported.geometry.len(), "a unit adds nothing");
    }
}

pub fn stl(bytes: &[u8]) {
    read_as(Format::Stl, bytes);
}

pub fn obj(bytes: &[u8]) {
    read_as(Format::Obj, bytes);
}

pub fn ply(bytes: &[u8]) {
    read_as(Format::Ply, bytes);
}

pub fn off(bytes: &[u8]) {
    read_as(Format::Off, bytes);
}

pub fn xyz(bytes: &[u8]) {
    read_as(Format::Xyz, bytes);
}

/// A whole archive, or the parts of one, with the right checksums: the model, and another that its components may name.
pub fn threemf(bytes: &[u8]) {
    if bytes.starts_with(b"PK") {
        return read_as(Format::ThreeMf, bytes);
    }
    const SEPARATOR: &[u8] = b"\n----\n";
    let at = bytes.windows(SEPARATOR.len()).position(|window| window == SEPARATOR);
    let (model, other) = match at {
        Some(at) => (&bytes[..at], &bytes[at + SEPARATOR.len()..]),
        None => (bytes, &[][..]),
    };
    let relations = br#"<Relationships><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>"#;
    read_as(
        Format::ThreeMf,
        &archive(&[("_rels/.rels", relations), ("3D/3dmodel.model", model), ("3D/other.model", other)]),
    );
}

/// A ZIP archive of files as they are.
pub fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let mut crc = Crc::new();
        crc.update(content);
        let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        common.extend(crc.sum().to_le_bytes());
        common.extend([content.len() as u32, content.len() as u32].map(u32::to_le_bytes).as_flattened());
        common.extend([name.len() as u16, 0].map(u16::to_le_bytes).as_flattened());
        directory.extend(b"PK\x01\x02\x14\0");
        directory.extend(&common);
        directory.extend([0; 10]);
        directory.extend((bytes.len() as u32).to_le_bytes());
        directory.extend(name.as_bytes());
        bytes.extend(b"PK\x03\x04");
        bytes.extend(&common);
        bytes.extend(name.as_bytes());
        bytes.extend(*content);
    }
    let start = bytes.len() as u32;
    bytes.extend(&directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    bytes.extend([files.len() as u16; 2].map(u16::to_le_bytes).as_flattened());
    bytes.extend([directory.len() as u32, start].map(u32::to_le_bytes).as_flattened());
    bytes.extend([0, 0]);
    bytes
}

/// A saved field: with its head as it is, or, if it has none, with one that says what is true of it.
pub fn saved(bytes: &[u8]) {
    const MARK: &[u8] = b"\x89FWF\r\n\x1a\n";
    const HEAD: usize = 24;
    let content = if bytes.starts_with(MARK) { &bytes[bytes.len().min(HEAD)..] } else { bytes };
    let mut whole = MARK.to_vec();
    let mut crc = Crc::new();
    crc.update(content);
    whole.extend(1u32.to_le_bytes());
    whole.extend(crc.sum().to_le_bytes());
    whole.extend((content.len() as u64).to_le_bytes());
    whole.extend(content);
    let _ = WindingField::load(bytes);
    let Ok(field) = WindingField::load(&whole) else { return };
    let queries = Source::new(bytes).queries(field.bounds(), 4);
    for q in queries.into_iter().chain([Vec3::ZERO, Vec3::splat(0.5)]) {
        field.at(q, Accuracy::default());
        field.contains_point(q);
    }
    let mut again = Vec::new();
    field.save(&mut again).expect("memory takes what is written");
    assert!(WindingField::load(&again).is_ok(), "what was loaded can be saved and loaded");
}
