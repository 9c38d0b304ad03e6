//! The level set of a soup: w jumps there, so only sides of it are known.
use crate::data::{Monitor, fill_in_blocks};
use crate::levelset::{Edge, LevelSet, TraceError, crossing};
use crate::math::Vec3;
use crate::winding::{Scratch, WindingField};

/// Which side of a level places are on. Nodes are proven; where an edge crosses it is known to a millionth of the edge.
pub struct Sides<'a> {
    pub field: &'a WindingField,
    pub level: f64,
}

impl LevelSet for Sides<'_> {
    fn takes_bricks(&self) -> bool {
        false
    }

    fn values(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f32>, TraceError> {
        let inside = self.field.classify(points, self.level, monitor)?;
        Ok(inside.into_iter().map(|inside| if inside { 1.0 } else { -1.0 }).collect())
    }

    fn crossings(&self, edges: &[Edge], monitor: &dyn Monitor) -> Result<Vec<f64>, TraceError> {
        let mut crossings = vec![0.0; edges.len()];
        let find = |i: usize, scratch: &mut Scratch| {
            let edge = &edges[i];
            crossing(edge.ends[0] > 0.0, |t| self.field.is_nearly_above(edge.at(t), self.level, scratch))
        };
        fill_in_blocks(&mut crossings, find, "surface vertices", monitor)?;
        Ok(crossings)
    }
}
