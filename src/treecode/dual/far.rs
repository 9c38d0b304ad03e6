//! Far fields of clusters at blocks of queries (M2L), eight clusters at a time.
use super::bounds::{self, ROUND_UP, ROUNDING_OF_TAYLOR};
use super::clusters::Clusters;
use super::derivatives::{Derivatives, REDUCED};
use super::factors;
use super::local::{Local, sum_of_octet};
use super::moments::COEFFICIENTS;
use super::octet::{Octet, parts};
use super::place::Place;
use super::reach::CLASSES;
use super::{DualAccuracy, WIDTH};
use crate::math::{Floats, Registers, Work, in_widest_registers};
use wide::f32x4;

/// The space that M2L needs.
#[derive(Default)]
pub struct FarFields {
    derivatives: Derivatives,
}

impl FarFields {
    /// Adds the fields of the clusters `far` to the Taylor polynomial of a block; answers a bound of the error made if that is
    /// asked for: then `lacking` is what sources lack of the largest field.
    pub fn add(
        &mut self,
        clusters: &Clusters,
        far: &mut [Vec<u32>; CLASSES],
        place: &Place,
        accuracy: &DualAccuracy,
        lacking: Option<f32>,
        local: &mut Local,
    ) -> f64 {
        if far.iter().all(Vec::is_empty) {
            return 0.0;
        }
        fill_up(far);
        let (mut sums, mut errors) = ([Octet::ZERO; REDUCED], Octet::ZERO);
        let derivatives = &mut self.derivatives;
        let errors_if_asked = lacking.map(|lacking| (ROUNDING_OF_TAYLOR as f32 + lacking, &mut errors));
        let fields =
            Fields { derivatives, clusters, far, place, accuracy, sums: &mut sums, errors: errors_if_asked };
        in_widest_registers(fields);
        local.add_derivatives(&sums, accuracy.degree);
        ROUND_UP * sum_of_octet(&errors)
    }
}

/// Moves the last clusters of classes to the next longer ones where these have room for them in their last eight.
fn fill_up(far: &mut [Vec<u32>; CLASSES]) {
    for class in (1..CLASSES).rev() {
        let (shorter, longer) = far.split_at_mut(class);
        let (shorter, longer) = (&mut shorter[class - 1], &mut longer[0]);
        let (rest, room) = (shorter.len() % WIDTH, longer.len().next_multiple_of(WIDTH) - longer.len());
        if rest <= room {
            longer.extend(shorter.drain(shorter.len() - rest..));
        }
    }
}

/// The work of [`FarFields::add`].
struct Fields<'a> {
    derivatives: &'a mut Derivatives,
    clusters: &'a Clusters,
    far: &'a [Vec<u32>; CLASSES],
    place: &'a Place,
    accuracy: &'a DualAccuracy,
    sums: &'a mut [Octet; REDUCED],
    /// Bounds of errors, and what rounding and sources lack of the largest field.
    errors: Option<(f32, &'a mut Octet)>,
}

impl Work for Fields<'_> {
    #[inline(always)]
    fn run<R: Registers>(mut self) {
        let mut eight = Eight::default();
        for (class, far) in self.far.iter().enumerate() {
            let accuracy = self.accuracy.class(class);
            for members in far.chunks(WIDTH) {
                eight.gather(self.clusters, members, self.place, accuracy.0);
                for part in parts::<R::Singles>().filter(|part| *part < members.len()) {
                    self.add::<R::Singles>(&eight, part, accuracy);
                }
            }
        }
    }
}

impl Fields<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>>(&mut self, eight: &Eight, part: usize, (order, degree): (usize, usize)) {
        let [x, y, z] = &eight.offset;
        let (x, y, z): (F, F, F) = (x.get(part), y.get(part), z.get(part));
        let (radius, area): (F, F) = (eight.radius.get(part), eight.area.get(part));
        let square = x * x + y * y + z * z;
        let distance = square.sqrt();
        let inverse = F::splat(1.0) / distance;
        let mut factors = [F::splat(0.0); COEFFICIENTS];
        for (factor, eight) in factors.iter_mut().zip(&eight.factors) {
            *factor = eight.get(part);
        }
        let coefficients = factors::coefficients(factors, area * inverse * inverse, radius * inverse, order);
        let reach = F::splat(self.place.radius);
        let unit = [x * inverse, y * inverse, z * inverse];
        let highest = bounds::highest(order, degree);
        self.derivatives.compute(unit, highest);
        self.derivatives.add_taylor((order, degree), &coefficients, reach * inverse, part, self.sums);

        let Some((lacking, errors)) = &mut self.errors else { return };
        let (inner, outer) = (distance - reach, distance - radius);
        let left_out = bounds::multipole_tail(area, eight.spread.get(part), radius, inner, order)
            + bounds::taylor_tail(area, reach, outer, degree)
            + bounds::products(area, radius * inverse, reach * inverse, distance, (order, degree));
        let largest = bounds::largest_field(area, inner - radius);
        errors.add(part, left_out + F::splat(*lacking) * largest);
    }
}

/// Up to eight clusters, side by side. Places beyond the last one repeat the first, without area.
#[derive(Default)]
struct Eight {
    /// The block's centre relative to theirs.
    offset: [Octet; 3],
    radius: Octet,
    area: Octet,
    spread: Octet,
    factors: [Octet; COEFFICIENTS],
}

impl Eight {
    #[inline(always)]
    fn gather(&mut self, clusters: &Clusters, members: &[u32], place: &Place, order: usize) {
        let at = |k: usize| members[if k < members.len() { k } else { 0 }] as usize;
        for half in (0..WIDTH).step_by(4) {
            let four = [at(half), at(half + 1), at(half + 2), at(half + 3)];
            let (offset, radius) = place.relative_to(four.map(|c| &clusters.balls[c]));
            (0..3).for_each(|axis| self.offset[axis].put(half, offset[axis]));
            self.radius.put(half, radius);
            let series = four.map(|c| &clusters.series[c]);
            for k in (0..order * (order + 4) + 3).step_by(4) {
                let row = |of: usize| Floats::load(&series[of].factors[k..k + 4]);
                let lanes = f32x4::transpose([row(0), row(1), row(2), row(3)]);
                (0..4).for_each(|i| self.factors[k + i].put(half, lanes[i]));
            }
        }
        for k in 0..WIDTH {
            let series = &clusters.series[at(k)];
            self.area.0[k] = if k < members.len() { series.area } else { 0.0 };
            self.spread.0[k] = bounds::spread_of_order(series.spread, order);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::treecode::dual::reach::LONGEST;
    use crate::treecode::dual::sources::tests::{Dipoles, random};
    use std::f64::consts::PI;

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
        let bound =
            FarFields::default().add(&clusters, &mut longest, &place, accuracy, Some(0.0), &mut local);
        let mut worst: f64 = 0.0;
        for q in queries {
            let offset = (frame.local(q) - place.center) / f64::from(place.radius);
            let mut values = [Octet::ZERO];
            let group = offset.to_array().map(|x| Octet([x as f32; WIDTH]));
            local.add_values(&[group], (1.0, [0.0; 3]), accuracy.degree, &mut values);
            worst = worst.max((f64::from(values[0].0[3]) - exact(&sources, q)).abs());
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
