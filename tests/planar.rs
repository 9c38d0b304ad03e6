//! Winding numbers of oriented points of a plane, plain and bounded: the fast ones against the sums by the definition.
mod common;

use common::random;
use fast_winding::data::Silent;
use fast_winding::math::Vec2;
use fast_winding::winding::{
    FieldError, PlanarCloud, PlanarConfig, PlanarError, PlanarField, bounded_winding_in_plane,
};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, 1e-6];

fn field(cloud: &PlanarCloud, bounded: bool) -> PlanarField {
    PlanarField::new(cloud, PlanarConfig { bounded, ..PlanarConfig::default() })
}

/// Σ l n·(p − q) / 2π|p − q|², by the definition.
fn plain(cloud: &PlanarCloud, q: Vec2) -> f64 {
    let term = |i: usize| {
        let r = cloud.points()[i] - q;
        let apart = r != Vec2::ZERO;
        if apart { cloud.lengths()[i] * cloud.normals()[i].dot(r) / (TAU * r.length_squared()) } else { 0.0 }
    };
    (0..cloud.len()).map(term).sum()
}

fn by_definition(cloud: &PlanarCloud, q: Vec2, bounded: bool) -> f64 {
    if bounded {
        bounded_winding_in_plane(cloud.points(), cloud.normals(), cloud.lengths(), q)
    } else {
        plain(cloud, q)
    }
}

/// `count` samples of the closed polygon, counter-clockwise, evenly along each side and at the middle of their pieces.
fn polygon(corners: &[Vec2], count: usize) -> PlanarCloud {
    let sides = |i: usize| (corners[i], corners[(i + 1) % corners.len()]);
    let around: f64 = (0..corners.len()).map(|i| sides(i).0.distance(sides(i).1)).sum();
    let (mut points, mut normals, mut lengths) = (vec![], vec![], vec![]);
    for (a, b) in (0..corners.len()).map(sides) {
        let pieces = (count as f64 * a.distance(b) / around).ceil();
        for i in 0..pieces as usize {
            points.push(a.lerp(b, (i as f64 + 0.5) / pieces));
            normals.push(-(b - a).perp());
            lengths.push(a.distance(b) / pieces);
        }
    }
    PlanarCloud::new(points, normals, lengths).unwrap()
}

fn circle(centre: Vec2, radius: f64, count: usize) -> PlanarCloud {
    let normals: Vec<Vec2> = (0..count).map(|i| Vec2::from_angle(TAU * i as f64 / count as f64)).collect();
    let points = normals.iter().map(|n| centre + radius * *n).collect();
    PlanarCloud::new(points, normals, vec![TAU * radius / count as f64; count]).unwrap()
}

/// A star with five points, its corners sharp both ways.
fn star(count: usize) -> PlanarCloud {
    let corner =
        |i: usize| Vec2::from_angle(PI * i as f64 / 5.0) * if i.is_multiple_of(2) { 1.0 } else { 0.3 };
    polygon(&(0..10).map(corner).collect::<Vec<_>>(), count)
}

/// Points all over a rectangle, facing anywhere, with lengths from 0 to nearly their spacing.
fn chaos(count: usize, seed: u64) -> PlanarCloud {
    let mut next = random(seed);
    let points = (0..count).map(|_| Vec2::new(3.0 * next(), next())).collect();
    let normals = (0..count).map(|_| Vec2::from_angle(TAU * next())).collect();
    let lengths = (0..count).map(|_| 1.4 / (count as f64).sqrt() * next().powi(3)).collect();
    PlanarCloud::new(points, normals, lengths).unwrap()
}

fn joined(parts: &[PlanarCloud]) -> PlanarCloud {
    PlanarCloud::new(
        parts.iter().flat_map(|p| p.points().to_vec()).collect(),
        parts.iter().flat_map(|p| p.normals().to_vec()).collect(),
        parts.iter().flat_map(|p| p.lengths().to_vec()).collect(),
    )
    .unwrap()
}

