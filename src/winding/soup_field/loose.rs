//! Soups with loose components at many points: crossings for what is closed, and the dual tree for the rest.
use super::{SoupField, TIE};
use crate::data::{Cancelled, Lattice, Monitor, map_items, map_tasks, set_bit, zeroed};
use crate::math::Vec3;
use crate::treecode::{DualAccuracy, LatticeTargets, PointTargets};
use crate::winding::config::FieldError;
use crate::winding::many::{InsideTest, Many};
use crate::winding::scan::{SLAB_PLANES, Scan, Slab};

/// Samples whose crossings are held at once, about.
const SAMPLES_AT_ONCE: usize = 1 << 21;

/// The integer part at a point, of the caps too.
#[derive(Clone, Copy, Debug)]
enum Part {
    Crossings(i32),
    OnSurface,
    NotFinite,
}

impl Part {
    fn value(self) -> f64 {
        match self {
            Part::Crossings(n) => f64::from(n),
            Part::OnSurface => 0.0,
            Part::NotFinite => f64::NAN,
        }
    }
}

impl SoupField {
    /// Winding numbers at many points: the sources of the fraction by the dual tree.
    pub fn many_values(
        &self,
        many: &Many,
        points: &[Vec3],
        accuracy: &DualAccuracy,
        monitor: &dyn Monitor,
    ) -> Result<Vec<f64>, Cancelled> {
        let parts = self.integer_parts(points);
        let mut values = map_items(parts.len(), |i| parts[i].value());
        many.add(&PointTargets::new(points), accuracy, &mut values, monitor)?;
        for i in on_surface(&parts) {
            values[i] = self.principal_at(points[i]);
        }
        Ok(values)
    }

    /// Whether w ≥ `threshold` at many points.
    pub fn many_inside(
        &self,
        many: &Many,
        points: &[Vec3],
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, Cancelled> {
        let parts = self.integer_parts(points);
        let mut inside = vec![false; points.len()];
        let test = InsideTest {
            threshold,
            offset: &|i| parts[i].value(),
            point: &|i| points[i],
            exactly: &|indices, points| {
                self.are_inside_exactly(indices, &|i| parts[i].value(), points, threshold)
            },
        };
        let mut set = |i: usize, is_inside: bool| inside[i] = is_inside;
        self.count_refined(many.classify(&PointTargets::new(points), &test, monitor, &mut set)?);
        for i in on_surface(&parts) {
            inside[i] = self.touches_inside(points[i], threshold);
        }
        Ok(inside)
    }

    fn integer_parts(&self, points: &[Vec3]) -> Vec<Part> {
        map_items(points.len(), |i| match points[i] {
            q if !q.is_finite() => Part::NotFinite,
            q => self.crossings_at(q).map_or(Part::OnSurface, Part::Crossings),
        })
    }

    /// By the direct sum; `crossings` are those of the surface and the caps.
    fn are_inside_exactly(
        &self,
        indices: &[usize],
        crossings: &dyn Fn(usize) -> f64,
        points: &[Vec3],
        threshold: f64,
    ) -> Vec<bool> {
        let mut fractions = vec![0.0; points.len()];
        self.exact_fractions(points, &mut fractions);
        let is_inside = |((index, q), fraction): ((&usize, &Vec3), &f64)| {
            crossings(*index) - f64::from(self.cap_crossings(*q)) + fraction >= threshold - TIE
        };
        indices.iter().zip(points).zip(&fractions).map(is_inside).collect()
    }

    /// One bit for each sample, set where w ≥ `threshold`.
    pub fn many_bits(
        &self,
        many: &Many,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let mut bits = zeroed::<u8>(lattice.len().div_ceil(8))?;
        let mut set = |index: usize, inside: bool| set_bit(&mut bits, index, inside);
        let per_plane = lattice.counts[0] * lattice.counts[1];
        let scan = Scan::new(self.facets(), 0..self.facets().len(), lattice);
        let at_once = (SAMPLES_AT_ONCE / (SLAB_PLANES * per_plane).max(1)).max(1);
        for first in (0..scan.slabs()).step_by(at_once) {
            let slabs = first..scan.slabs().min(first + at_once);
            let counted = map_tasks(slabs.len(), |k| {
                let mut slab = Slab::default();
                scan.count(first + k, &mut slab);
                slab
            });
            let planes = SLAB_PLANES * first..scan.planes(slabs.end - 1).end;
            let start = planes.start * per_plane;
            let crossings = |index: usize| {
                let place = index - start;
                let slab = SLAB_PLANES * per_plane;
                f64::from(counted[place / slab].crossings[place % slab])
            };
            let point = |index: usize| lattice.point(lattice.sample(index));
            let test = InsideTest {
                threshold,
                offset: &crossings,
                point: &point,
                exactly: &|indices, points| self.are_inside_exactly(indices, &crossings, points, threshold),
            };
            let share = slabs.len() as f64 / scan.slabs() as f64;
            let part = |fraction: f64, stage: &str| {
                let done = first as f64 / scan.slabs() as f64 + share * fraction;
                monitor.report(done.min(1.0), stage).is_ok()
            };
            let targets = LatticeTargets::of_planes(lattice, planes);
            self.count_refined(many.classify(&targets, &test, &part, &mut set)?);
            for (k, slab) in counted.iter().enumerate() {
                for place in &slab.on_surface {
                    let index = start + k * SLAB_PLANES * per_plane + *place as usize;
                    set(index, self.touches_inside(point(index), threshold));
                }
            }
        }
        Ok(bits)
    }
}

fn on_surface(parts: &[Part]) -> impl Iterator<Item = usize> {
    (0..parts.len()).filter(|i| matches!(parts[*i], Part::OnSurface))
}
