//! Sums over all pairs of a source and a target, again and again with other strengths: who acts on whom singly and which
//! clusters act as a whole is found out once.
//!
//! Sources are charges or dipoles; wanted are potentials or fields at the targets, which may be the sources themselves.
//! Clusters act by a monopole, a dipole and a quadrupole about their middle.
mod kernels;
mod lists;
mod series;

use super::Octet;
use crate::bvh::{Bvh, morton_code};
use crate::data::{map_items, map_tasks};
use crate::math::{Aabb, Vec3};
use kernels::{Block, Record, Sum};
use lists::{Blocks, Lists};
use series::Clusters;
use std::sync::Arc;

/// Most points in a leaf, which are also those summed for together.
const LEAF: usize = 16;
/// Points in one register of the widest kind.
const WIDTH: usize = 8;
/// Blocks that make a task.
const BLOCKS_PER_TASK: usize = 32;

/// Points that act or are acted on, as [`Mutual`] needs them.
pub struct Clustered {
    /// Points in the order of the Morton curve.
    order: Vec<u32>,
    places: Vec<[f32; 3]>,
    clusters: Clusters,
    blocks: Blocks,
}

impl Clustered {
    /// Points are to be finite and within a few units of the origin.
    pub fn new(points: &[Vec3]) -> Clustered {
        let bounds = Aabb::around(points.iter().copied());
        let bvh = Bvh::along_curve(map_items(points.len(), |i| morton_code(points[i], &bounds)), LEAF);
        let order = bvh.items().to_vec();
        let sorted: Vec<Vec3> = order.iter().map(|i| points[*i as usize]).collect();
        let clusters = Clusters::over(&bvh, &sorted);
        let blocks = Blocks::of(&clusters, &sorted);
        let places = sorted.iter().map(|p| p.to_array().map(|x| x as f32)).collect();
        Clustered { order, places, clusters, blocks }
    }

    pub fn len(&self) -> usize {
        self.order.len()
    }

    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.order[..])
            + size_of_val(&self.places[..])
            + self.clusters.bytes()
            + self.blocks.bytes()
    }

    /// Vectors of the points in the order of the curve; none if there are none.
    fn sorted(&self, vectors: &[Vec3]) -> Vec<Vec3> {
        let vector = |i: &u32| vectors.get(*i as usize).copied();
        self.order.iter().filter_map(vector).collect()
    }
}

/// The pairs of points of a cloud, or of two: sources and targets.
///
/// Strengths are in the order of the sources, results in that of the targets.
pub struct Mutual {
    sources: Arc<Clustered>,
    targets: Arc<Clustered>,
    lists: Lists,
}

impl Mutual {
    /// The pairs of points of one cloud. A cluster acts as a whole where it is farther than `opening` times its radius.
    ///
    /// Points are to be finite and within a few units of the origin.
    pub fn new(points: &[Vec3], opening: f64) -> Mutual {
        let points = Arc::new(Clustered::new(points));
        Mutual::between(&points, &points, opening)
    }

    /// The pairs of a source and a target.
    pub fn between(sources: &Arc<Clustered>, targets: &Arc<Clustered>, opening: f64) -> Mutual {
        let lists = Lists::find(&sources.clusters, &targets.blocks, opening as f32);
        Mutual { sources: sources.clone(), targets: targets.clone(), lists }
    }

    /// Number of targets.
    pub fn len(&self) -> usize {
        self.targets.len()
    }

    pub fn is_empty(&self) -> bool {
        self.targets.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let targets = if Arc::ptr_eq(&self.sources, &self.targets) { 0 } else { self.targets.bytes() };
        self.sources.bytes() + targets + self.lists.bytes()
    }

    /// Potentials Σⱼ μⱼ·(pⱼ − qᵢ) / |pⱼ − qᵢ|³ at targets q over the sources p that are `width` or farther away: 4π times the winding numbers
    /// of dipoles μ.
    pub fn potentials(&self, dipoles: &[Vec3], width: f64) -> Vec<f64> {
        firsts(self.sum(Sum::Potential, width, &|i| dipoles[i], &[]))
    }

    /// The same, each term w of one point bounded to 2π sign(w) (1 − 1/√(1 + |w|/π)): 4π times the bounded winding number
    /// (*Leaps and Bounds*, eq. 41), clusters that act as a whole excepted, which are far.
    pub fn bounded_potentials(&self, dipoles: &[Vec3], width: f64) -> Vec<f64> {
        firsts(self.sum(Sum::BoundedPotential, width, &|i| dipoles[i], &[]))
    }

