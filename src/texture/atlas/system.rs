//! Sparse symmetric systems over the vertices of a chart, two unknowns each, solved by conjugate gradients (Hestenes & Stiefel 1952).
use crate::math::Vec2;

/// A symmetric 2 × 2 block: xx, xy, yy.
pub type Block = [f64; 3];

fn times([xx, xy, yy]: Block, v: Vec2) -> Vec2 {
    Vec2::new(xx * v.x + xy * v.y, xy * v.x + yy * v.y)
}

fn inverse([xx, xy, yy]: Block) -> Block {
    let determinant = xx * yy - xy * xy;
    if determinant > 0.0 { [yy, -xy, xx].map(|entry| entry / determinant) } else { [1.0, 0.0, 1.0] }
}

/// Blocks where vertices share a triangle: rows of a symmetric matrix, the diagonal first.
pub struct System {
    starts: Vec<u32>,
    columns: Vec<u32>,
    blocks: Vec<Block>,
    /// Of each triangle, the places of its nine blocks, row by row.
    places: Vec<[u32; 9]>,
}

impl System {
    /// All zero.
    pub fn new(vertices: usize, triangles: &[[u32; 3]]) -> System {
        let mut pairs: Vec<u64> = (0..vertices as u64).map(|v| v << 32).collect();
        for t in triangles {
            for k in 0..3 {
                let [row, one, other] = [t[k], t[(k + 1) % 3], t[(k + 2) % 3]].map(u64::from);
                pairs.extend([row << 32 | (one + 1), row << 32 | (other + 1)]);
            }
        }
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0u32; vertices + 1];
        pairs.iter().for_each(|pair| starts[(pair >> 32) as usize + 1] += 1);
        (0..vertices).for_each(|v| starts[v + 1] += starts[v]);
        // A diagonal block is first in its row: its column was 0, others are counted from 1.
        let column = |pair: &u64| match *pair as u32 {
            0 => (pair >> 32) as u32,
            other => other - 1,
        };
        let columns: Vec<u32> = pairs.iter().map(column).collect();
        let place = |row: u32, of: u32| {
            let first = starts[row as usize];
            if row == of {
                return first;
            }
            let rest = &columns[first as usize + 1..starts[row as usize + 1] as usize];
            first + 1 + rest.binary_search(&of).expect("corners of a triangle share it") as u32
        };
        let places = triangles
            .iter()
            .map(|t| [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|k: usize| place(t[k / 3], t[k % 3])))
            .collect();
        let blocks = vec![[0.0; 3]; columns.len()];
        System { starts, columns, blocks, places }
    }

    pub fn clear(&mut self) {
        self.blocks.fill([0.0; 3]);
    }

    /// Adds `scale · block` where corners `row` and `column` of a triangle meet.
    pub fn add(&mut self, triangle: usize, [row, column]: [usize; 2], scale: f64, block: Block) {
        let at = &mut self.blocks[self.places[triangle][3 * row + column] as usize];
        (0..3).for_each(|k| at[k] += scale * block[k]);
    }

    /// Adds to the diagonal of a vertex.
    pub fn add_diagonal(&mut self, vertex: usize, value: f64) {
        let at = &mut self.blocks[self.starts[vertex] as usize];
        at[0] += value;
        at[2] += value;
    }

    fn row(&self, vertex: usize) -> std::ops::Range<usize> {
        self.starts[vertex] as usize..self.starts[vertex + 1] as usize
    }

    pub fn diagonal(&self, vertex: usize) -> Block {
        self.blocks[self.starts[vertex] as usize]
    }

    fn product(&self, x: &[Vec2], result: &mut [Vec2]) {
        for (vertex, to) in result.iter_mut().enumerate() {
            let terms = self.row(vertex).map(|k| times(self.blocks[k], x[self.columns[k] as usize]));
            *to = terms.fold(Vec2::ZERO, |sum, term| sum + term);
        }
    }

    /// Moves `x` toward the solution of `matrix · x = right`, until the residual is `tolerance` times as large as that of x = 0 or the
    /// steps are used up; preconditioned by the inverse diagonal blocks. Each step lowers the quadratic function of the system, so that
    /// even the first few are a way down.
    pub fn solve(&self, right: &[Vec2], x: &mut [Vec2], tolerance: f64, steps: usize) {
        let inverses: Vec<Block> = (0..x.len()).map(|v| inverse(self.diagonal(v))).collect();
        let precondition = |r: &[Vec2], z: &mut [Vec2]| {
            z.iter_mut().zip(r).zip(&inverses).for_each(|((z, r), m)| *z = times(*m, *r));
        };
        let dot = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
        let mut product = vec![Vec2::ZERO; x.len()];
        self.product(x, &mut product);
        let mut residual: Vec<Vec2> = right.iter().zip(&product).map(|(b, p)| *b - *p).collect();
        let mut preconditioned = residual.clone();
        precondition(right, &mut preconditioned);
        let enough = tolerance * tolerance * dot(right, &preconditioned);
        precondition(&residual, &mut preconditioned);
        let mut direction = preconditioned.clone();
        let mut square = dot(&residual, &preconditioned);
        for _ in 0..steps {
            if square <= enough {
                break;
            }
            self.product(&direction, &mut product);
            let step = square / dot(&direction, &product);
            if !step.is_finite() {
                break;
            }
            for k in 0..x.len() {
                x[k] += step * direction[k];
                residual[k] -= step * product[k];
            }
            precondition(&residual, &mut preconditioned);
            let next = dot(&residual, &preconditioned);
            let share = next / square;
            square = next;
            direction.iter_mut().zip(&preconditioned).for_each(|(d, z)| *d = *z + share * *d);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_gives_back_the_right_side() {
        // A strip of 40 triangles, with blocks that are not diagonal.
        let triangles: Vec<[u32; 3]> = (0..40).map(|t| [t, t + 1, t + 2]).collect();
        let mut system = System::new(42, &triangles);
        for t in 0..40 {
            for k in 0..9 {
                let scale = if k % 4 == 0 { 2.0 } else { -1.0 };
                system.add(t, [k / 3, k % 3], scale, [2.0 + t as f64 % 3.0, 0.7, 1.0]);
            }
        }
        (0..42).for_each(|v| system.add_diagonal(v, 0.01));
        let wanted: Vec<Vec2> = (0..42).map(|v| Vec2::new((1.3 * v as f64).sin(), v as f64)).collect();
        let mut right = vec![Vec2::ZERO; 42];
        system.product(&wanted, &mut right);
        let mut x = vec![Vec2::ZERO; 42];
        system.solve(&right, &mut x, 1e-14, 1000);
        assert!(x.iter().zip(&wanted).all(|(a, b)| a.distance(*b) < 1e-8), "{x:?}");
    }
}
