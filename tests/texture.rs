//! Textures of soups: proxies, atlases and what field lines carry over, against shapes whose answers are known.
#[path = "texture/atlases.rs"]
mod atlases;
mod common;
#[path = "texture/proxies.rs"]
mod proxies;

use common::parts::{genus_five, gridded_cube, torn, wedge};
use common::{cube, joined, sphere, topology, torus};
use fast_winding::TriangleSoup;
use fast_winding::charge::{LineError, Refinement};
use fast_winding::data::{Silent, SurfaceMesh, WarningKind};
use fast_winding::math::{Aabb, Vec2, Vec3, distance_to_triangle};
use fast_winding::texture::{
    Anchors, Atlas, AtlasConfig, AtlasError, Mapping, MappingReport, Proxy, ProxyConfig, ProxyError,
    ProxySides, SeamCost, Seams, SoupLines, SoupLinesConfig, SoupLinesError, Texture, TextureConfig,
    TextureError, seam_through, smallest_single_offset, texture, transferred,
};
use fast_winding::winding::{FieldConfig, WindingField};
use std::sync::Arc;

fn field(soup: TriangleSoup) -> WindingField {
    WindingField::new(soup, FieldConfig::default())
}

fn proxy_of(soup: TriangleSoup, config: &ProxyConfig) -> Proxy {
    Proxy::new(&field(soup), config, &Silent).unwrap()
}

fn at_offset(offset: f64) -> ProxyConfig {
    ProxyConfig { offset: Some(offset), ..ProxyConfig::default() }
}

/// A proxy at an offset; fewer charges and steps than by default, as these shapes are simple.
fn quick(offset: f64) -> TextureConfig {
    let mut lines = SoupLinesConfig::default();
    lines.charge.refinement = Some(Refinement { least_parts: 400, ..Refinement::default() });
    lines.line.steps = 24;
    TextureConfig { proxy: at_offset(offset), lines, ..TextureConfig::default() }
}

fn textured(soup: TriangleSoup, offset: f64) -> Texture {
    texture(Arc::new(soup), &quick(offset), &Silent).unwrap()
}

fn moved(soup: &TriangleSoup, by: Vec3) -> TriangleSoup {
    TriangleSoup::new(soup.positions().iter().map(|p| *p + by).collect(), soup.triangles().to_vec()).unwrap()
}

#[test]
fn bad_options_are_typed_errors() {
    let of = |offset: f64| Proxy::new(&field(cube(1.0)), &at_offset(offset), &Silent).unwrap_err();
    assert_eq!(of(0.0), ProxyError::BadOffset(0.0));
    assert_eq!(of(-1.0), ProxyError::BadOffset(-1.0));
    assert!(matches!(of(f64::NAN), ProxyError::BadOffset(_)));
    let few = ProxyConfig { samples: Some(1), ..ProxyConfig::default() };
    assert_eq!(Proxy::new(&field(cube(1.0)), &few, &Silent), Err(ProxyError::TooFewSamples(1)));
    let none = texture(Arc::new(TriangleSoup::default()), &TextureConfig::default(), &Silent);
    assert_eq!(none, Err(TextureError::Proxy(ProxyError::NoTriangles)));
    // Numbers are looked at before anything else: nothing is told of any work.
    let refused = |config: TextureConfig| {
        let no_work = |_: f64, stage: &str| -> bool { panic!("{stage}") };
        texture(Arc::new(cube(1.0)), &config, &no_work).unwrap_err()
    };
    let mut config = TextureConfig::default();
    config.lines.line.steps = usize::MAX;
    let too_many = TextureError::Lines(SoupLinesError::Line(LineError::TooManySteps(usize::MAX)));
    assert_eq!(refused(config.clone()), too_many);
    config.lines.line.steps = 10;
    config.lines.line.largest_turn = Some(-std::f64::consts::FRAC_PI_2);
    assert!(refused(config.clone()).to_string().contains("-90 degrees"));
    config.atlas.texels = 3;
    assert_eq!(refused(config), TextureError::Atlas(AtlasError::BadTexels(3)));
    let mesh = proxy_of(cube(1.0), &at_offset(0.3)).mesh;
    let cone = AtlasConfig { cone_degrees: 95.0, ..AtlasConfig::default() };
    assert_eq!(Atlas::new(&mesh, &cone, &Silent), Err(AtlasError::BadCone(95.0)));
    let small = AtlasConfig { texels: 16, margin: 9, ..AtlasConfig::default() };
    assert!(matches!(Atlas::new(&mesh, &small, &Silent), Err(AtlasError::DoesNotFit { charts: 6, .. })));
    let stop = |_: f64, stage: &str| stage != "atlas";
    assert!(matches!(Atlas::new(&mesh, &AtlasConfig::default(), &stop), Err(AtlasError::Cancelled(_))));
    let wide = AtlasConfig { margin: u32::MAX, ..AtlasConfig::default() };
    assert!(matches!(Atlas::new(&mesh, &wide, &Silent), Err(AtlasError::DoesNotFit { .. })));
    let sparse = ProxyConfig { samples: Some(9), ..at_offset(0.2) };
    let warnings = proxy_of(cube(1.0), &sparse).warnings;
    assert!(warnings.iter().any(|w| w.kind == WarningKind::CoarseProxy && w.count == 20), "{warnings:?}");
}

