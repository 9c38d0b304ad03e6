//! Inside tests: w against a threshold, at a point, at many, on a lattice.
use super::{Engine, WindingField};
use crate::data::{Lattice, Monitor, Parts, fill_blocks, set_bit, zeroed};
use crate::math::Vec3;
use crate::treecode::{LatticeTargets, Order, PointTargets, Scratch};
use crate::winding::config::{Accuracy, FieldError, THRESHOLD};
use crate::winding::many::MANY;

/// Inside tests that make a task: few need a sum, and these few are then summed together.
const INSIDE_TESTS: usize = 512;

impl WindingField {
    /// Whether each of `points` is inside, w ≥ 1/2; for soups the solid counts as closed: a point on the surface is inside
    /// if and only if some region that touches it is.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn contains(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<bool>, FieldError> {
        self.classify(points, THRESHOLD, monitor)
    }

    /// Whether w ≥ `threshold` at each of `points`, as in [`WindingField::contains`].
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the answers do not fit in memory.
    pub fn classify(
        &self,
        points: &[Vec3],
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, FieldError> {
        let monitor = &Parts::new(monitor);
        let mut inside = zeroed(points.len())?;
        monitor.report(0.0, "inside test")?;
        match &self.engine {
            _ if points.len() < MANY => {}
            Engine::Cloud(cloud) => {
                let mut set = |i: usize, is_inside: bool| inside[i] = is_inside;
                cloud.classify(&PointTargets::new(points), &|i| points[i], threshold, monitor, &mut set)?;
                return Ok(inside);
            }
            Engine::Soup(soup) => {
                if let Some(many) = &soup.many {
                    soup.prepare_points();
                    return Ok(soup.many_inside(many, points, threshold, monitor)?);
                }
            }
        }
        self.prepare_single_points();
        let block = |start: usize, results: &mut [bool], scratch: &mut Scratch| match &self.engine {
            Engine::Cloud(_) => {
                let singly = |(i, result): (usize, &mut bool)| {
                    *result = self.exceeds(points[start + i], threshold, scratch);
                };
                results.iter_mut().enumerate().for_each(singly);
            }
            Engine::Soup(soup) => {
                soup.classify(&points[start..start + results.len()], threshold, true, results, scratch);
            }
        };
        fill_blocks(&mut inside, INSIDE_TESTS, block, "inside test", monitor)?;
        Ok(inside)
    }

    /// Which samples of a lattice have w ≥ `threshold`: one bit for each, lowest first, x fastest. Samples on the surface
    /// count as in [`WindingField::contains`].
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the bits do not fit in memory.
    pub fn classify_lattice(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let monitor = &Parts::new(monitor);
        match &self.engine {
            Engine::Soup(soup) => match &soup.many {
                Some(many) => soup.many_bits(many, lattice, threshold, monitor),
                None => soup.lattice_bits(lattice, threshold, monitor),
            },
            Engine::Cloud(cloud) => {
                let mut bits = zeroed(lattice.len().div_ceil(8))?;
                let mut set = |index: usize, inside: bool| set_bit(&mut bits, index, inside);
                let point = |index: usize| lattice.point(lattice.sample(index));
                let targets = LatticeTargets::new(lattice);
                cloud.classify(&targets, &point, threshold, monitor, &mut set)?;
                Ok(bits)
            }
        }
    }

    /// [`WindingField::classify_lattice`], handed to `store` some planes at a time with the first of them, which is a multiple of
    /// eight. Those of clouds and loose triangles come all at once.
    ///
    /// # Errors
    /// As [`WindingField::classify_lattice`].
    pub(crate) fn classify_planes(
        &self,
        lattice: &Lattice,
        threshold: f64,
        monitor: &dyn Monitor,
        store: &mut dyn FnMut(usize, &[u8]),
    ) -> Result<(), FieldError> {
        match &self.engine {
            Engine::Soup(soup) if soup.many.is_none() => {
                soup.for_each_group_of_planes(lattice, threshold, monitor, store)
            }
            _ => {
                store(0, &self.classify_lattice(lattice, threshold, monitor)?);
                Ok(())
            }
        }
    }

    /// Which samples of a lattice have w ≥ `threshold` as the evaluator of Barill et al. 2018 has it, with its parameters and
    /// without proof: one bit for each, as of [`WindingField::classify_lattice`].
    ///
    /// # Errors
    /// As [`WindingField::classify_lattice`].
    pub fn classify_lattice_fast(
        &self,
        lattice: &Lattice,
        (order, beta): (Order, f64),
        threshold: f64,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u8>, FieldError> {
        let mut bits = zeroed(lattice.len().div_ceil(8))?;
        let store = |index: usize, w: f64| set_bit(&mut bits, index, w >= threshold);
        self.for_each_sample(lattice, Accuracy::Explicit { order, beta }, store, monitor)?;
        Ok(bits)
    }

    /// Whether `q` is inside.
    pub fn contains_point(&self, q: Vec3) -> bool {
        self.exceeds(q, THRESHOLD, &mut Scratch::default())
    }

    /// Whether w ≥ `threshold` at `q`, as in [`WindingField::contains`].
    pub fn exceeds(&self, q: Vec3, threshold: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(soup) => {
                let mut result = [false];
                soup.classify(&[q], threshold, true, &mut result, scratch);
                result[0]
            }
            Engine::Cloud(cloud) => cloud.exceeds(q, threshold, scratch),
        }
    }

    /// Whether w ≥ `level` at `q`, for tracing level sets: the same answer each time. For soups as [`WindingField::exceeds`]; for
    /// clouds without the direct sum that this falls back on next to the level set, where tracing spends its time.
    pub fn is_above(&self, q: Vec3, level: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(_) => self.exceeds(q, level, scratch),
            Engine::Cloud(_) => self.at_with(q, Accuracy::of_paper(&self.shape), scratch) >= level,
        }
    }

    /// As [`WindingField::is_above`], but a soup's loose triangles are not summed directly either: what is next to the level set may
    /// be on either side, by some 1e-5 of w. For where an edge crosses it.
    pub fn is_nearly_above(&self, q: Vec3, level: f64, scratch: &mut Scratch) -> bool {
        match &self.engine {
            Engine::Soup(soup) => {
                let mut result = [false];
                soup.classify(&[q], level, false, &mut result, scratch);
                result[0]
            }
            Engine::Cloud(_) => self.is_above(q, level, scratch),
        }
    }
}
