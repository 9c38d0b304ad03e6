//! Heights of layers that follow the slopes of a shape.
mod common;

use common::*;
use fast_winding::data::{OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Mat3, Vec3, area_vector};
use fast_winding::slice::{AdaptiveHeights, LayerPlan, SliceConfig, SliceError, Span, slice};
use fast_winding::winding::WindingField;

const HEIGHTS: AdaptiveHeights = AdaptiveHeights { least: 0.01, most: 0.1, deviation: 0.01 };

fn plan(heights: AdaptiveHeights) -> LayerPlan {
    LayerPlan { adaptive: Some(heights), ..LayerPlan::default() }
}

fn spans(shape: impl Into<Shape>, heights: AdaptiveHeights) -> Vec<Span> {
    let shape = shape.into();
    let spans = plan(heights).spans_of(&shape).unwrap();
    let bounds = shape.bounds();
    assert_eq!(spans[0].bottom, bounds.min.z);
    assert!(spans.windows(2).all(|w| w[0].top == w[1].bottom), "no gaps");
    let last = spans[spans.len() - 1];
    assert!(last.top >= bounds.max.z - 1e-8 && last.bottom < bounds.max.z, "the top is covered");
    for span in &spans {
        let height = span.top - span.bottom;
        assert!(height > heights.least - 1e-7 && height < heights.most + 1e-7, "{height}");
        assert_eq!(span.sample, 0.5 * (span.bottom + span.top));
    }
    spans
}

fn height(span: &Span) -> f64 {
    span.top - span.bottom
}

/// The span that holds `z`.
fn at(spans: &[Span], z: f64) -> &Span {
    spans.iter().find(|span| span.bottom <= z && z < span.top).unwrap()
}

/// Asserts that no face passes a layer with a larger step than allowed, unless the layer is as thin as may be.
fn assert_deviation_is_kept(soup: &TriangleSoup, spans: &[Span], heights: AdaptiveHeights) {
    let mut thickest = 0.0_f64;
    for t in 0..soup.len() {
        let z = soup.corners(t).map(|p| p.z);
        let slope = area_vector(soup.corners(t)).normalize_or_zero().z.abs();
        let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
        for span in spans.iter().filter(|span| span.bottom < high && low < span.top) {
            let step = height(span) * slope;
            assert!(
                step < heights.deviation * (1.0 + 1e-6) || height(span) < heights.least * (1.0 + 1e-6),
                "{step} at {span:?}, which {low} to {high} passes"
            );
            thickest = thickest.max(step);
        }
    }
    assert!(thickest > 0.9 * heights.deviation, "layers are no thinner than they have to be: {thickest}");
}

#[test]
fn a_sphere_has_thin_layers_at_its_poles_and_thick_ones_at_its_equator() {
    let soup = sphere(64);
    let spans = spans(soup.clone(), HEIGHTS);
    assert_deviation_is_kept(&soup, &spans, HEIGHTS);
    assert!(height(at(&spans, -0.99)) < 0.013 && height(at(&spans, 0.99)) < 0.013);
    assert!((height(at(&spans, 0.0)) - 0.1).abs() < 1e-9);
    // At z the slope of a sphere is z: a layer that reaches from z to z + h has h (z + h) = 0.01, but for the facets.
    for z in [0.3_f64, 0.5, 0.7] {
        let span = at(&spans, z);
        let expected = 0.01 / span.top;
        assert!(
            (height(span) / expected - 1.0).abs() < 0.06,
            "{} instead of {expected} at {z}",
            height(span)
        );
    }
    let uniform = 2.0 / 0.01;
    assert!((spans.len() as f64) < 0.6 * uniform, "{}", spans.len());
}

#[test]
fn steps_stay_within_the_deviation_on_any_shape() {
    let turn = Mat3::from_rotation_x(0.4) * Mat3::from_rotation_y(0.9);
    let turned = |soup: TriangleSoup| {
        let positions = soup.positions().iter().map(|p| turn * *p).collect();
        TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
    };
    let shapes =
        [turned(cube(1.0)), turned(torus(1.0, 0.4, 60, 30)), damaged(&turned(torus(1.0, 0.4, 60, 30)), 5)];
    for soup in shapes {
        for least in [0.001, 0.02] {
            let heights = AdaptiveHeights { least, most: 0.15, deviation: 0.015 };
            assert_deviation_is_kept(&soup, &spans(soup.clone(), heights), heights);
        }
    }
}

