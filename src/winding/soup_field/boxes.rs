//! Boxes of samples that cover a few of a block.

/// Samples of a box for each that is open, at most; and how many of these it takes.
const MOST_OF_BOX: usize = 6;
const FEW_IN_BOX: usize = 32;

/// A sample of a lattice by its indices.
pub type Sample = [usize; 3];

/// Samples from a corner to before another, x fastest.
pub struct Box3 {
    pub low: Sample,
    pub high: Sample,
}

impl Box3 {
    fn counts(&self) -> [usize; 3] {
        std::array::from_fn(|axis| self.high[axis] - self.low[axis])
    }

    pub fn place(&self, [i, j, k]: Sample) -> usize {
        let [nx, ny, _] = self.counts();
        ((k - self.low[2]) * ny + (j - self.low[1])) * nx + i - self.low[0]
    }

    pub fn sample(&self, place: usize) -> Sample {
        let [nx, ny, _] = self.counts();
        [self.low[0] + place % nx, self.low[1] + place / nx % ny, self.low[2] + place / (nx * ny)]
    }
}

/// Covers samples by boxes of which a good part is samples, but for few that are not worth a box.
pub fn cover(samples: Vec<Sample>, boxes: &mut Vec<(Box3, Vec<Sample>)>, singly: &mut Vec<Sample>) {
    if samples.len() < FEW_IN_BOX {
        return singly.extend(samples);
    }
    let low = samples.iter().fold([usize::MAX; 3], |low, s| std::array::from_fn(|a| low[a].min(s[a])));
    let high = samples.iter().fold([0; 3], |high, s| std::array::from_fn(|a| high[a].max(s[a] + 1)));
    let one = Box3 { low, high };
    let counts = one.counts();
    if counts.iter().product::<usize>() <= MOST_OF_BOX * samples.len() {
        return boxes.push((one, samples));
    }
    let axis = (0..3).max_by_key(|axis| counts[*axis]).expect("there are three");
    let middle = low[axis] + counts[axis] / 2;
    let (before, behind) = samples.into_iter().partition(|s| s[axis] < middle);
    cover(before, boxes, singly);
    cover(behind, boxes, singly);
}
