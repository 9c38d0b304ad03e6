//! Inside tests at scattered points, every shortcut of them, against the sum by the definition.
mod common;

use common::*;
use fast_winding::data::{Lattice, Silent, TriangleSoup};
use fast_winding::math::{
    Aabb, Vec3, covers, distance_to_triangle, orient_yz, perturbed_side_of_plane, touches,
};
use fast_winding::winding::{FieldConfig, Scratch, WindingField, winding_of_soup};

fn field(soup: &TriangleSoup) -> WindingField {
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    field.prepare_points();
    field
}

fn moved(soup: &TriangleSoup, map: impl Fn(Vec3) -> Vec3) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| map(*p)).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

fn models() -> Vec<(&'static str, TriangleSoup)> {
    let ball = sphere(12);
    let ring = torus(1.0, 0.4, 30, 16);
    let overlapping = joined(&[ball.clone(), moved(&ball, |p| p + 0.4 * Vec3::X), flipped(&ring)]);
    let flat = moved(&ball, |p| p * Vec3::new(1.0, 1e-7, 1.0));
    let slivers = moved(&cube(1.0), |p| Vec3::new(p.x + p.y, p.y + 1e-9 * p.x, p.z + p.y));
    let one =
        TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, Vec3::new(0.2, 0.7, 0.9)], vec![[0, 1, 2]]).unwrap();
    // Each of its sides is above all columns of a row, so that columns are wider than cells.
    let prism = prism(400);
    vec![
        ("prism", prism.clone()),
        ("open prism", without(&prism, |t| t < 14 || t == 403)),
        ("ball", ball.clone()),
        ("ring", ring.clone()),
        ("overlapping", overlapping),
        ("flat", flat),
        ("slivers", slivers),
        ("cube", cube(1.0)),
        ("one triangle", one),
        ("open ball", without(&ball, |t| t < 20)),
        ("open ring", without(&ring, |t| (200..215).contains(&t) || t % 311 == 0)),
        ("open cube in a closed one", joined(&[cube(2.0), without(&subdivided_cube(), |t| t < 18)])),
    ]
}

/// A leaning cylinder along z of `n` sides, two triangles to each, then two to close it.
fn prism(n: usize) -> TriangleSoup {
    let corner = |k: usize, z: f64| {
        let angle = std::f64::consts::TAU * (k % n) as f64 / n as f64;
        Vec3::new(angle.cos() + 0.7 * z, angle.sin(), 2.0 * z)
    };
    let side = |k: usize| {
        let [a, b, c, d] = [corner(k, 0.0), corner(k + 1, 0.0), corner(k + 1, 1.0), corner(k, 1.0)];
        [[a, b, c], [a, c, d]]
    };
    let lid = |k: usize| {
        let (low, high) = (Vec3::ZERO, Vec3::new(0.7, 0.0, 2.0));
        [[low, corner(k + 1, 0.0), corner(k, 0.0)], [high, corner(k, 1.0), corner(k + 1, 1.0)]]
    };
    let faces: Vec<[Vec3; 3]> = (0..n).flat_map(side).chain((0..n).flat_map(lid)).collect();
    let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(faces.concat(), triangles).unwrap()
}

