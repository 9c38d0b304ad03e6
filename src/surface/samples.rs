//! The level set of a cloud: smooth, and asked for at many places at once.
use super::trim::Reach;
use crate::bvh::Nearest;
use crate::data::{BLOCK, Monitor, fill_in_blocks};
use crate::levelset::{Blur, Edge, LevelSet, TraceError, find_roots};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Cells, Targets};
use crate::winding::WindingField;

/// Largest error of w.
const TOLERANCE: f64 = 3e-2;

/// Values beyond this are cut off before they are smoothed: w changes by 1 across a surface.
const MOST: f32 = 0.5;

/// The field of a cloud, less a level.
pub struct Samples<'a> {
    pub field: &'a WindingField,
    pub level: f64,
    /// Where it is traced, if not everywhere.
    pub reach: Option<&'a Reach>,
    /// Between nodes.
    pub spacing: f64,
    pub blur: Option<Blur>,
}

impl Samples<'_> {
    fn at(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        let found = self.field.evaluate_targets(&InOrder(points), points.len(), TOLERANCE, monitor);
        let mut values = found?;
        values.iter_mut().for_each(|w| *w -= self.level);
        Ok(values)
    }

    /// Values in bricks that reach into a ball around a point, NaN in the others.
    fn within(&self, reach: &Reach, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        let bricks: Vec<&[Vec3]> = points.chunks(BLOCK).collect();
        let mut held = vec![false; bricks.len()];
        // From a vertex to a corner of its cell, and four cells along each axis to what is smoothed.
        let margin = self.spacing * if self.blur.is_some() { 9.0 } else { 2.0 };
        let is_held = |k: usize, nearest: &mut Nearest| {
            let bounds = Aabb::around(bricks[k].iter().copied());
            reach.holds(bounds.center(), 0.5 * bounds.diagonal() + margin, nearest)
        };
        fill_in_blocks(&mut held, is_held, "surface cells", monitor)?;
        let wanted: Vec<Vec3> = bricks
            .iter()
            .zip(&held)
            .filter(|(_, held)| **held)
            .flat_map(|(brick, _)| *brick)
            .copied()
            .collect();
        let mut values = self.at(&wanted, monitor)?.into_iter();
        let is_held = |k: usize| held[k / BLOCK];
        let value =
            |k: usize| if is_held(k) { values.next().map_or(f32::NAN, |w| w as f32) } else { f32::NAN };
        Ok((0..points.len()).map(value).collect())
    }
}

impl LevelSet for Samples<'_> {
    fn takes_bricks(&self) -> bool {
        true
    }

    fn blur(&self) -> Option<Blur> {
        self.blur
    }

    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        let mut values: Vec<f32> = match self.reach {
            Some(reach) => self.within(reach, points, monitor)?,
            None => self.at(points, monitor)?.into_iter().map(|w| w as f32).collect(),
        };
        if self.blur.is_some() {
            // Those next to a point tell nothing of what is around.
            values.iter_mut().for_each(|value| *value = value.clamp(-MOST, MOST));
        }
        Ok(values)
    }

    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        if self.blur.is_some() {
            return Ok(edges.iter().map(Edge::interpolated).collect());
        }
        find_roots(edges, &|points, part: &dyn Monitor| self.at(points, part), monitor)
    }
}

/// Points in an order in which neighbours are near each other, as those of bricks along a curve are.
struct InOrder<'a>(&'a [Vec3]);

impl Targets for InOrder<'_> {
    fn whole(&self) -> Option<Cells> {
        (!self.0.is_empty()).then_some([0..self.0.len(), 0..1, 0..1])
    }

    fn len(&self, [places, ..]: &Cells) -> usize {
        places.len()
    }

    fn bounds(&self, [places, ..]: &Cells) -> Aabb {
        Aabb::around(self.0[places.clone()].iter().copied())
    }

    /// In up to eight parts of as many whole blocks.
    fn split(&self, [places, ..]: &Cells, child: &mut dyn FnMut(Cells)) {
        let blocks = places.len().div_ceil(BLOCK);
        let end_of = |part: usize| (places.start + BLOCK * (blocks * part / 8)).min(places.end);
        let parts = (0..8).map(|part| end_of(part)..end_of(part + 1));
        parts.filter(|part| !part.is_empty()).for_each(|part| child([part, 0..1, 0..1]));
    }

    fn for_each(&self, [places, ..]: &Cells, sample: &mut dyn FnMut(usize, Vec3)) {
        places.clone().for_each(|place| sample(place, self.0[place]));
    }

    fn outcasts(&self) -> &[u32] {
        &[]
    }
}
