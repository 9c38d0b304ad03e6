//! Far fields of clusters at blocks of queries (M2L), four clusters at a time.
use super::bounds::{self, ROUND_UP, ROUNDING_OF_TAYLOR};
use super::clusters::Clusters;
use super::derivatives::{Derivatives, REDUCED};
use super::local::{Local, sum_of_lanes};
use super::moments::COEFFICIENTS;
use super::place::Place;
use super::reach::CLASSES;
use super::{DualAccuracy, WIDTH};
use wide::f32x4;

/// The space that M2L needs.
#[derive(Default)]
pub struct FarFields {
    derivatives: Derivatives,
}

impl FarFields {
    /// Adds the fields of the clusters `far` to the Taylor polynomial of a block; answers a bound of the error made.
    pub fn add(
        &mut self,
        clusters: &Clusters,
        far: &[Vec<u32>; CLASSES],
        place: &Place,
        accuracy: &DualAccuracy,
        local: &mut Local,
    ) -> f64 {
        if far.iter().all(Vec::is_empty) {
            return 0.0;
        }
        let mut sums = [f32x4::ZERO; REDUCED];
        let mut error = 0.0;
        for (class, far) in far.iter().enumerate() {
            for four in far.chunks(WIDTH) {
                error += self.add_four(clusters, four, place, accuracy.class(class), &mut sums);
            }
        }
        local.add_derivatives(&sums, accuracy.degree);
        ROUND_UP * error
    }

    fn add_four(
        &mut self,
        clusters: &Clusters,
        four: &[u32],
        place: &Place,
        (order, degree): (usize, usize),
        sums: &mut [f32x4; REDUCED],
    ) -> f64 {
        let at = |k: usize| four[if k < four.len() { k } else { 0 }] as usize;
        let members = [at(0), at(1), at(2), at(3)];
        let ball = |k: usize| &clusters.balls[members[k]];
        let (offset, radius) = place.relative_to([ball(0), ball(1), ball(2), ball(3)]);
        let series = [0, 1, 2, 3].map(|k| &clusters.series[members[k]]);
        let spread = |k: usize| bounds::spread_of_order(series[k].spread, order);
        let spread = [spread(0), spread(1), spread(2), spread(3)];
        // Places beyond the last cluster repeat the first, without area.
        let weight = |k: usize| if k < four.len() { series[k].area } else { 0.0 };
        let area = f32x4::from([weight(0), weight(1), weight(2), weight(3)]);

        let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        let distance = square.sqrt();
        let inverse = f32x4::splat(1.0) / distance;
        let [a, b, c, d] = series;
        let rows = [&a.coefficients, &b.coefficients, &c.coefficients, &d.coefficients];
        let coefficients = weighted(rows, area * inverse * inverse, radius * inverse, order);
        let reach = f32x4::splat(place.radius);
        let unit = [offset[0] * inverse, offset[1] * inverse, offset[2] * inverse];
        self.derivatives.compute(unit, order + 1 + degree);
        let s = reach * inverse;
        self.derivatives.add_taylor(order, degree, &coefficients, s, sums);

        let (inner, outer) = (distance - reach, distance - radius);
        let left_out = bounds::multipole_tail(area, f32x4::from(spread), radius, inner, order)
            + bounds::taylor_tail(area, reach, outer, degree);
        let rounding = bounds::largest_field(area, inner - radius);
        sum_of_lanes(left_out) + ROUNDING_OF_TAYLOR * sum_of_lanes(rounding)
    }
}

