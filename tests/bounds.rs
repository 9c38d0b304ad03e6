//! Bounds of the errors of single values, and inside tests at few points, which rest on them.
mod common;

use common::*;
use fast_winding::data::{OrientedCloud, Shape, Silent, TriangleSoup};
use fast_winding::math::{Vec3, side_of_plane};
use fast_winding::treecode::{Kernel, Scratch, Tree, TreeConfig};
use fast_winding::winding::{
    Dipoles, FieldConfig, Triangles, WindingField, bounded_winding_of_cloud, winding, winding_of_cloud,
};
use rayon::prelude::*;
use std::sync::Arc;

/// Triangles all over the place, of sizes over three decades.
fn scraps(count: usize) -> TriangleSoup {
    let mut random = random(11);
    let mut point = |size: f64| size * (2.0 * Vec3::new(random(), random(), random()) - Vec3::ONE);
    let corners = (0..count).flat_map(|t| {
        let size = 0.2 * 10f64.powf(-3.0 * (t % 17) as f64 / 16.0);
        let middle = point(1.0);
        [middle + point(size), middle + point(size), middle + point(size)]
    });
    let corners: Vec<Vec3> = corners.collect();
    let triangles = (0..count as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(corners, triangles).unwrap()
}

/// A dipole at each barycentre; where they are `turned`, half of them look the other way.
fn dipoles(soup: &TriangleSoup, turned: bool) -> OrientedCloud {
    let mut random = random(3);
    let areas: Vec<Vec3> =
        (0..soup.len()).map(|t| fast_winding::math::area_vector(soup.corners(t))).collect();
    let points = (0..soup.len()).map(|t| fast_winding::math::barycentre(soup.corners(t))).collect();
    let turn = |n: Vec3, r: f64| if turned && r < 0.5 { -n } else { n };
    let normals = areas.iter().map(|a| turn(a.normalize_or(Vec3::Z), random())).collect();
    OrientedCloud::new(points, normals, areas.iter().map(|a| a.length()).collect()).unwrap()
}

/// Points everywhere, next to sources and far away.
fn queries(shape: &Shape, near: impl Fn(usize) -> Vec3, count: usize) -> Vec<Vec3> {
    let mut random = random(23);
    let bounds = shape.bounds();
    let size = bounds.diagonal();
    (0..count)
        .map(|k| {
            let shift = 2.0 * Vec3::new(random(), random(), random()) - Vec3::ONE;
            match k % 3 {
                0 => bounds.center() + size * shift,
                1 => near(k % shape.len()) + 0.03 * size * shift,
                _ => bounds.center() + size * 10f64.powf(4.0 * random()) * shift,
            }
        })
        .collect()
}

/// The largest share of its bound that an error takes.
fn largest_share<K: Kernel>(
    kernel: &K,
    exact: impl Fn(Vec3) -> f64 + Sync,
    queries: &[Vec3],
    beta: f64,
) -> f64 {
    let tree = Tree::build(kernel, &TreeConfig { leaf_size: 8 });
    let share = |q: &Vec3| {
        let (w, bound) = tree.bounded(*q, beta, &mut Scratch::default());
        (w - exact(*q)).abs() / bound
    };
    queries.par_iter().map(share).reduce(|| 0.0, f64::max)
}

#[test]
fn errors_stay_within_their_bounds() {
    for soup in [scraps(700), sphere(12), torus(1.0, 0.05, 40, 12)] {
        let soup = Arc::new(soup);
        let shape = Shape::Soup(soup.clone());
        let queries = queries(&shape, |t| soup.corners(t)[0], 3000);
        for beta in [1.5, 2.0, 4.0, 10.0, 60.0] {
            let share = largest_share(&Triangles::new(soup.clone()), |q| winding(&shape, q), &queries, beta);
            println!("soup of {}: {share} for β {beta}", soup.len());
            assert!(share < 1.0, "soup of {}: {share} of the bound for β {beta}", soup.len());
            // The first terms left out matter: a bound that is never approached would decide nothing.
            assert!(beta > 20.0 || share > 1e-3, "soup of {}: {share} of the bound for β {beta}", soup.len());
        }
        for turned in [false, true] {
            let cloud = Arc::new(dipoles(&soup, turned));
            for beta in [1.5, 2.0, 4.0, 10.0, 60.0] {
                let plain = Dipoles::new(cloud.clone(), false);
                let share = largest_share(&plain, |q| winding_of_cloud(&cloud, q), &queries, beta);
                let bounded = Dipoles::new(cloud.clone(), true);
                let share_of_bounded =
                    largest_share(&bounded, |q| bounded_winding_of_cloud(&cloud, q), &queries, beta);
                println!("cloud of {}: {share}, bounded {share_of_bounded} for β {beta}", soup.len());
                assert!(share < 1.0, "cloud of {}: {share} of the bound for β {beta}", soup.len());
                assert!(
                    share_of_bounded < 1.0,
                    "bounded cloud: {share_of_bounded} of the bound for β {beta}"
                );
            }
        }
    }
}

/// Few points at a time, so that each is decided by itself.
fn check_few(shape: impl Into<Shape>, queries: &[Vec3]) {
    let field = WindingField::new(shape, FieldConfig::default());
    check(&field, queries, 300, |q| winding(field.shape(), q));
}

/// So many queries at a time.
fn check(field: &WindingField, queries: &[Vec3], together: usize, exact: impl Fn(Vec3) -> f64 + Sync) {
    let mut inside = Vec::new();
    for some in queries.chunks(together) {
        inside.extend(field.contains(some, &Silent).unwrap());
    }
    let expected: Vec<f64> = queries.par_iter().map(|q| exact(*q)).collect();
    let mut compared = 0;
    for ((q, w), inside) in queries.iter().zip(expected).zip(inside) {
        if (w - 0.5).abs() > 1e-9 {
            assert_eq!(inside, w >= 0.5, "{w} at {q:?}");
            assert_eq!(field.contains_point(*q), inside, "{w} at {q:?}");
            compared += 1;
        }
    }
    assert!(compared > queries.len() / 2);
}

#[test]
fn few_points_are_decided_right() {
    let scraps = Arc::new(scraps(3000));
    let shape = Shape::Soup(scraps.clone());
    let points = queries(&shape, |t| scraps.corners(t)[1], 3000);
    check_few(scraps.clone(), &points);
    check_few(dipoles(&scraps, true), &points);
    let torus = torus(1.0, 0.4, 50, 24);
    check_few(dipoles(&torus, false), &points);
}

#[test]
fn points_of_bounded_clouds_are_decided_right() {
    let scraps = scraps(3000);
    for cloud in [dipoles(&scraps, true), dipoles(&torus(1.0, 0.4, 50, 24), false), sphere_cloud(5000)] {
        let cloud = Arc::new(cloud);
        let config = FieldConfig { bounded: true, ..FieldConfig::default() };
        let field = WindingField::new(cloud.clone(), config);
        let points = queries(&Shape::Cloud(cloud.clone()), |i| cloud.points()[i], 3000);
        let exact = |q: Vec3| bounded_winding_of_cloud(&cloud, q);
        check(&field, &points, 300, exact);
        check(&field, &points, 3000, exact);
    }
}

/// Along a straight line through the place where w = ½, closer and closer to it.
#[test]
fn points_next_to_the_level_set_are_decided_right() {
    let cloud = Arc::new(dipoles(&torus(1.0, 0.4, 80, 40), false));
    let shape = Shape::Cloud(cloud.clone());
    let field = WindingField::new(shape.clone(), FieldConfig::default());
    let at = |s: f64| Vec3::new(1.0 + s, 0.013, 0.02);
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        let w = winding(&shape, at(middle));
        if (w - 0.5).abs() > 1e-9 {
            assert_eq!(field.contains_point(at(middle)), w >= 0.5, "{w} at {middle}");
        }
        *if w >= 0.5 { &mut inside } else { &mut outside } = middle;
    }
    assert!(field.refined() > 5, "{} sums next to the level set", field.refined());
}

