//! The exact field of soups and its classifications against the sum by the definition, where that is hardest.
mod common;

use common::*;
use fast_winding::data::{Lattice, Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3, touches};
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::winding::{Accuracy, FieldConfig, WindingField, winding_of_soup};
use proptest::prelude::*;

fn field(soup: &TriangleSoup) -> WindingField {
    WindingField::new(soup.clone(), FieldConfig::default())
}

/// A box of which the face at x = −1 is missing, subdivided so that it is capped and not loose.
fn open_box(n: usize) -> TriangleSoup {
    let at = |k: usize| -1.0 + 2.0 * k as f64 / n as f64;
    let mut faces = Vec::new();
    for (axis, sign) in [(0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)] {
        for k in 0..n * n {
            let corner = |i: usize, j: usize| {
                let mut p = [0.0; 3];
                p[axis] = sign;
                p[(axis + 1) % 3] = at(k % n + i);
                p[(axis + 2) % 3] = at(k / n + j);
                Vec3::from_array(p)
            };
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            faces.extend(if sign > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    loose(&faces)
}

fn loose(faces: &[[Vec3; 3]]) -> TriangleSoup {
    let triangles = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(faces.concat(), triangles).unwrap()
}

/// What DESIGN.md asks of a point on the surface, by brute force: w close by, in many directions.
fn is_inside_nearby(soup: &TriangleSoup, q: Vec3, size: f64) -> bool {
    let mut next = random(11);
    (0..400).any(|_| {
        let d = Vec3::new(next() - 0.5, next() - 0.5, next() - 0.5).normalize_or_zero();
        winding_of_soup(soup, q + 1e-7 * size * d) >= 0.5
    })
}

/// Compares values and inside tests with the sum by the definition.
fn check(soup: &TriangleSoup, queries: &[Vec3], tolerance: f64) {
    check_with(soup, queries, tolerance, |q| winding_of_soup(soup, q));
}

/// Compares values with an oracle, which may know better than the sum by the definition.
fn check_with(soup: &TriangleSoup, queries: &[Vec3], tolerance: f64, oracle: impl Fn(Vec3) -> f64) {
    let field = field(soup);
    let exact = field.evaluate(queries, Accuracy::EXACT, &Silent).unwrap();
    let fast = field.evaluate(queries, Accuracy::Tolerance(1e-3), &Silent).unwrap();
    let inside = field.contains(queries, &Silent).unwrap();
    for (k, q) in queries.iter().enumerate() {
        let is_on = (0..soup.len()).any(|t| touches(*q, soup.corners(t)));
        let w = oracle(*q);
        assert!((exact[k] - w).abs() <= tolerance, "exact: {} instead of {w} at {q:?}", exact[k]);
        assert!((fast[k] - w).abs() <= 1e-3 + tolerance, "fast: {} instead of {w} at {q:?}", fast[k]);
        if is_on {
            let size = soup.bounds().diagonal();
            assert_eq!(inside[k], is_inside_nearby(soup, *q, size), "on the surface at {q:?}, w = {w}");
        } else if (w - 0.5).abs() > 1e-9 {
            assert_eq!(inside[k], w >= 0.5, "{w} at {q:?}");
        }
    }
}

#[test]
fn queries_on_and_next_to_vertices_edges_and_faces() {
    for soup in [cube(1.0), open_box(6), joined(&[cube(1.0), flipped(&cube(0.5))])] {
        let mut queries = Vec::new();
        for t in 0..soup.len().min(24) {
            let [a, b, c] = soup.corners(t);
            let normal = (b - a).cross(c - a).normalize();
            for p in [a, 0.5 * (a + b), 0.25 * a + 0.75 * c, (a + b + c) / 3.0, a + 2.0 * (a - b)] {
                queries.push(p);
                for exponent in [3, 6, 9, 12] {
                    let step = 10f64.powi(-exponent);
                    queries.extend([
                        p + step * normal,
                        p - step * normal,
                        p + step * (p - soup.bounds().center()),
                    ]);
                }
            }
        }
        // Next to an edge of the opening the sum itself has lost digits.
        let on_rim = |q: &Vec3| (q.x + 1.0).abs() < 1e-2 && soup.len() > 30;
        queries.retain(|q| !on_rim(q));
        // Within 1e-9 of an edge the sum over all triangles has lost its last digits: the box is closed less its face.
        let face = [Vec3::new(-1.0, -1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, 1.0)];
        let face = loose(&[face, [face[0], face[2], Vec3::new(-1.0, 1.0, -1.0)]]);
        let is_in = |q: Vec3, half: f64| {
            let on = q.abs().to_array().iter().filter(|c| **c == half).count() as i32;
            if q.abs().max_element() <= half { 0.5f64.powi(on) } else { 0.0 }
        };
        let oracle = |q: Vec3| match soup.len() {
            12 => is_in(q, 1.0),
            24 => is_in(q, 1.0) - is_in(q, 0.5),
            _ => is_in(q, 1.0) - winding_of_soup(&face, q),
        };
        check_with(&soup, &queries, 1e-12, oracle);
    }
}

#[test]
fn the_plane_of_a_cap_is_like_any_other_place() {
    let soup = open_box(6);
    let report = field(&soup).report().clone();
    assert_eq!((report.boundary_edges, report.caps, report.loose_components), (24, 22, 0));
    let mut queries = Vec::new();
    for (y, z) in
        [(0.0, 0.0), (0.31, -0.47), (1.0 / 3.0, 1.0 / 3.0), (-2.0 / 3.0, 0.1), (0.5, 0.5), (1.7, 0.3)]
    {
        for step in [0.0, 1e-3, -1e-3, 1e-6, -1e-6, 1e-9, -1e-9, 1e-12, -1e-12] {
            queries.push(Vec3::new(-1.0 + step, y, z));
        }
    }
    check(&soup, &queries, 1e-12);
}

#[test]
fn an_open_box_on_the_planes_of_a_lattice() {
    let soup = open_box(6);
    let lattice = Lattice { origin: Vec3::splat(-1.5), spacing: Vec3::splat(0.25), counts: [13, 13, 13] };
    let field = field(&soup);
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let contains = field.contains(&points, &Silent).unwrap();
    let values = field.evaluate_lattice(&lattice, Accuracy::EXACT, &Silent).unwrap().values;
    for (index, q) in points.iter().enumerate() {
        assert_eq!(voxels.get(lattice.sample(index)), contains[index], "{q}");
        let on_rim = (q.x + 1.0).abs() < 1e-9 && q.y.abs().max(q.z.abs()) == 1.0;
        let w = winding_of_soup(&soup, *q);
        assert!(on_rim || (values[index] - w).abs() < 1e-12, "{} instead of {w} at {q}", values[index]);
        if q.abs().max_element() < 1.0 {
            assert!(contains[index], "{q}");
        }
        if q.abs().max_element() > 1.3 {
            assert!(!contains[index], "{q}");
        }
    }
}

#[test]
fn far_from_the_origin_with_small_features() {
    let offset = Vec3::new(1e6, -1e6, 1e6);
    for soup in [torus(1e-3, 4e-4, 40, 16), without(&torus(1e-3, 4e-4, 40, 16), |t| t % 200 == 3)] {
        let moved: Vec<Vec3> = soup.positions().iter().map(|p| *p + offset).collect();
        let soup = TriangleSoup::new(moved, soup.triangles().to_vec()).unwrap();
        check(&soup, &scattered(soup.bounds(), 400, 3), 1e-6);
    }
}

#[test]
fn degenerate_soups() {
    let flat = [Vec3::ZERO, Vec3::X, 2.0 * Vec3::X];
    let tetrahedron = |o: Vec3| {
        let [x, y, z] = [o + Vec3::X, o + Vec3::Y, o + Vec3::Z];
        [[o, y, x], [o, x, z], [o, z, y], [x, y, z]]
    };
    let doubled = [tetrahedron(Vec3::ZERO), tetrahedron(Vec3::ZERO)].concat();
    let cancelled: Vec<[Vec3; 3]> =
        tetrahedron(Vec3::ZERO).into_iter().flat_map(|[a, b, c]| [[a, b, c], [a, c, b]]).collect();
    // A T-junction: one long edge against two short ones.
    let [a, b, c, d] = [Vec3::ZERO, 2.0 * Vec3::X, 2.0 * Vec3::Y, 2.0 * Vec3::Z];
    let junction = [[a, c, b], [a, b, d], [a, d, c], [b, c, 0.5 * (b + d)], [0.5 * (b + d), c, d]];
    let sliver = [[Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1e-13, 0.0)]];
    let mut soups = vec![loose(&[]), loose(&[flat]), loose(&doubled), loose(&cancelled), loose(&junction)];
    soups.extend([
        loose(&sliver),
        loose(&[[Vec3::ZERO, Vec3::X, Vec3::Y]]),
        loose(&[flat, flat, [Vec3::ONE; 3]]),
    ]);
    for soup in soups {
        let around = Aabb { min: Vec3::splat(-0.7), max: Vec3::splat(2.3) };
        check(&soup, &scattered(around, 300, 9), 1e-12);
    }
}

#[test]
fn a_million_disjoint_triangles_are_loose_and_answered() {
    let mut next = random(7);
    let faces: Vec<[Vec3; 3]> = (0..1_000_000)
        .map(|_| {
            let p = 100.0 * Vec3::new(next(), next(), next());
            [p, p + Vec3::X * next(), p + Vec3::Y * next()]
        })
        .collect();
    let soup = loose(&faces);
    let field = field(&soup);
    assert_eq!((field.report().loose_components, field.report().caps), (1_000_000, 0));
    for q in scattered(soup.bounds(), 3, 2) {
        let w = winding_of_soup(&soup, q);
        assert!((field.at(q, Accuracy::EXACT) - w).abs() < 1e-10);
        assert!((field.at(q, Accuracy::Tolerance(1e-2)) - w).abs() < 1e-2);
    }
}

#[test]
fn scattered_points_and_lattices_agree_on_the_bunny() {
    let bunny = bunny();
    let field = field(&bunny);
    assert_eq!(field.report().boundary_edges, 223);
    let lattice = Lattice::with_counts(field.bounds(), [40; 3]).unwrap();
    let points: Vec<Vec3> = (0..lattice.len()).map(|i| lattice.point(lattice.sample(i))).collect();
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    let contains = field.contains(&points, &Silent).unwrap();
    assert_eq!(voxels.to_bytes().unwrap(), contains.iter().map(|i| u8::from(*i)).collect::<Vec<u8>>());
    let exact = field.evaluate_lattice(&lattice, Accuracy::EXACT, &Silent).unwrap().values;
    for (w, inside) in exact.iter().zip(contains) {
        assert!((w - 0.5).abs() < 1e-9 || inside == (*w >= 0.5), "{w}");
    }
    for k in (0..points.len()).step_by(331) {
        let w = winding_of_soup(&bunny, points[k]);
        assert!((exact[k] - w).abs() < 1e-12, "{} instead of {w}", exact[k]);
    }
    assert!(field.refined() < 2 * points.len() / 10, "{} points were summed singly", field.refined());
}

/// Closed pieces, torn, flipped, doubled and overlapping.
fn torn() -> impl Strategy<Value = TriangleSoup> {
    (1..4usize, prop::collection::vec((0..4usize, any::<u32>()), 0..12), any::<u64>()).prop_map(
        |(parts, damages, seed)| {
            let mut next = random(seed);
            let mut place = || 0.8 * Vec3::new(next() - 0.5, next() - 0.5, next() - 0.5);
            let pieces: Vec<TriangleSoup> = (0..parts)
                .map(|k| {
                    let piece = if k % 2 == 0 { torus(1.0, 0.4, 14, 9) } else { sphere(4) };
                    let by = place();
                    let moved = piece.positions().iter().map(|p| *p + by).collect();
                    TriangleSoup::new(moved, piece.triangles().to_vec()).unwrap()
                })
                .collect();
            let whole = joined(&pieces);
            let mut triangles = whole.triangles().to_vec();
            for (damage, at) in damages {
                let at = at as usize % triangles.len();
                match damage {
                    0 => drop(triangles.swap_remove(at)),
                    1 => triangles[at].swap(0, 1),
                    2 => triangles.push(triangles[at]),
                    _ => triangles[at][0] = triangles[(at + 1) % triangles.len()][2],
                }
            }
            TriangleSoup::new(whole.positions().to_vec(), triangles).unwrap()
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn every_way_of_asking_agrees_with_the_definition(soup in torn(), seed in any::<u64>()) {
        let queries = scattered(soup.bounds().padded(0.2), 120, seed);
        check(&soup, &queries, 1e-11);
        let field = field(&soup);
        let lattice = Lattice::with_counts(soup.bounds().padded(0.1), [13, 11, 9]).unwrap();
        let values = field.evaluate_lattice(&lattice, Accuracy::EXACT, &Silent).unwrap().values;
        let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
        for (index, value) in values.iter().enumerate() {
            let w = winding_of_soup(&soup, lattice.point(lattice.sample(index)));
            prop_assert!((value - w).abs() < 1e-11, "{} instead of {}", value, w);
            if (w - 0.5).abs() > 1e-9 {
                prop_assert_eq!(voxels.get(lattice.sample(index)), w >= 0.5);
            }
        }
    }
}
