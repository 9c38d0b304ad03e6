//! Seams drawn by hand: the cheapest way along edges from one picked vertex to the next (Schier et al. 2018, section 6).
use crate::data::{SurfaceMesh, sorted_pairs};
use crate::math::Vec3;
use rustc_hash::FxHashSet;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What an edge costs, in mean edges: its length, and the weights α and β of the paper times how little the surface bends at its ends
/// and how much the bend changes between them, both in largest bends of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamCost {
    /// α.
    pub curvature: f64,
    /// β.
    pub change: f64,
}

impl Default for SeamCost {
    fn default() -> Self {
        SeamCost { curvature: 2.0, change: 1.0 }
    }
}

/// Why there is no such seam.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SeamError {
    #[error("a seam goes through vertex {vertex}, but the proxy has only {vertices}")]
    NoSuchVertex { vertex: u32, vertices: usize },
    #[error("weights of a seam must be finite and not negative: they are {0} and {1}")]
    BadWeights(f64, f64),
    #[error("there is no way from vertex {from} to vertex {to} that no earlier part of the seam has used")]
    NoWay { from: u32, to: u32 },
}

/// The edges of the seam through picked vertices, in order, each as it is run through. Edges of earlier parts are not used again
/// (Dijkstra 1959 with infinite weights there); a vertex that follows itself adds nothing.
///
/// # Errors
/// If and only if a vertex does not exist, a weight is negative or not finite, or no way is left.
pub fn seam_through(mesh: &SurfaceMesh, picks: &[u32], cost: &SeamCost) -> Result<Vec<[u32; 2]>, SeamError> {
    let vertices = mesh.positions.len();
    if let Some(vertex) = picks.iter().copied().find(|v| *v as usize >= vertices) {
        return Err(SeamError::NoSuchVertex { vertex, vertices });
    }
    let is_weight = |w: f64| w.is_finite() && w >= 0.0;
    if !(is_weight(cost.curvature) && is_weight(cost.change)) {
        return Err(SeamError::BadWeights(cost.curvature, cost.change));
    }
    let graph = Graph::new(mesh, cost);
    let mut used = FxHashSet::default();
    let mut seam: Vec<[u32; 2]> = Vec::new();
    for ends in picks.windows(2).filter(|ends| ends[0] != ends[1]) {
        let way = graph.way([ends[0], ends[1]], &used)?;
        used.extend(way.iter().map(|[a, b]| [*a.min(b), *a.max(b)]));
        seam.extend(way);
    }
    Ok(seam)
}

/// Cotangent Laplacians at all vertices, in units of one over length where it is divided by a third of the area around: mean curvature
/// normals (Pinkall & Polthier 1993).
fn laplacians(mesh: &SurfaceMesh) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::ZERO, 0.0); mesh.positions.len()];
    for t in &mesh.triangles {
        let corners = t.map(|v| mesh.positions[v as usize]);
        let doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        if doubled <= 0.0 {
            continue;
        }
        for k in 0..3 {
            let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            let cotangent = (b - a).dot(c - a) / doubled;
            let (one, other) = (t[(k + 1) % 3] as usize, t[(k + 2) % 3] as usize);
            sums[one].0 += 0.5 * cotangent * (c - b);
            sums[other].0 += 0.5 * cotangent * (b - c);
            sums[t[k] as usize].1 += doubled / 6.0;
        }
    }
    sums.into_iter().map(|(sum, area)| if area > 0.0 { sum / area } else { Vec3::ZERO }).collect()
}

struct Graph {
    starts: Vec<u32>,
    /// Neighbours and what the edges to them cost.
    edges: Vec<(u32, f64)>,
}

impl Graph {
    fn new(mesh: &SurfaceMesh, weights: &SeamCost) -> Graph {
        let bends = laplacians(mesh);
        let largest = bends.iter().map(|b| b.length()).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let mut pairs: Vec<[u32; 2]> = mesh
            .triangles
            .iter()
            .flat_map(|t| (0..3).flat_map(|k| [[t[k], t[(k + 1) % 3]], [t[(k + 1) % 3], t[k]]]))
            .collect();
        pairs = sorted_pairs(pairs);
        pairs.dedup();
        let length = |[a, b]: [u32; 2]| mesh.positions[a as usize].distance(mesh.positions[b as usize]);
        let mean = pairs.iter().map(|p| length(*p)).sum::<f64>() / pairs.len().max(1) as f64;
        let cost = |[a, b]: [u32; 2]| {
            let (x, y) = (bends[a as usize], bends[b as usize]);
            length([a, b]) / mean.max(f64::MIN_POSITIVE)
                + weights.curvature * (1.0 - (x.length() + y.length()) / (2.0 * largest))
                + weights.change * (x - y).length() / largest
        };
        let mut starts = vec![0u32; mesh.positions.len() + 1];
        pairs.iter().for_each(|[a, _]| starts[*a as usize + 1] += 1);
        (0..mesh.positions.len()).for_each(|v| starts[v + 1] += starts[v]);
        Graph { starts, edges: pairs.iter().map(|pair| (pair[1], cost(*pair))).collect() }
    }

