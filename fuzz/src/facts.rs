//! What results are held to.
use fast_winding::data::{Cancelled, Monitor, SurfaceMesh};
use fast_winding::math::Vec3;
use std::cell::Cell;
use std::collections::HashMap;

/// Asserts that progress rises from 0 to 1 at most; cancels after some reports if told to.
pub struct Watch {
    left: Cell<usize>,
    told: Cell<f64>,
}

impl Watch {
    /// `cancelled_after` reports; 0 for never.
    pub fn new(cancelled_after: u8) -> Watch {
        let left = if cancelled_after == 0 { usize::MAX } else { usize::from(cancelled_after) };
        Watch { left: Cell::new(left), told: Cell::new(0.0) }
    }
}

impl Monitor for Watch {
    fn report(&self, fraction: f64, stage: &str) -> Result<(), Cancelled> {
        assert!((0.0..=1.0).contains(&fraction), "progress of {fraction} in {stage}");
        assert!(
            fraction >= self.told.get(),
            "progress falls from {} to {fraction} in {stage}",
            self.told.get()
        );
        self.told.set(fraction);
        self.left.set(self.left.get().saturating_sub(1));
        if self.left.get() == 0 { Err(Cancelled) } else { Ok(()) }
    }
}

/// How often each edge is run through in one direction more than in the other; only edges of which that is not 0.
pub fn imbalance<V: Copy + Eq + std::hash::Hash + Ord>(
    triangles: impl Iterator<Item = [V; 3]>,
) -> HashMap<[V; 2], i32> {
    let mut balance = HashMap::new();
    for [a, b, c] in triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if from != to {
                *balance.entry([from.min(to), from.max(to)]).or_insert(0) += if from < to { 1 } else { -1 };
            }
        }
    }
    balance.retain(|_, sum| *sum != 0);
    balance
}

pub fn assert_closed(triangles: &[[u32; 3]], what: &str) {
    let open = imbalance(triangles.iter().copied());
    assert!(open.is_empty(), "{what} is open at {} edges, such as {:?}", open.len(), open.iter().next());
}

/// Asserts that indices name vertices, vertices are finite and no edge is used twice in a direction.
pub fn assert_manifold(positions: &[Vec3], triangles: &[[u32; 3]], what: &str) {
    assert!(positions.iter().all(|p| p.is_finite()), "{what} has a vertex that is not finite");
    let mut directed = std::collections::HashSet::new();
    for [a, b, c] in triangles {
        assert!(
            [a, b, c].iter().all(|v| (**v as usize) < positions.len()),
            "{what} has an index out of range"
        );
        for edge in [[a, b], [b, c], [c, a]] {
            assert!(directed.insert(edge), "{what} uses the edge {edge:?} twice in one direction");
        }
    }
}

pub fn assert_closed_manifold(mesh: &SurfaceMesh, what: &str) {
    assert_manifold(&mesh.positions, &mesh.triangles, what);
    assert_closed(&mesh.triangles, what);
}

/// Whether coordinates are the same, −0 and 0 too.
pub fn place(p: Vec3) -> [u64; 3] {
    (p + Vec3::ZERO).to_array().map(f64::to_bits)
}