/// Coefficients of four clusters in lanes, those of degree n times `weight` · `ratio`^(n−1).
#[inline(always)]
fn weighted(
    series: [&[f32; COEFFICIENTS]; WIDTH],
    weight: f32x4,
    ratio: f32x4,
    order: usize,
) -> [f32x4; COEFFICIENTS] {
    let mut lanes = [f32x4::ZERO; COEFFICIENTS];
    for k in (0..order * (order + 4) + 3).step_by(WIDTH) {
        let row =
            |of: usize| f32x4::from([series[of][k], series[of][k + 1], series[of][k + 2], series[of][k + 3]]);
        let rows = [row(0), row(1), row(2), row(3)];
        lanes[k..k + WIDTH].copy_from_slice(&f32x4::transpose(rows));
    }
    let mut scale = weight;
    for n in 1..order + 2 {
        lanes[n * n - 1..n * n + 2 * n].iter_mut().for_each(|c| *c *= scale);
        scale *= ratio;
    }
    lanes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::treecode::dual::reach::LONGEST;
    use crate::treecode::dual::sources::tests::{Dipoles, random};
    use std::f64::consts::PI;
    use wide::f32x4;

    fn exact(sources: &Dipoles, q: Vec3) -> f64 {
        sources.0.iter().map(|(p, v)| (*p - q).dot(*v) / ((*p - q).length().powi(3) * 4.0 * PI)).sum()
    }

    /// The field of 8 random dipoles in a cluster of about `size`, seen from a block of about `reach` at about distance 1:
    /// the largest error at its queries, the bound, and the largest field that sources of that area can have there.
    fn errors(seed: u64, size: f64, reach: f64, accuracy: &DualAccuracy) -> (f64, f64, f64) {
        let mut next = random(seed);
        let mut vector = || Vec3::new(next(), next(), next());
        let dipoles = (0..8).map(|_| (size * vector(), vector())).collect();
        let (middle, half) = (vector().normalize(), reach / 3f64.sqrt() * vector().abs());
        let queries: Vec<Vec3> = (0..20).map(|_| middle + half * vector()).collect();
        let sources = Dipoles(dipoles);
        // One leaf of all.
        let clusters = Clusters::build(&sources, 8);
        let frame = clusters.frame;
        let place = Place::around(frame.local(middle), half * frame.scale);
        let mut local = Local::ZERO;
        let mut longest: [Vec<u32>; CLASSES] = Default::default();
        longest[LONGEST].push(0);
        let bound = FarFields::default().add(&clusters, &longest, &place, accuracy, &mut local);
        let mut worst: f64 = 0.0;
        for q in queries {
            let offset = (frame.local(q) - place.center) / f64::from(place.radius);
            let mut values = [f32x4::ZERO];
            let lanes = offset.to_array().map(|x| f32x4::splat(x as f32));
            local.values(&[lanes], accuracy.degree, &mut values);
            worst = worst.max((f64::from(values[0].to_array()[3]) - exact(&sources, q)).abs());
        }
        let area: f64 = sources.0.iter().map(|s| s.1.length()).sum();
        (worst, bound, area / (4.0 * PI * (1.0 - 2.0 * size - reach).powi(2)))
    }

    #[test]
    fn error_stays_below_the_bound_and_reaches_a_good_part_of_it() {
        let mut largest: f64 = 0.0;
        for seed in 0..4000 {
            let order = (seed % 4) as usize;
            let accuracy = DualAccuracy { order, degree: order + 2, error: 1e-3 };
            let size = 0.02 + 0.25 * (seed % 13) as f64 / 13.0;
            let (error, bound, _) = errors(seed, size, 0.02 + 0.2 * (seed % 7) as f64 / 7.0, &accuracy);
            assert!(error <= bound, "seed {seed}: {error} above {bound}");
            largest = largest.max(error / bound);
        }
        assert!(largest > 0.1, "{largest}");
    }

    #[test]
    fn rounding_stays_well_below_its_part_of_the_bound() {
        let accuracy = DualAccuracy { order: 3, degree: 5, error: 1e-6 };
        // Series so fast that rounding is all that is left.
        let ratios = (0..4000).map(|seed| {
            let (error, _, scale) = errors(seed, 1e-3, 1e-3, &accuracy);
            error / scale
        });
        let largest = ratios.fold(0.0, f64::max);
        assert!(largest < 0.2 * ROUNDING_OF_TAYLOR, "{largest}");
    }

    #[test]
    fn halving_lengths_divides_the_error_by_the_power_of_the_order() {
        // Error terms: (order + 2) powers of the cluster's size less one, degree + 1 powers of the block's.
        for (order, degree) in [(0, 3), (1, 4), (2, 5), (3, 5)] {
            let accuracy = DualAccuracy { order, degree, error: 1e-3 };
            let mean = |size: f64, reach: f64| {
                (0..200).map(|seed| errors(seed, size, reach, &accuracy).0).sum::<f64>() / 200.0
            };
            let ratio = mean(0.16, 0.005) / mean(0.08, 0.005);
            let expected = 2f64.powi(order as i32 + 1);
            assert!((0.6 * expected..1.7 * expected).contains(&ratio), "order {order}: {ratio}");
        }
        for degree in 1..5 {
            let accuracy = DualAccuracy { order: 3, degree, error: 1e-3 };
            let mean = |reach: f64| (0..200).map(|s| errors(s, 0.01, reach, &accuracy).0).sum::<f64>();
            let (ratio, expected) = (mean(0.3) / mean(0.15), 2f64.powi(degree as i32 + 1));
            assert!((0.6 * expected..1.7 * expected).contains(&ratio), "degree {degree}: {ratio}");
        }
    }
}
