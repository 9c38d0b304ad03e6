//! Areas of points against those they truly stand for, on sampled surfaces.
mod common;

use common::surfaces::{AreaErrors, SURFACES, Sampling, area_errors, cloud_of, sample, true_areas};
use common::*;
use fast_winding::PointCloud;
use fast_winding::data::{CloudError, Silent, TriangleSoup, Warning, WarningKind};
use fast_winding::estimate::{self, AreaMethod, EstimateConfig, EstimateError, areas, complete_with};
use fast_winding::math::Vec3;
use fast_winding::metrics::{chamfer_distance, sample_surface};

const ALL: [AreaMethod; 4] =
    [AreaMethod::Voronoi, AreaMethod::Curved, AreaMethod::NearestNeighbour, AreaMethod::Uniform];

fn by(cloud: &PointCloud, method: AreaMethod) -> Vec<f64> {
    areas(cloud, method, &EstimateConfig::default(), &Silent).unwrap()
}

fn errors(surface: &str, sampling: Sampling, method: AreaMethod) -> AreaErrors {
    let surface = SURFACES.iter().find(|s| s.name == surface).unwrap();
    let places = sample(surface, sampling, 3000, 1);
    area_errors(&by(&cloud_of(&places), method), &true_areas(surface, &places))
}

/// Asserts the median error, the 95th of 100, and that of the sum, all in percent. Each bound is up to half as much again
/// as what was measured (see `tests/bench/areas.rs`); the truth itself is sampled to some 0.3 %.
fn assert_within(found: AreaErrors, [median, most, sum]: [f64; 3]) {
    let AreaErrors { median: m, most: n, sum: s } = found;
    assert!(100.0 * m < median && 100.0 * n < most && 100.0 * s.abs() < sum, "{found:?}");
}

#[test]
fn cells_of_scanned_closed_surfaces_are_right_to_a_percent() {
    for surface in ["sphere", "torus", "ellipsoid"] {
        assert_within(errors(surface, Sampling::Spaced, AreaMethod::Voronoi), [1.0, 3.5, 0.8]);
        assert_within(errors(surface, Sampling::Spaced, AreaMethod::Curved), [0.9, 3.0, 0.5]);
    }
}

#[test]
fn cells_of_places_drawn_by_lot_are_right_to_a_few_percent() {
    for surface in ["sphere", "torus", "ellipsoid"] {
        assert_within(errors(surface, Sampling::Random, AreaMethod::Voronoi), [1.4, 5.0, 1.2]);
        assert_within(errors(surface, Sampling::Uneven, AreaMethod::Voronoi), [2.2, 10.0, 6.0]);
        assert_within(errors(surface, Sampling::Uneven, AreaMethod::Curved), [2.0, 10.0, 2.5]);
    }
}

#[test]
fn curvature_counts_where_places_are_few() {
    let [flat, curved] =
        [AreaMethod::Voronoi, AreaMethod::Curved].map(|m| errors("torus", Sampling::SixTimes, m));
    assert_within(flat, [5.5, 14.0, 7.0]);
    assert_within(curved, [3.0, 9.0, 3.0]);
    assert!(1.5 * curved.median < flat.median && 2.0 * curved.sum.abs() < flat.sum.abs());
}

#[test]
fn border_cells_end_about_where_the_surface_does() {
    assert_within(errors("disk", Sampling::Spaced, AreaMethod::Voronoi), [0.9, 12.0, 4.0]);
    assert_within(errors("disk", Sampling::Random, AreaMethod::Voronoi), [1.0, 16.0, 2.0]);
}

/// A fifth of the places lie at the sides' borders: they make up the largest errors.
#[test]
fn two_sides_of_a_thin_sheet_have_their_own_cells() {
    assert_within(errors("sheet", Sampling::Spaced, AreaMethod::Voronoi), [0.9, 45.0, 5.5]);
    assert_within(errors("sheet", Sampling::Random, AreaMethod::Voronoi), [1.4, 75.0, 4.0]);
}

#[test]
fn circles_add_up_for_places_drawn_by_lot_and_to_twice_as_much_for_scanned_ones() {
    let random = errors("sphere", Sampling::Random, AreaMethod::NearestNeighbour);
    assert!(random.sum.abs() < 0.05 && random.median > 0.4 && random.most > 0.9, "{random:?}");
    let spaced = errors("sphere", Sampling::Spaced, AreaMethod::NearestNeighbour);
    assert!((spaced.sum - 1.0).abs() < 0.1, "{spaced:?}");
}