/// A cube of half size 1 with 3 · 3 squares on each side, the ones at x = −1 first.
fn subdivided_cube() -> TriangleSoup {
    let at = |k: usize| -1.0 + 2.0 * k as f64 / 3.0;
    let mut faces: Vec<[Vec3; 3]> = Vec::new();
    for side in 0..6 {
        let (axis, is_high) = (side / 2, side % 2 == 1);
        for k in 0..9 {
            let corner = |i: usize, j: usize| {
                let mut p = [if is_high { 1.0 } else { -1.0 }; 3];
                p[(axis + 1) % 3] = at(k % 3 + i);
                p[(axis + 2) % 3] = at(k / 3 + j);
                Vec3::from_array(p)
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            faces.extend(if is_high { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(faces.concat(), triangles).unwrap()
}

/// Points where a table of cells, a box or a ray could go wrong.
fn queries(soup: &TriangleSoup, count: usize) -> Vec<Vec3> {
    let Aabb { min, max } = soup.bounds();
    let size = max - min;
    let mut next = random(5);
    let mut queries = Vec::new();
    // On the sides of cells, whatever their number.
    for _ in 0..count {
        let cells = f64::from(1u32 << (2.0 + 6.0 * next()) as u32);
        let place = Vec3::new(next(), next(), next()) * cells;
        let on = Vec3::from_array(place.to_array().map(|c| if next() < 0.6 { c.round() } else { c }));
        queries.push(min + on / cells * size);
    }
    // On the bounds and a rounding error off them.
    for k in 0..count {
        let mut q = [next(), next(), next()];
        q.iter_mut().enumerate().for_each(|(axis, c)| *c = min[axis] + *c * size[axis]);
        let axis = k % 3;
        let side = if k % 2 == 0 { min[axis] } else { max[axis] };
        q[axis] = [side, side.next_up(), side.next_down()][k / 6 % 3];
        queries.push(Vec3::from_array(q));
    }
    // On vertices, edges and faces, in line with them along x, and a rounding error off.
    for _ in 0..count {
        let [a, b, c] = soup.corners((next() * soup.len() as f64) as usize);
        let (s, t) = (next(), next());
        let on =
            [a, 0.5 * (a + b), a + s * (b - a), (a + b + c) / 3.0, a + 0.5 * s * (b - a) + 0.5 * t * (c - a)];
        for p in on {
            queries.extend([
                p,
                p.with_x(min.x + next() * size.x),
                p.with_x(p.x.next_up()),
                p.with_y(p.y.next_down()),
            ]);
        }
    }
    for scale in [1.01, 1.5, 3.0, 1e3, 1e9, 1e100] {
        for k in 0..count / 8 {
            let direction = Vec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
            let along = if k % 2 == 0 { direction } else { direction * Vec3::new(1.0, 0.1, 0.1) };
            queries.push(soup.bounds().center() + scale * along * size.max_element());
        }
    }
    queries
}

/// The winding number of a closed soup: crossings of all triangles by the ray along −x, by exact predicates.
fn crossings(soup: &TriangleSoup, q: Vec3) -> f64 {
    let one = |t: usize| {
        let corners = soup.corners(t);
        let facing = orient_yz(corners[0], corners[1], corners[2]);
        let is_crossed = covers(q, corners) && perturbed_side_of_plane(q, corners) == facing;
        if is_crossed { -f64::from(facing) } else { 0.0 }
    };
    (0..soup.len()).map(one).sum()
}

/// Whether w ≥ `threshold` at a point, where that is known.
fn expected(soup: &TriangleSoup, q: Vec3, threshold: f64, is_closed: bool) -> Option<bool> {
    if (0..soup.len()).any(|t| touches(q, soup.corners(t))) {
        return None;
    }
    if is_closed {
        return Some(crossings(soup, q) >= threshold);
    }
    // A rounding error off a triangle the sum by the definition has lost all digits.
    let far = 1e-10 * soup.bounds().diagonal();
    let is_clear = (0..soup.len()).all(|t| distance_to_triangle(q, soup.corners(t)) > far);
    let w = winding_of_soup(soup, q);
    (is_clear && (w - threshold).abs() > 1e-6).then_some(w >= threshold)
}

#[test]
fn every_shortcut_agrees_with_the_definition() {
    for (name, soup) in models() {
        let field = field(&soup);
        let queries = queries(&soup, 40);
        let inside = field.contains(&queries, &Silent).unwrap();
        let is_closed = field.report().boundary_edges == 0;
        assert!(!name.starts_with("open") || field.report().caps > 0, "{name}");
        let mut compared = 0;
        for (q, inside) in queries.iter().zip(&inside) {
            if let Some(expected) = expected(&soup, *q, 0.5, is_closed) {
                assert_eq!(*inside, expected, "{name} at {q:?}");
                compared += 1;
            }
        }
        assert!(compared > 100, "{name}: {compared}");
    }
}

#[test]
fn one_point_a_batch_and_a_lattice_answer_alike() {
    for (name, soup) in models() {
        let field = field(&soup);
        let queries = queries(&soup, 40);
        let inside = field.contains(&queries, &Silent).unwrap();
        for (q, inside) in queries.iter().zip(&inside) {
            assert_eq!(field.contains_point(*q), *inside, "{name} at {q:?}");
        }
        for (counts, pad) in [([17, 17, 17], 0.0), ([9, 14, 11], 0.21)] {
            let bounds = soup.bounds().padded(pad * soup.bounds().diagonal());
            let spacing = bounds.size() / Vec3::from_array(counts.map(|n| (n - 1) as f64));
            let lattice = Lattice { origin: bounds.min, spacing, counts };
            let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
            let bits = field.classify_lattice(&lattice, 0.5, &Silent).unwrap();
            let inside = field.contains(&points, &Silent).unwrap();
            for (k, inside) in inside.iter().enumerate() {
                assert_eq!(bits[k / 8] >> (k % 8) & 1 == 1, *inside, "{name} at {:?}", points[k]);
            }
        }
    }
}

#[test]
fn other_thresholds_have_their_own_answers() {
    for (name, soup) in models() {
        let field = field(&soup);
        let is_closed = field.report().boundary_edges == 0;
        let mut scratch = Scratch::default();
        for q in queries(&soup, 12) {
            for threshold in [-1.5, -0.5, -0.01, 0.0, 0.01, 0.3, 0.7, 1.0, 1.5, 2.0, 1e3, -1e3] {
                if let Some(expected) = expected(&soup, q, threshold, is_closed) {
                    let answer = field.exceeds(q, threshold, &mut scratch);
                    assert_eq!(answer, expected, "{name}, {threshold} at {q:?}");
                }
            }
        }
        for q in
            [Vec3::NAN, Vec3::INFINITY, Vec3::new(0.1, f64::NEG_INFINITY, 0.1), Vec3::new(f64::NAN, 0.0, 0.0)]
        {
            for threshold in [-1.0, 0.0, 0.5] {
                assert!(!field.exceeds(q, threshold, &mut scratch), "{name}, {threshold} at {q:?}");
            }
        }
    }
}

/// Scaling by powers of two and moving by multiples of the last digit keep every answer.
#[test]
fn tiny_huge_and_far_soups_answer_as_they_do_at_home() {
    let rounded = |p: Vec3| (p * 1024.0).round() / 1024.0;
    for (name, soup) in models().into_iter().filter(|(name, _)| !["flat", "slivers"].contains(name)) {
        let soup = moved(&soup, rounded);
        let queries: Vec<Vec3> =
            queries(&soup, 40).into_iter().map(rounded).filter(|q| q.is_finite()).collect();
        let queries: Vec<Vec3> = queries.into_iter().filter(|q| q.abs().max_element() < 1e3).collect();
        let inside = field(&soup).contains(&queries, &Silent).unwrap();
        let far = 2f64.powi(41);
        let maps: [&dyn Fn(Vec3) -> Vec3; 4] =
            [&|p| p * 2f64.powi(-280), &|p| p * 2f64.powi(240), &|p| p + Vec3::splat(far), &|p| {
                p * 2f64.powi(-340)
            }];
        for (k, map) in maps.into_iter().enumerate() {
            let there: Vec<Vec3> = queries.iter().map(|q| map(*q)).collect();
            let answers = field(&moved(&soup, map)).contains(&there, &Silent).unwrap();
            for (i, q) in queries.iter().enumerate() {
                let is_on = (0..soup.len()).any(|t| touches(*q, soup.corners(t)));
                assert!(is_on || answers[i] == inside[i], "{name}, map {k} at {q:?}");
            }
        }
    }
}

#[test]
fn any_number_of_threads_gives_the_same_answers() {
    let soup = bunny();
    let bounds = soup.bounds();
    let mut next = random(3);
    let queries: Vec<Vec3> =
        (0..30_000).map(|_| bounds.min + Vec3::new(next(), next(), next()) * 1.1 * bounds.size()).collect();
    let ask = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| field(&soup).contains(&queries, &Silent).unwrap())
    };
    let one = ask(1);
    assert!(one == ask(2) && one == ask(8));
    for k in (0..queries.len()).step_by(97) {
        if let Some(expected) = expected(&soup, queries[k], 0.5, false) {
            assert_eq!(one[k], expected, "at {:?}", queries[k]);
        }
    }
}
