//! What the field says of the volume: where it is ambiguous, and where it counts more than once or inside out.
use super::report::{Bounds, FieldCheck, List, Region, RegionKind};
use crate::data::{Lattice, Monitor, Parts, Sets};
use crate::math::{Aabb, Vec3};
use crate::winding::{Accuracy, FieldError, WindingField};

/// How far w may be from an integer.
const MARGIN: f64 = 0.1;

/// What kind of defect a value of w is, if any.
fn kind(w: f64) -> Option<RegionKind> {
    if w > MARGIN && w < 1.0 - MARGIN {
        Some(RegionKind::Ambiguous)
    } else if w >= 2.0 - MARGIN {
        Some(RegionKind::Overlap)
    } else if w <= MARGIN - 1.0 {
        Some(RegionKind::Inverted)
    } else {
        None
    }
}

/// Volumes of a cell: solid, and of each kind of defect.
#[derive(Clone, Copy, Default)]
struct Volumes {
    solid: f64,
    defects: [f64; 3],
}

impl Volumes {
    fn add(&mut self, w: f64, volume: f64) {
        self.solid += if w >= 0.5 - 1e-9 { volume } else { 0.0 };
        if let Some(kind) = kind(w) {
            self.defects[kind as usize] += volume;
        }
    }
}

/// Judges the volume of the bounds by `resolution` cells along the longest side; nothing if that is 0, or the bounds are flat.
pub fn field_check(
    field: &WindingField,
    resolution: usize,
    limit: usize,
    monitor: &dyn Monitor,
) -> Result<Option<FieldCheck>, FieldError> {
    let bounds = field.bounds();
    let size = bounds.size();
    if resolution == 0 || size.min_element() <= 0.0 {
        return Ok(None);
    }
    let cell = size.max_element() / resolution as f64;
    let counts = Lattice::cells_over(bounds, cell).1.to_array().map(|c| c as usize);
    // The cells fill the bounds exactly.
    let lattice = Lattice::with_counts(bounds, counts)?;
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.6);
    let values = field.evaluate_lattice(&lattice, Accuracy::default(), monitor)?.values;
    let mut cells = vec![Volumes::default(); lattice.len()];
    let class = |w: f64| (kind(w), w >= 0.5 - 1e-9);
    let mut mixed = Vec::new();
    for (index, cell) in cells.iter_mut().enumerate() {
        let own = class(values[index]);
        if neighbours(&lattice, index).any(|other| class(values[other]) != own) {
            mixed.push(index);
        } else {
            cell.add(values[index], lattice.cell_volume());
        }
    }
    let parts = |index: &usize| {
        let middle = lattice.point(lattice.sample(*index));
        (0..8u32).map(move |k| {
            let side = |axis: u32| if k >> axis & 1 == 1 { 0.25 } else { -0.25 };
            middle + lattice.spacing * Vec3::new(side(0), side(1), side(2))
        })
    };
    let points: Vec<Vec3> = mixed.iter().flat_map(parts).collect();
    monitor.begin(0.6, 1.0);
    let finer = field.evaluate(&points, Accuracy::default(), monitor)?;
    for (index, eight) in mixed.iter().zip(finer.as_chunks::<8>().0) {
        eight.iter().for_each(|w| cells[*index].add(*w, lattice.cell_volume() / 8.0));
    }
    let sum = |of: &dyn Fn(&Volumes) -> f64| cells.iter().map(of).sum::<f64>();
    let defects = [0, 1, 2].map(|kind| sum(&|cell| cell.defects[kind]));
    let box_volume = size.x * size.y * size.z;
    Ok(Some(FieldCheck {
        cell,
        box_volume,
        solid_volume: sum(&|cell| cell.solid),
        ambiguous_volume: defects[0],
        ambiguous_share: defects[0] / box_volume,
        overlap_volume: defects[1],
        inverted_volume: defects[2],
        regions: List::new(regions(&lattice, &values, &cells), limit),
    }))
}

/// The cells beside a cell, across its faces.
fn neighbours(lattice: &Lattice, index: usize) -> impl Iterator<Item = usize> + '_ {
    let at = lattice.sample(index);
    let steps = [1, lattice.counts[0], lattice.counts[0] * lattice.counts[1]];
    (0..3).flat_map(move |axis| {
        let before = (at[axis] > 0).then(|| index - steps[axis]);
        let after = (at[axis] + 1 < lattice.counts[axis]).then(|| index + steps[axis]);
        [before, after].into_iter().flatten()
    })
}

fn regions(lattice: &Lattice, values: &[f64], cells: &[Volumes]) -> Vec<Region> {
    let kinds = [RegionKind::Ambiguous, RegionKind::Overlap, RegionKind::Inverted];
    let mut found = Vec::new();
    for kind in kinds {
        let is_in = |index: usize| cells[index].defects[kind as usize] > 0.0;
        let mut sets = Sets::new(cells.len());
        for index in (0..cells.len()).filter(|index| is_in(*index)) {
            neighbours(lattice, index)
                .filter(|n| *n < index && is_in(*n))
                .for_each(|n| sets.join(index as u32, n as u32));
        }
        let mut of_roots: Vec<(u32, Region)> = Vec::new();
        let mut place = vec![u32::MAX; cells.len()];
        for index in (0..cells.len()).filter(|index| is_in(*index)) {
            let root = sets.find(index as u32);
            let slot = &mut place[root as usize];
            if *slot == u32::MAX {
                *slot = of_roots.len() as u32;
                let bounds = Bounds { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };
                let region =
                    Region { kind, volume: 0.0, bounds, least: f64::INFINITY, greatest: f64::NEG_INFINITY };
                of_roots.push((root, region));
            }
            let region = &mut of_roots[*slot as usize].1;
            let middle = lattice.point(lattice.sample(index));
            let around =
                Aabb { min: Vec3::from_array(region.bounds.min), max: Vec3::from_array(region.bounds.max) };
            let half = 0.5 * lattice.spacing;
            region.bounds = around.including(middle - half).including(middle + half).into();
            region.volume += cells[index].defects[kind as usize];
            region.least = region.least.min(values[index]);
            region.greatest = region.greatest.max(values[index]);
        }
        found.extend(of_roots.into_iter().map(|(_, region)| region));
    }
    found.sort_by(|a, b| b.volume.total_cmp(&a.volume));
    found
}