    fn way(&self, [from, to]: [u32; 2], used: &FxHashSet<[u32; 2]>) -> Result<Vec<[u32; 2]>, SeamError> {
        let count = self.starts.len() - 1;
        let (mut costs, mut before) = (vec![f64::INFINITY; count], vec![u32::MAX; count]);
        let mut queue = BinaryHeap::from([Reverse((0u64, from))]);
        costs[from as usize] = 0.0;
        while let Some(Reverse((cost, vertex))) = queue.pop() {
            if vertex == to {
                break;
            }
            if f64::from_bits(cost) > costs[vertex as usize] {
                continue;
            }
            let edges = self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize;
            for (next, step) in &self.edges[edges] {
                let way = f64::from_bits(cost) + step;
                let is_free = !used.contains(&[vertex.min(*next), vertex.max(*next)]);
                if is_free && way < costs[*next as usize] {
                    costs[*next as usize] = way;
                    before[*next as usize] = vertex;
                    queue.push(Reverse((way.to_bits(), *next)));
                }
            }
        }
        if !costs[to as usize].is_finite() {
            return Err(SeamError::NoWay { from, to });
        }
        let mut way = Vec::new();
        let mut at = to;
        while at != from {
            way.push([before[at as usize], at]);
            at = before[at as usize];
        }
        way.reverse();
        Ok(way)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of n × n squares, bent by a right angle along its middle row.
    fn roof(n: u32) -> SurfaceMesh {
        let place = |k: u32| {
            let (x, y) = (f64::from(k % (n + 1)), f64::from(k / (n + 1)));
            Vec3::new(x, y, -(y - f64::from(n / 2)).abs())
        };
        let quad = |k: u32| {
            let v = k / n * (n + 1) + k % n;
            [[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]
        };
        let triangles = (0..n * n).flat_map(quad).collect();
        SurfaceMesh::with_face_normals((0..(n + 1) * (n + 1)).map(place).collect(), triangles)
    }

    #[test]
    fn a_seam_keeps_to_the_ridge_and_never_goes_back() {
        let mesh = roof(10);
        // From the left of the ridge's row to its right: along it.
        let (left, right) = (5 * 11 + 1, 5 * 11 + 9);
        let seam = seam_through(&mesh, &[left, right], &SeamCost::default()).unwrap();
        let ridge: Vec<[u32; 2]> = (left..right).map(|v| [v, v + 1]).collect();
        assert_eq!(seam, ridge);
        // There and back: no edge twice.
        let both = seam_through(&mesh, &[left, right, left], &SeamCost::default()).unwrap();
        let edges: FxHashSet<[u32; 2]> = both.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
        assert_eq!(edges.len(), both.len());
        assert!(both.windows(2).all(|pair| pair[0][1] == pair[1][0]));
    }

    #[test]
    fn what_cannot_be_a_seam_is_refused() {
        let mesh = roof(2);
        let cost = SeamCost::default();
        let no_vertex = SeamError::NoSuchVertex { vertex: 9, vertices: 9 };
        assert_eq!(seam_through(&mesh, &[0, 9], &cost), Err(no_vertex));
        let negative = SeamCost { curvature: -1.0, change: 0.0 };
        assert_eq!(seam_through(&mesh, &[0, 8], &negative), Err(SeamError::BadWeights(-1.0, 0.0)));
        // One triangle: a third way between the same corners does not exist.
        let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let triangle = SurfaceMesh::with_face_normals(corners, vec![[0, 1, 2]]);
        let thrice = seam_through(&triangle, &[0, 1, 0, 1], &cost);
        assert_eq!(thrice, Err(SeamError::NoWay { from: 0, to: 1 }));
        assert_eq!(seam_through(&mesh, &[4, 4], &cost), Ok(vec![]));
    }
}
