//! Voxels in bricks: memory grows with the surface of what is inside, not with its volume.
use super::directory::{Directory, INSIDE, OUTSIDE};
use super::voxels::{VoxelDataError, check_lattice};
use super::{Lattice, OutOfMemory, VoxelRows, Voxels, ones, zeroed};

/// Voxels along each side of a brick.
pub const BRICK_SIDE: usize = 8;
/// Voxels of a brick.
const VOXELS: usize = BRICK_SIDE * BRICK_SIDE * BRICK_SIDE;

/// A bit for each voxel of a brick, of one plane in each number: x fastest, then y.
pub type BrickBits = [u64; BRICK_SIDE];

/// Cells of a lattice, each inside or outside, in bricks of 8 × 8 × 8: those that hold both have a bit for each cell, the others
/// share what they are.
#[derive(Clone, Debug)]
pub struct VoxelBricks {
    lattice: Lattice,
    directory: Directory,
    mixed: Vec<BrickBits>,
}

/// What a brick of [`VoxelBricks`] holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brick<'a> {
    Outside,
    /// All of it, as far as it is in the lattice.
    Inside,
    Mixed(&'a BrickBits),
}

impl VoxelBricks {
    /// A lattice that is outside everywhere.
    pub(crate) fn outside(lattice: &Lattice) -> Result<VoxelBricks, OutOfMemory> {
        Ok(VoxelBricks { lattice: *lattice, directory: Directory::new(lattice)?, mixed: Vec::new() })
    }

    /// The bricks of voxels.
    ///
    /// # Errors
    /// If and only if they do not fit in memory.
    pub fn from_voxels(voxels: &Voxels) -> Result<VoxelBricks, OutOfMemory> {
        let mut bricks = VoxelBricks::outside(voxels.lattice())?;
        bricks.set_planes(0, voxels.bits());
        bricks.directory.collapse();
        Ok(bricks)
    }

    /// Bricks by their places, x fastest, which rise: those that are `mixed` with the bits of each, those that are `full`.
    ///
    /// # Errors
    /// If and only if the lattice is none that can be, there are not as many bits as mixed bricks, or a place is none or not above
    /// the one before.
    pub fn from_parts(
        lattice: Lattice,
        mixed: &[u32],
        bits: &[BrickBits],
        full: &[u32],
    ) -> Result<VoxelBricks, VoxelDataError> {
        check_lattice(&lattice)?;
        if mixed.len() != bits.len() {
            let samples = mixed.len() * VOXELS;
            let [found, expected] = [bits.len(), mixed.len()].map(|n| n * size_of::<BrickBits>());
            return Err(VoxelDataError::WrongLength { found, expected, samples });
        }
        let mut bricks = VoxelBricks::outside(&lattice)?;
        let [nx, ny, nz] = bricks.directory.bricks();
        let count = nx * ny * nz;
        for places in [mixed, full] {
            let is_wrong = |k: &usize| places[*k] as usize >= count || *k > 0 && places[*k] <= places[*k - 1];
            if let Some(k) = (0..places.len()).find(is_wrong) {
                return Err(VoxelDataError::BadBrick { place: places[k], bricks: count });
            }
        }
        let at = |place: &u32| {
            let place = *place as usize;
            [place % nx, place / nx % ny, place / (nx * ny)]
        };
        full.iter().for_each(|place| bricks.directory.set(at(place), INSIDE));
        mixed.iter().zip(bits).for_each(|(place, bits)| bricks.set_brick(at(place), *bits));
        bricks.directory.collapse();
        Ok(bricks)
    }

    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Bricks along each axis.
    pub fn counts(&self) -> [usize; 3] {
        self.directory.bricks()
    }

