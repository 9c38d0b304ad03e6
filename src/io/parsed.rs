use super::{Format, Geometry, Imported, ReadError};
use crate::data::{PointCloud, TriangleSoup, Warning, WarningKind};
use crate::math::{Aabb, Vec3};

/// Diagonals, in millimetres, outside which a model was probably saved in another unit.
const USUAL_DIAGONALS: std::ops::RangeInclusive<f64> = 1.0..=2000.0;

/// Warnings with one entry for each kind.
#[derive(Debug, Default)]
pub(super) struct Tally(Vec<Warning>);

impl Tally {
    pub fn add(&mut self, kind: WarningKind, count: usize) {
        match self.0.iter_mut().find(|warning| warning.kind == kind) {
            _ if count == 0 => {}
            Some(warning) => warning.count = warning.count.saturating_add(count),
            None => self.0.push(Warning::new(kind, count)),
        }
    }

    fn extend(&mut self, warnings: Vec<Warning>) {
        warnings.into_iter().for_each(|warning| self.add(warning.kind, warning.count));
    }
}

/// What a reader found, not yet checked: coordinates may be NaN and indices out of range.
#[derive(Debug, Default)]
pub(super) struct Parsed {
    pub positions: Vec<Vec3>,
    /// Of a cloud: one for each position.
    pub normals: Option<Vec<Vec3>>,
    /// `None` makes a cloud.
    pub triangles: Option<Vec<[u32; 3]>>,
    pub tally: Tally,
}

impl Parsed {
    /// Scales to millimetres, drops what cannot be used, and warns of unusual sizes.
    pub fn import(mut self, format: Format, scale: f64) -> Result<Imported, ReadError> {
        if scale != 1.0 {
            self.positions.iter_mut().for_each(|p| *p *= scale);
        }
        let Parsed { positions, normals, triangles, mut tally } = self;
        let geometry = match triangles {
            Some(triangles) => soup(positions, triangles, &mut tally),
            None => cloud(positions, normals, &mut tally),
        };
        if geometry.is_empty() {
            return Err(ReadError::EmptyInput { format: Some(format), dropped: tally.0 });
        }
        let diagonal = geometry.bounds().diagonal();
        tally.add(WarningKind::TinyModel, usize::from(diagonal < *USUAL_DIAGONALS.start()));
        tally.add(WarningKind::HugeModel, usize::from(diagonal > *USUAL_DIAGONALS.end()));
        Ok(Imported { geometry, format, warnings: tally.0 })
    }
}

fn soup(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>, tally: &mut Tally) -> Geometry {
    let (soup, warnings) = TriangleSoup::cleaned(positions, triangles);
    tally.extend(warnings);
    Geometry::Soup(soup)
}

fn cloud(points: Vec<Vec3>, normals: Option<Vec<Vec3>>, tally: &mut Tally) -> Geometry {
    let is_usable = |normal: &Vec3| normal.try_normalize().is_some();
    // Exporters fill the columns with zeros when they know no normals: then the points still count.
    let normals = normals.filter(|normals| normals.len() == points.len());
    let all = normals.as_ref().map_or(0, Vec::len);
    let normals = normals.filter(|normals| normals.iter().any(is_usable));
    if normals.is_none() {
        tally.add(WarningKind::BadNormals, all);
    }
    let (cloud, warnings) = PointCloud::cleaned(points, normals, None)
        .expect("there are as many normals as points, and no areas");
    tally.extend(warnings);
    Geometry::Cloud(cloud)
}

impl Geometry {
    /// The smallest box around all triangles or points.
    pub fn bounds(&self) -> Aabb {
        match self {
            Geometry::Soup(soup) => soup.bounds(),
            Geometry::Cloud(cloud) => cloud.bounds(),
        }
    }

    /// Number of triangles or points.
    pub fn len(&self) -> usize {
        match self {
            Geometry::Soup(soup) => soup.len(),
            Geometry::Cloud(cloud) => cloud.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// An index as files give it; what cannot be one becomes `u32::MAX`, which names no vertex.
pub(super) fn vertex_index(index: i64) -> u32 {
    u32::try_from(index).unwrap_or(u32::MAX)
}

/// Adds a polygon as a fan around its first corner; fewer than three corners are skipped and counted.
///
/// Of a planar polygon that is not convex, the fan's triangles overlap with opposite signs, so that the
/// winding number is still that of the polygon.
pub(super) fn push_polygon(triangles: &mut Vec<[u32; 3]>, corners: &[u32], tally: &mut Tally) {
    match corners {
        [first, rest @ ..] if rest.len() >= 2 => {
            triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
        }
        _ => tally.add(WarningKind::SkippedElements, 1),
    }
}