#[test]
fn a_box_has_thick_layers_only() {
    let spans = spans(cuboid(Aabb { min: Vec3::ZERO, max: Vec3::new(3.0, 2.0, 2.0) }), HEIGHTS);
    assert_eq!(spans.len(), 20);
    assert!(spans.iter().all(|span| (height(span) - 0.1).abs() < 1e-9));
}

#[test]
fn horizontal_faces_of_a_tower_are_boundaries_of_layers() {
    let floor = |low: f64, high: f64, half: f64| {
        cuboid(Aabb { min: Vec3::new(-half, -half, low), max: Vec3::new(half, half, high) })
    };
    let tower = joined(&[floor(0.0, 1.23, 3.0), floor(1.23, 2.0, 2.0), floor(2.0, 2.777, 1.0)]);
    let heights = AdaptiveHeights { least: 0.05, most: 0.3, deviation: 0.01 };
    let spans = spans(tower.clone(), heights);
    for level in [0.0, 1.23, 2.0, 2.777] {
        let is_boundary = spans.iter().any(|span| span.bottom == level || span.top == level);
        assert!(is_boundary, "{level} in {spans:?}");
    }
    // Cut along its floors, the tower's volume is that of its layers.
    let field = WindingField::new(tower, Default::default());
    let layers = slice(&field, &plan(heights), &SliceConfig::default(), &Silent).unwrap();
    let volume: f64 = layers.iter().map(|layer| layer.area() * (layer.z_top - layer.z_bottom)).sum();
    assert!((volume - (36.0 * 1.23 + 16.0 * 0.77 + 4.0 * 0.777)).abs() < 1e-9, "{volume}");
}

#[test]
fn points_count_as_discs() {
    let ball = spans(sphere_cloud(20_000), HEIGHTS);
    assert!(height(at(&ball, 0.97)) < 0.014 && height(at(&ball, -0.97)) < 0.014);
    assert!((height(at(&ball, 0.0)) - 0.1).abs() < 1e-9);
    // Beside the sphere itself, whose slope at z is z, a disc reaches some 0.013 to each side.
    for z in [0.3, 0.5, 0.7] {
        let span = at(&ball, z);
        assert!((height(span) * (span.top + 0.013) / 0.01 - 1.0).abs() < 0.1, "{span:?}");
    }
    // The points of a box's floors lie in them, and its walls are steep.
    let grid = || (0..400).map(|k| Vec3::new(f64::from(k % 20) / 20.0, f64::from(k / 20) / 20.0, 0.0));
    let floors = grid().map(|p| (p, -Vec3::Z)).chain(grid().map(|p| (p.with_z(1.0), Vec3::Z)));
    let wall = grid().map(|p| (Vec3::new(0.0, p.x, p.y), -Vec3::X));
    let (points, normals): (Vec<Vec3>, Vec<Vec3>) = floors.chain(wall).unzip();
    let areas = vec![1.0 / 400.0; points.len()];
    let hall = spans(OrientedCloud::new(points, normals, areas).unwrap(), HEIGHTS);
    assert_eq!(hall.len(), 10);
}

#[test]
fn the_first_layer_keeps_its_own_height() {
    let soup = sphere(32);
    let first = LayerPlan { first_layer_height: Some(0.25), ..plan(HEIGHTS) };
    let found = first.spans_of(&soup.clone().into()).unwrap();
    assert_eq!((found[0].bottom, found[0].top), (-1.0, -0.75));
    assert_eq!(found[1].bottom, -0.75);
    assert!(height(&found[1]) < 0.02);
    assert_deviation_is_kept(&soup, &found[1..], HEIGHTS);
}

#[test]
fn a_layer_height_above_the_shape_is_an_error_that_says_so() {
    let field = WindingField::new(cube(0.05), Default::default());
    let error = slice(&field, &LayerPlan::default(), &SliceConfig::default(), &Silent).unwrap_err();
    assert!(matches!(error, SliceError::Plan(_)));
    assert_eq!(
        error.to_string(),
        "a layer height of 0.2 is above the shape, which is 0.1 high: no layer would be of it"
    );
    // As high as the shape is one layer, in its middle.
    let whole = LayerPlan { layer_height: 0.1, ..LayerPlan::default() };
    let layers = slice(&field, &whole, &SliceConfig::default(), &Silent).unwrap();
    assert_eq!((layers.len(), layers[0].z_sample), (1, 0.0));
    assert!((layers[0].area() - 0.01).abs() < 1e-12);
}
