//! Triangles that overlap in a plane get the same pieces where they do.
use super::LEAF;
use super::refine::Work;
use super::triangulate::shares;
use crate::bvh::Bvh;
use crate::data::{Cancelled, Monitor};
use crate::math::{Aabb, Twofold};

/// Places nearer to an edge than this share of the triangle's height lie on it.
const RIM: f64 = 1e-12;

impl Work<'_> {
    /// Cuts each triangle of the pairs as the other is where they overlap, and those that this changes in turn.
    pub fn share_cuts(&mut self, pairs: &[[u32; 2]], monitor: &dyn Monitor) -> Result<(), Cancelled> {
        // Each round takes cuts one triangle farther.
        const ROUNDS: usize = 16;
        for _ in 0..ROUNDS {
            let (mut segments, mut inside) = (Vec::new(), Vec::new());
            for [from, to] in pairs.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]) {
                if !self.is_cut(from) {
                    continue;
                }
                for ends in self.segments_of(from) {
                    let is_known = self.segments.binary_search(&(to, ends)).is_ok();
                    if !is_known && self.holds_middle(to, ends) {
                        segments.push((to, ends));
                    }
                }
                for point in self.inside_of(from) {
                    if self.inside.binary_search(&(to, point)).is_err() && self.holds_middle(to, [point; 2]) {
                        inside.push((to, point));
                    }
                }
            }
            if segments.is_empty() && inside.is_empty() {
                break;
            }
            let dirty = segments.iter().map(|s| s.0).chain(inside.iter().map(|i| i.0)).collect();
            self.segments.extend(segments);
            self.segments.sort_unstable();
            self.segments.dedup();
            self.inside.extend(inside);
            self.inside.sort_unstable();
            self.inside.dedup();
            self.refine(dirty, monitor)?;
        }
        self.share_pieces(pairs);
        Ok(())
    }

    /// Cuts the higher triangle of each pair into the pieces of the lower where they overlap.
    fn share_pieces(&mut self, pairs: &[[u32; 2]]) {
        let mut pairs: Vec<[u32; 2]> =
            pairs.iter().copied().filter(|[low, high]| self.is_cut(*low) || self.is_cut(*high)).collect();
        pairs.extend(self.neighbours_of_one(&pairs));
        pairs.sort_unstable();
        pairs.dedup();
        let mut involved: Vec<u32> = pairs.iter().flatten().copied().collect();
        involved.sort_unstable();
        involved.dedup();
        let mut wished: std::collections::BTreeMap<u32, Vec<[u32; 2]>> = Default::default();
        for triangle in involved {
            if let Some(wishes) = wished.remove(&triangle) {
                self.wishes = wishes.into_iter().map(|ends| (triangle, ends)).collect();
                self.wishes.sort_unstable();
                self.wishes.dedup();
                let pieces = self.cut(triangle);
                self.pieces.insert(triangle, pieces);
                self.wishes.clear();
            }
            let first = pairs.partition_point(|pair| pair[0] < triangle);
            for [_, higher] in pairs[first..].iter().take_while(|pair| pair[0] == triangle) {
                let Some(pieces) = self.pieces.get(&triangle) else { continue };
                for [a, b, c] in &pieces.triangles {
                    for ends in [[a, b], [b, c], [c, a]].map(|[a, b]| [*a.min(b), *a.max(b)]) {
                        if self.segments.binary_search(&(*higher, ends)).is_err()
                            && self.holds_middle(*higher, ends)
                        {
                            wished.entry(*higher).or_default().push(ends);
                        }
                    }
                }
            }
        }
    }

    /// Pairs of triangles that may overlap each other and a third, though they are not cut along each other: those of one side.
    fn neighbours_of_one(&self, pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
        let mut links: Vec<[u32; 2]> = pairs.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]).collect();
        links.sort_unstable();
        let mut found = Vec::new();
        for of_one in links.chunk_by(|a, b| a[0] == b[0]).filter(|of_one| of_one.len() > 1) {
            let corners = |link: &[u32; 2]| self.corners[link[1] as usize];
            let boxes: Vec<Aabb> = of_one
                .iter()
                .map(|link| Aabb::around(corners(link).map(|v| self.points.positions()[v as usize])))
                .collect();
            let overlaps = Bvh::build(&boxes, LEAF).own_overlaps(&boxes);
            found.extend(overlaps.into_iter().map(|pair| pair.map(|k| of_one[k as usize][1])));
        }
        found.iter_mut().for_each(|pair| pair.sort_unstable());
        found
    }

    fn is_cut(&self, triangle: u32) -> bool {
        self.pieces.contains_key(&triangle)
    }

    /// Whether a triangle holds the middle between two points of its plane, well inside.
    fn holds_middle(&self, triangle: u32, ends: [u32; 2]) -> bool {
        let middle = self.points.between(ends, Twofold::from(0.5));
        let [u, v] = shares(self.corners[triangle as usize], middle, &self.points);
        u > RIM && v > RIM && u + v < 1.0 - RIM
    }
}
