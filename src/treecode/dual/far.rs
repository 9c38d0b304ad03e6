//! Far fields of clusters at blocks of queries (M2L), four clusters at a time.
use super::bounds::{self, ROUND_UP, ROUNDING_OF_TAYLOR};
use super::clusters::Clusters;
use super::derivatives::{Derivatives, REDUCED};
use super::local::{Local, sum_of_lanes};
use super::moments::COEFFICIENTS;
use super::place::Place;
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
        far: &[u32],
        place: &Place,
        accuracy: &DualAccuracy,
        local: &mut Local,
    ) -> f64 {
        if far.is_empty() {
            return 0.0;
        }
        let mut sums = [f32x4::ZERO; REDUCED];
        let mut error = 0.0;
        for four in far.chunks(WIDTH) {
            error += self.add_four(clusters, four, place, accuracy, &mut sums);
        }
        local.add_derivatives(&sums, accuracy.degree);
        ROUND_UP * error
    }

    fn add_four(
        &mut self,
        clusters: &Clusters,
        four: &[u32],
        place: &Place,
        accuracy: &DualAccuracy,
        sums: &mut [f32x4; REDUCED],
    ) -> f64 {
        let at = |k: usize| four[if k < four.len() { k } else { 0 }] as usize;
        let members = [at(0), at(1), at(2), at(3)];
        let ball = |k: usize| &clusters.balls[members[k]];
        let (offset, radius) = place.relative_to([ball(0), ball(1), ball(2), ball(3)]);
        let series = [0, 1, 2, 3].map(|k| &clusters.series[members[k]]);
        let spread = |k: usize| bounds::spread_of_order(series[k].spread, accuracy.order);
        let spread = [spread(0), spread(1), spread(2), spread(3)];
        // Places beyond the last cluster repeat the first, without area.
        let weight = |k: usize| if k < four.len() { series[k].area } else { 0.0 };
        let area = f32x4::from([weight(0), weight(1), weight(2), weight(3)]);

        let square = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
        let distance = square.sqrt();
        let inverse = f32x4::splat(1.0) / distance;
        let [a, b, c, d] = series;
        let rows = [&a.coefficients, &b.coefficients, &c.coefficients, &d.coefficients];
        let coefficients = weighted(rows, area * inverse * inverse, radius * inverse, accuracy.order);
        let reach = f32x4::splat(place.radius);
        let unit = [offset[0] * inverse, offset[1] * inverse, offset[2] * inverse];
        self.derivatives.compute(unit, accuracy.order + 1 + accuracy.degree);
        let s = reach * inverse;
        self.derivatives.add_taylor(accuracy.order, accuracy.degree, &coefficients, s, sums);

        let (inner, outer) = (distance - reach, distance - radius);
        let left_out = bounds::multipole_tail(area, f32x4::from(spread), radius, inner, accuracy.order)
            + bounds::taylor_tail(area, reach, outer, accuracy.degree);
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
        let row = |of: usize| f32x4::from([series[of][k], series[of][k + 1], series[of][k + 2], series[of][k + 3]]);
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
