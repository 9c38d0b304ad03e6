//! Local expansions: Taylor polynomials of far fields about the middle of a block of queries.
use super::QueryGroup;
use super::derivatives::REDUCED;
use super::harmonic::place;
use super::octet::{Octet, parts};
use crate::math::{Floats, Registers, Work, in_widest_registers};
use crate::treecode::expansion::sum_of_lanes;
use wide::f32x4;

/// Highest degree.
pub const MAX_DEGREE: usize = 5;
/// Monomials in three variables up to that degree.
const TERMS: usize = (MAX_DEGREE + 1) * (MAX_DEGREE + 2) * (MAX_DEGREE + 3) / 6;

/// Place of the coefficients of y^b z^c x^a, a = 0 … `MAX_DEGREE` − b − c, which are contiguous.
const fn line(b: usize, c: usize) -> usize {
    let (mut at, mut z) = (0, 0);
    while z < c {
        let side = MAX_DEGREE + 1 - z;
        at += side * (side + 1) / 2;
        z += 1;
    }
    let side = MAX_DEGREE + 1 - c;
    at + b * side - b * b.saturating_sub(1) / 2
}

/// [`line`] for each c and b.
const LINES: [[usize; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut lines = [[0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut c = 0;
    while c <= MAX_DEGREE {
        let mut b = 0;
        while b + c <= MAX_DEGREE {
            lines[c][b] = line(b, c);
            b += 1;
        }
        c += 1;
    }
    lines
};

/// Place of y^b z^c.
#[inline(always)]
fn place_of(b: usize, c: usize) -> usize {
    LINES[c][b]
}

const INVERSE_FACTORIAL: [f64; MAX_DEGREE + 1] = [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0];

/// A polynomial Σ T_abc x^a y^b z^c up to `degree`, lengths in units of the block's radius.
#[derive(Clone, Copy)]
pub struct Local {
    terms: [f64; TERMS],
}

impl Local {
    pub const ZERO: Local = Local { terms: [0.0; TERMS] };

    /// Adds derivatives L_β of a harmonic function, given with 0 and 1 in z, octets to be summed. Those with more in
    /// z follow: L_(a,b,c) = −L_(a+2,b,c−2) − L_(a,b+2,c−2).
    pub fn add_derivatives(&mut self, reduced: &[Octet; REDUCED], degree: usize) {
        for n in 0..=degree {
            let mut rows = [[0.0; MAX_DEGREE + 1]; 2];
            for (z, row) in rows.iter_mut().enumerate() {
                let places = &reduced[place(n, z, 0)..place(n, z, (n + 1).saturating_sub(z))];
                row.iter_mut().zip(places).for_each(|(l, lanes)| *l = sum_of_octet(lanes));
            }
            for c in 0..=n {
                let row = &mut rows[c % 2];
                if c >= 2 {
                    (0..=n - c).for_each(|a| row[a] = -(row[a + 2] + row[a]));
                }
                for (a, l) in row[..=n - c].iter().enumerate() {
                    let b = n - c - a;
                    let factor = INVERSE_FACTORIAL[a] * INVERSE_FACTORIAL[b] * INVERSE_FACTORIAL[c];
                    self.terms[place_of(b, c) + a] += factor * l;
                }
            }
        }
    }

    /// The same polynomial about a point at `d` (in units of this block's radius), lengths multiplied by `ratio`, the
    /// new radius over the old one (L2L). Exact up to rounding.
    pub fn moved(&self, d: [f64; 3], ratio: f64, degree: usize) -> Local {
        let mut terms = self.terms;
        // Horner's scheme along each axis in turn.
        for c in 0..=degree {
            for b in 0..=degree - c {
                let length = degree - b - c;
                let start = place_of(b, c);
                for first in 0..length {
                    (first..length).rev().for_each(|a| terms[start + a] += d[0] * terms[start + a + 1]);
                }
            }
        }
        for c in 0..=degree {
            for a in 0..=degree - c {
                let length = degree - a - c;
                for first in 0..length {
                    for b in (first..length).rev() {
                        terms[place_of(b, c) + a] += d[1] * terms[place_of(b + 1, c) + a];
                    }
                }
            }
        }
        for b in 0..=degree {
            for a in 0..=degree - b {
                let length = degree - a - b;
                for first in 0..length {
                    for c in (first..length).rev() {
                        terms[place_of(b, c) + a] += d[2] * terms[place_of(b, c + 1) + a];
                    }
                }
            }
        }
        let mut powers = [1.0; MAX_DEGREE + 1];
        (1..=MAX_DEGREE).for_each(|n| powers[n] = powers[n - 1] * ratio);
        for c in 0..=degree {
            for b in 0..=degree - c {
                let start = place_of(b, c);
                (0..=degree - b - c).for_each(|a| terms[start + a] *= powers[a + b + c]);
            }
        }
        Local { terms }
    }

    /// Adds the values at groups of queries, whose positions are `scale` times those given, moved by `shift`, in units of the
    /// block's radius (L2P).
    pub fn add_values(
        &self,
        queries: &[QueryGroup],
        (scale, shift): (f32, [f32; 3]),
        degree: usize,
        values: &mut [Octet],
    ) {
        in_widest_registers(Values { local: self, queries, scale, shift, degree, values });
    }

    #[inline(always)]
    fn value_of<F: Floats<Number = f32>, const DEGREE: usize>(terms: &[f32; TERMS], [x, y, z]: [F; 3]) -> F {
        let mut sum = F::splat(0.0);
        for c in (0..=DEGREE).rev() {
            let mut in_y = F::splat(0.0);
            for b in (0..=DEGREE - c).rev() {
                let mut in_x = F::splat(0.0);
                for term in terms[place_of(b, c)..][..=DEGREE - b - c].iter().rev() {
                    in_x = in_x * x + F::splat(*term);
                }
                in_y = in_y * y + in_x;
            }
            sum = sum * z + in_y;
        }
        sum
    }
}

/// The work of [`Local::add_values`].
struct Values<'a> {
    local: &'a Local,
    queries: &'a [QueryGroup],
    scale: f32,
    shift: [f32; 3],
    degree: usize,
    values: &'a mut [Octet],
}

impl Values<'_> {
    #[inline(always)]
    fn add<F: Floats<Number = f32>, const DEGREE: usize>(self) {
        let terms = self.local.terms.map(|t| t as f32);
        for (group, values) in self.queries.iter().zip(self.values) {
            for part in parts::<F>() {
                let scale = F::splat(self.scale);
                let x = group[0].get::<F>(part) * scale + F::splat(self.shift[0]);
                let y = group[1].get::<F>(part) * scale + F::splat(self.shift[1]);
                let z = group[2].get::<F>(part) * scale + F::splat(self.shift[2]);
                values.add(part, Local::value_of::<F, DEGREE>(&terms, [x, y, z]));
            }
        }
    }
}

impl Work for Values<'_> {
    #[inline(always)]
    fn run<R: Registers>(self) {
        match self.degree {
            ..=2 => self.add::<R::Singles, 2>(),
            3 => self.add::<R::Singles, 3>(),
            4 => self.add::<R::Singles, 4>(),
            _ => self.add::<R::Singles, 5>(),
        }
    }
}

/// The sum of eight numbers.
pub fn sum_of_octet(octet: &Octet) -> f64 {
    let [a, b, c, d, e, f, g, h] = octet.0;
    sum_of_lanes(f32x4::new([a, b, c, d]) + f32x4::new([e, f, g, h]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(local: &Local, p: [f32; 3]) -> f64 {
        let mut values = [Octet::ZERO];
        local.add_values(&[p.map(|x| Octet([4.0 * x - 1.0; 8]))], (0.25, [0.25; 3]), MAX_DEGREE, &mut values);
        f64::from(values[0].0[5])
    }

    #[test]
    fn a_moved_polynomial_has_the_same_values() {
        let local = Local { terms: std::array::from_fn(|i| ((i * 7919 % 31) as f64 - 15.0) / 15.0) };
        let moved = local.moved([0.5, -0.25, 0.125], 0.5, MAX_DEGREE);
        for p in [[0.0f32; 3], [0.5, -0.25, 0.75], [-1.0, 0.5, 0.25]] {
            let old = [0.5 + 0.5 * p[0], -0.25 + 0.5 * p[1], 0.125 + 0.5 * p[2]];
            assert!((value(&moved, p) - value(&local, old)).abs() < 1e-5);
        }
    }
}
