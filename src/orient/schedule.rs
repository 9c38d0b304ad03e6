use crate::estimate::Roughness;

/// How far from a point the others must be to act on it, from the first iteration to the last, where the cloud fills the cube
/// [−1/1.1, 1/1.1]³: wider for noisier clouds (Lin et al. 2024, whose schedules l0 to l5 these are).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    pub first: f64,
    pub last: f64,
}

/// How many spacings the last width is at least. Angles of samples of 3,000 to 40,000 points without noise are best from 0.4
/// to 1; with more, thin parts are lost.
const SPACINGS: f64 = 0.4;
/// And how many times the noise: where it is 0.25 % to 0.5 % of the box, angles are best from 6 to 11.
const NOISES: f64 = 6.0;
/// Below so many spacings what looks like noise may be shape that the points are too sparse for, and wide widths would lose it:
/// then l3 is the widest. Of 3,000 clean points of a dragon and of raised letters that turns 99.1 % and 98.8 % outward, l5, which
/// the noise seen would ask for, 97.9 % and 95.7 %.
const CERTAIN: f64 = 0.3;

impl Widths {
    /// l0 to l5.
    pub const ALL: [Widths; 6] = [
        Widths { first: 0.016, last: 0.002 },
        Widths { first: 0.04, last: 0.01 },
        Widths { first: 0.08, last: 0.02 },
        Widths { first: 0.12, last: 0.03 },
        Widths { first: 0.16, last: 0.04 },
        Widths { first: 0.2, last: 0.05 },
    ];

    /// The narrowest of these that is as wide as spacing and noise of a cloud ask for, both in the unit of that cube.
    pub fn for_roughness(roughness: &Roughness) -> Widths {
        let by_noise = NOISES * roughness.noise;
        let is_certain = roughness.noise >= CERTAIN * roughness.spacing;
        let by_noise = if is_certain { by_noise } else { by_noise.min(Widths::ALL[3].last) };
        let needed = by_noise.max(SPACINGS * roughness.spacing);
        let [.., widest] = Widths::ALL;
        Widths::ALL.into_iter().find(|widths| widths.last >= needed).unwrap_or(widest)
    }

    /// The width of an iteration.
    pub(super) fn at(&self, iteration: usize, iterations: usize) -> f64 {
        let t = iteration as f64 / (iterations.max(2) - 1) as f64;
        self.first + t * (self.last - self.first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_grow_with_spacing_and_noise() {
        let chosen = |spacing, noise| Widths::for_roughness(&Roughness { spacing, noise });
        assert_eq!(chosen(0.002, 0.0), Widths::ALL[0]);
        assert_eq!(chosen(0.01, 1e-4), Widths::ALL[1]);
        assert_eq!(chosen(0.01, 0.0045), Widths::ALL[3]);
        assert_eq!(chosen(0.04, 0.0), Widths::ALL[2]);
        assert_eq!((chosen(0.04, 0.011), chosen(0.04, 0.013)), (Widths::ALL[3], Widths::ALL[5]));
        assert_eq!(chosen(1.0, 1.0), Widths::ALL[5]);
        assert!((Widths::ALL[5].at(39, 40) - 0.05).abs() < 1e-12);
        assert_eq!(Widths::ALL[5].at(0, 1), 0.2);
    }
}
