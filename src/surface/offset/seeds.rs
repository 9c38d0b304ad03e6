//! Cells near a surface at some distance from the shape: blocks that it may pass through are halved, the others left out.
use super::region::Region;
use crate::data::{Lattice, LatticeError, Monitor, fill_blocks};
use crate::distance::Search;
use crate::levelset::{Cell, SurfaceGrid};
use crate::math::{Aabb, Vec3};
use crate::surface::SurfaceError;
use crate::winding::THRESHOLD;

/// Cells along a side of the blocks that are looked at first, and last.
const LARGEST: i32 = 64;
const SMALLEST: i32 = 2;
/// Blocks that make a task.
const RUN: usize = 64;
/// For rounding, in cells.
const SLACK: f64 = 1e-6;

/// All cells through which the surface of a region passes, and others near it. Every cell that has a place at one of the region's
/// distances is among them, so that no part of the surface is missed that is as large as a cell.
pub fn cells_near(
    region: &Region,
    grid: &SurfaceGrid,
    bounds: Aabb,
    monitor: &dyn Monitor,
) -> Result<Vec<Cell>, SurfaceError> {
    let cell_of = |p: Vec3| ((p - grid.origin) / grid.spacing).floor();
    let first = (cell_of(bounds.min) / f64::from(LARGEST)).floor();
    let counts = (cell_of(bounds.max) / f64::from(LARGEST)).floor() - first + 1.0;
    // Also where they are no number, as the bounds are infinite.
    if !(0.0..=(Lattice::MAX_SAMPLES >> 8) as f64).contains(&counts.element_product()) {
        return Err(LatticeError::TooMany(counts.element_product() * f64::from(LARGEST).powi(3)).into());
    }
    let [nx, ny, nz] = counts.to_array().map(|c| c as i32);
    let first = first.to_array().map(|c| c as i32 * LARGEST);
    let all = (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / (nx * ny)]);
    let mut blocks: Vec<Cell> = all.map(|b| [0, 1, 2].map(|axis| first[axis] + LARGEST * b[axis])).collect();
    let mut size = LARGEST;
    loop {
        blocks = kept(region, grid, &blocks, size, monitor)?;
        if 64 * blocks.len() > Lattice::MAX_SAMPLES {
            return Err(LatticeError::TooMany(64.0 * blocks.len() as f64).into());
        }
        if size == SMALLEST {
            return Ok(parts(&blocks, 1).collect());
        }
        size /= 2;
        blocks = parts(&blocks, size).collect();
    }
}

/// The eight parts of each block, of that size.
fn parts(blocks: &[Cell], size: i32) -> impl Iterator<Item = Cell> {
    let part = move |block: &Cell, k: i32| [0, 1, 2].map(|axis| block[axis] + size * (k >> axis & 1));
    blocks.iter().flat_map(move |block| (0..8).map(move |k| part(block, k)))
}

/// The blocks that the surface may pass through.
fn kept(
    region: &Region,
    grid: &SurfaceGrid,
    blocks: &[Cell],
    size: i32,
    monitor: &dyn Monitor,
) -> Result<Vec<Cell>, SurfaceError> {
    let half = 0.5 * f64::from(size) * grid.spacing;
    let center = |block: &Cell| grid.origin + grid.spacing * Vec3::from_array(block.map(f64::from)) + half;
    let radius = half * 3f64.sqrt() + SLACK * grid.spacing;
    let levels = region.kept.distances();
    let limit = levels.iter().copied().fold(0.0, f64::max) + radius;
    let mut found = vec![f64::INFINITY; blocks.len()];
    let measure = |first: usize, run: &mut [f64], search: &mut Search| {
        for (distance, block) in run.iter_mut().zip(&blocks[first..]) {
            let at = region.tree.distance_within(center(block), limit, search);
            *distance = at.unwrap_or(f64::INFINITY);
        }
    };
    let undetermined = |_: f64, _: &str| monitor.report(0.0, "surface cells").is_ok();
    fill_blocks(&mut found, RUN, measure, "surface cells", &undetermined)?;
    let is_near = |distance: f64| levels.iter().any(|level| (distance - level).abs() <= radius);
    let mut is_kept: Vec<bool> = found.iter().map(|distance| is_near(*distance)).collect();
    if region.field.is_closed() && region.kept.has_one_side() {
        // No triangle is in blocks that are farther from the shape than their radius: they are on one side.
        let aside: Vec<usize> = (0..blocks.len()).filter(|b| is_kept[*b] && found[*b] > radius).collect();
        let centers: Vec<Vec3> = aside.iter().map(|b| center(&blocks[*b])).collect();
        let inside = region.field.classify(&centers, THRESHOLD, &undetermined)?;
        aside.iter().zip(inside).for_each(|(b, inside)| is_kept[*b] = inside == region.kept.is_within());
    }
    Ok(blocks.iter().zip(is_kept).filter(|(_, kept)| *kept).map(|(block, _)| *block).collect())
}