fn clouds() -> Vec<(&'static str, PlanarCloud)> {
    let far = Vec2::new(4e5, -1e5);
    let heap = {
        // 300 copies of each of 20 points of a circle, each with a part of its length.
        let all = joined(&vec![circle(Vec2::ZERO, 1.0, 20); 300]);
        let lengths = all.lengths().iter().map(|l| l / 300.0).collect();
        PlanarCloud::new(all.points().to_vec(), all.normals().to_vec(), lengths).unwrap()
    };
    vec![
        ("circle", circle(Vec2::new(0.3, -0.2), 1.0, 4000)),
        ("star", star(4000)),
        ("square", polygon(&[Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y], 3000)),
        ("chaos", chaos(5000, 3)),
        ("far apart", joined(&[circle(Vec2::ZERO, 1.0, 2000), circle(far, 2.0, 2000)])),
        ("copies", heap),
    ]
}

/// Places all around and far off, next to points at all distances, and on points.
fn queries(cloud: &PlanarCloud, seed: u64) -> Vec<Vec2> {
    let mut next = random(seed);
    let low = cloud.points().iter().fold(Vec2::INFINITY, |low, p| low.min(*p));
    let size = cloud.points().iter().fold(Vec2::NEG_INFINITY, |high, p| high.max(*p)) - low;
    let mut places = vec![low - 1e3 * size, low + 1e7 * size];
    places.extend((0..1000).map(|_| low + size * (2.0 * Vec2::new(next(), next()) - 0.5)));
    for i in (0..cloud.len()).step_by(cloud.len() / 500) {
        let p = cloud.points()[i];
        let distance = 10.0_f64.powf(-6.0 * next());
        places.extend([p, p + distance * Vec2::from_angle(TAU * next()), p - distance * cloud.normals()[i]]);
    }
    places
}

#[test]
fn values_are_within_their_tolerance_everywhere() {
    for (name, cloud) in clouds() {
        let places = queries(&cloud, 7);
        assert!(places.len() > 2500);
        for bounded in [false, true] {
            let exact: Vec<f64> = places.par_iter().map(|q| by_definition(&cloud, *q, bounded)).collect();
            let field = field(&cloud, bounded);
            for tolerance in TOLERANCES {
                let values = field.evaluate(&places, tolerance, &Silent).unwrap();
                let largest = values.iter().zip(&exact).map(|(w, e)| (w - e).abs()).fold(0.0, f64::max);
                println!("{name}, bounded: {bounded}: {largest:.1e} of {tolerance:.0e}");
                assert!(largest <= tolerance, "{name}, bounded: {bounded}: {largest} of {tolerance}");
                assert!(largest > 1e-3 * tolerance, "{name}: all is summed singly, or the bound is loose");
            }
            let values = field.evaluate(&places, 0.0, &Silent).unwrap();
            for ((w, e), q) in values.iter().zip(&exact).zip(&places) {
                assert!((w - e).abs() <= 1e-12 * e.abs().max(1.0), "{name}: {w} for {e} at {q}");
            }
        }
    }
}

#[test]
fn gradients_are_within_their_tolerance_everywhere() {
    for (name, cloud) in clouds() {
        let places = queries(&cloud, 8);
        for bounded in [false, true] {
            let field = field(&cloud, bounded);
            let exact = field.gradients(&places, 0.0, &Silent).unwrap();
            for tolerance in TOLERANCES {
                let found = field.gradients(&places, tolerance, &Silent).unwrap();
                // At a distance of 10⁻⁶ it reaches 10¹⁰: each of the additions of the direct sum rounds that.
                let rounding = 1.2e-16 * cloud.len() as f64;
                let over = |(g, e): (&Vec2, &Vec2)| (*g - *e).length() - rounding * e.length();
                let largest = found.iter().zip(&exact).map(over).fold(0.0, f64::max);
                println!("{name}, bounded: {bounded}: {largest:.1e} of {tolerance:.0e}");
                assert!(largest <= tolerance, "{name}, bounded: {bounded}: {largest} of {tolerance}");
                assert!(largest > 1e-3 * tolerance, "{name}: all is summed singly, or the bound is loose");
            }
        }
    }
}