    /// What brick (i, j, k) holds.
    pub fn brick(&self, brick: [usize; 3]) -> Brick<'_> {
        match self.directory.get(brick) {
            OUTSIDE => Brick::Outside,
            INSIDE => Brick::Inside,
            number => Brick::Mixed(&self.mixed[number as usize]),
        }
    }

    /// The bricks in which something is inside, x fastest.
    pub fn each(&self) -> impl Iterator<Item = ([usize; 3], Brick<'_>)> {
        let [nx, ny, nz] = self.directory.bricks();
        let places = (0..nx * ny * nz).map(move |b| [b % nx, b / nx % ny, b / (nx * ny)]);
        places.map(|at| (at, self.brick(at))).filter(|(_, brick)| *brick != Brick::Outside)
    }

    /// Whether voxel (i, j, k) is inside.
    pub fn get(&self, sample: [usize; 3]) -> bool {
        match self.brick(sample.map(|s| s / BRICK_SIDE)) {
            Brick::Outside => false,
            Brick::Inside => true,
            Brick::Mixed(bits) => bit_of(bits, sample),
        }
    }

    /// Number of voxels inside.
    pub fn count(&self) -> usize {
        let of_brick = |(at, brick): ([usize; 3], Brick)| match brick {
            Brick::Outside => 0,
            Brick::Inside => count_of(&self.mask(at)),
            Brick::Mixed(bits) => count_of(bits),
        };
        self.each().map(of_brick).sum()
    }

    /// Volume of the voxels inside, in cubic millimetres.
    pub fn volume(&self) -> f64 {
        self.count() as f64 * self.lattice.cell_volume()
    }

    /// Bricks that hold voxels of both kinds.
    pub fn mixed(&self) -> usize {
        self.mixed.len()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.directory.bytes() + size_of_val(&self.mixed[..])
    }

    /// The same voxels, a bit for each.
    ///
    /// # Errors
    /// If and only if they do not fit in memory.
    pub fn to_voxels(&self) -> Result<Voxels, OutOfMemory> {
        let mut voxels = Voxels::of_bits(self.lattice, zeroed(self.lattice.len().div_ceil(8))?);
        for (at, brick) in self.each() {
            let mask = self.mask(at);
            let bits = if let Brick::Mixed(bits) = brick { bits } else { &mask };
            for (k, plane) in bits.iter().enumerate() {
                for place in ones(*plane) {
                    let [x, y, z] = at.map(|b| b * BRICK_SIDE);
                    voxels.set([x + place % BRICK_SIDE, y + place / BRICK_SIDE, z + k], true);
                }
            }
        }
        Ok(voxels)
    }

    /// The voxels of a brick that are in the lattice.
    fn mask(&self, brick: [usize; 3]) -> BrickBits {
        mask_of_brick(&self.lattice, brick)
    }

    /// Sets a brick that was outside.
    pub(crate) fn set_brick(&mut self, brick: [usize; 3], bits: BrickBits) {
        let mask = self.mask(brick);
        let bits: BrickBits = std::array::from_fn(|k| bits[k] & mask[k]);
        let slot = if bits == [0; BRICK_SIDE] {
            OUTSIDE
        } else if bits == mask {
            INSIDE
        } else {
            self.mixed.push(bits);
            self.mixed.len() as u32 - 1
        };
        self.directory.set(brick, slot);
    }

    /// Sets a brick that was outside to be inside.
    pub(crate) fn fill_brick(&mut self, brick: [usize; 3]) {
        self.directory.set(brick, INSIDE);
    }

    /// Sets planes of samples, from the first of a brick on, by a bit for each as [`Voxels::bits`] has them.
    pub(crate) fn set_planes(&mut self, first: usize, bits: &[u8]) {
        let [nx, ny, nz] = self.lattice.counts;
        let [across, along, _] = self.directory.bricks();
        let planes = (nz - first).min(8 * bits.len() / (nx * ny).max(1));
        // Eight voxels from a place on; what lies beyond the row is left out by the brick's mask.
        let eight = |place: usize| {
            let low = u16::from(bits[place / 8]);
            let high = u16::from(bits.get(place / 8 + 1).copied().unwrap_or(0));
            ((low | high << 8) >> (place % 8)) as u8
        };
        for k in (0..planes).step_by(BRICK_SIDE) {
            for (j, i) in (0..along).flat_map(|j| (0..across).map(move |i| (j, i))) {
                let mut brick = [0; BRICK_SIDE];
                for (z, plane) in brick.iter_mut().enumerate().take(planes - k) {
                    let rows = (BRICK_SIDE * j..ny.min(BRICK_SIDE * (j + 1))).enumerate();
                    *plane = rows.fold(0, |plane, (y, row)| {
                        let place = ((k + z) * ny + row) * nx + BRICK_SIDE * i;
                        plane | u64::from(eight(place)) << (BRICK_SIDE * y)
                    });
                }
                if brick != [0; BRICK_SIDE] {
                    self.set_brick([i, j, (first + k) / BRICK_SIDE], brick);
                }
            }
        }
    }

    /// Ends a run of changes: memory that these have left unused is given back.
    pub(crate) fn finished(mut self) -> VoxelBricks {
        self.directory.collapse();
        self.mixed.shrink_to_fit();
        self
    }
}

impl VoxelRows for VoxelBricks {
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn row(&self, [i, j, k]: [usize; 3], inside: &mut [u8]) {
        let mut x = i;
        let end = i + inside.len();
        let mut rest = inside;
        while x < end {
            let next = end.min((x / BRICK_SIDE + 1) * BRICK_SIDE);
            let (part, others) = rest.split_at_mut(next - x);
            match self.brick([x, j, k].map(|s| s / BRICK_SIDE)) {
                Brick::Outside => part.fill(0),
                Brick::Inside => part.fill(1),
                Brick::Mixed(bits) => {
                    let row = bits[k % BRICK_SIDE] >> (BRICK_SIDE * (j % BRICK_SIDE) + x % BRICK_SIDE);
                    part.iter_mut().enumerate().for_each(|(place, byte)| *byte = (row >> place & 1) as u8);
                }
            }
            (x, rest) = (next, others);
        }
    }
}

/// The bit of a voxel in its brick.
pub(crate) fn bit_of(bits: &BrickBits, sample: [usize; 3]) -> bool {
    let [x, y, z] = sample.map(|s| s % BRICK_SIDE);
    bits[z] >> (BRICK_SIDE * y + x) & 1 == 1
}

