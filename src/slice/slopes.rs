//! How gently a shape slopes at each height, and layers no thicker than that allows.
//!
//! A face of normal n that passes a layer of height h becomes a step whose edge stands h |n_z| off the face: the cusp height of Dolenc
//! and Mäkelä 1994, *Slicing procedures for layered manufacturing techniques*. A horizontal face needs no step where it is the boundary
//! of two layers.
//!
//! Layers are made from the bottom up, each as thick as what it passes allows. Faces are sorted once, and a layer looks at those that
//! begin in it and at the gentlest of those that began below.
use super::plan::SLACK;
use super::{AdaptiveHeights, LayerPlan, PlanError};
use crate::data::{Shape, map_tasks};
use crate::math::area_vector;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::f64::consts::PI;

/// A face that rises less than this share of the least layer height counts as horizontal, and horizontal faces this near as one: far above
/// the rounding of files, which have seven digits, and below what any printer shows.
const LEVEL: f64 = 1e-3;
/// Faces that a task looks at.
const FACES_PER_TASK: usize = 1 << 16;

/// What a layer can pass.
#[derive(Clone, Copy, Debug)]
struct Face {
    low: f64,
    high: f64,
    /// |n_z|: 0 of a wall, 1 of a floor.
    slope: f64,
}

/// The faces of a shape that matter to the heights of its layers.
pub(super) struct Slopes {
    /// Those that slope too gently for the thickest layer, by `low`.
    faces: Vec<Face>,
    /// Heights of horizontal ones, ascending.
    levels: Vec<f64>,
}

impl Slopes {
    /// The triangles of a soup; of a cloud the discs that its points stand for, each of its point's area and normal.
    pub fn of(shape: &Shape, heights: &AdaptiveHeights) -> Slopes {
        let face = |k: usize| face(shape, k);
        // Of a small face only the normal tells whether it is part of a slope.
        let is_level =
            |face: &Face| face.high - face.low <= LEVEL * heights.least && face.slope > 1.0 - LEVEL;
        let is_gentle = |face: &Face| face.slope * heights.most > heights.deviation;
        let parts = map_tasks(shape.len().div_ceil(FACES_PER_TASK), |task| {
            let first = task * FACES_PER_TASK;
            let all = (first..shape.len().min(first + FACES_PER_TASK)).filter_map(face);
            let (flat, sloped): (Vec<Face>, Vec<Face>) = all.partition(is_level);
            let mut levels: Vec<f64> = flat.iter().map(|face| face.high).collect();
            levels.dedup();
            (levels, sloped.into_iter().filter(is_gentle).collect::<Vec<Face>>())
        });
        let (mut levels, mut faces) = (Vec::new(), Vec::new());
        for (some_levels, some_faces) in parts {
            levels.extend(some_levels);
            faces.extend(some_faces);
        }
        faces.sort_by(|a: &Face, b: &Face| a.low.total_cmp(&b.low));
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|next, kept| *next - *kept <= LEVEL * heights.least);
        Slopes { faces, levels }
    }

    /// Tops of layers from `low` to `high`, where the last one ends unless that would be nearer than the least height to the one before.
    ///
    /// Horizontal faces are boundaries of layers, unless that took one thinner than the least height or thicker than the
    /// slopes beside them allow.
    pub fn tops(
        &self,
        low: f64,
        high: f64,
        first: Option<f64>,
        heights: &AdaptiveHeights,
    ) -> Result<Vec<f64>, PlanError> {
        let near = SLACK * heights.least;
        let mut climb = Climb { faces: &self.faces, passed: BinaryHeap::new(), at: low };
        let mut tops = Vec::new();
        let mut top = first.map(|first| low + first);
        while climb.at < high - near {
            let next = top.take().unwrap_or_else(|| {
                let allowed = climb.at + climb.allowed(heights).max(heights.least);
                self.on_levels(climb.at, allowed, high, heights.least)
            });
            tops.push(next);
            if tops.len() > LayerPlan::MAX_LAYERS {
                return Err(PlanError::TooMany(tops.len() as f64));
            }
            climb.to(next);
        }
        Ok(tops)
    }

    /// Where the layer that begins at `bottom` and may reach `allowed` ends: at the next horizontal face, or the least height short of it,
    /// for the layer after to end there.
    fn on_levels(&self, bottom: f64, allowed: f64, high: f64, least: f64) -> f64 {
        let near = SLACK * least;
        let reachable = bottom + least - near;
        let level = self.levels.get(self.levels.partition_point(|z| *z < reachable)).copied();
        let level = level.unwrap_or(high).min(high);
        if level < reachable {
            // The shape ends within less than a layer.
            bottom + least
        } else if level <= allowed + near {
            level
        } else if level - allowed < least && level - least >= reachable {
            level - least
        } else {
            allowed
        }
    }
}

