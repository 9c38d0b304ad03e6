/// How far from a point the others must be to act on it, from the first iteration to the last, where the cloud fills the cube
/// [−1/1.1, 1/1.1]³: wider for noisier clouds (Lin et al. 2024, whose schedules l0 to l5 these are).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    pub first: f64,
    pub last: f64,
}

impl Widths {
    /// l0: no noise.
    pub const CLEAN: Widths = Widths { first: 0.016, last: 0.002 };
    /// l0 to l5.
    pub const ALL: [Widths; 6] = [
        Widths::CLEAN,
        Widths { first: 0.04, last: 0.01 },
        Widths { first: 0.08, last: 0.02 },
        Widths { first: 0.12, last: 0.03 },
        Widths { first: 0.16, last: 0.04 },
        Widths { first: 0.2, last: 0.05 },
    ];

    /// The width of an iteration.
    pub fn at(&self, iteration: usize, iterations: usize) -> f64 {
        let t = iteration as f64 / (iterations.max(2) - 1) as f64;
        self.first + t * (self.last - self.first)
    }
}
