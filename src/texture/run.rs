//! All stages in one call; each result is kept, so that a stage can be done again without those before it.
use super::seams::seams_between_places;
use super::{
    Anchors, Atlas, AtlasConfig, AtlasError, Distortion, Mapping, MappingReport, Proxy, ProxyConfig,
    ProxyError, Refined, Seams, SoupLines, SoupLinesConfig, SoupLinesError, apart_by_chart, refined,
};
use crate::data::{Cancelled, Monitor, Parts, TriangleSoup, Warning};
use crate::winding::{FieldConfig, WindingField};
use serde::Serialize;
use std::sync::Arc;

/// How a soup gets its texture.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextureConfig {
    pub proxy: ProxyConfig,
    pub atlas: AtlasConfig,
    /// Lines that have no length of their own lead [`TextureConfig::REACH`] offsets away at least, in steps of a quarter of an offset
    /// at most.
    pub lines: SoupLinesConfig,
    /// Whether triangles are split first where they run through each other.
    pub refine: bool,
}

impl TextureConfig {
    pub const REACH: f64 = 4.0;

    /// # Errors
    /// If and only if a number is out of its range, whatever the soup.
    pub fn check(&self) -> Result<(), TextureError> {
        self.proxy.check()?;
        self.atlas.check()?;
        Ok(self.lines.check()?)
    }
}

/// Why a soup got no texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TextureError {
    #[error(transparent)]
    Proxy(#[from] ProxyError),
    #[error(transparent)]
    Atlas(#[from] AtlasError),
    #[error(transparent)]
    Lines(#[from] SoupLinesError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A textured soup and all that led to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// The soup that has the texture: the given one, or its parts if it was refined.
    pub soup: Arc<TriangleSoup>,
    /// The triangle that each is a part of; empty if it was not refined.
    pub sources: Vec<u32>,
    pub proxy: Arc<Proxy>,
    pub atlas: Atlas,
    pub lines: Arc<SoupLines>,
    pub anchors: Arc<Anchors>,
    pub mapping: Mapping,
    /// Warnings of refining.
    warnings: Vec<Warning>,
}

/// What came of all stages.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct TextureReport {
    /// Millimetres.
    pub offset: f64,
    pub proxy_triangles: usize,
    pub proxy_components: usize,
    pub charts: usize,
    /// Millimetres.
    pub seam_length: f64,
    /// Share of the texture that is used.
    pub coverage: f64,
    pub proxy_distortion: Distortion,
    /// Where the texture of the soup is cut.
    pub seams: Seams,
    pub lines: usize,
    pub mapping: MappingReport,
    /// Those of all stages.
    pub warnings: Vec<Warning>,
}

/// Gives a soup the texture of a proxy around it: proxy, atlas, charges, lines, mapping.
///
/// # Errors
/// If and only if a stage fails or the monitor cancels. Numbers that are out of range whatever the soup are refused before work begins.
pub fn texture(
    soup: Arc<TriangleSoup>,
    config: &TextureConfig,
    monitor: &dyn Monitor,
) -> Result<Texture, TextureError> {
    config.check()?;
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.1);
    let (soup, sources, warnings) = match config.refine {
        true => {
            let Refined { soup, sources, warnings } = refined(&soup, monitor)?;
            (Arc::new(soup), sources, warnings)
        }
        false => (soup, Vec::new(), Vec::new()),
    };
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    monitor.begin(0.1, 0.3);
    let proxy = Proxy::new(&field, &config.proxy, monitor)?;
    monitor.begin(0.3, 0.5);
    let atlas = Atlas::new(&proxy.mesh, &config.atlas, monitor)?;
    monitor.begin(0.5, 0.9);
    let lines = SoupLines::new(&soup, &reaching(&config.lines, &soup, proxy.offset), monitor)?;
    monitor.begin(0.9, 0.95);
    let anchors = Anchors::new(&lines, &proxy, monitor)?;
    monitor.begin(0.95, 1.0);
    let mapping = Mapping::new(&soup, &lines, &anchors, &proxy, &atlas, monitor)?;
    let (proxy, lines, anchors) = (proxy.into(), lines.into(), anchors.into());
    Ok(Texture { soup, sources, proxy, atlas, lines, anchors, mapping, warnings })
}

