use super::curtains::Grid;
use crate::math::{Aabb, Nodes, Vec3, bernstein, lebesgue};
use std::f64::consts::PI;
use wide::f64x4;

const LANES: usize = 4;

/// A polynomial on a block, by its values at nodes, x fastest.
pub struct Interpolant {
    pub nodes: [Nodes; 3],
    pub values: Vec<f64>,
}

impl Interpolant {
    /// Values at the points of a grid, x fastest.
    pub fn at(&self, grid: &Grid) -> Vec<f64> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.nodes[axis].matrix(&grid[axis]));
        let [nx, ny, nz] = [0, 1, 2].map(|axis| self.nodes[axis].count());
        let rows = ny * nz;
        let along_x = contract_rows(&self.values, [rows, nx], &x, grid[0].len());
        let along_y = contract(&along_x, [nz, ny, grid[0].len()], &y, grid[1].len());
        contract(&along_y, [1, nz, grid[0].len() * grid[1].len()], &z, grid[2].len())
    }
}

/// Along the fastest axis.
fn contract_rows(values: &[f64], [rows, from]: [usize; 2], matrix: &[f64], to: usize) -> Vec<f64> {
    let mut result = vec![0.0; rows * to];
    // Columns of the matrix, padded, so that four targets are computed at once.
    let groups = to.div_ceil(LANES);
    let columns: Vec<f64x4> = (0..groups * from)
        .map(|i| {
            let (group, k) = (i / from, i % from);
            let entry = |lane: usize| matrix.get((LANES * group + lane) * from + k).copied().unwrap_or(0.0);
            f64x4::from(std::array::from_fn(entry))
        })
        .collect();
    for (values, result) in values.chunks_exact(from).zip(result.chunks_exact_mut(to)) {
        for (columns, result) in columns.chunks_exact(from).zip(result.chunks_mut(LANES)) {
            let sum = columns.iter().zip(values).fold(f64x4::ZERO, |sum, (c, v)| sum + *c * f64x4::splat(*v));
            result.copy_from_slice(&sum.to_array()[..result.len()]);
        }
    }
    result
}

/// Along the middle axis of three.
fn contract(values: &[f64], [outer, from, inner]: [usize; 3], matrix: &[f64], to: usize) -> Vec<f64> {
    let mut result = vec![0.0; outer * to * inner];
    for (values, result) in values.chunks_exact(from * inner).zip(result.chunks_exact_mut(to * inner)) {
        for (row, result) in matrix.chunks_exact(from).zip(result.chunks_exact_mut(inner)) {
            for (first, result) in (0..inner).step_by(LANES).zip(result.chunks_mut(LANES)) {
                if result.len() == LANES {
                    let mut sum = f64x4::ZERO;
                    for (k, m) in row.iter().enumerate() {
                        let start = k * inner + first;
                        let four: [f64; LANES] = values[start..start + LANES].try_into().expect("four");
                        sum += f64x4::from(four) * f64x4::splat(*m);
                    }
                    result.copy_from_slice(&sum.to_array());
                } else {
                    for (offset, result) in result.iter_mut().enumerate() {
                        *result =
                            row.iter().enumerate().map(|(k, m)| m * values[k * inner + first + offset]).sum();
                    }
                }
            }
        }
    }
    result
}

/// Bound of the error of interpolating the winding number of caps of an area, all in a box, over a block: at `nodes` nodes
/// along each axis, or exactly along those with none. Along an axis, with the other two coordinates anywhere in the block,
/// the field of a dipole at s is singular at z = s_x ± iR, R its distance from the axis; the ellipse with the ends of the
/// block as foci on which these lie has as its major axis the sum of the distances of s from the two ends, which is least for
/// the s of the box that is nearest to the axis, and to the middle of the block along it. Inside of that ellipse, at a distance
/// D from it, the field is at most 1 / 4πD² for each unit of area.
pub fn interpolation_error(area: f64, bounds: &Aabb, block: &Aabb, nodes: [Option<usize>; 3]) -> f64 {
    let (mut error, mut growth) = (0.0, 1.0);
    let gap = (bounds.min - block.max).max(block.min - bounds.max).max(Vec3::ZERO);
    let (middle, half) = (block.center(), 0.5 * block.size());
    for (axis, count) in nodes.into_iter().enumerate() {
        let Some(count) = count else { continue };
        let beside = (gap.length_squared() - gap[axis] * gap[axis]).max(0.0);
        let nearest = middle[axis].clamp(bounds.min[axis], bounds.max[axis]) - middle[axis];
        let to_end = |end: f64| (beside + (nearest - end) * (nearest - end)).sqrt();
        let singular = (to_end(half[axis]) + to_end(-half[axis])) / (2.0 * half[axis]);
        // Where they touch, rounding decides.
        if singular <= 1.0 + 1e-9 {
            return f64::INFINITY;
        }
        let (reach, factor) = bernstein(singular, count);
        let distance = half[axis] * (singular - reach);
        error += growth * factor * area / (4.0 * PI * distance * distance);
        growth *= lebesgue(count);
    }
    error
}
