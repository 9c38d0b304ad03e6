//! Atlases: a closed mesh cut into charts that are disks, laid flat without flipped triangles or overlaps, and packed into a square
//! (Schier et al. 2018, section 6).
mod charts;
mod cuts;
mod faces;
mod flatten;
mod merge;
mod overlap;
mod pack;
mod seams;
mod segments;
mod slim;
mod system;

pub use seams::{SeamCost, SeamError, seam_through};

use crate::data::{Cancelled, Monitor, Parts, SurfaceMesh, map_tasks};
use crate::math::Vec2;
use crate::texture::distortion::{Distortion, distortion};
use charts::{Chart, chart_of, disks, halves};
use faces::Faces;
use flatten::flattened;
use segments::{Segments, segment};

/// How an atlas is made.
#[derive(Clone, Debug, PartialEq)]
pub struct AtlasConfig {
    /// Degrees that triangles of a chart may face away from its axis; 55 and more give the six sides of a cube a chart each.
    pub cone_degrees: f64,
    /// Edges of the mesh that no chart reaches across, such as those of [`seam_through`], in either direction.
    pub seams: Vec<[u32; 2]>,
    /// Whether charts are made of these seams alone; what they leave is cut further only where it is no disk or overlaps itself.
    pub only_seams: bool,
    /// Side of the square texture in texels, for which the margin is measured.
    pub texels: u32,
    /// Texels between two charts.
    pub margin: u32,
    /// Rounds in which distortion is lowered.
    pub rounds: usize,
}

impl Default for AtlasConfig {
    fn default() -> Self {
        AtlasConfig {
            cone_degrees: 60.0,
            seams: Vec::new(),
            only_seams: false,
            texels: 2048,
            margin: 8,
            rounds: 12,
        }
    }
}

/// Why there is no atlas.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AtlasError {
    #[error("charts cannot face within {0} degrees of their axes: an angle from 10 to 80 is needed")]
    BadCone(f64),
    #[error("a texture of {0} texels is not possible: its side must have 16 to 65,536")]
    BadTexels(u32),
    #[error(
        "{charts} charts with margins of {margin} texels do not fit into {side} × {side}: a larger texture or a smaller margin is needed"
    )]
    DoesNotFit { charts: usize, side: u32, margin: u32 },
    #[error("the mesh has no triangles")]
    NoTriangles,
    #[error(transparent)]
    Seam(#[from] SeamError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Texture coordinates of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Atlas {
    /// From 0 to 1, v upward; a vertex of the mesh that lies on seams has several.
    pub uv: Vec<Vec2>,
    /// Of the corners of each triangle, places in `uv`. Charts share none.
    pub corners: Vec<[u32; 3]>,
    /// The chart of each triangle.
    pub charts: Vec<u32>,
    pub chart_count: usize,
    /// Texture coordinates for a millimetre: charts are as large as what they show, but for distortion.
    pub scale: f64,
    /// Share of the square that charts cover.
    pub coverage: f64,
    /// Millimetres of seams, each counted once.
    pub seam_length: f64,
    pub distortion: Distortion,
}

impl Atlas {
    /// Cuts, flattens and packs a closed mesh. No triangle with an area is flipped, and no two overlap.
    ///
    /// # Errors
    /// If and only if the mesh is empty, an option is out of range, the charts do not fit, or the monitor cancels.
    pub fn new(mesh: &SurfaceMesh, config: &AtlasConfig, monitor: &dyn Monitor) -> Result<Atlas, AtlasError> {
        config.check()?;
        config.check_seams(mesh)?;
        let monitor = &Parts::new(monitor);
        monitor.begin(0.0, 0.3);
        let mut seams: Vec<[u32; 2]> = config.seams.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
        seams.sort_unstable();
        let faces = Faces::new(mesh, &seams);
        let mut found = match config.only_seams {
            true => Segments { charts: vec![0; faces.len()], count: 1 },
            false => segment(&faces, config, monitor)?,
        };
        let charts = disks(&faces, &mut found);
        monitor.begin(0.3, 0.9);
        let (charts, places) = flat(&faces, charts, config, monitor)?;
        monitor.begin(0.9, 1.0);
        let packed = pack::packed(places, config.texels, config.margin, monitor)?;
        Ok(Atlas::assemble(mesh, &charts, packed, config.texels))
    }