#[test]
fn gradients_are_the_slopes_of_the_definition() {
    for cloud in [star(300), chaos(300, 5)] {
        let mut next = random(11);
        for bounded in [false, true] {
            let field = field(&cloud, bounded);
            for _ in 0..500 {
                let q = 2.0 * Vec2::new(next(), next()) - 1.0;
                let nearest = cloud.points().iter().map(|p| p.distance(q)).fold(f64::INFINITY, f64::min);
                // The error of a central difference falls with the square of the step over the distance.
                let step = 1e-4 * nearest;
                let slope = |axis: Vec2| {
                    let at = |t: f64| by_definition(&cloud, q + t * axis, bounded);
                    (at(step) - at(-step)) / (2.0 * step)
                };
                let (expected, found) = (Vec2::new(slope(Vec2::X), slope(Vec2::Y)), field.gradient(q, 0.0));
                let error = (found - expected).length();
                assert!(
                    error < 1e-6 * (1.0 / nearest).max(expected.length()),
                    "{found} for {expected} at {q}"
                );
            }
        }
    }
}

#[test]
fn on_and_next_to_a_point_bounded_values_stay_within_a_half() {
    let single = PlanarCloud::new(vec![Vec2::ONE], vec![Vec2::X], vec![0.1]).unwrap();
    let (plain, bounded) = (field(&single, false), field(&single, true));
    for distance in [0.1, 1e-3, 1e-9, 1e-15] {
        let q = Vec2::new(1.0 - distance, 1.0);
        let apart = 1.0 - q.x;
        let x = 0.1 / (TAU * apart);
        assert!((plain.at(q, 1e-3) / x - 1.0).abs() < 1e-14);
        assert!((bounded.at(q, 1e-3) - (PI * x).atan() / PI).abs() < 1e-15);
        assert!(bounded.at(q, 1e-3) <= 0.5 && plain.at(q, 1e-3) > 0.1);
    }
    for field in [plain, bounded] {
        assert_eq!((field.at(Vec2::ONE, 1e-3), field.gradient(Vec2::ONE, 1e-3)), (0.0, Vec2::ZERO));
        assert_eq!(field.at(Vec2::ONE, 0.0), 0.0);
    }
    // On a point of a circle the others give a half.
    let round = circle(Vec2::ZERO, 1.0, 5000);
    for p in round.points().iter().step_by(61) {
        assert!((field(&round, true).at(*p, 1e-4) - 0.5).abs() < 1e-3);
    }
}

#[test]
fn samples_of_closed_polygons_tend_to_one_inside_and_zero_outside() {
    let (mut last, near) = (f64::INFINITY, Vec2::new(0.27, 0.0));
    let inside = [Vec2::ZERO, near, Vec2::new(0.8, 0.0), Vec2::from_angle(0.4 * PI) * 0.7];
    let outside = [Vec2::from_angle(PI / 5.0) * 0.4, Vec2::new(1.1, 0.1), Vec2::new(-3.0, 2.0), 50.0 * near];
    for count in [100, 1000, 10_000, 100_000] {
        let cloud = star(count);
        for bounded in [false, true] {
            let field = field(&cloud, bounded);
            let w = |q: &Vec2| field.at(*q, 1e-9);
            let error_inside = inside.iter().map(|q| (w(q) - 1.0).abs()).fold(0.0, f64::max);
            let error = outside.iter().map(|q| w(q).abs()).fold(error_inside, f64::max);
            println!("{count} samples, bounded: {bounded}: {error:.1e}");
            // The midpoint rule: the error falls with the square of the spacing.
            assert!(error < 0.02 * (1e3 / count as f64).powi(2).max(1e-6), "{error} of {count}");
            if !bounded {
                assert!(error < last, "{error} is no better than {last}");
                last = error;
            }
        }
    }
}

