//! Inside tests of scattered points: by what is known of a cell, by crossings, at last by sums.
use super::answers::{INSIDE, answers, least_of};
use super::{FractionBy, SoupField, TIE};
use crate::data::BLOCK;
use crate::math::{Vec3, area_vector};
use crate::treecode::Scratch;
use crate::winding::THRESHOLD;
use crate::winding::exact::winding_of_soup;
use crate::winding::surface_rule::{share_of_touching, touches_inside};
use std::f64::consts::PI;

/// What inside tests of scattered points need beside a locator; built when the first is asked for.
pub(super) struct Answers {
    /// What is known of each cell of the locator for the threshold 1/2 (see [`answers`]); empty where that is its crossings
    /// or nothing.
    pub of_cells: Vec<i8>,
    /// Of all caps.
    cap_area: f64,
}

impl SoupField {
    pub(super) fn answers(&self) -> &Answers {
        self.answers.get_or_build(|| {
            let is_known = self.is_closed() || !self.is_summed();
            let of_cells = if is_known {
                vec![]
            } else if self.saved_answers.len() == self.locator().cells().len() {
                self.saved_answers.clone()
            } else {
                answers(self, self.locator())
            };
            let cap_area = self.closure.caps.iter().map(|cap| area_vector(*cap).length()).sum();
            Answers { of_cells, cap_area }
        })
    }

    /// Whether a point on the surface counts as inside: a region that touches it is.
    pub(super) fn touches_inside(&self, q: Vec3, threshold: f64) -> bool {
        let location = self.locator().locate(self.facets(), q, true);
        let principal = self.principal(q, &location.touching);
        touches_inside(q, &self.corners(&location.touching), principal, threshold)
    }

    /// [`SoupField::touches_inside`] without the fraction, of a soup without loose components; beside the point, `least` is
    /// the least number of crossings, of surface and caps, that is inside.
    pub(super) fn is_inside_on_surface(&self, q: Vec3, least: i32, threshold: f64) -> bool {
        let location = self.locator().locate(self.facets(), q, true);
        let corners = self.corners(&location.touching);
        let principal = if self.curtain.touches(q) {
            winding_of_soup(&self.soup, q)
        } else {
            // As good as the fraction itself: with this one, too, `least` crossings and no fewer reach the threshold.
            let fraction = threshold - f64::from(least);
            f64::from(location.crossings) + fraction - share_of_touching(q, &corners)
        };
        touches_inside(q, &corners, principal, threshold)
    }

    /// Whether w ≥ `threshold`: by crossings alone where the fraction does not matter, elsewhere by sums; where it is not
    /// `exactly` that is asked, by estimates of these that may be wrong next to the threshold.
    pub fn classify(
        &self,
        points: &[Vec3],
        threshold: f64,
        exactly: bool,
        results: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let answers = self.answers();
        let mut open = Vec::new();
        self.glance(answers, points, threshold, results, &mut open);
        open.retain(|k| {
            let decided = self.by_crossings(answers, points[*k], threshold);
            results[*k] = decided.unwrap_or(false);
            decided.is_none()
        });
        for some in open.chunks(BLOCK) {
            let queries: Vec<Vec3> = some.iter().map(|k| points[*k]).collect();
            let mut inside = [false; BLOCK];
            self.classify_by_sums(&queries, threshold, exactly, &mut inside, scratch);
            some.iter().zip(inside).for_each(|(k, inside)| results[*k] = inside);
        }
    }

    /// Whether w ≥ `threshold` at up to [`BLOCK`] points beside the surface: by bounds of estimates, at last exactly.
    fn classify_by_sums(
        &self,
        points: &[Vec3],
        threshold: f64,
        exactly: bool,
        results: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let mut open: Vec<usize> = (0..points.len()).collect();
        if let Some(tree) = self.tree().filter(|_| !self.is_summed()) {
            open.retain(|k| {
                let crossings = self.crossings_at(points[*k]).unwrap_or(0);
                let reaches = tree.reaches(points[*k], threshold - f64::from(crossings), scratch);
                results[*k] = reaches.threshold;
                exactly && !reaches.is_proven
            });
        }
        self.count_refined(open.len());
        let mut values = [0.0; BLOCK];
        let exact: Vec<Vec3> = open.iter().map(|k| points[*k]).collect();
        self.values(&exact, FractionBy::Edges, &mut values[..exact.len()], scratch);
        open.iter().zip(values).for_each(|(k, w)| results[*k] = w >= threshold - TIE);
    }

    /// Decides what can be told from the cells of the points alone; gives the others by number.
    fn glance(
        &self,
        answers: &Answers,
        points: &[Vec3],
        threshold: f64,
        results: &mut [bool],
        open: &mut Vec<usize>,
    ) {
        let is_known = threshold.abs() < 100.0 && self.is_closed();
        let (table, outside, least) = if is_known {
            // Where a negative integer is inside, so is all of space: points that are not finite are looked at singly.
            let least = threshold.ceil() as i8;
            (self.locator().cells(), if least > 0 { 0 } else { i8::MIN }, least)
        } else if threshold == THRESHOLD && !answers.of_cells.is_empty() {
            (&answers.of_cells[..], i8::MIN, INSIDE)
        } else {
            open.extend(0..points.len());
            return;
        };
        self.locator().glance(points, (table, outside), least, results, |k| open.push(k));
    }

    /// Decides without the fraction, where that can be.
    fn by_crossings(&self, answers: &Answers, q: Vec3, threshold: f64) -> Option<bool> {
        if !q.is_finite() {
            return Some(false);
        }
        // So far away the caps span too small a solid angle for w to reach the threshold from 0.
        let reach = 4.0 * PI * threshold.abs() * self.locator().distance_squared(q);
        if self.closure.loose.is_empty() && reach > answers.cap_area * (1.0 + 1e-9) {
            return Some(threshold < 0.0);
        }
        let least = if self.is_closed() {
            Some(threshold.ceil().clamp(-1e9, 1e9) as i32)
        } else if threshold == THRESHOLD && !answers.of_cells.is_empty() {
            self.locator().cell(q).and_then(|cell| least_of(answers.of_cells[cell]))
        } else {
            None
        };
        if let Some(crossings) = self.locator().at_a_glance(q) {
            return least.map(|least| crossings >= least); // near no triangle
        }
        let location = self.locator().locate(self.facets(), q, true);
        if !location.touching.is_empty() {
            let principal = self.principal(q, &location.touching);
            return Some(touches_inside(q, &self.corners(&location.touching), principal, threshold));
        }
        least.map(|least| location.crossings >= least)
    }
}
