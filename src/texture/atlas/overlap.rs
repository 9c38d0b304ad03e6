use crate::math::Vec2;
use rustc_hash::FxHashMap;

/// Whether no two segments cross or touch, but where they share an end. A map of a disk that flips no triangle overlaps itself if and
/// only if its rim does.
pub fn is_simple(segments: &[[u32; 2]], places: &[Vec2]) -> bool {
    let ends = |s: usize| segments[s].map(|v| places[v as usize]);
    let total: f64 = (0..segments.len()).map(|s| ends(s)[0].distance(ends(s)[1])).sum();
    // Cells as large as a segment in the mean.
    let cell = total / segments.len().max(1) as f64;
    if !(cell > 0.0 && cell.is_finite()) {
        return false;
    }
    let mut cells: FxHashMap<(i64, i64), Vec<u32>> = FxHashMap::default();
    for s in 0..segments.len() {
        let [a, b] = ends(s);
        let (low, high) = ((a.min(b) / cell).floor(), (a.max(b) / cell).floor());
        for x in low.x as i64..=high.x as i64 {
            for y in low.y as i64..=high.y as i64 {
                let here = cells.entry((x, y)).or_default();
                if here.iter().any(|other| meet(segments, places, s, *other as usize)) {
                    return false;
                }
                here.push(s as u32);
            }
        }
    }
    true
}

fn meet(segments: &[[u32; 2]], places: &[Vec2], one: usize, other: usize) -> bool {
    let ([i, j], [k, l]) = (segments[one], segments[other]);
    if i == k || i == l || j == k || j == l {
        return false;
    }
    let [a, b, c, d] = [i, j, k, l].map(|v| places[v as usize]);
    let side = |p: Vec2, q: Vec2, r: Vec2| {
        let coordinate = |v: Vec2| robust::Coord { x: v.x, y: v.y };
        robust::orient2d(coordinate(p), coordinate(q), coordinate(r))
    };
    let apart = |s: f64, t: f64| (s > 0.0 && t > 0.0) || (s < 0.0 && t < 0.0);
    if a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any() {
        return false;
    }
    !apart(side(a, b, c), side(a, b, d)) && !apart(side(c, d, a), side(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_that_crosses_itself_is_not_simple() {
        let ring = |places: &[[f64; 2]]| {
            let count = places.len() as u32;
            let segments: Vec<[u32; 2]> = (0..count).map(|k| [k, (k + 1) % count]).collect();
            is_simple(&segments, &places.iter().map(|p| Vec2::from_array(*p)).collect::<Vec<_>>())
        };
        assert!(ring(&[[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [1.5, 0.5], [0.0, 2.0]]));
        assert!(!ring(&[[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [1.5, -0.5], [0.0, 2.0]]));
        // A vertex on a side.
        assert!(!ring(&[[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [1.5, 0.0], [0.0, 2.0]]));
        assert!(!ring(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]));
    }
}
