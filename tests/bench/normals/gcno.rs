//! Globally consistent normal orientation of Xu et al. 2023, as *Leaps and Bounds* tells it (appendix E): for comparison.
use super::lbfgs::minimise;
use super::voronoi::Diagram;
use fast_winding::math::{Aabb, Vec3};
use fast_winding::treecode::{Clustered, Mutual};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// λ_B and λ_A: those of the authors' published code.
const BALANCE: f64 = 50.0;
const ALIGNMENT: f64 = 10.0;
/// Most steps of L-BFGS. Theirs ends after 150, where ours has 68 % of the dragon's 3,000 points outward; 600 have 98 %.
const STEPS: usize = 600;
/// Clusters act as a whole beyond so many of their radii, and points not at all within this distance.
const OPENING: f64 = 3.0;
const WIDTH: f64 = 1e-6;

struct Problem {
    points: Vec<Vec3>,
    diagram: Diagram,
    down: Mutual,
    up: Mutual,
}

/// Outward normals of distinct points.
pub fn gcno(points: &[Vec3], mut random: impl FnMut() -> f64) -> Vec<Vec3> {
    let bounds = Aabb::around(points.iter().copied());
    let scale = 2.0 / bounds.size().max_element();
    let points: Vec<Vec3> = points.iter().map(|p| (*p - bounds.center()) * scale).collect();
    let diagram = Diagram::of(&points);
    let sources = Arc::new(Clustered::new(&points));
    let vertices = Arc::new(Clustered::new(&diagram.vertices));
    let down = Mutual::between(&sources, &vertices, OPENING);
    let up = Mutual::between(&vertices, &sources, OPENING);
    let mut angles: Vec<f64> =
        points.iter().flat_map(|_| [(2.0 * random() - 1.0).acos(), TAU * random()]).collect();
    let problem = Problem { points, diagram, down, up };
    minimise(&mut angles, &|angles| problem.loss(angles), STEPS);
    angles.chunks(2).map(|a| frame(a)[0]).collect()
}

/// The normal at a polar angle and an azimuth, and its derivatives.
fn frame(angles: &[f64]) -> [Vec3; 3] {
    let ((sin, cos), (sine, cosine)) = (angles[0].sin_cos(), angles[1].sin_cos());
    [
        Vec3::new(sin * cosine, sin * sine, cos),
        Vec3::new(cos * cosine, cos * sine, -sin),
        Vec3::new(-sin * sine, sin * cosine, 0.0),
    ]
}

impl Problem {
    /// Eq. 55 and its slope.
    fn loss(&self, angles: &[f64]) -> (f64, Vec<f64>) {
        let frames: Vec<[Vec3; 3]> = angles.chunks(2).map(frame).collect();
        let areas = &self.diagram.areas;
        let vectors: Vec<Vec3> = frames.iter().zip(areas).map(|(f, a)| *a * f[0]).collect();
        let winding: Vec<f64> =
            self.down.potentials(&vectors, WIDTH).iter().map(|w| w / (4.0 * PI)).collect();
        let (mut loss, mut slopes) = (0.0, Vec::with_capacity(winding.len()));
        for w in &winding {
            let x = w - 0.5;
            loss += 4.0 * x.powi(4) - 2.0 * x * x - w / 4.0;
            slopes.push(16.0 * x.powi(3) - 4.0 * x - 0.25);
        }
        let mut along = vec![Vec3::ZERO; frames.len()];
        for (i, cell) in self.diagram.cells.iter().enumerate() {
            let count = cell.len() as f64;
            let of = |k: &u32| winding[*k as usize];
            let mean = cell.iter().map(of).sum::<f64>() / count;
            for k in cell {
                let (w, offset) = (of(k), self.diagram.vertices[*k as usize] - self.points[i]);
                // Eq. 58 squares the offset, in print; a vector has no square, and the authors' code has none.
                let height = frames[i][0].dot(offset);
                loss += (ALIGNMENT * w * height - BALANCE * (w - mean).powi(2)) / count;
                slopes[*k as usize] += (ALIGNMENT * height - 2.0 * BALANCE * (w - mean)) / count;
                along[i] += ALIGNMENT / count * w * offset;
            }
        }
        let fields = self.up.fields(&slopes, WIDTH);
        let share = 1.0 / frames.len() as f64;
        let slope = (0..frames.len()).flat_map(|i| {
            let pull = share * (areas[i] / (4.0 * PI) * fields[i] + along[i]);
            [frames[i][1].dot(pull), frames[i][2].dot(pull)]
        });
        (share * loss, slope.collect())
    }
}
