//! Faces of soups that run either way, turned back.
mod common;

use common::*;
use fast_winding::data::{Silent, TriangleSoup};
use fast_winding::math::{Vec3, area_vector};
use fast_winding::orient::{FaceConfig, FaceMethod, OrientReport, orient_soup};
use std::collections::HashSet;

fn oriented(soup: &TriangleSoup) -> (TriangleSoup, OrientReport) {
    orient_soup(soup, &FaceConfig::default(), &Silent).unwrap()
}

/// With a share of the faces turned, drawn by lot.
fn turned(soup: &TriangleSoup, share: f64, seed: u64) -> (TriangleSoup, HashSet<u32>) {
    let mut next = random(seed);
    let chosen: HashSet<u32> = (0..soup.len() as u32).filter(|_| next() < share).collect();
    let turn = |(t, [a, b, c]): (usize, &[u32; 3])| match chosen.contains(&(t as u32)) {
        true => [*a, *c, *b],
        false => [*a, *b, *c],
    };
    let triangles = soup.triangles().iter().enumerate().map(turn).collect();
    (TriangleSoup::new(soup.positions().to_vec(), triangles).unwrap(), chosen)
}

/// Each triangle with vertices of its own, shifted by up to `step` times the root of its area.
fn loose(soup: &TriangleSoup, step: f64) -> TriangleSoup {
    let mut next = random(5);
    let mut positions = Vec::new();
    for t in 0..soup.len() {
        let size = step * area_vector(soup.corners(t)).length().sqrt();
        let shift = size * (2.0 * Vec3::new(next(), next(), next()) - Vec3::ONE);
        positions.extend(soup.corners(t).map(|p| p + shift));
    }
    let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(positions, triangles).unwrap()
}

/// The share of the area that runs as in `truth`.
fn agreement(truth: &TriangleSoup, found: &TriangleSoup) -> f64 {
    let area = |soup: &TriangleSoup, t: usize| area_vector(soup.corners(t));
    let all: f64 = (0..truth.len()).map(|t| area(truth, t).length()).sum();
    let same = |t: &usize| area(truth, *t).dot(area(found, *t)) > 0.0;
    (0..truth.len()).filter(same).map(|t| area(truth, t).length()).sum::<f64>() / all
}

#[test]
fn closed_shapes_come_back_whole() {
    let shapes = [
        ("torus", torus(3.0, 1.0, 90, 40)),
        ("ball", sphere(20)),
        ("loose torus", loose(&torus(3.0, 1.0, 40, 20), 0.0)),
    ];
    for (name, truth) in shapes {
        for share in [0.0, 0.01, 0.1, 0.5, 1.0] {
            let (soup, chosen) = turned(&truth, share, 3);
            let (found, report) = oriented(&soup);
            assert_eq!(agreement(&truth, &found), 1.0, "{name}, {share}");
            let flipped: HashSet<u32> = report.flipped.iter().copied().collect();
            assert_eq!(flipped, chosen, "{name}, {share}");
            assert_eq!((report.patches, report.closed_patches), (1, 1), "{name}");
            assert!(report.flipped.is_sorted());
        }
    }
}

#[test]
fn triangles_without_neighbours_are_turned_by_rays() {
    for (name, truth) in [("torus", torus(3.0, 1.0, 60, 24)), ("ball", sphere(12))] {
        let truth = loose(&truth, 0.05);
        for share in [0.01, 0.1, 0.5] {
            let (found, report) = oriented(&turned(&truth, share, 8).0);
            let agreement = agreement(&truth, &found);
            assert!(agreement >= 0.999, "{name}, {share}: {agreement}");
            assert_eq!((report.patches, report.closed_patches), (truth.len(), 0));
            assert!(report.method.contains("rays"), "{}", report.method);
        }
    }
}

