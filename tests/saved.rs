//! Fields that are saved and loaded again: they answer with the same bits, and no bytes make loading fail otherwise than with an error.
mod common;

use common::{damaged, joined, random, sphere, sphere_cloud, torus, without};
use fast_winding::data::{Shape, Silent};
use fast_winding::math::Vec3;
use fast_winding::winding::{Accuracy, FieldConfig, LoadError, WindingField, is_saved_field};
use fast_winding::{Lattice, OrientedCloud, TriangleSoup};

fn shapes() -> Vec<(&'static str, Shape, FieldConfig)> {
    let plain = FieldConfig::default();
    let open = without(&sphere(12), |t| t % 97 == 5);
    let mixed = joined(&[torus(3.0, 0.5, 30, 16), damaged(&sphere(18), 4)]);
    // Normals that are not of length 1 to the last bit, and a vertex of no triangle that is not finite.
    let points: Vec<Vec3> = sphere_cloud(1700).points().to_vec();
    let normals = points.iter().map(|p| 0.7 * *p + Vec3::splat(0.01)).collect();
    let cloud = OrientedCloud::new(points, normals, vec![0.0073; 1700]).unwrap();
    let mut positions = torus(2.0, 0.7, 20, 12).positions().to_vec();
    positions.push(Vec3::NAN);
    let closed = TriangleSoup::new(positions, torus(2.0, 0.7, 20, 12).triangles().to_vec()).unwrap();
    vec![
        ("closed", closed.into(), plain),
        ("capped", open.into(), plain),
        ("loose", mixed.into(), FieldConfig { leaf_size: 5, ..plain }),
        ("cloud", cloud.clone().into(), plain),
        ("bounded", cloud.into(), FieldConfig { bounded: true, ..plain }),
        ("no triangles", TriangleSoup::default().into(), plain),
        ("no points", OrientedCloud::default().into(), plain),
    ]
}

fn saved(field: &WindingField) -> Vec<u8> {
    let mut bytes = Vec::new();
    field.save(&mut bytes).unwrap();
    bytes
}

/// Answers of all kinds, as bits.
fn answers(field: &WindingField) -> Vec<u64> {
    let mut next = random(11);
    let points: Vec<Vec3> = (0..2000).map(|_| 4.0 * Vec3::new(next(), next(), next()) - 1.5).collect();
    let mut all = Vec::new();
    for accuracy in [Accuracy::default(), Accuracy::EXACT, Accuracy::of_paper(field.shape())] {
        for points in [&points[..], &points[..100]] {
            all.extend(field.evaluate(points, accuracy, &Silent).unwrap().iter().map(|w| w.to_bits()));
        }
        all.extend(field.gradient(points[0], accuracy).to_array().map(f64::to_bits));
    }
    all.extend(field.contains(&points, &Silent).unwrap().iter().map(|inside| u64::from(*inside)));
    if !field.shape().is_empty() {
        let lattice = Lattice::with_resolution(field.bounds(), 14).unwrap();
        let grid = field.evaluate_lattice(&lattice, Accuracy::default(), &Silent).unwrap();
        all.extend(grid.values.iter().map(|w| w.to_bits()));
        let bits = field.classify_lattice(&lattice, 0.5, &Silent).unwrap();
        all.extend(bits.into_iter().map(u64::from));
    }
    all
}

#[test]
fn loaded_fields_answer_with_the_same_bits() {
    for (name, shape, config) in shapes() {
        let field = WindingField::new(shape.clone(), config);
        let bytes = saved(&field);
        assert!(is_saved_field(&bytes));
        let loaded = WindingField::load(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(loaded.report(), field.report(), "{name}");
        assert_eq!(loaded.config(), config, "{name}");
        assert_eq!(saved(&loaded), bytes, "{name}");
        let expected = answers(&field);
        assert_eq!(answers(&loaded), expected, "{name}");
        // What scattered points need has been built by now, and is saved too.
        let prepared = saved(&field);
        assert_eq!(prepared.len() > bytes.len(), name == "capped");
        let loaded = WindingField::load(&prepared).unwrap();
        assert_eq!(saved(&loaded), prepared, "{name}");
        assert_eq!(answers(&loaded), expected, "{name}");
        match (&shape, loaded.shape()) {
            (Shape::Soup(a), Shape::Soup(b)) => assert_eq!(a.triangles(), b.triangles()),
            (Shape::Cloud(a), Shape::Cloud(b)) => assert_eq!(a, b),
            _ => panic!("{name} has become another kind of shape"),
        }
    }
}

/// The checksum of what was changed, as a forger would set it: zlib's own.
fn with_checksum(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut crc = flate2::Crc::new();
    crc.update(&bytes[24..]);
    bytes[12..16].copy_from_slice(&crc.sum().to_le_bytes());
    bytes
}

fn load(bytes: &[u8]) -> Result<(), LoadError> {
    WindingField::load(bytes).map(|_| ())
}

#[test]
fn what_is_no_saved_field_is_refused_with_its_reason() {
    let bytes = saved(&WindingField::new(sphere(3), FieldConfig::default()));
    let foreign = LoadError::Foreign { found: "solid bo".into() };
    assert_eq!(load(b"solid box\nfacet"), Err(foreign));
    assert!(matches!(load(b""), Err(LoadError::Foreign { .. })));
    let mut newer = bytes.clone();
    newer[8] = 9;
    assert_eq!(load(&newer), Err(LoadError::OtherVersion { version: 9, known: 1 }));
    for end in 8..bytes.len() {
        assert!(matches!(load(&bytes[..end]), Err(LoadError::Truncated { .. })), "{end}");
    }
    let longer = [&bytes[..], b"?"].concat();
    assert_eq!(load(&longer), Err(LoadError::TrailingBytes(1)));
    let mut flipped = bytes.clone();
    let last = flipped.len() - 1;
    flipped[last] ^= 1;
    assert!(matches!(load(&flipped), Err(LoadError::Corrupt { .. })));
    assert_eq!(load(&with_checksum(bytes)), Ok(()));
}

#[test]
fn forged_fields_are_refused_or_answer() {
    let mut next = random(17);
    let mut any = |below: usize| (next() * below as f64) as usize;
    for (_, shape, config) in shapes() {
        let bytes = saved(&WindingField::new(shape, config));
        let (mut refused, rounds) = (0, 150);
        for round in 0..rounds {
            let mut forged = bytes.clone();
            // Lengths, indices and links, which lie anywhere, get high, low and wild values.
            for _ in 0..1 + any(3) {
                let at = 24 + any(forged.len() - 24);
                forged[at] = [0, 1, 0x7f, 0xff, any(256) as u8][any(5)];
            }
            if round % 5 == 0 {
                forged.truncate(24 + any(forged.len() - 24));
                let length = (forged.len() as u64 - 24).to_le_bytes();
                forged[16..24].copy_from_slice(&length);
            }
            match WindingField::load(&with_checksum(forged)) {
                Err(_) => refused += 1,
                Ok(field) => {
                    let points = [Vec3::ZERO, Vec3::splat(0.3), Vec3::X];
                    field.evaluate(&points, Accuracy::default(), &Silent).unwrap();
                    let lattice = Lattice { origin: -Vec3::ONE, spacing: Vec3::splat(0.5), counts: [5; 3] };
                    field.classify_lattice(&lattice, 0.5, &Silent).unwrap();
                }
            }
        }
        assert!(refused >= rounds / 5, "{refused} of {rounds}");
    }
}