#[test]
fn a_torn_cube_is_textured_as_the_whole_one() {
    let clean = gridded_cube(6);
    let noisy = torn(&clean, 4e-3, 3);
    let whole = textured(clean.clone(), 0.12);
    // The same proxy and atlas for both: what differs is the correspondence.
    let mut config = SoupLinesConfig::default();
    config.charge.refinement = None;
    let lines = SoupLines::new(&Arc::new(noisy.clone()), &config, &Silent).unwrap();
    let anchors = Anchors::new(&lines, &whole.proxy, &Silent).unwrap();
    let mapping = Mapping::new(&noisy, &lines, &anchors, &whole.proxy, &whole.atlas, &Silent).unwrap();
    assert_eq!((whole.mapping.report.flipped, mapping.report.flipped), (0, 0));
    assert_eq!((mapping.report.lost_lines, whole.mapping.report.lost_lines), (0, 0));
    let of_whole = |corners: &[u32; 3]| corners.map(|s| whole.anchors.of_starts[s as usize].point);
    let of_torn = |corners: &[u32; 3]| corners.map(|s| anchors.of_starts[s as usize].point);
    let pairs = whole.lines.starts.corners.iter().map(of_whole).zip(lines.starts.corners.iter().map(of_torn));
    let distances: Vec<f64> = pairs.flat_map(|(a, b)| [0, 1, 2].map(|k| a[k].distance(b[k]))).collect();
    let mean = distances.iter().sum::<f64>() / distances.len() as f64;
    // The noise is 4e-3 of the diagonal in the mean: the points that correspond are a few times as far apart, as lines spread.
    let noise = 4e-3 * clean.bounds().diagonal();
    assert!(mean < 4.0 * noise, "{mean} {noise}");
    // So it is in the texture, but for triangles next to seams that lie in another chart.
    let same: Vec<usize> =
        (0..noisy.len()).filter(|t| mapping.charts[*t] == whole.mapping.charts[*t]).collect();
    assert!(same.len() as f64 > 0.95 * noisy.len() as f64, "{} of {}", same.len(), noisy.len());
    let apart = same.iter().map(|t| {
        (0..3).map(|k| mapping.uv[*t][k].distance(whole.mapping.uv[*t][k])).fold(0.0, f64::max)
            / whole.atlas.scale
    });
    let apart: Vec<f64> = apart.collect();
    let mean = apart.iter().sum::<f64>() / apart.len() as f64;
    assert!(mean < 6.0 * noise, "{mean} {noise}");
    assert!(apart.iter().all(|a| *a < 40.0 * noise), "{:?}", apart.iter().fold(0.0, |m: f64, a| m.max(*a)));
}

