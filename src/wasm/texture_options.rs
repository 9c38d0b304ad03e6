//! How a soup is to be textured, as JavaScript says it: each part of the options is read by itself.
use crate::charge::{Integrator, Solver};
use crate::texture::{AtlasConfig, ProxyConfig, ProxySides, SoupLinesConfig};
use serde::Deserialize;

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum SidesName {
    Outer,
    Both,
}

#[derive(Default, Deserialize)]
pub struct ProxyOptions {
    offset: Option<f64>,
    resolution: Option<usize>,
    sides: Option<SidesName>,
    smoothing: Option<usize>,
}

impl ProxyOptions {
    pub fn sides(&self) -> Option<ProxySides> {
        self.sides.map(|name| match name {
            SidesName::Outer => ProxySides::Outer,
            SidesName::Both => ProxySides::Both,
        })
    }

    /// `config` with what is given in place of its own.
    pub fn over(self, config: ProxyConfig) -> ProxyConfig {
        ProxyConfig {
            offset: self.offset.or(config.offset),
            samples: self.resolution.or(config.samples),
            sides: self.sides().unwrap_or(config.sides),
            smoothing: self.smoothing.unwrap_or(config.smoothing),
        }
    }
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct AtlasOptions {
    cone: Option<f64>,
    /// Chains of vertices.
    seams: Option<Vec<Vec<u32>>>,
    only_seams: Option<bool>,
    texels: Option<u32>,
    margin: Option<u32>,
    rounds: Option<usize>,
}

impl AtlasOptions {
    /// `config` with what is given in place of its own.
    pub fn over(self, config: AtlasConfig) -> AtlasConfig {
        let edges = |chains: Vec<Vec<u32>>| {
            chains.iter().flat_map(|chain| chain.windows(2).map(|ends| [ends[0], ends[1]])).collect()
        };
        AtlasConfig {
            cone_degrees: self.cone.unwrap_or(config.cone_degrees),
            seams: self.seams.map_or(config.seams, edges),
            only_seams: self.only_seams.unwrap_or(config.only_seams),
            texels: self.texels.unwrap_or(config.texels),
            margin: self.margin.unwrap_or(config.margin),
            rounds: self.rounds.unwrap_or(config.rounds),
        }
    }
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum SolverName {
    Krylov,
    RobinHood,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum IntegratorName {
    Euler,
    Midpoint,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct LinesOptions {
    solver: Option<SolverName>,
    tolerance: Option<f64>,
    integrator: Option<IntegratorName>,
    steps: Option<usize>,
    step: Option<f64>,
    start_offset: Option<f64>,
    /// In degrees.
    largest_turn: Option<f64>,
}

impl LinesOptions {
    pub fn config(&self) -> SoupLinesConfig {
        let mut config = SoupLinesConfig::default();
        let SoupLinesConfig { charge, line } = &mut config;
        charge.solver = match self.solver {
            None => charge.solver,
            Some(SolverName::Krylov) => Solver::Krylov,
            Some(SolverName::RobinHood) => Solver::RobinHood,
        };
        charge.tolerance = self.tolerance.unwrap_or(charge.tolerance);
        line.integrator = match self.integrator {
            None => line.integrator,
            Some(IntegratorName::Euler) => Integrator::Euler,
            Some(IntegratorName::Midpoint) => Integrator::Midpoint,
        };
        line.steps = self.steps.unwrap_or(line.steps);
        line.step = self.step;
        line.start_offset = self.start_offset;
        line.largest_turn = self.largest_turn.map(f64::to_radians);
        config
    }
}

#[derive(Default, Deserialize)]
pub struct RefineOptions {
    #[serde(default)]
    pub refine: bool,
}

/// Which lines are wanted.
#[derive(Default, Deserialize)]
pub struct ShownOptions {
    pub count: Option<usize>,
}

/// Names of the files.
#[derive(Default, Deserialize)]
pub struct ExportOptions {
    pub name: Option<String>,
    pub image: Option<String>,
}
