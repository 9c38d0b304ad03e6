//! Normals and areas of points that have none, and fields in the plane.
use super::facts::Watch;
use super::shapes::Made;
use super::source::Source;
use fast_winding::data::{PointCloud, Silent};
use fast_winding::estimate::{AreaMethod, EstimateConfig, complete_with, deviations, roughness, spacings};
use fast_winding::math::Vec2;
use fast_winding::orient::{Bounded, ConsistencyConfig, OrientMethod, StochasticConfig, Widths, orient};
use fast_winding::winding::{PlanarCloud, PlanarConfig, PlanarField};

pub fn normals(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: cloud, .. } = source.cloud();
    let consistency = ConsistencyConfig {
        bounded: source.pick(&[Bounded::Nothing, Bounded::Gradients, Bounded::Everything]),
        widths: source.flag().then(|| Widths::ALL[source.below(6)]),
        iterations: source.below(6),
    };
    let stochastic = StochasticConfig { iterations: source.below(4), seed: 1, ..StochasticConfig::default() };
    let methods = [
        OrientMethod::Consistency(consistency),
        OrientMethod::Propagation,
        OrientMethod::Stochastic(stochastic),
    ];
    let method = source.pick(&methods);
    let made = orient(&cloud, &method, &Watch::new(source.byte()));
    roughness(cloud.points(), &Silent).ok();
    deviations(cloud.points(), &Silent).ok();
    spacings(cloud.points(), source.below(8), &Silent).ok();
    let config = EstimateConfig { neighbours: source.below(24) };
    let normals =
        cloud.points().iter().map(|_| source.grid_point() - fast_winding::math::Vec3::splat(1.5)).collect();
    let given = PointCloud::cleaned(cloud.points().to_vec(), Some(normals), None)
        .expect("as many normals as points")
        .0;
    let methods =
        [AreaMethod::Voronoi, AreaMethod::Curved, AreaMethod::NearestNeighbour, AreaMethod::Uniform];
    complete_with(&given, source.pick(&methods), &config, &Silent).ok();
    if let Ok((oriented, _)) = made {
        assert_eq!(oriented.points(), cloud.points(), "points move");
        assert!(
            oriented.normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-9),
            "a normal is no unit vector"
        );
        assert!(oriented.areas().iter().all(|a| a.is_finite() && *a >= 0.0), "an area is none");
    }
}

pub fn planar(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let count = source.below(40);
    let is_any = source.below(4) == 0;
    let point = |source: &mut Source| match is_any {
        true => source.any_point().truncate(),
        false => source.grid_point().truncate(),
    };
    let points: Vec<Vec2> = (0..count).map(|_| point(&mut source)).collect();
    let normals = points.iter().map(|_| Vec2::from_angle(source.share() * 6.3)).collect();
    let lengths = points.iter().map(|_| if is_any { source.number() } else { source.share() }).collect();
    let Ok(cloud) = PlanarCloud::new(points, normals, lengths) else { return };
    let config = PlanarConfig { leaf_size: 1 + source.below(8), bounded: source.flag() };
    let field = PlanarField::new(&cloud, config);
    for _ in 0..8 {
        let q = Vec2::new(4.0 * source.share(), 4.0 * source.share());
        let [fast, exact] = [1e-3, 0.0].map(|tolerance| field.at(q, tolerance));
        assert!(is_any || (fast - exact).abs() <= 1.1e-3, "w = {fast} to 1e-3, and {exact} exactly, at {q}");
        field.gradient(q, 1e-3);
    }
}