#[test]
fn uniform_areas_are_wrong_where_the_sampling_is_uneven() {
    let uneven = errors("sphere", Sampling::Uneven, AreaMethod::Uniform);
    assert!(uneven.median > 0.5 && uneven.sum.abs() < 0.02, "{uneven:?}");
}

#[test]
fn threads_change_no_bit() {
    let cloud = cloud_of(&sample(&SURFACES[1], Sampling::Random, 9000, 3));
    let with = |threads: usize, method| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| by(&cloud, method))
    };
    for method in ALL {
        assert_eq!(with(1, method), with(3, method));
    }
    let mesh = torus(1.0, 0.4, 60, 24);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| sample_surface(&mesh, 5000, 4).unwrap())
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one, three);
    assert_eq!(
        chamfer_distance(&one.points, mesh.positions()),
        chamfer_distance(&three.points, mesh.positions())
    );
}

#[test]
fn a_meshs_own_areas_add_up_to_it_and_give_its_field() {
    let soup = torus(1.0, 0.4, 60, 24);
    let exact: f64 = (0..soup.len()).map(|t| fast_winding::math::area_vector(soup.corners(t)).length()).sum();
    for (cloud, warnings) in [soup.vertex_cloud(), soup.barycentre_cloud()] {
        assert!(warnings.is_empty());
        assert!((cloud.areas().iter().sum::<f64>() / exact - 1.0).abs() < 1e-12);
        let w = |q: Vec3| fast_winding::winding::winding_of_cloud(&cloud, q);
        assert!((w(Vec3::X) - 1.0).abs() < 0.01 && w(Vec3::ZERO).abs() < 0.01, "{}", w(Vec3::X));
    }
    // The vertices' own areas are their cells', up to how triangles share theirs out.
    let (cloud, _) = soup.vertex_cloud();
    let (normals, points) = (cloud.normals().to_vec(), cloud.points().to_vec());
    let (bare, _) = PointCloud::cleaned(points, Some(normals), None).unwrap();
    let found = area_errors(&by(&bare, AreaMethod::Curved), cloud.areas());
    assert!(found.median < 0.02 && found.most < 0.05, "{found:?}");
}

#[test]
fn samplings_of_one_surface_are_no_farther_apart_than_chance_has_it() {
    let soup = sphere(40);
    let sampled = |seed| sample_surface(&soup, 20_000, seed).unwrap().points;
    let distance = chamfer_distance(&sampled(1), &sampled(2)).unwrap();
    let expected = 0.5 * (4.0 * std::f64::consts::PI / 20_000.0).sqrt();
    // Shares of the area that have one point each are a little more even than chance.
    assert!(distance > 0.85 * expected && distance < expected, "{distance} instead of {expected}");
}

fn raw(points: Vec<Vec3>, normals: Option<Vec<Vec3>>) -> (PointCloud, Vec<Warning>) {
    PointCloud::cleaned(points, normals, None).unwrap()
}

#[test]
fn clouds_without_a_volume_are_oriented_with_a_warning() {
    let few = vec![Vec3::ZERO, Vec3::X, Vec3::ONE];
    let equal = vec![Vec3::ONE; 30];
    let line = (0..30).map(|i| Vec3::ONE * f64::from(i)).collect();
    let tilted = |i: u32| Vec3::new(f64::from(i % 7), f64::from(i / 7), 0.3 * f64::from(i % 7));
    let plane: Vec<Vec3> = (0..42).map(tilted).map(|p| p.as_vec3().as_dvec3()).collect();
    for points in [vec![Vec3::ONE], few, equal, line, plane] {
        let count = points.len();
        let (cloud, warnings) =
            estimate::orient(&raw(points, None).0, &EstimateConfig::default(), &Silent).unwrap();
        assert_eq!(cloud.len(), count);
        let expected = [WarningKind::EstimatedNormals, WarningKind::FlatCloud];
        assert_eq!(warnings, expected.map(|kind| Warning::new(kind, count)));
    }
    let (_, warnings) = estimate::orient(
        &raw(sphere_cloud(50).points().to_vec(), None).0,
        &EstimateConfig::default(),
        &Silent,
    )
    .unwrap();
    assert_eq!(warnings.len(), 1);
}