    fn assemble(mesh: &SurfaceMesh, charts: &[Chart], packed: pack::Packed, texels: u32) -> Atlas {
        let count = mesh.triangles.len();
        let mut atlas = Atlas {
            uv: Vec::new(),
            corners: vec![[0; 3]; count],
            charts: vec![0; count],
            chart_count: charts.len(),
            scale: packed.scale / f64::from(texels),
            coverage: 0.0,
            seam_length: 0.0,
            distortion: Distortion::default(),
        };
        for (number, (chart, places)) in (0..).zip(charts.iter().zip(packed.places)) {
            let first = atlas.uv.len() as u32;
            for (t, corners) in chart.faces.iter().zip(&chart.triangles) {
                atlas.corners[*t as usize] = corners.map(|v| first + v);
                atlas.charts[*t as usize] = number;
            }
            atlas.uv.extend(places);
            let length =
                |[a, b]: &[u32; 2]| chart.positions[*a as usize].distance(chart.positions[*b as usize]);
            // Each seam is the rim of charts on both sides.
            atlas.seam_length += 0.5 * chart.rim.iter().map(length).sum::<f64>();
        }
        let pair = |t: usize| {
            let places = atlas.corners[t].map(|c| atlas.uv[c as usize]);
            (mesh.triangles[t].map(|v| mesh.positions[v as usize]), places)
        };
        atlas.distortion = distortion((0..count).map(pair));
        let area = |t: usize| {
            let [a, b, c] = pair(t).1;
            0.5 * (b - a).perp_dot(c - a)
        };
        atlas.coverage = (0..count).map(area).sum();
        atlas
    }

    /// The texture coordinates of a triangle's corners.
    pub fn corners_of(&self, triangle: u32) -> [Vec2; 3] {
        self.corners[triangle as usize].map(|c| self.uv[c as usize])
    }

    /// The texture coordinates of a place on a triangle.
    pub fn at(&self, triangle: u32, barycentric: [f64; 3]) -> Vec2 {
        let corners = self.corners_of(triangle);
        (0..3).map(|k| barycentric[k] * corners[k]).sum()
    }
}

impl AtlasConfig {
    /// Whether meshes can have such an atlas.
    ///
    /// # Errors
    /// If and only if a number is out of its range.
    pub fn check(&self) -> Result<(), AtlasError> {
        if !(10.0..=80.0).contains(&self.cone_degrees) {
            return Err(AtlasError::BadCone(self.cone_degrees));
        }
        if !(16..=65_536).contains(&self.texels) {
            return Err(AtlasError::BadTexels(self.texels));
        }
        Ok(())
    }

    fn check_seams(&self, mesh: &SurfaceMesh) -> Result<(), AtlasError> {
        if mesh.triangles.is_empty() {
            return Err(AtlasError::NoTriangles);
        }
        let vertices = mesh.positions.len();
        match self.seams.iter().flatten().find(|v| **v as usize >= vertices) {
            Some(vertex) => Err(SeamError::NoSuchVertex { vertex: *vertex, vertices }.into()),
            None => Ok(()),
        }
    }
}

/// Charts that are made flat between two reports.
const AT_ONCE: usize = 16;

/// All charts with their places in the plane; those that cannot be laid flat are halved.
fn flat(
    faces: &Faces,
    charts: Vec<Chart>,
    config: &AtlasConfig,
    monitor: &dyn Monitor,
) -> Result<(Vec<Chart>, Vec<Vec<Vec2>>), AtlasError> {
    let (mut done, mut places) = (Vec::new(), Vec::new());
    let mut open = charts;
    let mut share = 0.0;
    while !open.is_empty() {
        let rest = open.split_off(open.len().min(AT_ONCE));
        let made = map_tasks(open.len(), |k| flattened(&open[k], config.rounds));
        let mut again = Vec::new();
        for (chart, made) in open.into_iter().zip(made) {
            match made {
                Some(uv) => {
                    share += chart.faces.len() as f64 / faces.len() as f64;
                    done.push(chart);
                    places.push(uv);
                }
                None => again.extend(halves(faces, &chart.faces)),
            }
        }
        open = again.into_iter().map(|of| chart_of(faces, of)).chain(rest).collect();
        monitor.report(share.min(1.0), "atlas")?;
    }
    Ok((done, places))
}
