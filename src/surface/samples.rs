use crate::data::{Monitor, Silent};
use crate::levelset::{Edge, LevelSet, TraceError, find_roots};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Cells, Targets};
use crate::winding::{FieldError, WindingField};

/// The field of a cloud, less a level.
pub struct Samples<'a> {
    pub field: &'a WindingField,
    pub level: f64,
}

fn env(n: &str, d: f64) -> f64 { std::env::var(n).ok().and_then(|s| s.parse().ok()).unwrap_or(d) }

impl Samples<'_> {
    fn at(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        let mut values = self.field.evaluate_targets(&InOrder(points), points.len(), env("TOL", 1e-2), monitor).map_err(|e| match e {
            FieldError::Cancelled(c) => TraceError::Cancelled(c),
            FieldError::OutOfMemory(o) => TraceError::OutOfMemory(o),
            FieldError::Lattice(_) => unreachable!(),
        })?;
        values.iter_mut().for_each(|w| *w -= self.level);
        Ok(values)
    }
}

impl LevelSet for Samples<'_> {
    fn takes_bricks(&self) -> bool {
        true
    }

    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        Ok(self.at(points, monitor)?.into_iter().map(|w| w as f32).collect())
    }

    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        find_roots(edges, &|points| self.at(points, &Silent))
    }
}

/// Points that lie in an order in which neighbours are near each other.
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

    fn split(&self, [places, ..]: &Cells, child: &mut dyn FnMut(Cells)) {
        let blocks = places.len().div_ceil(64);
        let mut start = places.start;
        for k in 0..8 {
            let end = (places.start + 64 * (blocks * (k + 1) / 8)).min(places.end);
            if end > start {
                child([start..end, 0..1, 0..1]);
            }
            start = end;
        }
    }

    fn for_each(&self, [places, ..]: &Cells, sample: &mut dyn FnMut(usize, Vec3)) {
        places.clone().for_each(|i| sample(i, self.0[i]));
    }

    fn outcasts(&self) -> &[u32] {
        &[]
    }
}
