//! Voxels by continuation: only what lies along the level set is asked for, and only there are bricks.
use super::VoxelError;
use crate::data::{
    BRICK_SIDE, BrickBits, Directory, INSIDE, Lattice, Monitor, OUTSIDE, OutOfMemory, Shape, VoxelBricks,
    bit_of, mask_of_brick, ones,
};
use crate::levelset::for_each_cell_of_shape;
use crate::math::{Aabb, Vec3};
use crate::winding::{Scratch, WindingField};

/// Samples that are asked for together: as many as their points may take some megabytes for.
const AT_ONCE: usize = 1 << 17;

/// What is known of the voxels of a brick, and which of them were asked for.
#[derive(Clone, Copy, Default)]
struct Known {
    known: BrickBits,
    inside: BrickBits,
    wanted: BrickBits,
}

/// What is known of the voxels of a lattice, in the bricks where something is.
struct States<'a> {
    lattice: &'a Lattice,
    directory: Directory,
    bricks: Vec<Known>,
}

impl States<'_> {
    /// Whether a voxel is inside, if that is known.
    fn get(&self, sample: [usize; 3]) -> Option<bool> {
        match self.directory.get(sample.map(|s| s / BRICK_SIDE)) {
            OUTSIDE | INSIDE => None,
            number => {
                let brick = &self.bricks[number as usize];
                bit_of(&brick.known, sample).then(|| bit_of(&brick.inside, sample))
            }
        }
    }

    /// The brick of a voxel, which is made if there is none.
    fn brick(&mut self, sample: [usize; 3]) -> &mut Known {
        let at = sample.map(|s| s / BRICK_SIDE);
        let mut number = self.directory.get(at);
        if number == OUTSIDE {
            number = self.bricks.len() as u32;
            self.bricks.push(Known::default());
            self.directory.set(at, number);
        }
        &mut self.bricks[number as usize]
    }

    fn set(&mut self, sample: [usize; 3], inside: bool) {
        let [x, y, z] = sample.map(|s| s % BRICK_SIDE);
        let brick = self.brick(sample);
        brick.known[z] |= 1 << (8 * y + x);
        brick.inside[z] |= u64::from(inside) << (8 * y + x);
    }

    /// Adds a voxel to a wave, unless it was in one before.
    fn want(&mut self, sample: [usize; 3], wave: &mut Vec<usize>) {
        let [x, y, z] = sample.map(|s| s % BRICK_SIDE);
        let wanted = &mut self.brick(sample).wanted[z];
        let bit = 1 << (8 * y + x);
        if *wanted & bit == 0 {
            *wanted |= bit;
            wave.push(self.lattice.index(sample));
        }
    }

    /// The voxels in which some of a shape is.
    fn seeds(&mut self, shape: &Shape) -> Vec<usize> {
        let lattice = *self.lattice;
        let (mut wave, mut last) = (Vec::new(), [-1; 3]);
        let corner = lattice.origin - 0.5 * lattice.spacing;
        let counts = Vec3::from_array(lattice.counts.map(|count| count as f64));
        let limits = Aabb { min: corner, max: corner + lattice.spacing * counts }
            .padded(lattice.spacing.max_element());
        for_each_cell_of_shape(shape, corner, lattice.spacing, &limits, &mut |cell| {
            let sample = cell.map(|c| usize::try_from(c).unwrap_or(usize::MAX));
            if cell != last && (0..3).all(|axis| sample[axis] < lattice.counts[axis]) {
                self.want(sample, &mut wave);
            }
            last = cell;
        });
        wave
    }

    /// Unknown neighbours of both sides of every change of state that the last wave has found.
    fn beyond(&mut self, wave: &[usize]) -> Vec<usize> {
        let lattice = *self.lattice;
        let mut next = Vec::new();
        for &index in wave {
            let sample = lattice.sample(index);
            let state = self.get(sample);
            for other in neighbours(&lattice, sample) {
                let found = self.get(other);
                if found.is_some() && found != state {
                    let around = neighbours(&lattice, sample).chain(neighbours(&lattice, other));
                    around.for_each(|s| self.want(s, &mut next));
                }
            }
        }
        next
    }

    /// The bricks of all voxels. What is still unknown is cut off from the level set by known samples of one state: it has the
    /// state of the sample before it.
    fn filled(self, first: impl FnOnce() -> bool) -> Result<VoxelBricks, OutOfMemory> {
        let mut done = VoxelBricks::outside(self.lattice)?;
        let first = self.get([0; 3]).unwrap_or_else(first);
        let [nx, ny, nz] = self.directory.bricks();
        for brick in (0..nx * ny * nz).map(|b| [b % nx, b / nx % ny, b / (nx * ny)]) {
            let corner = brick.map(|b| b * BRICK_SIDE);
            match self.directory.get(brick) {
                OUTSIDE | INSIDE => {
                    if before(corner).map_or(first, |s| done.get(s)) {
                        done.fill_brick(brick);
                    }
                }
                number => {
                    let Known { known, mut inside, .. } = self.bricks[number as usize];
                    let unknown = mask_of_brick(self.lattice, brick);
                    for z in 0..BRICK_SIDE {
                        for place in ones(unknown[z] & !known[z]) {
                            let within = [place % BRICK_SIDE, place / BRICK_SIDE, z];
                            let sample = [0, 1, 2].map(|axis| corner[axis] + within[axis]);
                            let state = before(sample).map_or(first, |s| {
                                let is_here = (0..3).all(|axis| s[axis] >= corner[axis]);
                                if is_here { bit_of(&inside, s) } else { done.get(s) }
                            });
                            inside[z] |= u64::from(state) << place;
                        }
                    }
                    done.set_brick(brick, inside);
                }
            }
        }
        Ok(done.finished())
    }
}

