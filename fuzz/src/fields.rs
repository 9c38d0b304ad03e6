//! Winding numbers, inside tests and distances against sums over all triangles or points.
use super::facts::Watch;
use super::shapes::Made;
use super::source::Source;
use fast_winding::data::{
    LARGEST_COORDINATE, Lattice, OrientedCloud, Shape, Silent, SoupError, TriangleSoup,
};
use fast_winding::math::{Vec3, squared_distance_to_triangle};
use fast_winding::solid::{DistanceConfig, DistanceSign, SignedDistance};
use fast_winding::winding::{Accuracy, FieldConfig, Order, WindingField, bounded_winding_of_cloud, winding};

/// Beside rounding, which grows with the number of triangles.
const ROUNDING: f64 = 1e-9;
/// Winding numbers nearer to 1/2 than this may be on either side of it by rounding.
const DOUBTFUL: f64 = 1e-9;
const SAMPLES: usize = 5;
/// On a surface, and so near to it that rounding counts, in parts of the size, sides are another matter.
const NEAR: f64 = 1e-6;

/// Constructors of soups tell what is wrong, and only that.
fn assert_errors_are_true(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) {
    let in_range = triangles.iter().flatten().all(|index| (*index as usize) < positions.len());
    let is_usable = |p: Vec3| p.abs().cmple(Vec3::splat(LARGEST_COORDINATE)).all();
    let finite = in_range && triangles.iter().flatten().all(|index| is_usable(positions[*index as usize]));
    match TriangleSoup::new(positions, triangles) {
        Ok(_) => assert!(finite),
        Err(SoupError::IndexOutOfRange { index, vertices, .. }) => {
            assert!(!in_range && index as usize >= vertices)
        }
        Err(SoupError::NonFiniteVertex { .. }) => assert!(in_range && !finite),
        Err(SoupError::TooManyVertices(_)) => unreachable!("the vertices are few"),
    }
}

pub fn soups(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: soup, is_tame } = match source.below(4) {
        0 => {
            let (positions, triangles) = source.arrays();
            assert_errors_are_true(positions.clone(), triangles.clone());
            Made { shape: TriangleSoup::cleaned(positions, triangles).0, is_tame: false }
        }
        _ => source.soup(),
    };
    let vertices: Vec<Vec3> = soup.positions().iter().copied().take(8).collect();
    let config = FieldConfig { leaf_size: 1 + source.below(9), ..FieldConfig::default() };
    field(&mut source, soup.into(), is_tame, config, &vertices);
}

pub fn clouds(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: cloud, is_tame } = source.oriented_cloud();
    let config = FieldConfig { leaf_size: 1 + source.below(9), bounded: source.flag() };
    let points: Vec<Vec3> = cloud.points().iter().copied().take(8).collect();
    field(&mut source, cloud.into(), is_tame, config, &points);
}

