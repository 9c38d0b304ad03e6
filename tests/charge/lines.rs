//! Lines of the field.
use super::{as_is, lines_of, loose, plate, scaled, solve, sphere};
use fast_winding::charge::*;
use fast_winding::data::Silent;
use fast_winding::math::{Aabb, Vec3};
use std::f64::consts::PI;

/// Ends of lines are asked for together, and what is far is interpolated in cubes.
#[test]
fn steps_of_lines_follow_the_field_of_all_triangles() {
    let axes = Vec3::new(3.0, 2.0, 1.0);
    let field = solve(scaled(&sphere(4), axes, Vec3::ZERO), &as_is());
    let starts = field.soup().positions().to_vec();
    let normals: Vec<Vec3> = starts.iter().map(|p| *p / (axes * axes)).collect();
    let (integrator, step) = (Integrator::Euler, Some(0.01));
    let config = LineConfig { integrator, steps: 60, step, start_offset: Some(0.01), ..Default::default() };
    let lines = lines_of(&field, &starts, &normals, &config);
    let mut errors: Vec<f64> = Vec::new();
    for k in (0..lines.len()).step_by(17) {
        for ends in lines.line(k)[1..].windows(2).step_by(3) {
            let exact = field.direct(ends[0]).1.normalize();
            errors.push(((ends[1] - ends[0]) / 0.01).distance(exact));
        }
    }
    errors.sort_by(f64::total_cmp);
    let (median, largest) = (errors[errors.len() / 2], errors[errors.len() - 1]);
    assert!(median < 1e-3 && largest < 2e-2, "{median} {largest}");
}

#[test]
fn lines_of_a_sphere_are_radial_and_reach_another() {
    let field = solve(sphere(4), &as_is());
    let starts: Vec<Vec3> = (0..field.soup().len()).step_by(5).map(|t| field.soup().corners(t)[0]).collect();
    for integrator in [Integrator::Euler, Integrator::Midpoint] {
        let config = LineConfig { integrator, steps: 60, step: Some(0.01), ..Default::default() };
        let lines = lines_of(&field, &starts, &starts, &config);
        assert_eq!(lines.len(), starts.len());
        for (k, start) in starts.iter().enumerate() {
            let line = lines.line(k);
            assert_eq!((line[0], line.len()), (*start, 62));
            let turned = line.iter().map(|p| p.normalize().distance(*start)).fold(0.0, f64::max);
            assert!(turned < 0.01, "{start}: {turned}");
            assert!((line[61].length() - 1.601).abs() < 1e-3);
        }
        let around = scaled(&sphere(3), Vec3::splat(1.3), Vec3::ZERO);
        for (hit, start) in first_hits(&lines, &around).into_iter().zip(&starts) {
            let hit = hit.unwrap();
            assert!(hit.point.normalize().distance(*start) < 0.01, "{hit:?}");
            let place: Vec3 = (0..3).map(|k| hit.barycentric[k] * around.corners(hit.face as usize)[k]).sum();
            assert!(place.distance(hit.point) < 1e-12);
        }
    }
}

/// Lines from a great circle of an ellipsoid keep their order around it, and those from its other side stay apart from them.
#[test]
fn lines_do_not_cross() {
    let axes = Vec3::new(1.0, 0.5, 0.3);
    let field = solve(scaled(&sphere(4), axes, Vec3::ZERO), &as_is());
    let count = 200;
    let on = |k: usize| {
        let t = 2.0 * PI * k as f64 / count as f64;
        (axes * Vec3::new(t.cos(), t.sin(), 0.0), Vec3::new(t.cos(), t.sin(), 0.0) / axes)
    };
    let (starts, normals): (Vec<Vec3>, Vec<Vec3>) = (0..count).map(on).unzip();
    let config = LineConfig { steps: 100, step: Some(0.02), ..Default::default() };
    let lines = lines_of(&field, &starts, &normals, &config);
    let turn = |a: Vec3, b: Vec3| (a.x * b.y - a.y * b.x).atan2(a.x * b.x + a.y * b.y);
    for step in [2, 5, 10, 25, 50, 100] {
        let turns: Vec<f64> =
            (0..count).map(|k| turn(lines.line(k)[step], lines.line((k + 1) % count)[step])).collect();
        assert!(turns.iter().all(|t| *t > 0.0), "{step}: {turns:?}");
        assert!((turns.iter().sum::<f64>() - 2.0 * PI).abs() < 1e-9);
        // The plane of the circle is one of symmetry.
        assert!((0..count).all(|k| lines.line(k)[step].z.abs() < 0.02));
    }
}

