//! Surfaces from a field: its level set as a mesh; those at a distance from the shape, and hollow shapes.
mod cells;
mod components;
mod level;
mod offset;
mod samples;
mod sharp;
mod sides;
mod trim;

pub use level::suggested_level;
pub use offset::{Drain, HollowConfig, OffsetConfig, OffsetError, hollow, offset, two_sided_offset};

use crate::bvh::PointTree;
use crate::data::{Cancelled, LatticeError, Monitor, Parts, Shape, SurfaceMesh};
use crate::levelset::{TraceError, cells_of_points, cells_of_shape, trace_surface};
use crate::math::Vec3;
use crate::winding::{FieldError, THRESHOLD, WindingField};
use cells::{area, grid};
use components::keep_large;
use samples::Samples;
use sharp::{Limits, OfCloud, OfSoup, sharpen, tree_of};
use sides::Sides;
use trim::Reach;

/// How a surface is traced.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceConfig {
    /// Cells along the longest side of the bounds; used when `spacing` is not given. Where neither is, soups get
    /// [`SurfaceConfig::SOUP_RESOLUTION`], and clouds cells as large as the distances of their points allow.
    pub resolution: Option<usize>,
    /// Edge of a cell in millimetres.
    pub spacing: Option<f64>,
    /// The winding number on the surface. Where it is not given, [`suggested_level`] for clouds, but 0.1 at least unless they are
    /// trimmed; 1/2 for soups, whose triangles the surface passes through at any level near that.
    pub level: Option<f64>,
    /// Pieces of the surface that have less than this share of the largest one's area are left out; 0 keeps all. Where it is not
    /// given, soups keep all, and clouds those that have the area of ten points: what floats around noisy clouds is smaller.
    pub min_component: Option<f64>,
    /// Standard deviation of Gaussians that a cloud's points are taken for (Barill et al. 2018, section 5), in the cloud's median
    /// distance between points: for noisy clouds, about 1. Cells have to be at least two thirds of it. Their corners' winding numbers
    /// are smoothed, with weights that leave curved surfaces where they are.
    pub smoothing: Option<f64>,
    /// Surface that is farther from the nearest point of a cloud than this many of the distances between points there is left out,
    /// triangle by triangle, so that rims are jagged. It is then open, but still manifold. 1.5 leaves no holes between points that are
    /// spaced evenly, 3 none between points drawn at random.
    pub trim: Option<f64>,
    /// Degrees between the normals of two parts of the surface from which the edge where they meet is sharp, such as
    /// [`SurfaceConfig::SHARP`]: vertices are then put on it, and in corners. Without it cells cut off what is sharp.
    pub sharp: Option<f64>,
}

impl SurfaceConfig {
    /// Cells along the longest side of a soup.
    pub const SOUP_RESOLUTION: usize = 64;
    /// An angle that keeps the edges of parts that are made.
    pub const SHARP: f64 = 35.0;
}

/// Why a surface could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    #[error(transparent)]
    Lattice(#[from] LatticeError),
    #[error(transparent)]
    Trace(#[from] TraceError),
    #[error("a level of {0} has no closed surface: it must be finite and not 0, the winding number far away")]
    BadLevel(f64),
    #[error("pieces cannot be at least {0} of the largest: a share from 0 to 1 is needed")]
    BadShare(f64),
    #[error(
        "a surface cannot be trimmed at {0} distances from the points: a finite number above 0 is needed"
    )]
    BadTrim(f64),
    #[error("points cannot be smoothed over {0} distances between them: a finite number above 0 is needed")]
    BadSmoothing(f64),
    #[error("edges cannot be sharp from {0} degrees: an angle from 10 to 120 is needed")]
    BadSharp(f64),
    #[error("cells of {spacing} are too small to smooth over {deviation}: two thirds of that is needed")]
    SmallCells { spacing: f64, deviation: f64 },
    #[error("only surfaces of clouds are {0}")]
    OnlyOfClouds(&'static str),
}

impl From<FieldError> for SurfaceError {
    fn from(error: FieldError) -> SurfaceError {
        match error {
            FieldError::Lattice(lattice) => lattice.into(),
            error => TraceError::from(error).into(),
        }
    }
}

impl From<Cancelled> for SurfaceError {
    fn from(cancelled: Cancelled) -> SurfaceError {
        TraceError::from(cancelled).into()
    }
}

/// The parts of the progress that are told before cells are looked for, and when these are traced, if sharp edges follow.
const PREPARED: f64 = 0.05;
const TRACED: f64 = 0.6;
/// A surface that is not trimmed gets no level nearer to 0 than that unless it is asked for: w falls off with the square of the
/// distance, so that the level set of 0.1 of a flat square is a bubble as large as that, and those of smaller ones grow beyond bounds.
const LEAST_LEVEL: f64 = 0.1;
/// Points whose area a piece of a cloud's surface has at least. With noise of half to all of the spacing, nine in ten of the floating
/// pieces are smaller than 3, all but a few smaller than 10.
const POINTS_OF_PIECE: f64 = 10.0;

