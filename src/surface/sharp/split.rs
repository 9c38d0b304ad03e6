//! Triangles cut where edges of the mesh are: whatever is cut, each edge of the result has the triangles that it had before, or
//! two new ones, so that the mesh stays closed, manifold and oriented.
use crate::math::Vec3;

/// A triangle of the result, and which corner of the old one has its part of the surface.
pub type Part = ([u32; 3], usize);

/// Cuts a triangle at new vertices on some of its sides; side k begins at corner k. Where all are cut, `amid` is a new vertex within.
///
/// ```text
///        c                 c                  c
///       / \               / \                /|\
///      /   \             1───\              / │ \
///     /   , b           / \    \0          2──×──1
///    a──0'             a───b               │ / \ │   (two cut: the shorter diagonal)
///                                          a──0──b
/// ```
pub fn cut(
    corners: [u32; 3],
    sides: [Option<u32>; 3],
    amid: Option<u32>,
    at: impl Fn(u32) -> Vec3,
) -> Vec<Part> {
    let turned = |k: usize| ([0, 1, 2].map(|i| corners[(k + i) % 3]), [0, 1, 2].map(|i| (k + i) % 3));
    match sides {
        [None, None, None] => vec![(corners, 0)],
        [Some(ab), Some(bc), Some(ca)] => {
            let [a, b, c] = corners;
            match amid {
                Some(m) => vec![
                    ([a, ab, m], 0),
                    ([a, m, ca], 0),
                    ([b, bc, m], 1),
                    ([b, m, ab], 1),
                    ([c, ca, m], 2),
                    ([c, m, bc], 2),
                ],
                None => vec![([a, ab, ca], 0), ([b, bc, ab], 1), ([c, ca, bc], 2), ([ab, bc, ca], 0)],
            }
        }
        _ => {
            let count = sides.iter().flatten().count();
            // One: the side that is cut comes first. Two: the one that is not.
            let first = (0..3).find(|&k| sides[k].is_some() == (count == 1)).unwrap_or(0);
            let ([a, b, c], names) = turned(first);
            let [ab, bc, ca] = [0, 1, 2].map(|i| sides[names[i]]);
            match (ab, bc, ca) {
                (Some(ab), ..) => vec![([a, ab, c], names[0]), ([ab, b, c], names[1])],
                (_, Some(bc), Some(ca)) => {
                    let is_first_shorter = at(a).distance_squared(at(bc)) <= at(b).distance_squared(at(ca));
                    let [one, other] = if is_first_shorter {
                        [([a, b, bc], names[1]), ([a, bc, ca], names[0])]
                    } else {
                        [([a, b, ca], names[0]), ([b, bc, ca], names[1])]
                    };
                    vec![one, other, ([bc, c, ca], names[2])]
                }
                _ => vec![(corners, 0)],
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whatever_is_cut_the_outline_stays() {
        for mask in 0..8u32 {
            for with_middle in [false, true] {
                let side = |k: u32| (mask >> k & 1 == 1).then_some(3 + k);
                let place = |v: u32| Vec3::new(f64::from(v), f64::from(v * v % 7), 0.0);
                let parts = cut([0, 1, 2], [0, 1, 2].map(side), with_middle.then_some(6), place);
                let mut sides: Vec<(u32, u32)> =
                    parts.iter().flat_map(|(t, _)| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]).collect();
                let all = sides.clone();
                sides.retain(|&(a, b)| !all.contains(&(b, a)));
                sides.sort();
                let mut expected: Vec<(u32, u32)> = (0..3)
                    .flat_map(|k| match side(k) {
                        Some(new) => vec![(k, new), (new, (k + 1) % 3)],
                        None => vec![(k, (k + 1) % 3)],
                    })
                    .collect();
                expected.sort();
                assert_eq!(sides, expected, "{mask}");
                assert!(parts.iter().all(|(t, owner)| t.iter().any(|v| *v == *owner as u32 || *v > 2)));
            }
        }
    }
}