/// The face that a triangle or a point is; `None` of one without a normal.
fn face(shape: &Shape, index: usize) -> Option<Face> {
    match shape {
        Shape::Soup(soup) => {
            let corners = soup.corners(index);
            let [a, b, c] = corners.map(|p| p.z);
            let normal = area_vector(corners).try_normalize()?;
            Some(Face { low: a.min(b).min(c), high: a.max(b).max(c), slope: normal.z.abs() })
        }
        Shape::Cloud(cloud) => {
            let (z, normal) = (cloud.points()[index].z, cloud.normals()[index]);
            let reach = (cloud.areas()[index] / PI).sqrt() * normal.truncate().length();
            Some(Face { low: z - reach, high: z + reach, slope: normal.z.abs() })
        }
    }
}

/// The way up a shape.
struct Climb<'a> {
    /// Those that begin at `at` or above.
    faces: &'a [Face],
    /// Those that begin below: the gentlest first, and some that have ended.
    passed: BinaryHeap<Gentle>,
    at: f64,
}

impl Climb<'_> {
    /// How thick the layer from here may be for all faces in it.
    fn allowed(&self, heights: &AdaptiveHeights) -> f64 {
        let for_slope = |slope: f64| heights.deviation / slope;
        let mut allowed = heights.most;
        if let Some(Gentle(face)) = self.passed.peek() {
            allowed = allowed.min(for_slope(face.slope));
        }
        for face in self.faces {
            let below = face.low - self.at;
            if below >= allowed {
                break;
            }
            // Either it is not reached, or it is passed.
            allowed = allowed.min(for_slope(face.slope).max(below));
        }
        allowed
    }

    fn to(&mut self, at: f64) {
        let (begun, rest) = self.faces.split_at(self.faces.partition_point(|face| face.low < at));
        self.passed.extend(begun.iter().filter(|face| face.high > at).map(|face| Gentle(*face)));
        self.faces = rest;
        self.at = at;
        while self.passed.peek().is_some_and(|gentle| gentle.0.high <= at) {
            self.passed.pop();
        }
    }
}

/// A face in the order of slopes.
struct Gentle(Face);

impl Ord for Gentle {
    fn cmp(&self, other: &Gentle) -> Ordering {
        self.0.slope.total_cmp(&other.0.slope)
    }
}

impl PartialOrd for Gentle {
    fn partial_cmp(&self, other: &Gentle) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Gentle {
    fn eq(&self, other: &Gentle) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Gentle {}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHTS: AdaptiveHeights = AdaptiveHeights { least: 0.1, most: 0.4, deviation: 0.1 };

    fn tops(faces: &[(f64, f64, f64)], levels: &[f64], high: f64) -> Vec<f64> {
        let face = |&(low, high, slope): &(f64, f64, f64)| Face { low, high, slope };
        let slopes = Slopes { faces: faces.iter().map(face).collect(), levels: levels.to_vec() };
        slopes.tops(0.0, high, None, &HEIGHTS).unwrap()
    }

    fn assert_near(found: &[f64], expected: &[f64]) {
        let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(is_near && found.len() == expected.len(), "{found:?} instead of {expected:?}");
    }

    #[test]
    fn layers_stop_where_a_gentler_slope_begins_and_are_thick_after_it() {
        // Up to 0.5 anything goes, from there to 1 half of the thickest, then a face too gentle for the thinnest.
        let found = tops(&[(0.5, 1.0, 0.5), (1.0, 1.15, 2.0)], &[], 2.0);
        assert_near(&found, &[0.4, 0.6, 0.8, 1.0, 1.1, 1.2, 1.6, 2.0]);
    }

    #[test]
    fn a_slope_that_begins_below_counts_until_it_ends() {
        let found = tops(&[(0.0, 1.0, 0.5), (0.1, 0.3, 1.0), (0.1, 0.2, 0.25)], &[], 1.6);
        assert_near(&found, &[0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.1, 1.5, 1.6]);
    }

    #[test]
    fn horizontal_faces_are_boundaries_where_heights_allow() {
        assert_near(&tops(&[], &[0.3, 0.95], 2.0), &[0.3, 0.7, 0.95, 1.35, 1.75, 2.0]);
        // One at 0.45 would leave less than the least height: the layer before it is cut.
        assert_near(&tops(&[], &[0.45], 0.85), &[0.35, 0.45, 0.85]);
        // Two too near to each other: the lower one is met. One too near to the bottom: it is not.
        assert_near(&tops(&[], &[0.05, 0.3, 0.35], 0.8), &[0.3, 0.7, 0.8]);
    }

    #[test]
    fn the_last_layer_covers_the_top() {
        assert_near(&tops(&[], &[], 0.8), &[0.4, 0.8]);
        assert_near(&tops(&[], &[], 0.85), &[0.4, 0.75, 0.85]);
        assert_near(&tops(&[(0.0, 0.25, 1.0)], &[], 0.25), &[0.1, 0.2, 0.3]);
    }
}
