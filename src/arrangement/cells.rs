//! Points found by their place, where rounding may have put them a little beside it.
//!
//! Edges and triangles that met in a vertex before they were turned or moved pass it, and each other, by some units in the last place.
//! Points made there would lie so near to each other that triangles see them in different orders: they are one.
use crate::math::Vec3;
use rustc_hash::FxHashMap;

/// Points are one if their coordinates differ by no more than 2⁻⁵⁰ of the power of two below the largest of them.
const BITS: i32 = 50;
/// From here on up, so that a cell has a size.
const LOWEST: i32 = -900;
/// Points as near to a power of two, relatively, are found from both sides of it.
const MARGIN: f64 = 1e-9;

/// For each power of two that largest coordinates have, a grid of cells of twice the distance at which points are told apart.
#[derive(Default)]
pub struct Cells {
    points: FxHashMap<(i32, [i64; 3]), Vec<u32>>,
}

/// The exponent of a size that is finite.
fn exponent(size: f64) -> i32 {
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    let biased = (size.to_bits() >> MANTISSA) as i32;
    (biased - (f64::MAX_EXP - 1)).max(LOWEST)
}

fn power_of_two(exponent: i32) -> f64 {
    2f64.powi(exponent)
}

fn cell(place: Vec3, size: f64) -> [i64; 3] {
    place.to_array().map(|x| (x / size).floor() as i64)
}

impl Cells {
    pub fn insert(&mut self, place: Vec3, point: u32) {
        let largest = place.abs().max_element();
        let [low, high] = [1.0 - MARGIN, 1.0 + MARGIN].map(|factor| exponent(largest * factor));
        for e in low..=high {
            let at = cell(place, power_of_two(e - BITS + 1));
            self.points.entry((e, at)).or_default().push(point);
        }
    }

    /// The nearest of the points that are one with what lies in a place, and how far off it is; of several the first by number.
    pub fn nearest(&self, place: Vec3, positions: &[Vec3]) -> Option<(f64, u32)> {
        let e = exponent(place.abs().max_element());
        let reach = power_of_two(e - BITS);
        let [low, high] = [-reach, reach].map(|off| cell(place + off, 2.0 * reach));
        let mut nearest: Option<(f64, u32)> = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for point in self.points.get(&(e, [x, y, z])).into_iter().flatten() {
                        let off = (positions[*point as usize] - place).abs().max_element();
                        if off <= reach && nearest.is_none_or(|best| (off, *point) < best) {
                            nearest = Some((off, *point));
                        }
                    }
                }
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(places: &[Vec3], query: Vec3) -> Option<u32> {
        let mut cells = Cells::default();
        (0..).zip(places).for_each(|(point, place)| cells.insert(*place, point));
        cells.nearest(query, places).map(|(_, point)| point)
    }

    #[test]
    fn units_in_the_last_place_make_no_new_point() {
        let ulp = f64::EPSILON;
        for size in [1.0, -3.0, 1e-200, 1e70, 0.0] {
            let place = size * Vec3::new(1.0, 0.25, -0.5);
            assert_eq!(found(&[place], place), Some(0), "{size}");
            assert_eq!(found(&[place], place + size * Vec3::new(-ulp, 2.0 * ulp, ulp)), Some(0), "{size}");
            let off = size * Vec3::new(0.0, 0.0, 1e-14);
            assert_eq!(found(&[place], place + off), (size == 0.0).then_some(0), "{size}");
        }
        // The nearest of two, from below a power of two and from above.
        let places = [Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 2.0 * ulp, 0.0)];
        assert_eq!(found(&places, Vec3::new(1.0 - 0.5 * ulp, 1.5 * ulp, 0.0)), Some(1));
        assert_eq!(found(&places, Vec3::new(1.0 + ulp, 0.5 * ulp, 0.0)), Some(0));
    }
}