    /// The derivative of [`Mutual::bounded_potentials`] at `dipoles` towards `change` (eq. 51).
    pub fn bounded_change(&self, dipoles: &[Vec3], change: &[Vec3], width: f64) -> Vec<f64> {
        firsts(self.sum(Sum::Change, width, &|i| change[i], dipoles))
    }

    /// The transpose of [`Mutual::bounded_change`], as [`Mutual::fields`] is that of the potentials: `dipoles` are those of
    /// the targets, `charges` those of the sources.
    pub fn bounded_fields(&self, dipoles: &[Vec3], charges: &[f64], width: f64) -> Vec<Vec3> {
        vectors(self.sum(Sum::TransposedChange, width, &|i| Vec3::new(charges[i], 0.0, 0.0), dipoles))
    }

    /// The gradients of these; where `is_bounded`, each term of one point over (1 + |w| / π)^(3/2), w its own part of the
    /// potential: those of the bounded winding number (*Leaps and Bounds*, eq. 49, times 4π).
    pub fn gradients(&self, dipoles: &[Vec3], width: f64, is_bounded: bool) -> Vec<Vec3> {
        let sum = if is_bounded { Sum::BoundedGradient } else { Sum::Gradient };
        vectors(self.sum(sum, width, &|i| dipoles[i], &[]))
    }

    /// Σᵢ cᵢ (qⱼ − pᵢ) / |qⱼ − pᵢ|³ at targets q over the sources p that are `width` or farther away: the transpose of
    /// [`Mutual::potentials`] of the pairs the other way round.
    pub fn fields(&self, charges: &[f64], width: f64) -> Vec<Vec3> {
        vectors(self.sum(Sum::Field, width, &|i| Vec3::new(charges[i], 0.0, 0.0), &[]))
    }

    /// `bases` are the dipoles that tell how far points are bounded, if it is a change that is asked for: those of the
    /// sources, or of the targets for [`Sum::TransposedChange`].
    fn sum(
        &self,
        sum: Sum,
        width: f64,
        strength: &(dyn Fn(usize) -> Vec3 + Sync),
        bases: &[Vec3],
    ) -> Vec<[f32; 3]> {
        let Mutual { sources, targets, lists } = self;
        let sorted: Vec<Vec3> = sources.order.iter().map(|i| strength(*i as usize)).collect();
        let (of_sources, of_targets) = match sum {
            Sum::TransposedChange => (vec![], targets.sorted(bases)),
            _ => (sources.sorted(bases), vec![]),
        };
        let bases = targets.blocks.grouped(&of_targets);
        let single = |v: Vec3| v.to_array().map(|x| x as f32);
        let of_point =
            |k: usize| (Vec3::from_array(sources.places[k].map(f64::from)), sum.moments(sorted[k]));
        let series = sources.clusters.series(&of_point);
        let record = |k: usize| Record {
            place: sources.places[k],
            strength: single(sorted[k]),
            base: of_sources.get(k).map_or([0.0; 3], |base| single(*base)),
        };
        let records: Vec<Record> = (0..sources.len()).map(record).collect();
        let blocks = &targets.blocks;
        let tasks = map_tasks(blocks.len().div_ceil(BLOCKS_PER_TASK), |task| {
            let first = task * BLOCKS_PER_TASK;
            let mut sums = Vec::new();
            for k in first..blocks.len().min(first + BLOCKS_PER_TASK) {
                let block = Block {
                    groups: blocks.of_block(k, blocks.groups()),
                    far: lists.far(k),
                    near: lists.near(k),
                    series: &series,
                    records: &records,
                    bases: blocks.of_block(k, &bases),
                    width: width as f32,
                };
                let end = sums.len() + blocks.points(k).len();
                block.add(sum, &mut sums);
                sums.truncate(end);
            }
            sums
        });
        let mut results = vec![[0.0; 3]; targets.len()];
        for (i, value) in targets.order.iter().zip(tasks.into_iter().flatten()) {
            results[*i as usize] = value;
        }
        results
    }
}

fn firsts(sums: Vec<[f32; 3]>) -> Vec<f64> {
    sums.into_iter().map(|[sum, ..]| f64::from(sum)).collect()
}

fn vectors(sums: Vec<[f32; 3]>) -> Vec<Vec3> {
    sums.into_iter().map(|sum| Vec3::from_array(sum.map(f64::from))).collect()
}

/// Coordinates of eight points.
type Group = [Octet; 3];

#[cfg(test)]
mod tests {
    use super::*;
    use glam::swizzles::Vec3Swizzles;
    use std::f64::consts::PI;

