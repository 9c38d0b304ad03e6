//! Field lines to be looked at: some of them, spread over the soup, as far as the proxy.
use super::{SoupLines, Texture};
use crate::bvh::{morton_code, sorted_codes};
use crate::charge::{FieldLines, first_hits};
use crate::data::{TriangleSoup, map_items};
use crate::math::{Aabb, area_vector};

impl Texture {
    /// The field lines as far as the proxy; those that meet none are whole, and straight ones where a line was replaced. With a
    /// `count` that many at most, spread by the area of the soup.
    pub fn lines_to_proxy(&self, count: Option<usize>) -> FieldLines {
        let starts = &self.lines.starts;
        let chosen = chosen(&self.soup, &self.lines, count);
        let mut whole = FieldLines::default();
        chosen.iter().for_each(|start| whole.push(self.lines.lines.line(*start as usize)));
        let mut lines = FieldLines::default();
        for (k, hit) in first_hits(&whole, &self.proxy.soup()).into_iter().enumerate() {
            let start = chosen[k] as usize;
            let end = self.anchors.of_starts[start].point;
            match hit {
                _ if self.anchors.is_lost[start] => lines.push(whole.line(k)),
                Some(hit) if hit.point == end => {
                    let before = &whole.line(k)[..=hit.segment as usize];
                    lines.push(&[before, &[end]].concat());
                }
                _ => lines.push(&[starts.points[start], end]),
            }
        }
        lines
    }
}

/// Starts at equal steps of area along a space-filling curve, in its order.
fn chosen(soup: &TriangleSoup, lines: &SoupLines, count: Option<usize>) -> Vec<u32> {
    let starts = &lines.starts;
    let bounds = Aabb::around(starts.points.iter().copied());
    let order = sorted_codes(map_items(starts.points.len(), |s| morton_code(starts.points[s], &bounds))).1;
    let Some(count) = count.filter(|count| *count < order.len()) else { return order };
    let mut areas = vec![0.0; order.len()];
    for (t, corners) in starts.corners.iter().enumerate() {
        let area = area_vector(soup.corners(t)).length();
        corners.iter().for_each(|start| areas[*start as usize] += area);
    }
    let total: f64 = areas.iter().sum();
    let (mut passed, mut taken) = (0.0, 0);
    let mut chosen = Vec::with_capacity(count);
    for start in order {
        passed += areas[start as usize];
        // How many steps end before the middle of this start's share.
        let due = (count as f64 * (passed - 0.5 * areas[start as usize]) / total + 0.5) as usize;
        if due > taken && chosen.len() < count {
            chosen.push(start);
            taken = due;
        }
    }
    chosen
}