#[test]
fn a_scan_with_holes_comes_back_whole() {
    let truth = bunny();
    let (soup, chosen) = turned(&truth, 0.5, 9);
    let (found, report) = oriented(&soup);
    assert_eq!(agreement(&truth, &found), 1.0);
    assert_eq!(report.flipped.len(), chosen.len());
    // Half of it, a shell that rays leave on one side mostly.
    let half = without(&sphere(16), |t| t >= 8 * 256 / 2 + 256);
    let (soup, _) = turned(&half, 0.3, 4);
    assert_eq!(agreement(&half, &oriented(&soup).0), 1.0);
}

#[test]
fn cavities_stay_as_far_as_they_can_be_told() {
    let nest = |inner: &TriangleSoup| joined(&[torus(3.0, 1.0, 40, 20), inner.clone()]);
    let ring = torus(3.0, 0.4, 40, 12);
    let (solid, cavity) = (nest(&ring), nest(&flipped(&ring)));
    for truth in [&solid, &cavity] {
        // Most faces are right: what is inside stays what it is. All turned: the same, turned back.
        for share in [0.0, 0.1, 1.0] {
            let found = oriented(&turned(truth, share, 2).0).0;
            assert_eq!(agreement(truth, &found), 1.0, "{share}");
        }
        // Nothing left to go by: a cavity.
        let found = oriented(&turned(truth, 0.5, 2).0).0;
        assert_eq!(agreement(&cavity, &found), 1.0);
    }
    // Solids that overlap are no nest.
    let shifted = |by: f64| {
        let ball = sphere(12);
        let positions = ball.positions().iter().map(|p| *p + by * Vec3::X).collect();
        TriangleSoup::new(positions, ball.triangles().to_vec()).unwrap()
    };
    let overlapping = joined(&[shifted(0.0), shifted(0.7)]);
    assert_eq!(agreement(&overlapping, &oriented(&turned(&overlapping, 0.5, 6).0).0), 1.0);
}

#[test]
fn awkward_soups_are_taken_as_they_are() {
    let empty = TriangleSoup::default();
    assert_eq!(oriented(&empty).1.flipped, []);
    // A flat sheet has no inside: it keeps the way most of it runs. Two corners in one place have no way.
    let sheet = vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5], [1, 1, 0]];
    let positions: Vec<Vec3> = (0..6).map(|k| Vec3::new(f64::from(k / 2), f64::from(k % 2), 0.0)).collect();
    let truth = TriangleSoup::new(positions.clone(), sheet.clone()).unwrap();
    assert_eq!(oriented(&truth).1.flipped, []);
    let mut one = sheet.clone();
    one[2].swap(0, 1);
    assert_eq!(oriented(&TriangleSoup::new(positions.clone(), one).unwrap()).1.flipped, [2]);
    // A copy turns with the first.
    let ball = sphere(4);
    let mut triangles = ball.triangles().to_vec();
    triangles.extend([triangles[5], [triangles[5][0], triangles[5][2], triangles[5][1]]]);
    triangles[5].swap(0, 1);
    let soup = TriangleSoup::new(ball.positions().to_vec(), triangles).unwrap();
    assert_eq!(oriented(&soup).1.flipped, [5, 128, 129]);
    // A strip with a half turn.
    let strip = vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1]];
    let place = |k: usize| Vec3::new((k * k % 5) as f64, (3 * k % 7) as f64, (k * k * k % 11) as f64);
    let soup = TriangleSoup::new((0..5).map(place).collect(), strip).unwrap();
    assert_eq!(oriented(&soup).1.one_sided_patches, 1);
    let stop = |_: f64, _: &str| false;
    assert!(orient_soup(&soup, &FaceConfig::default(), &stop).is_err());
}

#[test]
fn all_methods_and_any_number_of_threads_turn_the_same() {
    let truth = loose(&sphere(8), 0.03);
    let (soup, _) = turned(&truth, 0.5, 1);
    for method in [FaceMethod::Parity, FaceMethod::Visibility, FaceMethod::Consistency] {
        let config = FaceConfig { method, ..FaceConfig::default() };
        let run = || orient_soup(&soup, &config, &Silent).unwrap();
        let (found, report) = run();
        assert!(agreement(&truth, &found) > 0.99, "{method:?}");
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(run);
        assert_eq!((found, report), alone, "{method:?}");
    }
}