#[test]
fn a_cube_has_a_piece_for_each_side_and_its_edges_for_seams() {
    let made = textured(gridded_cube(6), 0.1);
    let report = made.report();
    // Triangles along the edges have lines that meet two charts, and come to lie in that of their side.
    assert_eq!((report.charts, report.mapping.unfolded), (6, 0), "{:?}", report.mapping);
    let Seams { pieces, length } = report.seams;
    assert!(pieces == 6 && (length - 24.0).abs() < 1e-9, "{pieces} {length}");
    let affected = &made.mapping.affected;
    assert_eq!(affected.moved, affected.across);
    let on_edge = |t: &u32| {
        made.soup
            .corners(*t as usize)
            .iter()
            .any(|p| p.to_array().iter().filter(|x| x.abs() > 0.999).count() > 1)
    };
    assert!(!affected.across.is_empty() && affected.across.iter().all(on_edge));
}

#[test]
fn another_proxy_keeps_the_lines() {
    let made = textured(sphere(6), 0.08);
    let other = made.with_proxy(&at_offset(0.15), &AtlasConfig::default(), &Silent).unwrap();
    assert!(Arc::ptr_eq(&made.lines, &other.lines));
    let same_proxy =
        made.with_atlas(&AtlasConfig { texels: 256, ..AtlasConfig::default() }, &Silent).unwrap();
    assert!(Arc::ptr_eq(&made.anchors, &same_proxy.anchors) && made.atlas.scale != same_proxy.atlas.scale);
    // Lines of a sphere are radial, so that both anchors of a start lie on one ray, at their offsets.
    for (near, far) in made.anchors.of_starts.iter().zip(&other.anchors.of_starts) {
        assert!(near.point.normalize().distance(far.point.normalize()) < 0.02);
        assert!((far.point.length() - near.point.length() - 0.07).abs() < 0.02);
    }
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(made, one_thread.install(|| textured(sphere(6), 0.08)));
    let stop_at = |last: &'static str| move |_: f64, stage: &str| stage != last;
    for stage in ["proxy components", "packing", "meeting the proxy", "texture"] {
        let stopped = made.with_proxy(&at_offset(0.15), &AtlasConfig::default(), &stop_at(stage));
        assert!(stopped.is_err(), "{stage} is told");
    }
}

#[test]
fn any_attribute_of_the_proxy_is_carried_over() {
    let made = textured(sphere(6), 0.1);
    let carried = transferred(&made.proxy.mesh.positions, &made.lines, &made.anchors, &made.proxy);
    for (corners, values) in made.lines.starts.corners.iter().zip(&carried) {
        for k in 0..3 {
            assert!(values[k].distance(made.anchors.of_starts[corners[k] as usize].point) < 1e-9);
        }
    }
}

#[test]
fn one_triangle_is_laid_flat_as_it_is() {
    let corners = vec![Vec3::ZERO, 2.0 * Vec3::X, Vec3::Y];
    let made = textured(TriangleSoup::new(corners, vec![[0, 1, 2]]).unwrap(), 0.2);
    let report = &made.mapping.report;
    assert_eq!((report.flipped, report.lost_lines, report.torn), (0, 0, 0));
    // Its corners' lines run along it and are replaced by its normal: straight up, onto the flat side of its proxy.
    assert_eq!(report.tangential_lines, 3);
    for (start, anchor) in made.lines.starts.points.iter().zip(&made.anchors.of_starts) {
        assert!((anchor.point - *start).truncate().length() < 1e-9 && anchor.point.z > 0.1);
    }
}

#[test]
fn a_sheet_is_textured_on_the_side_of_its_normals() {
    let full = gridded_cube(8);
    let top: Vec<[u32; 3]> = full
        .triangles()
        .iter()
        .copied()
        .filter(|t| t.iter().all(|v| full.positions()[*v as usize].z > 0.999))
        .collect();
    for flip in [false, true] {
        let triangles = top.iter().map(|[a, b, c]| if flip { [*a, *c, *b] } else { [*a, *b, *c] }).collect();
        let made = textured(TriangleSoup::new(full.positions().to_vec(), triangles).unwrap(), 0.1);
        let side = if flip { -1.0 } else { 1.0 };
        assert!(made.anchors.of_starts.iter().all(|a| side * (a.point.z - 1.0) > 0.0));
        assert_eq!((made.mapping.report.flipped, made.mapping.report.lost_lines), (0, 0));
    }
}

