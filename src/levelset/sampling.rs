//! Values for the nodes of bricks.
use super::bricks::{Bricks, NODES, node_of};
use super::{Blur, LevelSet, SurfaceGrid, TraceError};
use crate::data::{Monitor, map_items, ones};
use crate::math::Vec3;

/// Bricks whose nodes are asked for together: their places and values take 32 MB.
const BRICKS_AT_ONCE: usize = 1 << 14;

impl Bricks {
    /// Asks for the values that were requested.
    pub fn sample(
        &mut self,
        grid: &SurfaceGrid,
        level_set: &dyn LevelSet,
        monitor: &dyn Monitor,
    ) -> Result<(), TraceError> {
        let mut requests = std::mem::take(&mut self.requests);
        self.sort(&mut requests);
        if let Some(blur) = level_set.blur() {
            return self.sample_smoothly(&requests, &blur, grid, level_set, monitor);
        }
        for some in requests.chunks(BRICKS_AT_ONCE) {
            let mut points = Vec::new();
            for &place in some {
                let brick = &self.bricks[place as usize];
                points.extend(ones(brick.wanted).map(|bit| grid.position(node_of(brick.first, bit))));
            }
            let mut values = level_set.values(&points, monitor)?.into_iter();
            some.iter().for_each(|place| self.learn(*place, &mut values));
        }
        Ok(())
    }

    /// Takes the values of the wanted nodes of a brick.
    fn learn(&mut self, place: u32, values: &mut dyn Iterator<Item = f32>) {
        let brick = &mut self.bricks[place as usize];
        for (bit, value) in ones(brick.wanted).zip(values) {
            brick.inside |= u64::from(value.is_sign_positive()) << bit;
            brick.void |= u64::from(value.is_nan()) << bit;
            self.values[place as usize * NODES + bit] = value;
        }
        brick.known |= std::mem::take(&mut brick.wanted);
    }

    /// The same for smoothed values: asks for those of the bricks around too.
    fn sample_smoothly(
        &mut self,
        requests: &[u32],
        blur: &Blur,
        grid: &SurfaceGrid,
        level_set: &dyn LevelSet,
        monitor: &dyn Monitor,
    ) -> Result<(), TraceError> {
        let mut around = Vec::with_capacity(requests.len());
        let mut missing = Vec::new();
        for &place in requests {
            let first = self.bricks[place as usize].first;
            let mut all = [0; 27];
            for (k, other) in all.iter_mut().enumerate() {
                let at = |axis: usize, power: usize| first[axis] + 4 * (k / power % 3) as i32 - 4;
                *other = self.place([at(0, 1), at(1, 3), at(2, 9)])?.0;
                if !std::mem::replace(&mut self.bricks[*other as usize].is_sampled, true) {
                    missing.push(*other);
                }
            }
            around.push(all);
        }
        self.sort(&mut missing);
        self.sharp.resize(self.values.len(), f32::NAN);
        for some in missing.chunks(BRICKS_AT_ONCE) {
            let nodes = some.iter().flat_map(|place| {
                let first = self.bricks[*place as usize].first;
                (0..NODES).map(move |bit| grid.position(node_of(first, bit)))
            });
            let points: Vec<Vec3> = nodes.collect();
            let values = level_set.values(&points, monitor)?;
            for (place, values) in some.iter().zip(values.chunks_exact(NODES)) {
                self.sharp[*place as usize * NODES..][..NODES].copy_from_slice(values);
            }
        }
        let smooth = map_items(requests.len(), |k| {
            blur.of(&around[k].map(|place| &self.sharp[place as usize * NODES..][..NODES]))
        });
        for (place, values) in requests.iter().zip(smooth) {
            self.learn(*place, &mut values.into_iter());
        }
        Ok(())
    }
}
