//! Proxies: closed, at their offset, in as many pieces as gaps leave.
use super::*;

#[test]
fn a_proxy_is_closed_and_lies_at_its_offset() {
    let soup = torus(2.0, 0.7, 40, 20);
    let proxy = proxy_of(soup.clone(), &at_offset(0.25));
    assert_eq!((proxy.components, topology(&proxy.mesh)), (1, (0, 0)));
    assert!(proxy.warnings.is_empty());
    for p in proxy.mesh.positions.iter().step_by(17) {
        let distance =
            (0..soup.len()).map(|t| distance_to_triangle(*p, soup.corners(t))).fold(f64::MAX, f64::min);
        assert!((distance - 0.25).abs() < 1e-3 * 0.25, "{distance}");
    }
    // The torus of radius 0.95 around the same circle, but for the chords.
    let expected = 2.0 * std::f64::consts::PI.powi(2) * 2.0 * 0.95f64.powi(2);
    assert!((proxy.mesh.volume() / expected - 1.0).abs() < 0.03);
}

#[test]
fn the_inner_side_of_a_proxy_is_kept_beside_it() {
    let both = ProxyConfig { sides: ProxySides::Both, ..at_offset(0.2) };
    let proxy = proxy_of(cube(1.0), &both);
    assert_eq!((topology(&proxy.mesh).0, topology(&proxy.inner).0), (2, 2));
    // It is a cube, inside out.
    assert!((proxy.inner.volume() + 1.6f64.powi(3)).abs() < 0.05, "{}", proxy.inner.volume());
    // A ball in the cavity of a shell: neither it nor the cavity's side is outer.
    let nested = joined(&[cube(2.0), common::flipped(&cube(1.5)), cube(0.4)]);
    let proxy = proxy_of(nested, &ProxyConfig { offset: Some(0.15), ..both });
    assert_eq!((proxy.components, topology(&proxy.mesh).0), (1, 2));
}

#[test]
fn gaps_wider_than_two_offsets_give_several_proxies_and_the_least_offset_bridges_them() {
    let parts = joined(&[cube(1.0), moved(&cube(1.0), Vec3::new(2.6, 0.0, 0.0))]);
    let apart = proxy_of(parts.clone(), &at_offset(0.2));
    assert_eq!(apart.components, 2);
    assert!(apart.warnings.iter().any(|w| w.kind == WarningKind::SeveralProxies && w.count == 2));
    assert!(apart.component.iter().all(|c| *c < 2) && apart.component.contains(&1));
    let told = std::cell::RefCell::new(Vec::new());
    let hear = |fraction: f64, _: &str| {
        told.borrow_mut().push(fraction);
        true
    };
    let least = smallest_single_offset(&field(parts.clone()), ProxySides::Outer, &hear).unwrap();
    let told = told.into_inner();
    assert!(told.is_sorted() && told.iter().all(|f| (0.0..=1.0).contains(f)), "{told:?}");
    assert!(told.iter().any(|f| (0.4..0.6).contains(f)), "{told:?}");
    // Half of the gap of 0.6, less half of a cell, an eighth of the offset.
    assert!(least > 0.3 / 1.125 / 1.04 && least < 0.3 * 1.05, "{least}");
    assert_eq!(proxy_of(parts.clone(), &at_offset(least)).components, 1);
    // Each part is textured by its own.
    let made = textured(parts, 0.2);
    assert_eq!((made.mapping.report.flipped, made.mapping.report.lost_lines), (0, 0));
    for (t, corners) in made.lines.starts.corners.iter().enumerate() {
        let component = made.proxy.component[made.anchors.of_starts[corners[0] as usize].face as usize];
        assert_eq!(component, u32::from(t >= 12));
    }
}
