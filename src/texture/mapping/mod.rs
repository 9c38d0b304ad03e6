//! From the points of a proxy that a soup's corners correspond to, to their texture coordinates.
mod affected;
mod charts;
mod correct;
mod lay;

pub use affected::Affected;

use super::distortion::distortion;
use super::{Anchors, Atlas, Distortion, Proxy, SoupLines};
use crate::data::{Cancelled, Monitor, Parts, TriangleSoup, Warning, WarningKind};
use crate::math::{Vec2, Vec3};
use charts::Charts;
use correct::all_placed;
use serde::Serialize;

/// The texture of a soup.
#[derive(Clone, Debug, PartialEq)]
pub struct Mapping {
    /// Of the corners of each triangle, from 0 to 1, v upward.
    pub uv: Vec<[Vec2; 3]>,
    /// The chart that each triangle is in.
    pub charts: Vec<u32>,
    pub affected: Affected,
    pub report: MappingReport,
}

/// What became of the triangles of a soup: how many there are of each kind of [`Affected`].
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MappingReport {
    pub triangles: usize,
    /// Triangles whose corners meet different charts.
    pub across_charts: usize,
    /// Of those, triangles put into one chart by the closest points of it.
    pub moved: usize,
    /// Triangles that were flipped, or flat, before anything was moved: those within one chart.
    pub folded: usize,
    /// Triangles that were squashed or torn before anything was moved: those within one chart.
    pub squashed: usize,
    /// Triangles that would be flipped, squashed or torn even so, and were laid into a chart as they are in space; they may reach beyond
    /// it, but not beyond the texture.
    pub unfolded: usize,
    /// Triangles that are flipped at last, or flat.
    pub flipped: usize,
    /// Triangles whose area is more than [`MappingReport::TORN`] times as large or as small as it should be at last.
    pub torn: usize,
    /// Starts whose lines meet no proxy, and those from a boundary that were replaced.
    pub lost_lines: usize,
    pub tangential_lines: usize,
    /// Triangles in narrow places that the lines do not lead out of well: the field is weaker than [`MappingReport::WEAK`] of its median.
    pub weak_field: usize,
    /// Of the soup's texture.
    pub distortion: Distortion,
    pub warnings: Vec<Warning>,
}

impl MappingReport {
    pub const TORN: f64 = 8.0;
    pub const WEAK: f64 = 0.05;
}

impl Mapping {
    /// Texture coordinates where the lines meet the proxy; triangles whose corners meet different charts are put into one of them
    /// (Schier et al. 2018, section 8).
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn new(
        soup: &TriangleSoup,
        lines: &SoupLines,
        anchors: &Anchors,
        proxy: &Proxy,
        atlas: &Atlas,
        monitor: &dyn Monitor,
    ) -> Result<Mapping, Cancelled> {
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, 0.9);
        let placed = all_placed(&mut Charts::new(proxy, atlas), soup, lines, anchors, monitor)?;
        monitor.begin(0.9, 1.0);
        let affected = Affected::new(soup, lines, anchors, atlas.scale, &placed, monitor)?;
        let distortion = distortion(placed.iter().enumerate().map(|(t, p)| (soup.corners(t), p.uv)));
        let report = report(anchors, &affected, distortion, soup.len());
        let (uv, charts) = placed.into_iter().map(|p| (p.uv, p.chart)).unzip();
        Ok(Mapping { uv, charts, affected, report })
    }
}

/// Any values at the proxy's vertices, such as colours or normals, at the corners of the soup's triangles.
pub fn transferred(values: &[Vec3], lines: &SoupLines, anchors: &Anchors, proxy: &Proxy) -> Vec<[Vec3; 3]> {
    let at = |start: u32| {
        let anchor = &anchors.of_starts[start as usize];
        let corners = proxy.mesh.triangles[anchor.face as usize];
        (0..3).map(|k| anchor.barycentric[k] * values[corners[k] as usize]).sum()
    };
    lines.starts.corners.iter().map(|corners| corners.map(at)).collect()
}

fn report(anchors: &Anchors, affected: &Affected, distortion: Distortion, triangles: usize) -> MappingReport {
    let mut found = MappingReport {
        triangles,
        across_charts: affected.across.len(),
        moved: affected.moved.len(),
        folded: affected.folded.len(),
        squashed: affected.squashed.len(),
        unfolded: affected.unfolded.len(),
        flipped: affected.flipped.len(),
        torn: affected.torn.len(),
        lost_lines: anchors.lost,
        tangential_lines: anchors.tangential.len(),
        weak_field: affected.weak.len(),
        distortion,
        warnings: Vec::new(),
    };
    let counts = [
        (WarningKind::LostLines, found.lost_lines),
        (WarningKind::TangentialLines, found.tangential_lines),
        (WarningKind::WeakField, found.weak_field),
        (WarningKind::BadTexture, affected.bad()),
    ];
    found.warnings = Warning::counted(counts);
    found
}
