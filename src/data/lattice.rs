use crate::math::{Aabb, Vec3};

/// A regular arrangement of sample points, x fastest: sample (i, j, k) lies at `origin + spacing * (i, j, k)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// The first sample.
    pub origin: Vec3,
    pub spacing: Vec3,
    /// Samples along x, y and z.
    pub counts: [usize; 3],
}

/// Why a lattice cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LatticeError {
    #[error("there is nothing to sample: the shape is empty")]
    EmptyBounds,
    #[error("a resolution of {0} is not possible: 1 or more cells along the longest side are needed")]
    BadResolution(f64),
    #[error("a spacing of {0} is not possible: it must be finite and above 0")]
    BadSpacing(f64),
    #[error("{0} samples are too many: at most {max} fit", max = Lattice::MAX_SAMPLES)]
    TooMany(f64),
}

impl Lattice {
    /// The largest number of samples a lattice may have: 2³¹, so that bytes of it stay below 4 GiB.
    pub const MAX_SAMPLES: usize = 1 << 31;

    /// Nodes that are sampled for each square of a cell's edge: bricks of 64 that a surface crosses askew.
    const NODES_PER_SQUARE: f64 = 12.0;

    /// Cubic cells that fill `bounds`, `resolution` of them along the longest side; samples at the cell centres.
    ///
    /// # Errors
    /// If and only if `bounds` is empty, `resolution` is zero or the samples are more than [`Self::MAX_SAMPLES`].
    pub fn with_resolution(bounds: Aabb, resolution: usize) -> Result<Lattice, LatticeError> {
        if bounds.is_empty() {
            return Err(LatticeError::EmptyBounds);
        }
        if resolution == 0 {
            return Err(LatticeError::BadResolution(0.0));
        }
        let longest = bounds.size().max_element();
        // A single point has no size: any spacing serves.
        let spacing = if longest > 0.0 { longest / resolution as f64 } else { 1.0 };
        Lattice::with_spacing(bounds, spacing)
    }

    /// Cubic cells of edge `spacing` that cover `bounds`, centred on it; samples at the cell centres.
    ///
    /// # Errors
    /// If and only if `bounds` is empty, `spacing` is not finite and positive, or the samples are too many.
    pub fn with_spacing(bounds: Aabb, spacing: f64) -> Result<Lattice, LatticeError> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(LatticeError::BadSpacing(spacing));
        }
        if bounds.is_empty() {
            return Err(LatticeError::EmptyBounds);
        }
        let (origin, cells) = Lattice::cells_over(bounds, spacing);
        let total = cells.x * cells.y * cells.z;
        if total > Lattice::MAX_SAMPLES as f64 {
            return Err(LatticeError::TooMany(total));
        }
        Ok(Lattice { origin, spacing: Vec3::splat(spacing), counts: cells.to_array().map(|c| c as usize) })
    }

    /// Cubic cells of edge `spacing` that cover bounds that are not empty, centred on them: the middle of the first, and how many there
    /// are along each axis.
    pub(crate) fn cells_over(bounds: Aabb, spacing: f64) -> (Vec3, Vec3) {
        // The slack keeps a side of exactly n cells from getting n + 1 by rounding.
        let cells = (bounds.size() / spacing - Vec3::splat(1e-9)).ceil().max(Vec3::ONE);
        (bounds.center() - 0.5 * spacing * (cells - Vec3::ONE), cells)
    }

    /// Cells of an edge of `spacing` that a surface of `area` passes through are to be fewer than samples may be: what level sets of
    /// clouds reach that have far larger areas than their points suggest is not known before.
    ///
    /// # Errors
    /// If and only if they are not, or no number.
    pub fn check_area(area: f64, spacing: f64) -> Result<(), LatticeError> {
        let nodes = Self::NODES_PER_SQUARE * area / spacing / spacing;
        if nodes <= Self::MAX_SAMPLES as f64 { Ok(()) } else { Err(LatticeError::TooMany(nodes)) }
    }

    /// `counts` cells that fill `bounds` exactly (not cubic in general); samples at the cell centres.
    ///
    /// # Errors
    /// If and only if `bounds` is empty, a count is zero or the samples are too many.
    pub fn with_counts(bounds: Aabb, counts: [usize; 3]) -> Result<Lattice, LatticeError> {
        if bounds.is_empty() {
            return Err(LatticeError::EmptyBounds);
        }
        let cells = Vec3::from_array(counts.map(|c| c as f64));
        if cells.min_element() < 1.0 {
            return Err(LatticeError::BadResolution(cells.min_element()));
        }
        if cells.x * cells.y * cells.z > Lattice::MAX_SAMPLES as f64 {
            return Err(LatticeError::TooMany(cells.x * cells.y * cells.z));
        }
        let spacing = bounds.size() / cells;
        Ok(Lattice { origin: bounds.min + 0.5 * spacing, spacing, counts })
    }

    /// Number of samples; `usize::MAX` if they are more.
    pub fn len(&self) -> usize {
        self.counts.iter().copied().fold(1, usize::saturating_mul)
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of sample (i, j, k).
    #[inline]
    pub fn point(&self, [i, j, k]: [usize; 3]) -> Vec3 {
        self.origin + self.spacing * Vec3::new(i as f64, j as f64, k as f64)
    }

    /// Place of sample (i, j, k) in an array of all samples.
    #[inline]
    pub fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    /// The sample at place `index` of an array of all samples.
    pub fn sample(&self, index: usize) -> [usize; 3] {
        let (row, i) = (index / self.counts[0], index % self.counts[0]);
        [i, row % self.counts[1], row / self.counts[1]]
    }

    /// Volume of one cell.
    pub fn cell_volume(&self) -> f64 {
        self.spacing.x * self.spacing.y * self.spacing.z
    }
}

/// One value for each sample of a lattice, x fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<T> {
    pub lattice: Lattice,
    pub values: Vec<T>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_cubic_and_start_half_a_cell_in() {
        let bounds = Aabb { min: Vec3::new(-1.0, 0.0, 0.0), max: Vec3::new(1.0, 1.0, 0.5) };
        let lattice = Lattice::with_resolution(bounds, 8).unwrap();
        assert_eq!(lattice.counts, [8, 4, 2]);
        assert_eq!(lattice.spacing, Vec3::splat(0.25));
        assert_eq!(lattice.origin, Vec3::new(-0.875, 0.125, 0.125));
        for index in 0..lattice.len() {
            assert_eq!(lattice.index(lattice.sample(index)), index);
        }
    }

    #[test]
    fn impossible_requests_are_refused() {
        let cube = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        assert_eq!(Lattice::with_resolution(Aabb::EMPTY, 8), Err(LatticeError::EmptyBounds));
        assert!(matches!(Lattice::with_resolution(cube, 100_000), Err(LatticeError::TooMany(_))));
        assert!(matches!(Lattice::with_spacing(cube, f64::NAN), Err(LatticeError::BadSpacing(_))));
        assert!(matches!(Lattice::with_counts(cube, [1, 0, 1]), Err(LatticeError::BadResolution(_))));
    }
}
