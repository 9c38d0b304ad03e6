use super::*;
use crate::data::TriangleSoup;

/// Numbers between -1 and 1.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn scattered(count: usize, size: f64, seed: u64) -> Vec<Vec3> {
    let mut next = random(seed);
    (0..count).map(|_| size * Vec3::new(next(), next(), next())).collect()
}

/// The same by a look at all elements.
fn by_all(tree: &DistanceTree, count: u32, place: Vec3) -> (f64, u32) {
    let all = (0..count).map(|e| (tree.squared_distance(place, e), e));
    all.min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap()
}

/// Triangles of all sizes: some are needles, some have no area, some are there twice.
fn soup(count: usize, seed: u64) -> TriangleSoup {
    let mut next = random(seed);
    let mut corners = Vec::new();
    for kind in 0..count {
        let (a, size) = (Vec3::new(next(), next(), next()), 0.3 * next().abs().powi(4));
        let mut side = || size * Vec3::new(next(), next(), next());
        let (b, c) = (side(), side());
        corners.extend(match kind % 5 {
            0 => [a, a + b, a + 1e-7 * c],
            1 => [a, a + b, a + 0.5 * b],
            _ => [a, a + b, a + c],
        });
    }
    let mut triangles: Vec<[u32; 3]> = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let again: Vec<[u32; 3]> = triangles.iter().step_by(9).map(|t| [t[1], t[2], t[0]]).collect();
    triangles.extend(again);
    TriangleSoup::new(corners, triangles).unwrap()
}

#[test]
fn the_nearest_is_that_of_a_search_through_all() {
    for (count, seed) in [(1, 1), (5, 2), (400, 3), (1500, 4)] {
        let shape = Shape::from(soup(count, seed));
        let tree = DistanceTree::new(&shape);
        let mut search = Search::default();
        for place in scattered(300, 1.5, seed).into_iter().chain(scattered(50, 1e4, 9)) {
            let (squared, element) = by_all(&tree, shape.len() as u32, place);
            let found = tree.closest_within(place, f64::INFINITY, &mut search).unwrap();
            assert_eq!((found.distance, found.element), (squared.sqrt(), element));
            assert!((found.point.distance(place) - found.distance).abs() < 1e-12 * (1.0 + found.distance));
            assert_eq!(tree.closest(place), Some(found), "what was found before makes no difference");
            assert_eq!(tree.distance_within(place, 0.999 * found.distance, &mut search), None);
            let within = tree.distance_within(place, 1.001 * found.distance, &mut search);
            assert_eq!(within, Some(found.distance));
        }
    }
}

#[test]
fn far_away_and_tiny_shapes_are_measured_as_exactly() {
    for (shift, scale) in
        [(Vec3::splat(1e6), 1.0), (Vec3::ZERO, 1e-30), (Vec3::splat(-3e3), 1e-3), (Vec3::ZERO, 1e25)]
    {
        let soup = soup(300, 6);
        let moved = soup.positions().iter().map(|p| scale * *p + shift).collect();
        let shape = Shape::from(TriangleSoup::new(moved, soup.triangles().to_vec()).unwrap());
        let tree = DistanceTree::new(&shape);
        for place in scattered(200, 1.2 * scale, 7) {
            let (squared, element) = by_all(&tree, shape.len() as u32, place + shift);
            let found = tree.closest(place + shift).unwrap();
            assert_eq!((found.distance, found.element), (squared.sqrt(), element));
        }
    }
}

#[test]
fn points_of_clouds_are_found_too() {
    for count in [1, 3, 1000] {
        let points = scattered(count, 1.0, 5);
        let normals = vec![Vec3::Z; count];
        let cloud = OrientedCloud::new(points.clone(), normals, vec![1.0; count]).unwrap();
        let tree = DistanceTree::new(&cloud.into());
        for place in scattered(300, 1.5, 8) {
            let (squared, element) = by_all(&tree, count as u32, place);
            let found = tree.closest(place).unwrap();
            assert_eq!((found.distance, found.element), (squared.sqrt(), element));
            assert_eq!((found.point, found.feature), (points[element as usize], Feature::Vertex(0)));
        }
    }
}

#[test]
fn of_equally_near_ones_the_first_is_taken() {
    // Corners of a grid, seen from the centres of its cells.
    let points: Vec<Vec3> =
        (0..216).map(|i| Vec3::new((i * 5 % 6) as f64, (i / 6 % 6) as f64, (i / 36) as f64)).collect();
    let count = points.len();
    let cloud = OrientedCloud::new(points, vec![Vec3::Z; count], vec![1.0; count]).unwrap();
    let tree = DistanceTree::new(&cloud.into());
    for cell in 0..125 {
        let place = Vec3::new((cell % 5) as f64, (cell / 5 % 5) as f64, (cell / 25) as f64) + 0.5;
        assert_eq!(tree.closest(place).unwrap().element, by_all(&tree, count as u32, place).1);
    }
}

#[test]
fn nothing_is_near_where_there_is_nothing() {
    let empty = DistanceTree::new(&TriangleSoup::default().into());
    assert_eq!(empty.closest(Vec3::ZERO), None);
    let tree = DistanceTree::new(&soup(10, 1).into());
    assert_eq!((tree.closest(Vec3::NAN), tree.closest(Vec3::INFINITY)), (None, None));
    assert!(
        tree.closest(Vec3::splat(1e200))
            .is_some_and(|found| found.distance == f64::INFINITY || found.distance > 1e200)
    );
}
