//! The methods that the paper compares itself with: the exact hierarchy of 2013 against the direct sum, and ray parity
//! where it is right and where it is wrong.
mod common;

use common::*;
use fast_winding::data::{Silent, TriangleSoup};
use fast_winding::math::{Aabb, Vec3};
use fast_winding::winding::{ExactHierarchy, RayParity, Rays, winding_of_soup};
use proptest::prelude::*;

const MAJORITY: Rays = Rays::Majority { count: 5, seed: 7 };

fn assert_exact(soup: &TriangleSoup, queries: &[Vec3]) {
    let hierarchy = ExactHierarchy::new(soup);
    let values = hierarchy.evaluate(queries, &Silent).unwrap();
    for (q, value) in queries.iter().zip(values) {
        let expected = winding_of_soup(soup, *q);
        assert!((value - expected).abs() < 1e-10, "{value} instead of {expected} at {q}");
        assert_eq!(value.to_bits(), hierarchy.at(*q).to_bits());
    }
}

#[test]
fn hierarchy_is_exact_on_damaged_and_overlapping_soups() {
    for seed in 0..4 {
        let torus = damaged(&torus(1.0, 0.4, 60, 30), seed);
        let flipped_sphere = flipped(&damaged(&sphere(14), seed + 10));
        let soup = joined(&[torus.clone(), flipped_sphere, cube(0.7), torus]);
        assert_exact(&soup, &scattered(soup.bounds().padded(0.4), 300, seed));
    }
}

#[test]
fn hierarchy_is_exact_on_the_bunny_and_below_thrice_its_size() {
    let bunny = bunny();
    assert_exact(&bunny, &scattered(bunny.bounds().padded(0.01), 60, 3));
    let bytes_of_triangles = bunny.len() * size_of::<[Vec3; 3]>();
    let bytes = ExactHierarchy::new(&bunny).bytes();
    assert!(bytes < 3 * bytes_of_triangles, "{bytes} for {bytes_of_triangles}");
}

