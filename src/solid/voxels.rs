use super::continuation::along_the_level_set;
use crate::data::{
    Cancelled, Lattice, LatticeError, Monitor, OutOfMemory, Shape, TriangleSoup, VoxelBricks, Voxels,
};
use crate::winding::{FieldConfig, FieldError, Order, Stabbing, THRESHOLD, WindingField, stab_lattice};

/// How it is found out what is inside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum VoxelMethod {
    /// Every sample is asked: proven for soups, and decided by bounds and at last by the direct sum for clouds.
    #[default]
    Lattice,
    /// Those that hold geometry and, from there, all along the level set; the rest is filled in
    /// (Barill et al. 2018, implementation details). Much faster at high resolution; parts of the level set that come
    /// near no triangle or point are missed.
    Continuation,
    /// By crossings of rays with the triangles of a soup, without a field.
    Rays(Stabbing),
    /// w as the evaluator of Barill et al. 2018 approximates it, with terms up to an order and the opening distance β.
    Fast { order: Order, beta: f64 },
    /// w of points in the place of triangles, as Pimentel, Scrivener & To 2022 do it; that of a cloud as it is.
    Points(PointsOf),
}

/// Which points stand for the triangles of a soup, with the areas and normals of its triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PointsOf {
    #[default]
    Vertices,
    Barycentres,
}

/// How a shape is turned into voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoxelConfig {
    /// A voxel is inside where w is at least this.
    pub threshold: f64,
    pub method: VoxelMethod,
}

impl Default for VoxelConfig {
    fn default() -> Self {
        VoxelConfig { threshold: THRESHOLD, method: VoxelMethod::Lattice }
    }
}

/// Why voxels could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VoxelError {
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
    #[error("a threshold of {0} is not possible: it must be a finite number")]
    BadThreshold(f64),
    #[error("an opening distance of {0} is not possible: it must be a finite number above 0")]
    BadBeta(f64),
    #[error("a cloud of {points} points has no triangles that rays could cross: only soups have")]
    NoTriangles { points: usize },
}

impl From<FieldError> for VoxelError {
    fn from(error: FieldError) -> VoxelError {
        match error {
            FieldError::Lattice(error) => error.into(),
            FieldError::Cancelled(error) => error.into(),
            FieldError::OutOfMemory(error) => error.into(),
        }
    }
}

impl VoxelConfig {
    fn check(&self) -> Result<(), VoxelError> {
        if !self.threshold.is_finite() {
            return Err(VoxelError::BadThreshold(self.threshold));
        }
        match self.method {
            VoxelMethod::Fast { beta, .. } if !(beta.is_finite() && beta > 0.0) => {
                Err(VoxelError::BadBeta(beta))
            }
            _ => Ok(()),
        }
    }
}

/// Which cells of a lattice are inside: w ≥ threshold at the cell's centre.
///
/// # Errors
/// If and only if the threshold or β is none that can be, rays are asked for of a cloud, the monitor cancels, or the voxels do not
/// fit in memory.
pub fn voxelize(
    field: &WindingField,
    lattice: &Lattice,
    config: &VoxelConfig,
    monitor: &dyn Monitor,
) -> Result<Voxels, VoxelError> {
    config.check()?;
    let named = |fraction: f64, _: &str| monitor.report(fraction, "voxels").is_ok();
    let threshold = config.threshold;
    let bits = match (config.method, field.shape()) {
        (VoxelMethod::Continuation, _) => {
            return Ok(along_the_level_set(field, lattice, threshold, monitor)?.to_voxels()?);
        }
        (VoxelMethod::Rays(stabbing), Shape::Soup(soup)) => {
            return voxelize_by_rays(soup, lattice, stabbing, threshold, monitor);
        }
        (VoxelMethod::Rays(_), Shape::Cloud(cloud)) => {
            return Err(VoxelError::NoTriangles { points: cloud.len() });
        }
        (VoxelMethod::Fast { order, beta }, _) => {
            field.classify_lattice_fast(lattice, (order, beta), threshold, &named)?
        }
        (VoxelMethod::Points(points), Shape::Soup(soup)) => {
            field_of_points(soup, points).classify_lattice(lattice, threshold, &named)?
        }
        (VoxelMethod::Lattice, _) | (VoxelMethod::Points(_), Shape::Cloud(_)) => {
            field.classify_lattice(lattice, threshold, &named)?
        }
    };
    Ok(Voxels::of_bits(*lattice, bits))
}

/// [`voxelize`] by rays: no field is needed. The threshold matters to signed crossings alone.
///
/// # Errors
/// If and only if the threshold is not finite, the monitor cancels, or the voxels do not fit in memory.
pub fn voxelize_by_rays(
    soup: &TriangleSoup,
    lattice: &Lattice,
    stabbing: Stabbing,
    threshold: f64,
    monitor: &dyn Monitor,
) -> Result<Voxels, VoxelError> {
    VoxelConfig { threshold, method: VoxelMethod::Rays(stabbing) }.check()?;
    let named = |fraction: f64, _: &str| monitor.report(fraction, "voxels").is_ok();
    Ok(Voxels::of_bits(*lattice, stab_lattice(soup, lattice, stabbing, threshold, &named)?))
}

/// The field of points in the place of the triangles of a soup.
fn field_of_points(soup: &TriangleSoup, points: PointsOf) -> WindingField {
    let (cloud, _) = match points {
        PointsOf::Vertices => soup.vertex_cloud(),
        PointsOf::Barycentres => soup.barycentre_cloud(),
    };
    WindingField::new(cloud, FieldConfig::default())
}

/// The same voxels as [`voxelize`] makes, in bricks. By continuation, and of every sample of soups that are not loose, memory
/// grows with the surface, and beside it some planes of the lattice are held; otherwise all voxels are made first.
///
/// # Errors
/// As [`voxelize`].
pub fn voxelize_bricks(
    field: &WindingField,
    lattice: &Lattice,
    config: &VoxelConfig,
    monitor: &dyn Monitor,
) -> Result<VoxelBricks, VoxelError> {
    config.check()?;
    match config.method {
        VoxelMethod::Continuation => along_the_level_set(field, lattice, config.threshold, monitor),
        VoxelMethod::Lattice => {
            let named = |fraction: f64, _: &str| monitor.report(fraction, "voxels").is_ok();
            let mut bricks = VoxelBricks::outside(lattice)?;
            let mut store = |first: usize, bits: &[u8]| bricks.set_planes(first, bits);
            field.classify_planes(lattice, config.threshold, &named, &mut store)?;
            Ok(bricks.finished())
        }
        _ => Ok(VoxelBricks::from_voxels(&voxelize(field, lattice, config, monitor)?)?),
    }
}
