//! Normals by stochastic globally consistent normal orientation.
mod common;

use common::*;
use fast_winding::data::{Cancelled, PointCloud, Silent, TriangleSoup, WarningKind};
use fast_winding::estimate::EstimateError;
use fast_winding::math::Vec3;
use fast_winding::metrics::{angle_rmse, good_points, sample_surface};
use fast_winding::orient::{
    Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, consistent_area_vectors, orient,
    stochastic_area_vectors,
};

/// A start that takes a moment: a third of the steps.
fn short() -> StochasticConfig {
    StochasticConfig { iterations: 200, ..Default::default() }
}

fn found(points: &[Vec3], config: &StochasticConfig) -> Vec<Vec3> {
    stochastic_area_vectors(points, config, &Silent).unwrap()
}

fn cloud(points: &[Vec3]) -> PointCloud {
    PointCloud::cleaned(points.to_vec(), None, None).unwrap().0
}

#[test]
fn clean_samples_are_turned_outward() {
    let inner = sphere(20);
    let inner = flipped(
        &TriangleSoup::new(inner.positions().iter().map(|p| 0.5 * *p).collect(), inner.triangles().to_vec())
            .unwrap(),
    );
    for (name, soup, worst) in [
        ("ball", sphere(20), 8.0),
        ("torus", torus(1.0, 0.3, 90, 30), 9.0),
        ("hollow ball", joined(&[sphere(20), inner]), 15.0),
        ("bunny", bunny(), 15.0),
    ] {
        let samples = sample_surface(&soup, 2000, 3).unwrap();
        let vectors = found(&samples.points, &short());
        let good = good_points(&vectors, &samples.normals).unwrap();
        let angle = angle_rmse(&vectors, &samples.normals).unwrap();
        println!("{name}: {good}, {angle}");
        assert!(good >= 0.99 && angle < worst, "{name}: {good} good, {angle}°");
    }
}