pub(super) fn along_the_level_set(
    field: &WindingField,
    lattice: &Lattice,
    threshold: f64,
    monitor: &dyn Monitor,
) -> Result<VoxelBricks, VoxelError> {
    let mut states = States { lattice, directory: Directory::new(lattice)?, bricks: Vec::new() };
    if lattice.is_empty() {
        return Ok(VoxelBricks::outside(lattice)?);
    }
    let mut wave = states.seeds(field.shape());
    // How far it has to go is not known.
    let undetermined = |_: f64, _: &str| monitor.report(0.0, "voxels").is_ok();
    undetermined.report(0.0, "voxels")?;
    while !wave.is_empty() {
        for some in wave.chunks(AT_ONCE) {
            let points: Vec<Vec3> = some.iter().map(|i| lattice.point(lattice.sample(*i))).collect();
            let inside = field.classify(&points, threshold, &undetermined)?;
            some.iter().zip(inside).for_each(|(index, inside)| states.set(lattice.sample(*index), inside));
        }
        wave = states.beyond(&wave);
    }
    let first = || field.exceeds(lattice.origin, threshold, &mut Scratch::default());
    let bricks = states.filled(first)?;
    monitor.report(1.0, "voxels")?;
    Ok(bricks)
}

/// The samples next to one along the three axes.
fn neighbours(lattice: &Lattice, sample: [usize; 3]) -> impl Iterator<Item = [usize; 3]> + use<> {
    let counts = lattice.counts;
    (0..6).filter_map(move |k| {
        let (axis, mut other) = (k / 2, sample);
        other[axis] = if k % 2 == 1 { other[axis] + 1 } else { other[axis].wrapping_sub(1) };
        (other[axis] < counts[axis]).then_some(other)
    })
}

/// The sample before one along the first axis along which there is one.
fn before(mut sample: [usize; 3]) -> Option<[usize; 3]> {
    let axis = (0..3).find(|axis| sample[*axis] > 0)?;
    sample[axis] -= 1;
    Some(sample)
}
