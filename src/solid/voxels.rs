use super::voxel_surface;
use crate::data::{
    Cancelled, Lattice, LatticeError, Monitor, OutOfMemory, SurfaceMesh, fill_in_blocks, zeroed,
};
use crate::levelset::cells_of_shape;
use crate::winding::{FieldError, Scratch, WindingField};

/// Which samples are asked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VoxelMethod {
    /// Every one.
    #[default]
    Lattice,
    /// Those that hold geometry and, from there, all along the level set; the rest is filled in
    /// (Barill et al. 2018, implementation details). Much faster at high resolution; parts of the level set that come
    /// near no triangle or point are missed.
    Continuation,
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
        VoxelConfig { threshold: 0.5, method: VoxelMethod::Lattice }
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

/// Cells of a lattice, each inside or outside; one bit for each.
#[derive(Clone, Debug, PartialEq)]
pub struct Voxels {
    lattice: Lattice,
    bits: Vec<u8>,
}

impl Voxels {
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// Whether voxel (i, j, k) is inside.
    pub fn get(&self, sample: [usize; 3]) -> bool {
        self.at(self.lattice.index(sample))
    }

    fn at(&self, index: usize) -> bool {
        self.bits[index / 8] >> (index % 8) & 1 == 1
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

    /// The faces between inside and outside as a mesh: each vertex once, two triangles for each face, none inside.
    pub fn surface(&self) -> SurfaceMesh {
        voxel_surface::exposed_faces(self)
    }
}

/// Which cells of a lattice are inside: w ≥ threshold at the cell's centre.
///
/// # Errors
/// If and only if the threshold is not finite, the monitor cancels, or the voxels do not fit in memory.
pub fn voxelize(
    field: &WindingField,
    lattice: &Lattice,
    config: &VoxelConfig,
    monitor: &dyn Monitor,
) -> Result<Voxels, VoxelError> {
    if !config.threshold.is_finite() {
        return Err(VoxelError::BadThreshold(config.threshold));
    }
    let bits = match config.method {
        VoxelMethod::Lattice => {
            let named = |fraction: f64, _: &str| monitor.report(fraction, "voxels").is_ok();
            field.classify_lattice(lattice, config.threshold, &named)?
        }
        VoxelMethod::Continuation => along_the_level_set(field, lattice, config.threshold, monitor)?,
    };
    Ok(Voxels { lattice: *lattice, bits })
}

#[derive(Clone, Copy, Default, PartialEq, Eq)]
enum State {
    #[default]
    Unknown,
    Outside,
    Inside,
}

fn along_the_level_set(
    field: &WindingField,
    lattice: &Lattice,
    threshold: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<u8>, VoxelError> {
    let mut states = zeroed::<State>(lattice.len())?;
    field.prepare_single_points();
    let corner = lattice.origin - 0.5 * lattice.spacing;
    let mut wave: Vec<usize> = cells_of_shape(field.shape(), corner, lattice.spacing)
        .into_iter()
        .filter_map(|c| index_of(lattice, c))
        .collect();
    while !wave.is_empty() {
        let mut found = zeroed::<bool>(wave.len())?;
        let inside = |i: usize, scratch: &mut Scratch| {
            field.exceeds(lattice.point(lattice.sample(wave[i])), threshold, scratch)
        };
        let undetermined = |_: f64, stage: &str| monitor.report(0.0, stage).is_ok();
        fill_in_blocks(&mut found, inside, "voxels", &undetermined)?;
        for (&index, inside) in wave.iter().zip(found) {
            states[index] = if inside { State::Inside } else { State::Outside };
        }
        wave = beyond(lattice, &states, &wave);
    }
    fill_unknown(field, lattice, threshold, &mut states);
    let mut bits = zeroed(lattice.len().div_ceil(8))?;
    for (byte, eight) in bits.iter_mut().zip(states.chunks(8)) {
        *byte = eight.iter().rev().fold(0, |bits, s| bits << 1 | u8::from(*s == State::Inside));
    }
    monitor.report(1.0, "voxels")?;
    Ok(bits)
}

fn index_of(lattice: &Lattice, cell: [i32; 3]) -> Option<usize> {
    let sample = cell.map(|c| usize::try_from(c).unwrap_or(usize::MAX));
    sample.iter().zip(lattice.counts).all(|(s, n)| *s < n).then(|| lattice.index(sample))
}

/// The samples next to `index` along the three axes.
fn neighbours(lattice: &Lattice, index: usize) -> impl Iterator<Item = usize> + use<> {
    let (sample, counts) = (lattice.sample(index), lattice.counts);
    let steps = [1, counts[0], counts[0] * counts[1]];
    (0..6).filter_map(move |k| {
        let (axis, up) = (k / 2, k % 2 == 1);
        match up {
            true => (sample[axis] + 1 < counts[axis]).then(|| index + steps[axis]),
            false => (sample[axis] > 0).then(|| index - steps[axis]),
        }
    })
}

/// Unknown neighbours of both sides of every change of state that the last wave has found.
fn beyond(lattice: &Lattice, states: &[State], wave: &[usize]) -> Vec<usize> {
    let mut next = Vec::new();
    for &index in wave {
        for other in neighbours(lattice, index) {
            if states[other] != State::Unknown && states[other] != states[index] {
                next.extend(neighbours(lattice, index).chain(neighbours(lattice, other)));
            }
        }
    }
    next.retain(|&i| states[i] == State::Unknown);
    next.sort_unstable();
    next.dedup();
    next
}

/// What is still unknown is cut off from the level set by known samples of one state: it has that state.
fn fill_unknown(field: &WindingField, lattice: &Lattice, threshold: f64, states: &mut [State]) {
    let steps = [1, lattice.counts[0], lattice.counts[0] * lattice.counts[1]];
    for index in 0..states.len() {
        if states[index] == State::Unknown {
            let sample = lattice.sample(index);
            let before = (0..3).find(|&axis| sample[axis] > 0).map(|axis| states[index - steps[axis]]);
            states[index] = before.unwrap_or_else(|| {
                let inside = field.exceeds(lattice.point(sample), threshold, &mut Scratch::default());
                if inside { State::Inside } else { State::Outside }
            });
        }
    }
}