/// Next to a triangle, off its plane by rounding only: as a little farther off on the same side.
#[test]
fn sides_of_loose_triangles_are_exact() {
    let whole = torus(1.0, 0.4, 50, 24);
    let mut random = random(29);
    let mut apart = || 1e-3 * (2.0 * Vec3::new(random(), random(), random()) - Vec3::ONE);
    let corners: Vec<Vec3> = (0..whole.len())
        .flat_map(|t| {
            let shift = apart();
            whole.corners(t).map(|c| c + shift)
        })
        .collect();
    let triangles = (0..whole.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let soup = TriangleSoup::new(corners, triangles).unwrap();
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    assert!(field.report().loose_components > 0);
    let (mut next, mut off) = (Vec::new(), Vec::new());
    for t in 0..soup.len() {
        let corners = soup.corners(t);
        let middle = fast_winding::math::barycentre(corners);
        let out = fast_winding::math::area_vector(corners).normalize();
        for q in [middle, middle.with_x(middle.x.next_up()), middle.with_z(middle.z.next_down())] {
            let side = f64::from(side_of_plane(q, corners));
            if side != 0.0 {
                next.push(q);
                off.push(q + 1e-9 * side * out);
            }
        }
    }
    assert!(next.len() > 3000, "{}", next.len());
    let at_once = |points: &[Vec3]| field.contains(points, &Silent).unwrap();
    let expected = at_once(&off);
    let wrong = |answers: Vec<bool>| answers.iter().zip(&expected).filter(|(a, b)| a != b).count();
    assert_eq!(wrong(at_once(&next)), 0, "of {} at once", next.len());
    assert_eq!(wrong(next.chunks(500).flat_map(at_once).collect()), 0, "of {} by few", next.len());
}