    /// Points on a bumpy sphere, with strengths of any kind.
    fn sample(count: usize) -> (Vec<Vec3>, Vec<Vec3>, Vec<f64>) {
        let point = |i: usize| {
            let z = 1.0 - 2.0 * (i as f64 + 0.5) / count as f64;
            let (r, a) = ((1.0 - z * z).sqrt(), 2.4 * i as f64);
            Vec3::new(r * a.cos(), r * a.sin(), z) * (1.0 + 0.1 * (3.0 * a).sin() * r)
        };
        let points: Vec<Vec3> = (0..count).map(point).collect();
        let wave = |i: usize, k: f64| (k * i as f64).sin();
        let turned = |i: usize| points[i] + 0.5 * Vec3::new(wave(i, 1.1), wave(i, 2.3), wave(i, 3.7));
        let dipoles = (0..count).map(|i| 12.0 / count as f64 * turned(i)).collect();
        let charges = (0..count).map(|i| 0.3 + wave(i, 5.1)).collect();
        (points, dipoles, charges)
    }

    fn rms(values: impl Iterator<Item = f64>) -> f64 {
        let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v * v, count + 1.0));
        (sum / f64::max(count, 1.0)).sqrt()
    }

    /// The sums by their definitions: potentials, gradients, bounded gradients, fields.
    #[allow(clippy::type_complexity, reason = "four results")]
    fn direct(
        (points, dipoles, charges): &(Vec<Vec3>, Vec<Vec3>, Vec<f64>),
        width: f64,
    ) -> (Vec<f64>, Vec<Vec3>, Vec<Vec3>, Vec<Vec3>) {
        let mut results = (vec![], vec![], vec![], vec![]);
        for q in points {
            let mut sums = (0.0, Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
            for (k, p) in points.iter().enumerate() {
                let d = *p - *q;
                let r = d.length();
                if r < width {
                    continue;
                }
                let potential = d.dot(dipoles[k]) / r.powi(3);
                let gradient = 3.0 * d.dot(dipoles[k]) * d / r.powi(5) - dipoles[k] / r.powi(3);
                sums.0 += potential;
                sums.1 += gradient;
                sums.2 += gradient / (1.0 + potential.abs() / std::f64::consts::PI).powf(1.5);
                sums.3 -= charges[k] * d / r.powi(3);
            }
            results.0.push(sums.0);
            results.1.push(sums.1);
            results.2.push(sums.2);
            results.3.push(sums.3);
        }
        results
    }

    #[test]
    fn sums_are_those_of_all_pairs() {
        // With a wide cut, clusters are cut off whole.
        let cases = [
            (1, 0.1, 2.0, 1e-9),
            (7, 0.1, 2.0, 1e-6),
            (300, 0.05, 2.0, 1e-2),
            (3000, 0.01, 2.0, 3e-2),
            (3000, 0.01, 5.0, 5e-3),
            (3000, 0.3, 2.0, 1e-1),
        ];
        for (count, width, opening, most) in cases {
            let sample = sample(count);
            let mutual = Mutual::new(&sample.0, opening);
            let expected = direct(&sample, width);
            let potentials = mutual.potentials(&sample.1, width);
            let error = rms(potentials.iter().zip(&expected.0).map(|(a, b)| a - b));
            let size = rms(expected.0.iter().copied()).max(1e-9);
            println!("{count}, {width}: potentials {:.1e}", error / size);
            assert!(error < most * size, "{count}: {error} of {size}");
            let gradients = mutual.gradients(&sample.1, width, false);
            let bounded = mutual.gradients(&sample.1, width, true);
            let fields = mutual.fields(&sample.2, width);
            for (name, found, expected) in [
                ("gradients", gradients, &expected.1),
                ("bounded", bounded, &expected.2),
                ("fields", fields, &expected.3),
            ] {
                let error = rms(found.iter().zip(expected).map(|(a, b)| a.distance(*b)));
                let size = rms(expected.iter().map(|v| v.length())).max(1e-9);
                println!("{count}, {width}: {name} {:.1e}", error / size);
                assert!(error < most * size, "{name} of {count}: {error} of {size}");
            }
        }
    }

    #[test]
    fn sums_between_two_clouds_are_those_of_all_pairs() {
        let (points, dipoles, _) = sample(1200);
        let targets: Vec<Vec3> = sample(700).0.iter().map(|p| 1.07 * p.yzx()).collect();
        let charges: Vec<f64> = (0..700).map(|i| (1.7 * f64::from(i)).sin()).collect();
        let [sources, places] = [&points, &targets].map(|points| Arc::new(Clustered::new(points)));
        let (down, up) = (Mutual::between(&sources, &places, 5.0), Mutual::between(&places, &sources, 5.0));
        assert_eq!((down.len(), up.len()), (700, 1200));
        let cube = |offset: Vec3| offset / offset.length().powi(3);
        let potential =
            |q: &Vec3| points.iter().zip(&dipoles).map(|(p, d)| cube(*p - *q).dot(*d)).sum::<f64>();
        let expected: Vec<f64> = targets.iter().map(potential).collect();
        let error = rms(down.potentials(&dipoles, 1e-6).iter().zip(&expected).map(|(a, b)| a - b));
        assert!(error < 5e-3 * rms(expected.iter().copied()), "{error}");
        let field = |p: &Vec3| targets.iter().zip(&charges).map(|(q, c)| *c * cube(*p - *q)).sum::<Vec3>();
        let expected: Vec<Vec3> = points.iter().map(field).collect();
        let error = rms(up.fields(&charges, 1e-6).iter().zip(&expected).map(|(a, b)| a.distance(*b)));
        assert!(error < 5e-3 * rms(expected.iter().map(|v| v.length())), "{error}");
        // What bounds a point are the dipoles of the targets here, of the sources there.
        let (down, up) = (Mutual::between(&sources, &places, 1e9), Mutual::between(&places, &sources, 1e9));
        let step: Vec<Vec3> = dipoles.iter().map(|d| d.zxy()).collect();
        let change = down.bounded_change(&dipoles, &step, 1e-6);
        let fields = up.bounded_fields(&dipoles, &charges, 1e-6);
        let left: f64 = change.iter().zip(&charges).map(|(a, b)| a * b).sum();
        let right: f64 = fields.iter().zip(&step).map(|(a, b)| a.dot(*b)).sum();
        let size: f64 = change.iter().zip(&charges).map(|(a, b)| (a * b).abs()).sum();
        assert!((left - right).abs() < 1e-5 * size, "{left} and {right}");
    }

    #[test]
    fn bounded_potentials_change_as_their_derivative_says() {
        let (points, dipoles, charges) = sample(1500);
        // Strong ones, so that the bound matters.
        let dipoles: Vec<Vec3> = dipoles.iter().map(|d| 30.0 * *d).collect();
        let mutual = Mutual::new(&points, 2.0);
        let width = 0.01;
        let bounded = mutual.bounded_potentials(&dipoles, width);
        let plain = mutual.potentials(&dipoles, width);
        let expected = |i: usize| -> f64 {
            let of = |(p, d): (&Vec3, &Vec3)| {
                let offset = *p - points[i];
                let w = offset.dot(*d) / offset.length().powi(3);
                let bound = 2.0 * PI * (1.0 - 1.0 / (1.0 + w.abs() / PI).sqrt());
                if offset.length() < width { 0.0 } else { bound.copysign(w) }
            };
            points.iter().zip(&dipoles).map(of).sum()
        };
        let error = rms((0..1500).step_by(10).map(|i| bounded[i] - expected(i)));
        let size = rms(bounded.iter().copied());
        assert!(error < 0.03 * size, "{error} of {size}");
        assert!(
            rms(bounded.iter().zip(&plain).map(|(a, b)| a - b)) > 0.1 * size,
            "the bound does not matter here"
        );
        // A small step towards each side.
        let step: Vec<Vec3> = dipoles.iter().enumerate().map(|(i, d)| charges[i] * d.yzx()).collect();
        let moved = |t: f64| -> Vec<f64> {
            let dipoles: Vec<Vec3> = dipoles.iter().zip(&step).map(|(d, s)| *d + t * *s).collect();
            mutual.bounded_potentials(&dipoles, width)
        };
        let change = mutual.bounded_change(&dipoles, &step, width);
        let (up, down) = (moved(3e-3), moved(-3e-3));
        let error = rms((0..1500).map(|i| change[i] - (up[i] - down[i]) / 6e-3));
        let size = rms(change.iter().copied());
        assert!(error < 3e-3 * size, "{error} of {size}");
    }

    #[test]
    fn transposes_are_transposes() {
        let (points, dipoles, charges) = sample(1500);
        let step: Vec<Vec3> = dipoles.iter().map(|d| d.zxy()).collect();
        // All singly: far clusters are approximated otherwise than far points.
        let mutual = Mutual::new(&points, 1e9);
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let products = |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
        for width in [0.01, 0.2] {
            let pairs = [
                (
                    product(&mutual.potentials(&step, width), &charges),
                    products(&mutual.fields(&charges, width), &step),
                ),
                (
                    product(&mutual.bounded_change(&dipoles, &step, width), &charges),
                    products(&mutual.bounded_fields(&dipoles, &charges, width), &step),
                ),
            ];
            let size =
                rms(charges.iter().copied()) * rms(mutual.potentials(&step, width).into_iter()) * 1500.0;
            for (left, right) in pairs {
                assert!((left - right).abs() < 5e-5 * size, "{left} and {right}, of {size}");
            }
        }
    }
}
