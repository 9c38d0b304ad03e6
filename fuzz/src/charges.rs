//! Charged soups, field lines and textures.
use super::facts::Watch;
use super::shapes::Made;
use super::source::Source;
use fast_winding::charge::{
    ChargeConfig, ElectricField, Integration, Integrator, LineConfig, Refinement, Solver, trace,
};
use fast_winding::data::Silent;
use fast_winding::math::Vec3;
use fast_winding::texture::{AtlasConfig, ProxyConfig, ProxySides, SoupLinesConfig, TextureConfig, texture};
use std::sync::Arc;

fn charge_config(source: &mut Source) -> ChargeConfig {
    ChargeConfig {
        solver: source.pick(&[Solver::Krylov, Solver::RobinHood]),
        tolerance: source.setting(&[1e-6, 1e-3]),
        most_steps: source.below(200),
        integration: source.pick(&[Integration::Exact, Integration::Quadrature]),
        refinement: source.flag().then(|| Refinement {
            least_parts: source.below(100),
            most_parts: 200,
            ..Refinement::default()
        }),
        total: source.setting(&[1.0, -2.0]),
        ..ChargeConfig::default()
    }
}

fn line_config(source: &mut Source) -> LineConfig {
    LineConfig {
        integrator: source.pick(&[Integrator::Euler, Integrator::Midpoint]),
        steps: source.below(12),
        step: source.option(&[0.1, 0.5]),
        start_offset: source.option(&[0.01]),
        largest_turn: source.option(&[0.3, 0.05]),
        bounds: None,
    }
}

pub fn fields(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: soup, is_tame } = source.soup();
    let config = charge_config(&mut source);
    let made = ElectricField::solve(Arc::new(soup), &config, &Watch::new(source.byte()));
    let Ok(field) = made else { return };
    let bounds = field.soup().bounds();
    let queries = source.queries(bounds, 6);
    let values = field.potential(&queries);
    let vectors = field.field(&queries);
    let is_moderate = (1e-100..1e100).contains(&config.total.abs());
    if is_tame && is_moderate {
        let total: f64 = field.charges().iter().sum();
        // Charges of nearly the same triangles may be far larger, of both signs.
        let sizes: f64 = field.charges().iter().map(|charge| charge.abs()).sum();
        assert!(
            (total - config.total).abs() <= 1e-12 * sizes,
            "charges of {sizes} without signs add up to {total}, {config:?}"
        );
        assert!(
            values.iter().all(|v| v.is_finite()) && vectors.iter().all(|v| v.is_finite()),
            "a field that is none"
        );
    }
    let starts: Vec<Vec3> = queries.iter().copied().filter(|q| q.is_finite()).collect();
    let directions = vec![Vec3::Z; starts.len()];
    let line = line_config(&mut source);
    let Ok(lines) = trace(&field, &starts, &directions, &line, &Watch::new(source.byte())) else { return };
    assert_eq!(lines.len(), starts.len(), "a line for each start");
    assert!(!is_tame || lines.points.iter().all(|p| p.is_finite()), "a line leads nowhere");
}

pub fn textures(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let Made { shape: soup, is_tame } = source.soup();
    let size = soup.bounds().size().max_element();
    let config = TextureConfig {
        proxy: ProxyConfig {
            offset: source.flag().then(|| size * source.setting(&[0.1, 0.3, 1.0])),
            samples: Some(source.below(10)),
            sides: source.pick(&[ProxySides::Outer, ProxySides::Both]),
            smoothing: source.below(3),
        },
        atlas: AtlasConfig {
            cone_degrees: source.setting(&[60.0, 30.0]),
            seams: (0..source.below(4))
                .map(|_| [u32::from(source.byte()), u32::from(source.byte())])
                .collect(),
            only_seams: source.flag(),
            texels: source.pick(&[256, 16, 1024, 0]),
            margin: source.pick(&[2, 0, 8]),
            rounds: source.below(3),
        },
        lines: SoupLinesConfig { charge: charge_config(&mut source), line: line_config(&mut source) },
        refine: source.flag(),
    };
    let made = texture(Arc::new(soup), &config, &Watch::new(source.byte()));
    let Ok(texture) = made else { return };
    texture.report();
    assert!(!is_tame || texture.atlas.uv.iter().all(|uv| uv.is_finite()), "a texture coordinate is none");
    texture.lines_to_proxy(Some(3));
    texture.with_atlas(&AtlasConfig::default(), &Silent).ok();
}
