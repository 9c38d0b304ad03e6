//! Checks, repairs, faces turned outward, and triangles cut along each other.
use super::facts::{Watch, assert_closed_manifold, imbalance, place};
use super::shapes::Made;
use super::source::Source;
use fast_winding::arrangement::{Pairs, arrange};
use fast_winding::check::{CheckConfig, check};
use fast_winding::data::{Shape, Silent, SurfaceMesh, TriangleSoup};
use fast_winding::math::{Vec3, area_vector};
use fast_winding::orient::{FaceConfig, FaceMethod, orient_soup};
use fast_winding::repair::{ConserveConfig, RemeshConfig, Repaired, conserve, remesh};
use fast_winding::texture::refined;
use fast_winding::winding::{FieldConfig, WindingField};
use std::collections::HashMap;

pub fn checks(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape, is_tame } = source.shape();
    let config = CheckConfig {
        limit: source.below(20),
        sliver_ratio: source.setting(&[0.01, 0.5]),
        self_intersections: source.flag(),
        samples: source.below(200),
        thickness: source.flag(),
        minimum_thickness: source.setting(&[0.8, 0.0]),
        overhang_angle: source.setting(&[50.0, 0.0, 90.0]),
        bed: source.flag().then(|| [source.number(), 200.0, source.setting(&[100.0])]),
        resolution: source.below(10),
    };
    let field = WindingField::new(shape.clone(), FieldConfig::default());
    let Ok(report) = check(&field, &config, &Watch::new(source.byte())) else { return };
    let Shape::Soup(soup) = shape else { panic!("a cloud has no faces to check") };
    let welded = |t: &[u32; 3]| t.map(|v| place(soup.positions()[v as usize]));
    if let (true, Some(crossings)) = (is_tame, &report.self_intersections) {
        assert!(crossings.list.len() <= config.limit && crossings.list.len() <= crossings.count);
    }
    let is_balanced = imbalance(soup.triangles().iter().map(welded)).is_empty();
    assert!(is_balanced || !field.is_closed(), "a field is closed and its soup is not");
}

pub fn repairs(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape, .. } = source.shape();
    let field = WindingField::new(shape, FieldConfig::default());
    let anew = RemeshConfig {
        resolution: Some(source.below(12)),
        spacing: None,
        sharp: source.option(&[35.0]),
        min_component: source.option(&[0.1]),
    };
    let made = if source.flag() {
        remesh(&field, &anew, &Watch::new(source.byte()))
    } else {
        let config = ConserveConfig {
            tolerance: source.option(&[0.0, 0.01, 0.5]),
            orient: source.flag(),
            least_agreement: source.setting(&[0.8, 0.0, 1.0]),
            fallback: source.flag().then_some(anew),
        };
        conserve(&field, &config, &Watch::new(source.byte()))
    };
    let Ok(Repaired { soup, sources, report }) = made else { return };
    assert!(sources.is_empty() || sources.len() == soup.len(), "a source for each triangle");
    if report.closed {
        let mesh = SurfaceMesh {
            positions: soup.positions().to_vec(),
            triangles: soup.triangles().to_vec(),
            normals: vec![],
        };
        assert_closed_manifold(&mesh, "a repaired soup");
    }
}

pub fn faces(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: soup, .. } = source.soup();
    let method = source.pick(&[FaceMethod::Parity, FaceMethod::Visibility, FaceMethod::Consistency]);
    let config = FaceConfig { method, rays: source.below(40) };
    let Ok((turned, report)) = orient_soup(&soup, &config, &Watch::new(source.byte())) else { return };
    let flipped: Vec<u32> = (0..soup.len() as u32)
        .filter(|t| turned.triangles()[*t as usize] != soup.triangles()[*t as usize])
        .collect();
    // A triangle that names a vertex twice may look the same, turned.
    assert!(
        flipped.iter().all(|t| report.flipped.binary_search(t).is_ok()),
        "a turned face is not in the report"
    );
    let sorted = |t: &[u32; 3]| {
        let mut corners = *t;
        corners.sort_unstable();
        corners
    };
    let same = soup.triangles().iter().zip(turned.triangles()).all(|(a, b)| sorted(a) == sorted(b));
    let places = |soup: &TriangleSoup| soup.positions().iter().copied().map(place).collect::<Vec<_>>();
    assert!(same && places(&soup) == places(&turned), "turning faces moves corners");
}

pub fn arrangements(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: soup, is_tame } = source.soup();
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut positions: Vec<Vec3> = Vec::new();
    let mut number = |p: Vec3| {
        *numbers.entry(place(p)).or_insert_with(|| {
            positions.push(p);
            positions.len() as u32 - 1
        })
    };
    let triangles: Vec<[u32; 3]> =
        soup.triangles().iter().map(|t| t.map(|v| number(soup.positions()[v as usize]))).collect();
    let pairs = if source.flag() { Pairs::All } else { Pairs::Between(source.below(triangles.len() + 1)) };
    let made = arrange(positions, &triangles, pairs, &Watch::new(source.byte()));
    refined(&soup, &Silent).expect("nobody cancels");
    let Ok(made) = made else { return };
    let mut areas = vec![Vec3::ZERO; triangles.len()];
    for (piece, source) in made.pieces.iter().zip(&made.sources) {
        areas[*source as usize] += area_vector(piece.map(|v| made.positions[v as usize]));
    }
    for (t, area) in areas.iter().enumerate().filter(|_| is_tame) {
        let whole = area_vector(triangles[t].map(|v| made.positions[v as usize]));
        let scale = soup.bounds().diagonal().powi(2);
        assert!(
            whole.distance(*area) <= 1e-9 * scale,
            "the pieces of triangle {t} have {area}, it has {whole}"
        );
    }
    // Cutting adds no boundary.
    let is_closed = imbalance(triangles.iter().copied()).is_empty();
    if is_closed && is_tame && matches!(pairs, Pairs::All) {
        let open = imbalance(made.pieces.iter().copied());
        assert!(open.is_empty(), "a closed soup is open once cut: {open:?}, {} unresolved", made.unresolved);
    }
}