/// The surface {w = level}, traced from the cells that hold geometry (Barill et al. 2018, Fig. 9): closed unless it is trimmed,
/// manifold, oriented outward. Vertices lie where edges of the cells cross it: of soups, where w jumps, by bisection; of clouds, where
/// it is smooth, by false position on values within 0.03, or by interpolation if values are smoothed. It may reach beyond the bounds,
/// as the field does. Normals are those of the faces around: next to a cloud's points its gradient tells less of the surface.
///
/// # Errors
/// If and only if the shape is empty, an option is out of range, or the monitor cancels.
// Not part of its caller, which the package for JavaScript loads sooner.
#[inline(never)]
pub fn extract(
    field: &WindingField,
    config: &SurfaceConfig,
    monitor: &dyn Monitor,
) -> Result<SurfaceMesh, SurfaceError> {
    check(field.shape(), config)?;
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, PREPARED);
    let (grid, blur) = grid(field, config, monitor)?;
    let level = match (config.level, field.shape()) {
        (Some(level), _) => level,
        (None, Shape::Soup(_)) => THRESHOLD,
        (None, Shape::Cloud(_)) => match suggested_level(field, monitor)? {
            level if config.trim.is_none() && level.abs() < LEAST_LEVEL => LEAST_LEVEL,
            level => level,
        },
    };
    if !level.is_finite() || level == 0.0 && config.trim.is_none() {
        return Err(SurfaceError::BadLevel(level));
    }
    let limits = config.sharp.map(Limits::new);
    let traced = if limits.is_some() { TRACED } else { 1.0 };
    monitor.begin(PREPARED, traced);
    let mut mesh = match field.shape() {
        Shape::Soup(soup) => {
            field.prepare_single_points();
            let seeds = cells_of_shape(field.shape(), grid.origin, Vec3::splat(grid.spacing));
            let mut mesh = trace_surface(&grid, &seeds, &Sides { field, level }, monitor)?;
            if let Some(limits) = limits {
                monitor.begin(traced, 1.0);
                let evidence =
                    OfSoup { soup, field, level, bvh: tree_of(soup), spacing: grid.spacing, limits };
                sharpen(&mut mesh, &evidence, grid.spacing, limits, monitor)?;
            }
            mesh
        }
        Shape::Cloud(cloud) => {
            let seeds = cells_of_points(cloud.points(), grid.origin, Vec3::splat(grid.spacing));
            let reach = config.trim.map(|trim| Reach::new(cloud, trim, monitor)).transpose()?;
            let samples = Samples { field, level, reach: reach.as_ref(), spacing: grid.spacing, blur };
            let mut mesh = trace_surface(&grid, &seeds, &samples, monitor)?;
            if let Some(limits) = limits {
                monitor.begin(traced, 1.0);
                let evidence = OfCloud { cloud, points: PointTree::new(cloud.points()), limits };
                sharpen(&mut mesh, &evidence, grid.spacing, limits, monitor)?;
            }
            if let Some(reach) = &reach {
                reach.trim(&mut mesh, monitor)?;
            }
            mesh
        }
    };
    match (config.min_component, field.shape()) {
        (Some(share), _) => keep_large(&mut mesh, |largest| share * largest),
        (None, Shape::Soup(_)) => {}
        (None, Shape::Cloud(cloud)) => {
            let least = POINTS_OF_PIECE * area(field.shape()) / cloud.len() as f64;
            keep_large(&mut mesh, |largest| least.min(largest));
        }
    }
    Ok(mesh)
}

fn check(shape: &Shape, config: &SurfaceConfig) -> Result<(), SurfaceError> {
    if let Some(share) = config.min_component.filter(|share| !(0.0..=1.0).contains(share)) {
        return Err(SurfaceError::BadShare(share));
    }
    check_sharp(config.sharp)?;
    let is_size = |size: &f64| size.is_finite() && *size > 0.0;
    if let Some(trim) = config.trim.filter(|trim| !is_size(trim)) {
        return Err(SurfaceError::BadTrim(trim));
    }
    if let Some(smoothing) = config.smoothing.filter(|smoothing| !is_size(smoothing)) {
        return Err(SurfaceError::BadSmoothing(smoothing));
    }
    match shape {
        Shape::Soup(_) if config.trim.is_some() => Err(SurfaceError::OnlyOfClouds("trimmed")),
        Shape::Soup(_) if config.smoothing.is_some() => Err(SurfaceError::OnlyOfClouds("smoothed")),
        _ => Ok(()),
    }
}

fn check_sharp(sharp: Option<f64>) -> Result<(), SurfaceError> {
    match sharp {
        Some(sharp) if !(10.0..=120.0).contains(&sharp) => Err(SurfaceError::BadSharp(sharp)),
        _ => Ok(()),
    }
}