#[test]
fn the_midpoint_method_is_of_second_order_and_eulers_of_first() {
    let axes = Vec3::new(1.0, 0.4, 0.7);
    // No clusters: where others are taken, the field of the tree is not smooth.
    let opening = Opening { beta: 1e3, near: 1e3 };
    let field = solve(scaled(&sphere(2), axes, Vec3::ZERO), &ChargeConfig { opening, ..as_is() });
    let starts: Vec<Vec3> = (0..40)
        .map(|k| {
            axes * Vec3::new(f64::from(k).sin(), (1.7 * f64::from(k)).cos(), (0.6 * f64::from(k)).sin())
                .normalize()
        })
        .collect();
    let normals: Vec<Vec3> = starts.iter().map(|p| *p / (axes * axes)).collect();
    let ends = |integrator: Integrator, steps: usize| -> Vec<Vec3> {
        let config = LineConfig {
            integrator,
            steps,
            step: Some(0.8 / steps as f64),
            start_offset: Some(0.3),
            ..Default::default()
        };
        let lines = lines_of(&field, &starts, &normals, &config);
        (0..40).map(|k| *lines.line(k).last().unwrap()).collect()
    };
    let best = ends(Integrator::Midpoint, 640);
    let error = |integrator: Integrator, steps: usize| -> f64 {
        ends(integrator, steps).iter().zip(&best).map(|(a, b)| a.distance(*b)).sum::<f64>() / 40.0
    };
    let euler = error(Integrator::Euler, 20) / error(Integrator::Euler, 80);
    let midpoint = error(Integrator::Midpoint, 20) / error(Integrator::Midpoint, 80);
    assert!((3.5..4.6).contains(&euler), "{euler}");
    assert!((13.0..20.0).contains(&midpoint), "{midpoint}");
}

#[test]
fn short_steps_follow_turns_and_lead_as_far() {
    let field = solve(plate(12), &as_is());
    let starts = [Vec3::new(0.97, 0.02, 0.0), Vec3::new(0.01, 0.02, 0.0)];
    let fixed = LineConfig { steps: 20, step: Some(0.05), ..Default::default() };
    let config = LineConfig { largest_turn: Some(0.05), ..fixed };
    let lines = lines_of(&field, &starts, &[Vec3::Z; 2], &config);
    let length = |line: &[Vec3]| line.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
    assert!(lines.line(0).len() > 22 && lines.line(1).len() < lines.line(0).len());
    (0..2).for_each(|k| assert!((length(lines.line(k)) - 1.005).abs() < 4e-3));
}

#[test]
fn lines_of_a_plate_stay_on_the_side_that_is_asked_for() {
    let field = solve(plate(16), &as_is());
    let starts: Vec<Vec3> = (0..100)
        .map(|k| 0.9 * Vec3::new((1.3 * f64::from(k)).sin(), (2.7 * f64::from(k)).cos(), 0.0))
        .collect();
    for side in [1.0, -1.0] {
        let lines = lines_of(&field, &starts, &[side * Vec3::Z; 100], &LineConfig::default());
        for k in 0..100 {
            let line = lines.line(k);
            assert!(line.windows(2).all(|w| side * (w[1].z - w[0].z) > 0.0), "{line:?}");
        }
    }
}

#[test]
fn lines_end_at_bounds_and_where_they_are_told() {
    let field = solve(sphere(2), &as_is());
    let bounds = Aabb { min: Vec3::splat(-1.25), max: Vec3::splat(1.25) };
    let config = LineConfig { steps: 1000, step: Some(0.01), bounds: Some(bounds), ..Default::default() };
    let lines = lines_of(&field, &[Vec3::X, Vec3::Z], &[Vec3::X, Vec3::Z], &config);
    assert!((0..2).all(|k| (1.25..1.2601).contains(&lines.line(k).last().unwrap().max_element())));
    let stop = |line: usize, from: Vec3, to: Vec3| line == 1 && from.z < 1.1 && to.z >= 1.1;
    let lines =
        trace_until(&field, &[Vec3::X, Vec3::Z], &[Vec3::X, Vec3::Z], &config, &stop, &Silent).unwrap();
    assert!(
        (1.1..1.1101).contains(&lines.line(1).last().unwrap().z) && lines.line(0).last().unwrap().x > 1.2
    );
}

