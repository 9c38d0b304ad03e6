//! A cap with triangles as large as those around it, moved to the level set (refinement of Liepa 2003, *Filling Holes in Meshes*).
use super::edges::sides_with_length;
use crate::data::{Monitor, by_edge, edge_key, ends, opposite};
use crate::math::{Vec3, area_vector, barycentre};
use crate::winding::{Accuracy, FieldError, THRESHOLD, WindingField};

/// Rounds in which triangles are divided, edges flipped.
const ROUNDS: usize = 12;
const FLIPS: usize = 8;
/// A triangle is divided whose middle is farther from its corners than the lengths of edges there, over this.
const DENSITY: f64 = std::f64::consts::SQRT_2;
/// Most vertices put into a cap.
const MOST: usize = 20_000;
/// Times that vertices are moved to the middle of their neighbours, and to the level set after.
const SMOOTHED: usize = 60;
const MOVED: usize = 12;
/// How exactly w is known where vertices are moved.
const TOLERANCE: f64 = 1e-4;

/// Triangles over the points of a rim and those within.
pub struct Cap {
    /// Those of the rim first.
    pub points: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    /// How many points the rim has.
    pub rim: usize,
}

impl Cap {
    /// Divides triangles until edges are as long as those of the rim nearby.
    pub fn refine(&mut self) {
        let rim = &self.points[..self.rim];
        let length = |k: usize| rim[k].distance(rim[(k + 1) % self.rim]);
        let mut lengths: Vec<f64> =
            (0..self.rim).map(|k| 0.5 * (length(k) + length((k + self.rim - 1) % self.rim))).collect();
        for _ in 0..ROUNDS {
            let before = self.points.len();
            for t in 0..self.triangles.len() {
                self.divide(t, &mut lengths);
            }
            if self.points.len() == before || self.points.len() > MOST {
                break;
            }
            (0..FLIPS).take_while(|_| self.flip() > 0).count();
        }
    }

    fn divide(&mut self, t: usize, lengths: &mut Vec<f64>) {
        let [a, b, c] = self.triangles[t];
        let middle = barycentre([a, b, c].map(|v| self.points[v as usize]));
        let length = [a, b, c].iter().map(|v| lengths[*v as usize]).sum::<f64>() / 3.0;
        let is_far = |v: u32| {
            let distance = DENSITY * middle.distance(self.points[v as usize]);
            distance > length && distance > lengths[v as usize]
        };
        if [a, b, c].into_iter().all(is_far) {
            let new = self.points.len() as u32;
            self.points.push(middle);
            lengths.push(length);
            self.triangles[t] = [a, b, new];
            self.triangles.extend([[b, c, new], [c, a, new]]);
        }
    }

    /// Flips edges within to the diagonal opposite to the smaller angles; how many.
    fn flip(&mut self) -> usize {
        let sides = sides_with_length(&self.triangles);
        let has_edge = |a: u32, b: u32| sides.binary_search_by_key(&edge_key(a, b), |s| s.0).is_ok();
        let mut is_touched = vec![false; self.triangles.len()];
        let mut new_edges = std::collections::BTreeSet::new();
        let mut flipped = 0;
        for pair in by_edge(&sides).filter(|sides| sides.len() == 2) {
            let [one, other] = [pair[0].1, pair[1].1];
            let [t, u] = [one as usize / 3, other as usize / 3];
            if is_touched[t] || is_touched[u] {
                continue;
            }
            let [a, b] = ends(&self.triangles, one);
            let [c, d] = [one, other].map(|side| opposite(&self.triangles, side));
            let new = edge_key(c, d);
            if c == d || has_edge(c, d) || new_edges.contains(&new) || !self.is_better_flipped(a, b, c, d) {
                continue;
            }
            (self.triangles[t], self.triangles[u]) = ([c, d, b], [d, c, a]);
            (is_touched[t], is_touched[u]) = (true, true);
            new_edges.insert(new);
            flipped += 1;
        }
        flipped
    }

    /// Whether triangles abc and bad are better cut from c to d: the angles there are more than half a turn, and none is turned over.
    fn is_better_flipped(&self, a: u32, b: u32, c: u32, d: u32) -> bool {
        let [a, b, c, d] = [a, b, c, d].map(|v| self.points[v as usize]);
        let cosine = |top: Vec3| (a - top).normalize_or_zero().dot((b - top).normalize_or_zero());
        // cos γ + cos δ < 0 if and only if γ + δ > π.
        if cosine(c) + cosine(d) >= -1e-9 {
            return false;
        }
        let before = area_vector([a, b, c]) + area_vector([b, a, d]);
        [[c, d, b], [d, c, a]].into_iter().all(|t| area_vector(t).dot(before) > 0.0)
    }

    /// Smooths the points within, and moves them to where w is a half, each no farther than the edges around it are long; those that
    /// do not get there stay.
    pub fn settle(&mut self, field: &WindingField, monitor: &dyn Monitor) -> Result<(), FieldError> {
        let count = self.points.len() - self.rim;
        if count == 0 {
            return Ok(());
        }
        let around = self.neighbours();
        let middle = |points: &[Vec3], k: usize| {
            around[k].iter().map(|v| points[*v as usize]).sum::<Vec3>() / around[k].len() as f64
        };
        for _ in 0..SMOOTHED {
            (0..count).for_each(|k| self.points[self.rim + k] = middle(&self.points, k));
        }
        let smooth = self.points[self.rim..].to_vec();
        let reach: Vec<f64> = (0..count)
            .map(|k| {
                let place = smooth[k];
                around[k].iter().map(|v| place.distance(self.points[*v as usize])).fold(0.0, f64::max)
            })
            .collect();
        let accuracy = Accuracy::Tolerance(TOLERANCE);
        for _ in 0..MOVED {
            let places = self.points[self.rim..].to_vec();
            let values = field.evaluate(&places, accuracy, monitor)?;
            let slopes = field.gradients(&places, accuracy, monitor)?;
            for k in 0..count {
                let steep = slopes[k].length_squared();
                let step = (THRESHOLD - values[k]) / steep * slopes[k];
                let step = if step.is_finite() { step.clamp_length_max(0.5 * reach[k]) } else { Vec3::ZERO };
                self.points[self.rim + k] = places[k] + step;
            }
        }
        let places = self.points[self.rim..].to_vec();
        let values = field.evaluate(&places, accuracy, monitor)?;
        for k in 0..count {
            if (values[k] - THRESHOLD).abs() > 0.01 || places[k].distance(smooth[k]) > 8.0 * reach[k] {
                self.points[self.rim + k] = smooth[k];
            }
        }
        Ok(())
    }

    /// The points that share an edge with each one within.
    fn neighbours(&self) -> Vec<Vec<u32>> {
        let mut around = vec![Vec::new(); self.points.len() - self.rim];
        for [a, b, c] in &self.triangles {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                // Each edge at a point within has two sides, of which one leaves it.
                if let Some(k) = (*from as usize).checked_sub(self.rim) {
                    around[k].push(*to);
                }
            }
        }
        around
    }
}