#[test]
fn a_query_takes_far_fewer_terms_than_there_are_points() {
    // The sum of |x|³ falls with the square of the distance along a curve, but with the distance only where points fill the plane:
    // many more of them are bounded singly.
    let tasks = [
        ("circle", circle(Vec2::ZERO, 1.0, 100_000), [250, 300]),
        ("star", star(100_000), [250, 300]),
        ("chaos", chaos(100_000, 6), [1000, 5000]),
    ];
    for (name, cloud, most) in tasks {
        let mut next = random(4);
        let mut places: Vec<Vec2> = (0..300).map(|_| 3.0 * Vec2::new(next(), next()) - 1.0).collect();
        places.extend(cloud.points().iter().step_by(331).map(|p| *p + 1e-7));
        for (bounded, most) in [false, true].into_iter().zip(most) {
            let field = field(&cloud, bounded);
            for tolerance in TOLERANCES {
                let costs = places.iter().map(|q| field.cost(*q, tolerance));
                let counts: Vec<usize> = costs.map(|c| c.terms + c.points).collect();
                let mean = counts.iter().sum::<usize>() / counts.len();
                println!("{name}, bounded: {bounded}, {tolerance:.0e}: {mean} terms");
                assert!(tolerance < 1e-3 || mean < most, "{name}, bounded: {bounded}: {mean} terms");
                assert!(
                    counts.iter().all(|count| *count < 4 * mean),
                    "{name}, bounded: {bounded}: {mean} terms"
                );
            }
        }
        let far = field(&cloud, true).cost(Vec2::splat(1e3), 1e-3);
        assert!(far.clusters == 1 && far.points == 0 && far.terms < 4, "{far:?}");
        let exact = field(&cloud, true).cost(Vec2::ZERO, 0.0);
        assert_eq!((exact.points, exact.terms, exact.clusters), (cloud.len(), 0, 0));
    }
}

#[test]
fn copies_of_a_point_at_the_query_leave_others_their_share_of_the_tolerance() {
    let round = circle(Vec2::ZERO, 1.0, 20_000);
    // So far away that it is a cluster of its own, beside that of the circle.
    let q = Vec2::splat(10.0);
    let heap = PlanarCloud::new(vec![q; 300], vec![Vec2::X; 300], vec![1e-6; 300]).unwrap();
    let cloud = joined(&[round, heap]);
    for bounded in [false, true] {
        for place in [q, q + 1e-12 * Vec2::Y] {
            let cost = field(&cloud, bounded).cost(place, 1e-3);
            assert!(cost.terms + cost.points < 800, "{cost:?}");
        }
    }
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let cloud = joined(&[chaos(20_000, 9), star(5000)]);
    let places = queries(&cloud, 10);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let field = field(&cloud, true);
            let values = field.evaluate(&places, 1e-3, &Silent).unwrap();
            let gradients = field.gradients(&places, 1e-2, &Silent).unwrap();
            let bits = gradients.iter().flat_map(|g| [g.x.to_bits(), g.y.to_bits()]);
            values.iter().map(|w| w.to_bits()).chain(bits).collect::<Vec<_>>()
        })
    };
    let one = run(1);
    for threads in [2, 3, 7] {
        assert!(run(threads) == one, "{threads} threads");
    }
    let field = field(&cloud, true);
    let singly: Vec<u64> = places.iter().map(|q| field.at(*q, 1e-3).to_bits()).collect();
    assert!(singly == one[..places.len()], "one by one");
}