#[test]
fn hierarchy_is_exact_next_to_the_faces_of_its_boxes() {
    // An open box whose rim lies in the face of its bounding box, in pieces of one leaf and of many.
    let fine = |n: usize| {
        let at = |i: usize, j: usize| (i * (n + 1) + j) as u32;
        let quad = |k: usize| {
            let (i, j) = (k / n, k % n);
            [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
        };
        let step = |i: usize| i as f64 / n as f64;
        let positions = (0..=n).flat_map(|i| (0..=n).map(move |j| Vec3::new(step(i), step(j), 0.0)));
        TriangleSoup::new(positions.collect(), (0..n * n).flat_map(quad).collect()).unwrap()
    };
    let open = without(&cube(0.5), |t| t < 2);
    for soup in [fine(3), fine(24), joined(&[open, fine(16)])] {
        let mut next = random(11);
        let queries: Vec<Vec3> = scattered(soup.bounds().padded(0.1), 400, 12)
            .into_iter()
            .map(|q| {
                // One coordinate onto a plane of the model, or a rounding beside it.
                let axis = (3.0 * next()) as usize;
                let mut q = q;
                q[axis] = [-0.5, 0.0, 0.5, 1.0][(4.0 * next()) as usize]
                    + [0.0, 1e-16, -1e-12, 1e-9][(4.0 * next()) as usize];
                q
            })
            .collect();
        assert_exact(&soup, &queries);
    }
}

#[test]
fn hierarchy_takes_empty_and_degenerate_soups() {
    let point = TriangleSoup::new(vec![Vec3::ONE; 3], vec![[0, 1, 2]; 250]).unwrap();
    let needles = (0..300).map(|i| f64::from(i) * Vec3::ONE).collect();
    let needles = TriangleSoup::new(needles, (0..298).map(|i| [i, i + 1, i + 2]).collect()).unwrap();
    for soup in [TriangleSoup::default(), point, needles] {
        let hierarchy = ExactHierarchy::new(&soup);
        for q in [Vec3::ZERO, Vec3::ONE, Vec3::new(3.0, 2.0, 1.0), Vec3::splat(1e9)] {
            assert!(hierarchy.at(q).abs() < 1e-12, "{}", hierarchy.at(q));
        }
        assert!(hierarchy.at(Vec3::NAN).is_nan() && hierarchy.at(Vec3::INFINITY).is_nan());
    }
    assert!(ExactHierarchy::new(&sphere(40)).at(Vec3::splat(4.0)) == 0.0, "a closed mesh has no stand-in");
}

/// Triangles between few places, so that edges, faces and points coincide in every way.
fn crowded_soup() -> impl Strategy<Value = TriangleSoup> {
    let place = prop::array::uniform3(0..4i32).prop_map(|p| Vec3::from_array(p.map(f64::from)));
    let corners = prop::collection::vec(prop::array::uniform3(place), 0..700);
    corners.prop_map(|corners| {
        let triangles = (0..corners.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        TriangleSoup::new(corners.concat(), triangles).unwrap()
    })
}

/// A patch of a closed surface, cut out, flipped and doubled by lot, where stand-ins are much smaller than their boxes.
fn damaged_patch() -> impl Strategy<Value = TriangleSoup> {
    (any::<u64>(), 8..40usize, 6..30usize).prop_map(|(seed, nu, nv)| {
        let whole = torus(1.0, 0.4, nu, nv);
        let half = without(&whole, |t| t > whole.len() / 2);
        let hurt = damaged(&half, seed);
        joined(&[half, hurt])
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn hierarchy_equals_the_direct_sum(soup in prop_oneof![crowded_soup(), damaged_patch()], seed in any::<u64>()) {
        assert_exact(&soup, &scattered(Aabb { min: Vec3::splat(-1.7), max: Vec3::splat(4.6) }, 40, seed));
    }
}

#[test]
fn parity_is_right_off_closed_surfaces() {
    for soup in [torus(1.0, 0.4, 60, 24), sphere(12), cube(1.0), flipped(&cube(1.0))] {
        let queries = scattered(soup.bounds().padded(0.3), 500, 2);
        for rays in [Rays::Axis, MAJORITY] {
            let inside = RayParity::new(&soup, rays).contains_all(&queries, &Silent).unwrap();
            for (q, inside) in queries.iter().zip(inside) {
                assert_eq!(inside, winding_of_soup(&soup, *q).abs() > 0.5, "{rays:?} at {q}");
            }
        }
    }
}

#[test]
fn rays_through_edges_and_vertices_are_counted_once() {
    // From the middle along x the ray meets a diagonal; from elsewhere on a lattice edges, vertices and whole faces.
    let soup = joined(&[cube(1.0), cuboid(Aabb { min: Vec3::splat(3.0), max: Vec3::splat(5.0) })]);
    let parity = RayParity::new(&soup, Rays::Axis);
    let places = [-2.0, -0.5, 0.0, 0.5, 1.5, 4.0, 6.0];
    for (x, y, z) in places.iter().flat_map(|x| places.iter().flat_map(move |y| places.map(|z| (*x, *y, z))))
    {
        let q = Vec3::new(x, y, z);
        let expected = q.abs().max_element() < 1.0 || (q - 4.0).abs().max_element() < 1.0;
        assert_eq!(parity.contains(q), expected, "{q}");
    }
    let octahedron = RayParity::new(&sphere(1), Rays::Axis);
    assert!(octahedron.contains(Vec3::ZERO) && octahedron.contains(Vec3::new(-0.5, 0.0, 0.0)));
    assert!(
        !octahedron.contains(Vec3::new(-2.0, 0.0, 0.0)) && !octahedron.contains(Vec3::new(-2.0, 0.3, 0.0))
    );
}

#[test]
fn parity_is_wrong_behind_holes_and_in_overlaps() {
    let open = without(&cube(1.0), |t| (2..4).contains(&t)); // no face at +x
    let q = Vec3::new(-0.9, 0.2, 0.1);
    assert!(winding_of_soup(&open, q) > 0.9);
    assert!(!RayParity::new(&open, Rays::Axis).contains(q), "the ray leaves through the hole");
    assert!(RayParity::new(&open, Rays::Majority { count: 15, seed: 1 }).contains(q), "most rays do not");
    let twice = joined(&[cube(1.0), cube(1.0)]);
    for rays in [Rays::Axis, MAJORITY] {
        assert!(!RayParity::new(&twice, rays).contains(q), "two crossings are even");
    }
}

#[test]
fn parity_is_the_same_every_time_and_takes_anything() {
    let soup = damaged(&torus(1.0, 0.4, 30, 14), 5);
    let queries = scattered(soup.bounds(), 300, 6);
    let answers = || RayParity::new(&soup, MAJORITY).contains_all(&queries, &Silent).unwrap();
    assert_eq!(answers(), answers());
    let other = RayParity::new(&soup, Rays::Majority { count: 5, seed: 8 }).contains_all(&queries, &Silent);
    assert_ne!(answers(), other.unwrap());
    for rays in [Rays::Axis, MAJORITY, Rays::Majority { count: 0, seed: 0 }] {
        assert!(!RayParity::new(&TriangleSoup::default(), rays).contains(Vec3::ZERO));
        let parity = RayParity::new(&cube(1.0), rays);
        assert!(!parity.contains(Vec3::NAN) && !parity.contains(Vec3::INFINITY));
    }
}