#[test]
fn narrow_places_are_reported_and_wide_ones_are_not() {
    // How weak the field is next to a plate takes charges as fine as by default.
    let of = |degrees: f64| {
        let config = TextureConfig { proxy: at_offset(0.1), ..TextureConfig::default() };
        texture(Arc::new(wedge(degrees, 8)), &config, &Silent).unwrap()
    };
    let (narrow, wide) = (of(15.0), of(120.0));
    // Only what did not come to lie where its lines lead is told of: in the wide one all did.
    assert_eq!(wide.mapping.report.weak_field, 0);
    let affected = &narrow.mapping.affected;
    assert!(affected.weak.len() > 8, "{:?}", narrow.mapping.report);
    assert!(affected.weak.iter().all(|t| affected.unfolded.contains(t) || affected.lost.contains(t)));
    // They lie next to the edge in which the plates meet, inside.
    let reach = |t: &u32| narrow.soup.corners(*t as usize).iter().map(|p| p.x.hypot(p.z)).fold(0.0, f64::max);
    assert!(affected.weak.iter().all(|t| reach(t) < 1.0));
    assert!(narrow.report().warnings.iter().any(|w| w.kind == WarningKind::WeakField));
}

#[test]
fn triangles_that_cross_are_split_on_request() {
    // Two squares through each other's middle.
    let square = |x: Vec3, y: Vec3| [-x - y, x - y, x + y, -x + y];
    let places = [square(Vec3::X, Vec3::Y), square(Vec3::X, Vec3::Z)].concat();
    let soup = TriangleSoup::new(places, vec![[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]).unwrap();
    let config = TextureConfig { refine: true, ..quick(0.15) };
    let made = texture(Arc::new(soup.clone()), &config, &Silent).unwrap();
    assert!(made.soup.len() > soup.len() && made.sources.len() == made.soup.len());
    // No part lies on both sides of the other square.
    for t in 0..made.soup.len() {
        // One has y = 0, the other z = 0.
        let heights = made.soup.corners(t).map(|p| p.y + p.z);
        assert!(heights.iter().all(|h| *h >= 0.0) || heights.iter().all(|h| *h <= 0.0), "{t}: {heights:?}");
    }
    assert_eq!(made.mapping.report.flipped, 0);
    let area = |soup: &TriangleSoup| {
        (0..soup.len()).map(|t| fast_winding::math::area_vector(soup.corners(t)).length()).sum::<f64>()
    };
    assert!((area(&made.soup) - area(&soup)).abs() < 1e-12);
}

#[test]
fn parts_that_overlap_get_one_texture() {
    let bar = common::cuboid(Aabb { min: Vec3::new(-0.4, -0.4, -2.0), max: Vec3::new(0.4, 0.4, 2.0) });
    let made = textured(joined(&[gridded_cube(4), bar]), 0.1);
    let report = made.report();
    assert_eq!((report.proxy_components, report.mapping.flipped), (1, 0));
    // The bar's ends stick out; half of it is in the cube, where its lines lead nowhere: it is laid flat, in the texture.
    let MappingReport { unfolded, lost_lines, weak_field, distortion, .. } = &report.mapping;
    assert!(*unfolded > 0 && *lost_lines + unfolded > 8 && *weak_field == 0, "{:?}", report.mapping);
    assert!(distortion.largest_ratio <= 8.0, "{distortion:?}");
    let is_within = |p: &Vec2| p.cmpge(Vec2::ZERO).all() && p.cmple(Vec2::ONE).all();
    assert!(made.mapping.uv.iter().flatten().all(is_within));
    assert_eq!(topology(&made.proxy.mesh), (2, 0));
    let json = serde_json::to_value(&report).unwrap();
    assert!(json["mapping"]["acrossCharts"].is_u64() && json["proxyDistortion"]["meanRatio"].is_f64());
}