#[test]
fn points_in_one_place_have_no_areas() {
    for count in [1, 30] {
        let (cloud, _) = raw(vec![Vec3::ONE; count], Some(vec![Vec3::X; count]));
        let expected = Err(EstimateError::OnePlace { points: count });
        assert_eq!(estimate::complete(&cloud, &EstimateConfig::default(), &Silent), expected);
        for method in ALL {
            assert_eq!(complete_with(&cloud, method, &EstimateConfig::default(), &Silent), expected);
        }
    }
    for method in ALL {
        let none = areas(&PointCloud::default(), method, &EstimateConfig::default(), &Silent);
        assert_eq!(none, Err(EstimateError::Empty));
        // Two points are enough for an area.
        let (two, _) = raw(vec![Vec3::ZERO, Vec3::X], Some(vec![Vec3::Z; 2]));
        assert!(by(&two, method).iter().all(|a| *a > 0.0 && a.is_finite()), "{method:?}");
    }
}

#[test]
fn areas_of_cells_need_normals() {
    let (bare, _) = raw(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z], None);
    for method in [AreaMethod::Voronoi, AreaMethod::Curved, AreaMethod::Uniform] {
        let missing = Err(EstimateError::MissingNormals { points: 4 });
        assert_eq!(areas(&bare, method, &EstimateConfig::default(), &Silent), missing);
    }
    assert_eq!(by(&bare, AreaMethod::NearestNeighbour), vec![std::f64::consts::PI; 4]);
}

#[test]
fn copies_of_points_change_neither_normals_nor_the_whole_area() {
    let points = sphere_cloud(500).points().to_vec();
    let many: Vec<Vec3> = (0..30).flat_map(|_| points.clone()).collect();
    let oriented = |points: Vec<Vec3>| {
        estimate::orient(&raw(points, None).0, &EstimateConfig::default(), &Silent).unwrap().0
    };
    let (single, many) = (oriented(points), oriented(many));
    for i in 0..many.len() {
        assert_eq!(many.normals()[i], single.normals()[i % 500]);
        assert_eq!(many.areas()[i], single.areas()[i % 500] / 30.0);
    }
}

#[test]
fn bad_rows_are_dropped_and_the_others_get_the_same_areas() {
    let good = sphere_cloud(500);
    let (mut points, mut normals) = (good.points().to_vec(), good.normals().to_vec());
    let expected = by(&raw(points.clone(), Some(normals.clone())).0, AreaMethod::Voronoi);
    points.extend([Vec3::NAN, Vec3::new(0.0, f64::INFINITY, 0.0), Vec3::X]);
    normals.extend([Vec3::X, Vec3::X, Vec3::ZERO]);
    let (cloud, warnings) = raw(points, Some(normals));
    let counted = [Warning::new(WarningKind::NonFinitePoints, 2), Warning::new(WarningKind::BadNormals, 1)];
    assert_eq!(warnings, counted);
    assert_eq!(by(&cloud, AreaMethod::Voronoi), expected);
    let negative = PointCloud::cleaned(vec![Vec3::X], None, Some(vec![-1.0]));
    assert_eq!(negative, Err(CloudError::BadArea { point: 0, area: -1.0 }));
    let wrong = PointCloud::cleaned(vec![Vec3::X], Some(vec![]), None);
    assert_eq!(wrong, Err(CloudError::LengthMismatch { what: "normals", found: 0, points: 1 }));
}

#[test]
fn meshes_without_area_give_empty_clouds_and_counts() {
    let soup = TriangleSoup::new(vec![Vec3::X, Vec3::Y], vec![[0, 1, 1], [0, 0, 0]]).unwrap();
    let (cloud, warnings) = soup.barycentre_cloud();
    assert!(cloud.is_empty());
    assert_eq!(warnings, [Warning::new(WarningKind::DegenerateFaces, 2)]);
    let (cloud, warnings) = soup.vertex_cloud();
    assert!(cloud.is_empty());
    let counted =
        [Warning::new(WarningKind::DegenerateFaces, 2), Warning::new(WarningKind::UnusedVertices, 2)];
    assert_eq!(warnings, counted);
}