fn field(source: &mut Source, shape: Shape, is_tame: bool, config: FieldConfig, special: &[Vec3]) {
    let field = WindingField::new(shape.clone(), config);
    let mut queries = source.queries(field.bounds(), 8);
    let generic = queries.len();
    queries.extend(special);
    queries.extend([Vec3::ZERO, source.any_point(), source.grid_point()]);
    let sum = |q: Vec3| match &shape {
        Shape::Cloud(cloud) if config.bounded => bounded_winding_of_cloud(cloud, q),
        shape => winding(shape, q),
    };
    let singly: Vec<bool> = queries.iter().map(|q| field.contains_point(*q)).collect();
    let together = field.contains(&queries, &Silent).expect("nobody cancels");
    for (k, q) in queries.iter().enumerate() {
        let fast = field.at(*q, Accuracy::default());
        assert!(q.is_finite() || fast.is_nan(), "w = {fast} at {q}");
        if is_tame && matches!(shape, Shape::Soup(_)) {
            assert_eq!(singly[k], together[k], "{q} is inside or not, alone and among others");
        }
        let is_near = || nearest(&shape, *q) <= NEAR * field.bounds().diagonal();
        if !is_tame || k >= generic || !q.is_finite() || is_near() {
            continue;
        }
        let direct = sum(*q);
        let exact = field.at(*q, Accuracy::EXACT);
        assert!(
            (exact - direct).abs() <= ROUNDING * (1.0 + direct.abs()),
            "w = {exact}, the sum is {direct} at {q}"
        );
        assert!(
            (fast - direct).abs() <= 1e-3 * (1.0 + direct.abs()),
            "w = {fast} to 1e-3, the sum is {direct} at {q}"
        );
        if (direct - 0.5).abs() > DOUBTFUL {
            assert_eq!(singly[k], direct >= 0.5, "{q} with w = {direct}");
            assert_eq!(together[k], direct >= 0.5, "{q} with w = {direct}, among others");
        }
    }
    let explicit = Accuracy::Explicit {
        order: source.pick(&[Order::Zero, Order::One, Order::Two]),
        beta: source.setting(&[2.0, 1.0]),
    };
    field.at(queries[0], explicit);
    field.gradient(queries[0], Accuracy::default());
    field.evaluate(&queries, explicit, &Watch::new(source.byte())).ok();
    if let Ok(lattice) = Lattice::with_resolution(field.bounds(), SAMPLES) {
        let all = field.evaluate_lattice(&lattice, Accuracy::EXACT, &Watch::new(0)).expect("nobody cancels");
        assert_eq!(all.values.len(), lattice.len());
        field.evaluate_lattice(&lattice, Accuracy::default(), &Watch::new(source.byte())).ok();
    }
    let mut saved = Vec::new();
    field.save(&mut saved).expect("memory takes what is written");
    // Areas beyond 32-bit floats make clusters that are not saved.
    let loaded = match WindingField::load(&saved) {
        Err(error) if is_tame => panic!("a field that was saved: {error}"),
        Err(_) => return,
        Ok(loaded) => loaded,
    };
    for q in &queries {
        let [before, after] = [&field, &loaded].map(|field| field.at(*q, Accuracy::default()).to_bits());
        assert_eq!(before, after, "a loaded field answers otherwise at {q}");
    }
}

pub fn distances(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape, is_tame } = source.shape();
    let field = WindingField::new(shape.clone(), FieldConfig::default());
    let mut queries = source.queries(field.bounds(), 8);
    let generic = queries.len();
    queries.extend([Vec3::ZERO, source.any_point(), source.grid_point()]);
    let distance = SignedDistance::new(&field);
    let config = DistanceConfig {
        sign: source.pick(&[DistanceSign::Hard, DistanceSign::Smooth, DistanceSign::None]),
        band: source.option(&[0.5, 2.0]),
    };
    let found = distance.distances(&queries, &config, &Watch::new(source.byte()));
    assert!(found.is_err() || !shape.is_empty(), "an empty shape has no distances");
    let closest = distance.closest(&queries, &Silent);
    if let Ok(lattice) = Lattice::with_resolution(field.bounds(), SAMPLES) {
        distance.lattice(&lattice, &config, &Watch::new(source.byte())).ok();
    }
    let Ok(closest) = closest else { return };
    for (q, closest) in queries.iter().zip(closest).take(if is_tame { generic } else { 0 }) {
        let expected = nearest(&shape, *q);
        let (signed, length) = (distance.at(*q), closest.closest.distance);
        assert!((length - expected).abs() <= ROUNDING * (1.0 + expected), "{length} and {expected} at {q}");
        assert_eq!(signed.abs(), length, "alone and among others at {q}");
        assert_eq!(signed < 0.0, field.contains_point(*q) && length > 0.0, "the sign at {q}");
    }
}

/// The distance from the nearest triangle or point, asked one by one.
fn nearest(shape: &Shape, q: Vec3) -> f64 {
    let squares: Vec<f64> = match shape {
        Shape::Soup(soup) => {
            (0..soup.len()).map(|t| squared_distance_to_triangle(q, soup.corners(t))).collect()
        }
        Shape::Cloud(cloud) => OrientedCloud::points(cloud).iter().map(|p| p.distance_squared(q)).collect(),
    };
    squares.into_iter().fold(f64::INFINITY, f64::min).sqrt()
}