fn count_of(bits: &BrickBits) -> usize {
    bits.iter().map(|plane| plane.count_ones() as usize).sum()
}

/// The voxels of a brick that are in a lattice.
pub(crate) fn mask_of_brick(lattice: &Lattice, brick: [usize; 3]) -> BrickBits {
    let [x, y, z] = [0, 1, 2].map(|axis| (lattice.counts[axis] - brick[axis] * BRICK_SIDE).min(BRICK_SIDE));
    let row = (1u64 << x) - 1;
    let plane = (0..y).fold(0, |plane, y| plane | row << (BRICK_SIDE * y));
    std::array::from_fn(|k| if k < z { plane } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    fn lattice(counts: [usize; 3]) -> Lattice {
        Lattice { origin: Vec3::ZERO, spacing: Vec3::new(1.0, 2.0, 0.5), counts }
    }

    /// A ball in a lattice, and everything beyond a plane.
    fn voxels(counts: [usize; 3]) -> Voxels {
        let lattice = lattice(counts);
        let middle = Vec3::from_array(counts.map(|n| 0.5 * n as f64));
        let bytes: Vec<u8> = (0..lattice.len())
            .map(|index| {
                let at = Vec3::from_array(lattice.sample(index).map(|s| s as f64 + 0.5));
                u8::from((at - middle).length() < 0.4 * middle.max_element() || at.x > 0.9 * counts[0] as f64)
            })
            .collect();
        Voxels::from_bytes(lattice, &bytes).unwrap()
    }

    #[test]
    fn bricks_hold_the_voxels_they_are_made_of() {
        for counts in [[1, 1, 1], [8, 8, 8], [9, 17, 5], [70, 66, 130], [131, 1, 3]] {
            let voxels = voxels(counts);
            let bricks = VoxelBricks::from_voxels(&voxels).unwrap();
            assert_eq!(bricks.to_voxels().unwrap(), voxels);
            assert_eq!((bricks.count(), bricks.volume()), (voxels.count(), voxels.volume()));
            let mut row = vec![0; counts[0]];
            for (j, k) in (0..counts[1]).flat_map(|j| (0..counts[2]).map(move |k| (j, k))) {
                bricks.row([0, j, k], &mut row);
                assert!((0..counts[0]).all(|i| (row[i] == 1) == voxels.get([i, j, k])));
                assert!((0..counts[0]).all(|i| bricks.get([i, j, k]) == voxels.get([i, j, k])));
            }
            let place = |at: [usize; 3]| {
                let [nx, ny, _] = bricks.counts();
                ((at[2] * ny + at[1]) * nx + at[0]) as u32
            };
            let (mut mixed, mut bits, mut full) = (vec![], vec![], vec![]);
            for (at, brick) in bricks.each() {
                match brick {
                    Brick::Mixed(own) => {
                        mixed.push(place(at));
                        bits.push(*own);
                    }
                    _ => full.push(place(at)),
                }
            }
            let again = VoxelBricks::from_parts(*voxels.lattice(), &mixed, &bits, &full).unwrap();
            assert_eq!(again.to_voxels().unwrap(), voxels);
        }
    }

    #[test]
    fn a_full_lattice_takes_no_bricks() {
        let lattice = lattice([130, 70, 9]);
        let full = Voxels::from_bytes(lattice, &vec![1; lattice.len()]).unwrap();
        let bricks = VoxelBricks::from_voxels(&full).unwrap();
        // A slot for each of 3 × 2 × 1 nodes.
        assert_eq!((bricks.mixed(), bricks.bytes()), (0, 6 * size_of::<u32>()));
        assert_eq!(bricks.count(), lattice.len());
    }

    #[test]
    fn data_that_fit_no_lattice_are_refused() {
        let small = lattice([3, 3, 3]);
        let length = VoxelDataError::WrongLength { found: 3, expected: 4, samples: 27 };
        assert_eq!(Voxels::from_bits(small, vec![0; 3]), Err(length));
        assert!(Voxels::from_bytes(small, &[0; 26]).is_err());
        assert_eq!(Voxels::from_bits(small, vec![255; 4]).unwrap().count(), 27);
        assert!(matches!(Voxels::from_bits(lattice([0, 1, 1]), vec![]), Err(VoxelDataError::BadCounts(_))));
        let endless = Lattice { origin: Vec3::NAN, ..small };
        assert_eq!(Voxels::from_bits(endless, vec![0; 4]), Err(VoxelDataError::BadLattice));
        for (mixed, full) in [(vec![], vec![1]), (vec![0, 0], vec![])] {
            let bits = vec![[1; 8]; mixed.len()];
            let found = VoxelBricks::from_parts(small, &mixed, &bits, &full);
            assert!(matches!(found, Err(VoxelDataError::BadBrick { .. })));
        }
        assert!(VoxelBricks::from_parts(small, &[0], &[], &[]).is_err());
    }
}
