//! Multipole fields at queries (M2P).
use super::clusters::Series;
use super::factors::factor;
use super::octet::Octet;
use super::sources::{QueryGroup, relative};
use crate::math::Floats;

/// The series of one cluster for queries near a point.
pub struct Multipole<'a> {
    pub series: &'a Series,
    /// The centre, relative to that point.
    pub center: [f32; 3],
    pub radius: f32,
}

impl Multipole<'_> {
    /// Adds the field of order `ORDER` at a part of a group of queries, relative to the same point.
    #[inline(always)]
    pub fn add<F: Floats<Number = f32>, const ORDER: usize>(
        &self,
        queries: &QueryGroup,
        part: usize,
        sums: &mut Octet,
    ) {
        let splat = F::splat;
        let [x, y, z] = relative::<F>(queries, part, self.center);
        let square = x * x + y * y + z * z;
        let inverse_square = splat(1.0) / square;
        let inverse = square.sqrt() * inverse_square;
        let (x, y, z) = (x * inverse, y * inverse, z * inverse);
        let t = splat(self.radius) * inverse;
        // For each m the sum over n of t^(n−1) q_nm(z) times the coefficients, by Horner's scheme in t.
        let mut zero = self.cosine::<F>(0, 1) * z;
        let (mut cosine_1, mut sine_1) = (self.cosine::<F>(1, 1), self.sine::<F>(1, 1));
        let mut sum = splat(0.0);
        if ORDER >= 1 {
            let tt = t * t;
            let (tz, zz) = (t * z, z * z);
            let q20 = (zz - splat(1.0 / 3.0)) * t;
            zero = zero + self.cosine::<F>(0, 2) * q20;
            cosine_1 = cosine_1 + self.cosine::<F>(1, 2) * tz;
            sine_1 = sine_1 + self.sine::<F>(1, 2) * tz;
            let (xx_yy, xy) = (x * x - y * y, (x + x) * y);
            let (mut cosine_2, mut sine_2) = (self.cosine::<F>(2, 2) * t, self.sine::<F>(2, 2) * t);
            if ORDER >= 2 {
                let (q30, q31) = ((zz - splat(0.6)) * (tt * z), (zz - splat(0.2)) * tt);
                let ttz = t * tz;
                zero = zero + self.cosine::<F>(0, 3) * q30;
                cosine_1 = cosine_1 + self.cosine::<F>(1, 3) * q31;
                sine_1 = sine_1 + self.sine::<F>(1, 3) * q31;
                cosine_2 = cosine_2 + self.cosine::<F>(2, 3) * ttz;
                sine_2 = sine_2 + self.sine::<F>(2, 3) * ttz;
                let (re_3, im_3) = (xx_yy * x - xy * y, xx_yy * y + xy * x);
                let (mut cosine_3, mut sine_3) = (self.cosine::<F>(3, 3) * tt, self.sine::<F>(3, 3) * tt);
                if ORDER >= 3 {
                    let ttt = tt * t;
                    let tttz = ttt * z;
                    let q40 = (zz * (zz - splat(6.0 / 7.0)) + splat(3.0 / 35.0)) * ttt;
                    let q41 = (zz - splat(3.0 / 7.0)) * tttz;
                    let q42 = (zz - splat(1.0 / 7.0)) * ttt;
                    zero = zero + self.cosine::<F>(0, 4) * q40;
                    cosine_1 = cosine_1 + self.cosine::<F>(1, 4) * q41;
                    sine_1 = sine_1 + self.sine::<F>(1, 4) * q41;
                    cosine_2 = cosine_2 + self.cosine::<F>(2, 4) * q42;
                    sine_2 = sine_2 + self.sine::<F>(2, 4) * q42;
                    cosine_3 = cosine_3 + self.cosine::<F>(3, 4) * tttz;
                    sine_3 = sine_3 + self.sine::<F>(3, 4) * tttz;
                    let (re_4, im_4) = (xx_yy * xx_yy - xy * xy, (xx_yy + xx_yy) * xy);
                    sum = sum + (self.cosine::<F>(4, 4) * re_4 + self.sine::<F>(4, 4) * im_4) * ttt;
                }
                sum = sum + cosine_3 * re_3 + sine_3 * im_3;
            }
            sum = sum + cosine_2 * xx_yy + sine_2 * xy;
        }
        sum = sum + zero + (cosine_1 * x + sine_1 * y);
        sums.add(part, sum * (splat(self.series.area) * inverse_square));
    }

    /// The factor of q_nm cos mφ.
    #[inline(always)]
    fn cosine<F: Floats<Number = f32>>(&self, m: usize, n: usize) -> F {
        F::splat(self.series.factors[factor(n, m, false)])
    }

    /// The factor of q_nm sin mφ.
    #[inline(always)]
    fn sine<F: Floats<Number = f32>>(&self, m: usize, n: usize) -> F {
        F::splat(self.series.factors[factor(n, m, true)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::treecode::dual::bounds::{
        ROUNDING_OF_MULTIPOLE, largest_field, multipole_tail, spread_of_order,
    };
    use crate::treecode::dual::clusters::Clusters;
    use crate::treecode::dual::sources::tests::{Dipoles, random};
    use std::f64::consts::PI;
    use wide::f32x4;

    fn value(multipole: &Multipole, q: Vec3, order: usize) -> f64 {
        let query = q.to_array().map(|x| Octet([x as f32; 8]));
        let mut sums = Octet::ZERO;
        match order {
            0 => multipole.add::<f32x4, 0>(&query, 4, &mut sums),
            1 => multipole.add::<f32x4, 1>(&query, 4, &mut sums),
            2 => multipole.add::<f32x4, 2>(&query, 4, &mut sums),
            _ => multipole.add::<f32x4, 3>(&query, 4, &mut sums),
        };
        f64::from(sums.0[5])
    }

    #[test]
    fn error_stays_below_the_bound_and_rounding_below_its_part() {
        let mut largest_rounding: f64 = 0.0;
        for seed in 0..8000 {
            let order = (seed % 4) as usize;
            let mut next = random(seed);
            let mut vector = || Vec3::new(next(), next(), next());
            let dipoles: Vec<(Vec3, Vec3)> = (0..6).map(|_| (vector(), vector())).collect();
            let far = if seed % 2 == 0 { 1e4 } else { 2.5 + (seed % 11) as f64 / 5.0 };
            let q = far * vector().normalize();
            let sum: f64 =
                dipoles.iter().map(|(p, v)| (*p - q).dot(*v) / ((*p - q).length().powi(3) * 4.0 * PI)).sum();
            let clusters = Clusters::build(&Dipoles(dipoles), 8);
            let ball = clusters.balls[0];
            let center = Vec3::new(f64::from(ball[0]), f64::from(ball[1]), f64::from(ball[2]));
            let local = clusters.frame.local(q);
            let offset = (center - local).to_array().map(|x| x as f32);
            let multipole = Multipole { series: &clusters.series[0], center: offset, radius: ball[3] };
            let error = (value(&multipole, Vec3::ZERO, order) - sum).abs();
            let [area, radius, distance, spread] = [
                clusters.series[0].area,
                ball[3],
                (center - local).length() as f32,
                spread_of_order(clusters.series[0].spread, order),
            ]
            .map(f32x4::splat);
            if (distance - radius).to_array()[0] <= 0.1 * radius.to_array()[0] {
                continue;
            }
            let one = |lanes: f32x4| f64::from(lanes.to_array()[0]);
            let left_out = one(multipole_tail(area, spread, radius, distance, order));
            let scale = one(largest_field(area, distance - radius));
            let bound = left_out + ROUNDING_OF_MULTIPOLE * scale;
            assert!(error <= bound, "seed {seed}: {error} above {bound}");
            if order == 3 && far > 1e3 {
                largest_rounding = largest_rounding.max(error / scale);
            }
        }
        assert!(largest_rounding < 0.05 * ROUNDING_OF_MULTIPOLE, "{largest_rounding}");
    }
}