/// Between concentric spheres of radii 1 and 2 with charges ±1 the field is 1/r², and beyond them 0. The spheres' potentials
/// are ±1 by the choice of the scale: V₁ = q + Q/2 = v, V₂ = (q + Q)/2 = −v, so that q = 4v, Q = −6v.
#[test]
fn the_dipole_field_leads_from_the_soup_to_what_is_around_it() {
    let (inner, outer) = (sphere(3), scaled(&sphere(3), Vec3::splat(2.0), Vec3::ZERO));
    let field = ElectricField::dipole(&inner, &outer, &as_is(), &Silent).unwrap();
    assert!(field.report().deviation < 1e-9);
    let charge: f64 = field.charges()[512..].iter().sum();
    assert!((charge + 1.5).abs() < 0.03, "{charge}");
    let starts: Vec<Vec3> = (0..60).map(|t| inner.corners(8 * t)[0]).collect();
    // Whatever part of a step is left before the surface around, where the field turns round.
    for step in [0.02, 0.0203, 0.0207, 0.0211] {
        let config = LineConfig { steps: 60, step: Some(step), ..Default::default() };
        let lines = lines_of(&field, &starts, &starts, &config);
        for (hit, start) in first_hits(&lines, &outer).iter().zip(&starts) {
            assert!(hit.is_some_and(|hit| hit.point.normalize().distance(*start) < 0.02), "{step}: {hit:?}");
        }
    }
    let at = 1.5 * Vec3::new(0.6, 0.0, 0.8);
    assert!((field.field(&[at])[0] * 2.25).distance(at / 1.5) < 0.02);
}

/// A pipe of 320 faces and 160 vertices, of wall thickness 0.1: no line from its inside leads through it, with exact integrals.
#[test]
fn lines_from_inside_a_pipe_leave_through_its_ends() {
    let (around, along) = (16, 4);
    let at = |k: usize, z: usize, r: f64| {
        let angle = 2.0 * PI * k as f64 / around as f64;
        Vec3::new(r * angle.cos(), r * angle.sin(), z as f64 - 0.5 * along as f64)
    };
    let mut cells = Vec::new();
    for k in 0..around {
        let next = k + 1;
        for z in 0..along {
            cells.push([at(k, z, 1.0), at(next, z, 1.0), at(next, z + 1, 1.0), at(k, z + 1, 1.0)]);
            cells.push([at(next, z, 0.9), at(k, z, 0.9), at(k, z + 1, 0.9), at(next, z + 1, 0.9)]);
        }
        cells.push([at(k, along, 0.9), at(k, along, 1.0), at(next, along, 1.0), at(next, along, 0.9)]);
        cells.push([at(k, 0, 1.0), at(k, 0, 0.9), at(next, 0, 0.9), at(next, 0, 1.0)]);
    }
    let pipe = loose(&cells.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect::<Vec<_>>());
    assert_eq!(pipe.len(), 320);
    let mut starts = Vec::new();
    let mut normals = Vec::new();
    for [a, b, c, _] in cells.iter().filter(|cell| cell.iter().all(|p| p.truncate().length() < 0.95)) {
        starts.push(a.midpoint(*c));
        normals.push((*b - *a).cross(*c - *a));
    }
    let config = LineConfig { steps: 400, step: Some(0.02), ..Default::default() };
    let field = solve(pipe, &ChargeConfig { tolerance: 1e-8, ..Default::default() });
    let lines = lines_of(&field, &starts, &normals, &config);
    // Without their starts, which are on the wall.
    let mut free = FieldLines::default();
    (0..lines.len()).for_each(|k| free.push(&lines.line(k)[1..]));
    let hits = first_hits(&free, field.soup());
    assert_eq!(hits.iter().filter(|hit| hit.is_some()).count(), 0);
    assert!((0..lines.len()).all(|k| lines.line(k).last().unwrap().z.abs() > 2.0));
}
