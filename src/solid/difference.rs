use crate::data::{Lattice, VoxelRows, map_tasks};

/// Where two sets of voxels of one lattice differ: places of samples, x fastest, which rise.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VoxelDifference {
    /// Inside the first, outside the second.
    pub lost: Vec<u32>,
    /// Outside the first, inside the second.
    pub gained: Vec<u32>,
}

/// Two sets of voxels are not of one lattice.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("voxels of different lattices cannot be compared: {first:?} and {second:?}")]
pub struct DifferentLattices {
    pub first: Box<Lattice>,
    pub second: Box<Lattice>,
}

impl VoxelDifference {
    /// Number of voxels that differ.
    pub fn count(&self) -> usize {
        self.lost.len() + self.gained.len()
    }

    /// |A ∧ B| / |A ∨ B|, given the number of voxels inside the first; 1 if none is inside either.
    pub fn intersection_over_union(&self, first: usize) -> f64 {
        let union = first + self.gained.len();
        if union == 0 { 1.0 } else { (first - self.lost.len()) as f64 / union as f64 }
    }
}

/// Which voxels change from one set to another.
///
/// # Errors
/// If and only if they are not of one lattice.
pub fn difference(
    first: &dyn VoxelRows,
    second: &dyn VoxelRows,
) -> Result<VoxelDifference, DifferentLattices> {
    let lattice = *first.lattice();
    if lattice != *second.lattice() {
        return Err(DifferentLattices { first: Box::new(lattice), second: Box::new(*second.lattice()) });
    }
    let [nx, ny, nz] = lattice.counts;
    let planes = map_tasks(nz, |k| {
        let mut found = VoxelDifference::default();
        let (mut a, mut b) = (vec![0; nx], vec![0; nx]);
        for j in 0..ny {
            first.row([0, j, k], &mut a);
            second.row([0, j, k], &mut b);
            if a == b {
                continue;
            }
            for i in (0..nx).filter(|i| a[*i] != b[*i]) {
                let changed = if a[i] == 1 { &mut found.lost } else { &mut found.gained };
                changed.push(lattice.index([i, j, k]) as u32);
            }
        }
        found
    });
    let mut all = VoxelDifference::default();
    for plane in planes {
        all.lost.extend(plane.lost);
        all.gained.extend(plane.gained);
    }
    Ok(all)
}
