use super::{Lattice, OutOfMemory, bit, byte_of, set_bit, zeroed};

/// Cells of a lattice, each inside or outside, however they are kept.
pub trait VoxelRows: Sync {
    fn lattice(&self) -> &Lattice;

    /// Sets a byte for each voxel from (i, j, k) on along x, 1 inside, 0 outside. They are in the lattice.
    fn row(&self, first: [usize; 3], inside: &mut [u8]);
}

/// Cells of a lattice, each inside or outside; one bit for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    lattice: Lattice,
    bits: Vec<u8>,
}

/// Why data are not the voxels of a lattice.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VoxelDataError {
    #[error("{found} bytes are not {expected}, as {samples} voxels need")]
    WrongLength { found: usize, expected: usize, samples: usize },
    #[error("a lattice of {0:?} voxels is not possible: each count must be 1 or more, and their product {max} at most", max = Lattice::MAX_SAMPLES)]
    BadCounts([usize; 3]),
    #[error("the lattice is not finite: origin and spacing must be finite numbers, spacing from 0")]
    BadLattice,
    #[error("brick {place} is not possible: places must rise, and {bricks} bricks fill the lattice")]
    BadBrick { place: u32, bricks: usize },
    #[error(transparent)]
    OutOfMemory(#[from] OutOfMemory),
}

impl Voxels {
    /// Voxels of a bit each, lowest first, x fastest; bits beyond the last voxel do not count.
    ///
    /// # Errors
    /// If and only if the lattice is none that can be, or the bytes are not as many as its voxels need.
    pub fn from_bits(lattice: Lattice, mut bits: Vec<u8>) -> Result<Voxels, VoxelDataError> {
        check_lattice(&lattice)?;
        check_length(bits.len(), lattice.len().div_ceil(8), &lattice)?;
        let used = lattice.len() % 8;
        if let Some(last) = bits.last_mut().filter(|_| used > 0) {
            *last &= (1 << used) - 1;
        }
        Ok(Voxels { lattice, bits })
    }

    /// Of as many bits as the lattice has samples.
    pub(crate) fn of_bits(lattice: Lattice, bits: Vec<u8>) -> Voxels {
        Voxels { lattice, bits }
    }

    /// Voxels of a byte each, x fastest: inside where it is not 0.
    ///
    /// # Errors
    /// As [`Voxels::from_bits`], or if the bits do not fit in memory.
    pub fn from_bytes(lattice: Lattice, bytes: &[u8]) -> Result<Voxels, VoxelDataError> {
        check_lattice(&lattice)?;
        check_length(bytes.len(), lattice.len(), &lattice)?;
        let mut bits = zeroed(lattice.len().div_ceil(8))?;
        for (byte, eight) in bits.iter_mut().zip(bytes.chunks(8)) {
            *byte = byte_of(eight.iter().map(|inside| *inside != 0));
        }
        Ok(Voxels { lattice, bits })
    }

    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Whether voxel (i, j, k) is inside.
    pub fn get(&self, sample: [usize; 3]) -> bool {
        self.at(self.lattice.index(sample))
    }

    fn at(&self, index: usize) -> bool {
        bit(&self.bits, index)
    }

    pub(crate) fn set(&mut self, sample: [usize; 3], inside: bool) {
        set_bit(&mut self.bits, self.lattice.index(sample), inside);
    }

    /// Eight voxels a byte, lowest bit first, x fastest, rows one after the other without padding.
    pub fn bits(&self) -> &[u8] {
        &self.bits
    }

    /// One byte for each voxel, 0 or 1, x fastest.
    ///
    /// # Errors
    /// If and only if the bytes do not fit in memory.
    pub fn to_bytes(&self) -> Result<Vec<u8>, OutOfMemory> {
        let mut bytes = zeroed(self.lattice.len())?;
        bytes.iter_mut().enumerate().for_each(|(index, byte)| *byte = u8::from(self.at(index)));
        Ok(bytes)
    }

    /// Number of voxels inside.
    pub fn count(&self) -> usize {
        self.bits.iter().map(|byte| byte.count_ones() as usize).sum()
    }

    /// Volume of the voxels inside, in cubic millimetres.
    pub fn volume(&self) -> f64 {
        self.count() as f64 * self.lattice.cell_volume()
    }
}

impl VoxelRows for Voxels {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn row(&self, first: [usize; 3], inside: &mut [u8]) {
        let first = self.lattice.index(first);
        inside.iter_mut().enumerate().for_each(|(i, byte)| *byte = u8::from(self.at(first + i)));
    }
}

/// Whether a lattice that comes from elsewhere can be.
pub(super) fn check_lattice(lattice: &Lattice) -> Result<(), VoxelDataError> {
    if lattice.is_empty() || lattice.len() > Lattice::MAX_SAMPLES {
        return Err(VoxelDataError::BadCounts(lattice.counts));
    }
    let is_good =
        lattice.origin.is_finite() && lattice.spacing.is_finite() && lattice.spacing.min_element() >= 0.0;
    if is_good { Ok(()) } else { Err(VoxelDataError::BadLattice) }
}

fn check_length(found: usize, expected: usize, lattice: &Lattice) -> Result<(), VoxelDataError> {
    if found == expected {
        return Ok(());
    }
    Err(VoxelDataError::WrongLength { found, expected, samples: lattice.len() })
}