#[test]
fn scaling_and_extreme_units_change_nothing() {
    let cloud = star(2000);
    let values = |scale: f64| -> Vec<f64> {
        let points = cloud.points().iter().map(|p| scale * *p).collect();
        let lengths = cloud.lengths().iter().map(|l| scale * l).collect();
        let scaled = PlanarCloud::new(points, cloud.normals().to_vec(), lengths).unwrap();
        let places: Vec<Vec2> = queries(&cloud, 12).iter().map(|q| scale * *q).collect();
        field(&scaled, true).evaluate(&places, 1e-4, &Silent).unwrap()
    };
    // Powers of two, so that coordinates round alike.
    let expected = values(1.0);
    for scale in [2.0_f64.powi(-200), 2.0_f64.powi(200)] {
        for (w, e) in values(scale).iter().zip(&expected) {
            assert!((w - e).abs() < 1e-12, "{w} for {e} at a scale of {scale}");
        }
    }
}

#[test]
fn no_points_and_no_lengths_have_no_field() {
    let empty = PlanarCloud::new(vec![], vec![], vec![]).unwrap();
    let nothing = {
        let cloud = chaos(100, 1);
        PlanarCloud::new(cloud.points().to_vec(), cloud.normals().to_vec(), vec![0.0; 100]).unwrap()
    };
    for cloud in [empty, nothing] {
        for bounded in [false, true] {
            let field = field(&cloud, bounded);
            for tolerance in [0.0, 1e-3, f64::INFINITY] {
                for q in [Vec2::ZERO, Vec2::new(1.5, 0.5)] {
                    assert_eq!((field.at(q, tolerance), field.gradient(q, tolerance)), (0.0, Vec2::ZERO));
                }
                assert!(field.at(Vec2::new(0.0, f64::INFINITY), tolerance).is_nan());
                assert!(field.gradient(Vec2::NAN, tolerance).is_nan());
            }
        }
    }
}

#[test]
fn tolerances_that_are_none_ask_for_the_direct_sum() {
    let field = field(&chaos(500, 2), true);
    let q = Vec2::new(1.0, 0.4);
    for tolerance in [-1.0, f64::NAN] {
        assert_eq!(field.at(q, tolerance).to_bits(), field.at(q, 0.0).to_bits());
        assert_eq!(field.cost(q, tolerance).points, 500);
    }
}

#[test]
fn errors_name_the_point() {
    let (p, n, l) = (vec![Vec2::ZERO, Vec2::ONE], vec![Vec2::X, 3.0 * Vec2::Y], vec![1.0, 0.0]);
    let made = PlanarCloud::new(p.clone(), n.clone(), l.clone()).unwrap();
    assert_eq!((made.normals()[1], made.len(), made.is_empty()), (Vec2::Y, 2, false));
    let error =
        |p: &[Vec2], n: &[Vec2], l: &[f64]| PlanarCloud::new(p.to_vec(), n.to_vec(), l.to_vec()).unwrap_err();
    let mismatch = |what, found| PlanarError::CountMismatch { what, found, points: 2 };
    assert_eq!(error(&p, &n[..1], &l), mismatch("normals", 1));
    assert_eq!(error(&p, &n, &[1.0; 3]), mismatch("lengths", 3));
    assert_eq!(
        error(&[Vec2::ZERO, Vec2::new(0.0, f64::NAN)], &n, &l),
        PlanarError::NonFinitePoint { point: 1 }
    );
    for normal in [Vec2::ZERO, Vec2::NAN, Vec2::new(f64::INFINITY, 0.0)] {
        assert_eq!(error(&p, &[normal, Vec2::X], &l), PlanarError::BadNormal { point: 0 });
    }
    for length in [-1.0, f64::INFINITY] {
        assert_eq!(error(&p, &n, &[1.0, length]), PlanarError::BadLength { point: 1, length });
    }
    assert!(error(&p, &n, &[f64::NAN, 1.0]).to_string().starts_with("the length of point 0 is NaN"));
}

#[test]
fn a_monitor_cancels() {
    let field = field(&circle(Vec2::ZERO, 1.0, 50), false);
    let stop = |_: f64, _: &str| false;
    let places = [Vec2::ZERO; 10];
    assert!(matches!(field.evaluate(&places, 1e-3, &stop), Err(FieldError::Cancelled(_))));
    assert!(matches!(field.gradients(&places, 1e-3, &stop), Err(FieldError::Cancelled(_))));
}
