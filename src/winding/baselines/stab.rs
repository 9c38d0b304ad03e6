//! Inside by ray stabbing on a lattice, as programs that voxelize do: rays along its rows, which many samples share (the first
//! method of Pimentel, Scrivener & To 2022, without its rays that hit edges).
use crate::data::{Lattice, Monitor, TriangleSoup, bit, byte_of, set_each, zeroed};
use crate::math::Vec3;
use crate::winding::FieldError;
use crate::winding::closure::Closure;
use crate::winding::facets::Facets;
use crate::winding::scan::{SLAB_PLANES, Scan, Slab, for_each_slab};

/// What makes a sample inside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StabCount {
    /// An odd number of crossings, whichever way the triangles face: right off closed surfaces that do not overlap, and wrong
    /// along whole rays elsewhere.
    #[default]
    Parity,
    /// Crossings out of the surface, less those into it, that reach the threshold: right off closed surfaces, overlaps included.
    Signed,
}

/// Which rays are cast, and what is made of their crossings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stabbing {
    pub count: StabCount,
    /// Whether rays along −x, −y and −z vote, two of the three deciding; else there are those along −x alone.
    pub majority: bool,
}

/// Bytes of votes that are counted together.
const BYTES_PER_TASK: usize = 4096;

/// Which samples of a lattice are inside a soup by ray stabbing: one bit for each, lowest first, x fastest. A ray that meets an edge
/// or a vertex crosses there once. On the surface itself either answer may come.
///
/// # Errors
/// If and only if `monitor` cancels or the bits do not fit in memory.
pub fn stab_lattice(
    soup: &TriangleSoup,
    lattice: &Lattice,
    stabbing: Stabbing,
    threshold: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<u8>, FieldError> {
    let is_inside = |crossings: i32| match stabbing.count {
        StabCount::Parity => crossings & 1 == 1,
        StabCount::Signed => f64::from(crossings) >= threshold,
    };
    let axes = if stabbing.majority { 3 } else { 1 };
    let part = |axis: usize| {
        move |fraction: f64, stage: &str| {
            monitor.report((axis as f64 + fraction) / f64::from(axes), stage).is_ok()
        }
    };
    let along_x = stab_rows(soup, lattice, &is_inside, &part(0))?;
    if !stabbing.majority {
        return Ok(along_x);
    }
    let others = [1, 2].map(|axis| {
        let (soup, lattice) = (turned(soup, axis), turned_lattice(lattice, axis));
        stab_rows(&soup, &lattice, &is_inside, &part(axis)).map(|bits| (axis, lattice, bits))
    });
    let [y, z] = others;
    let others = [y?, z?];
    let mut bits = zeroed::<u8>(along_x.len())?;
    set_each(&mut bits, BYTES_PER_TASK, |place, byte| {
        let votes = |k: usize| {
            let index = 8 * place + k;
            let sample = lattice.sample(index.min(lattice.len() - 1));
            let mut votes = i32::from(along_x[place] >> k & 1);
            for (axis, lattice, bits) in &others {
                let index = lattice.index([0, 1, 2].map(|k| sample[(k + axis) % 3]));
                votes += i32::from(bit(bits, index));
            }
            index < lattice.len() && votes >= 2
        };
        *byte = byte_of((0..8).map(votes));
    });
    Ok(bits)
}

fn stab_rows(
    soup: &TriangleSoup,
    lattice: &Lattice,
    is_inside: &(dyn Fn(i32) -> bool + Sync),
    monitor: &dyn Monitor,
) -> Result<Vec<u8>, FieldError> {
    let closure = Closure::default();
    let mut bits = zeroed::<u8>(lattice.len().div_ceil(8))?;
    let scan = Scan::new(Facets { soup, closure: &closure }, 0..soup.len(), lattice);
    let fill = |_: usize, counted: &Slab, bits: &mut [u8]| -> Vec<()> {
        for (byte, crossings) in bits.iter_mut().zip(counted.crossings.chunks(8)) {
            *byte = byte_of(crossings.iter().map(|n| is_inside(*n)));
        }
        vec![]
    };
    const { assert!(SLAB_PLANES.is_multiple_of(8), "the bits of a slab fill bytes") };
    for_each_slab(&scan, 0..lattice.counts[2], &mut bits, 1, fill, "ray stabbing", monitor)?;
    Ok(bits)
}

/// What was along an axis and the two after it, along x, y and z.
fn turned(soup: &TriangleSoup, axis: usize) -> TriangleSoup {
    let turn = |p: &Vec3| Vec3::new(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
    TriangleSoup::new(soup.positions().iter().map(turn).collect(), soup.triangles().to_vec())
        .expect("its triangles are those of a soup")
}

fn turned_lattice(lattice: &Lattice, axis: usize) -> Lattice {
    let turn = |v: Vec3| Vec3::new(v[axis], v[(axis + 1) % 3], v[(axis + 2) % 3]);
    let counts = [0, 1, 2].map(|k| lattice.counts[(k + axis) % 3]);
    Lattice { origin: turn(lattice.origin), spacing: turn(lattice.spacing), counts }
}