/// A tenth of the diagonal is what lines reach by themselves.
const OWN_REACH: f64 = 0.1;
const STEPS_OF_OFFSET: f64 = 4.0;
const MOST_STEPS: f64 = 400.0;

fn reaching(config: &SoupLinesConfig, soup: &TriangleSoup, offset: f64) -> SoupLinesConfig {
    let mut config = *config;
    if config.line.step.is_none() {
        let reach = (OWN_REACH * soup.bounds().diagonal()).max(TextureConfig::REACH * offset);
        let steps = (STEPS_OF_OFFSET * reach / offset).min(MOST_STEPS).ceil() as usize;
        config.line.steps = config.line.steps.max(steps);
        config.line.step = Some(reach / config.line.steps as f64);
    }
    config
}

impl Texture {
    /// The same soup with another proxy: its field and its lines stay, only their intersections are new (Schier et al. 2018, section
    /// 12.2). Lines that are too short for a larger offset are lost.
    ///
    /// # Errors
    /// If and only if a stage fails or the monitor cancels.
    pub fn with_proxy(
        &self,
        proxy: &ProxyConfig,
        atlas: &AtlasConfig,
        monitor: &dyn Monitor,
    ) -> Result<Texture, TextureError> {
        proxy.check()?;
        atlas.check()?;
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, 0.4);
        let field = WindingField::new(self.soup.clone(), FieldConfig::default());
        let proxy = Arc::new(Proxy::new(&field, proxy, monitor)?);
        monitor.begin(0.4, 0.8);
        let atlas = Atlas::new(&proxy.mesh, atlas, monitor)?;
        monitor.begin(0.8, 0.9);
        let anchors = Arc::new(Anchors::new(&self.lines, &proxy, monitor)?);
        monitor.begin(0.9, 1.0);
        self.with(proxy, anchors, atlas, monitor)
    }

    /// The same lines and proxy, which thus correspond as they did, with another atlas.
    ///
    /// # Errors
    /// If and only if a stage fails or the monitor cancels.
    pub fn with_atlas(&self, atlas: &AtlasConfig, monitor: &dyn Monitor) -> Result<Texture, TextureError> {
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, 0.9);
        let atlas = Atlas::new(&self.proxy.mesh, atlas, monitor)?;
        monitor.begin(0.9, 1.0);
        self.with(self.proxy.clone(), self.anchors.clone(), atlas, monitor)
    }

    fn with(
        &self,
        proxy: Arc<Proxy>,
        anchors: Arc<Anchors>,
        atlas: Atlas,
        monitor: &dyn Monitor,
    ) -> Result<Texture, TextureError> {
        let mapping = Mapping::new(&self.soup, &self.lines, &anchors, &proxy, &atlas, monitor)?;
        let Texture { soup, sources, lines, warnings, .. } = self;
        let (soup, sources, lines, warnings) =
            (soup.clone(), sources.clone(), lines.clone(), warnings.clone());
        Ok(Texture { soup, sources, proxy, atlas, lines, anchors, mapping, warnings })
    }

    /// Where the texture of the soup is cut.
    pub fn seams(&self) -> Seams {
        let uv = apart_by_chart(&self.mapping.uv, &self.mapping.charts);
        seams_between_places(&self.soup, &uv, self.atlas.scale, None)
    }

    pub fn report(&self) -> TextureReport {
        let all = [&self.warnings, &self.proxy.warnings, &self.mapping.report.warnings];
        TextureReport {
            offset: self.proxy.offset,
            proxy_triangles: self.proxy.mesh.triangles.len(),
            proxy_components: self.proxy.components,
            charts: self.atlas.chart_count,
            seam_length: self.atlas.seam_length,
            coverage: self.atlas.coverage,
            proxy_distortion: self.atlas.distortion,
            seams: self.seams(),
            lines: self.lines.lines.len(),
            mapping: self.mapping.report.clone(),
            warnings: all.into_iter().flatten().cloned().collect(),
        }
    }
}
