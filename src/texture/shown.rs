//! Field lines to be looked at: some of them, spread over the soup, as far as the proxy.
use super::{SoupLines, Texture};
use crate::bvh::along_curve;
use crate::charge::{FieldLines, first_hits};
use crate::data::TriangleSoup;
use crate::math::area_vector;

impl Texture {
    /// The field lines as far as the proxy; those that meet none are whole, and straight ones where a line was replaced. With a
    /// `count` that many at most, spread by the area of the soup.
    pub fn lines_to_proxy(&self, count: Option<usize>) -> FieldLines {
        let starts = &self.lines.starts;
        let chosen = chosen(&self.soup, &self.lines, count);
        let mut whole = FieldLines::default();
        chosen.iter().for_each(|start| whole.push(self.lines.lines.line(*start as usize)));
        let mut lines = FieldLines::default();
        let hits = first_hits(&whole, &self.proxy.soup());
        for (k, hit) in hits.into_iter().enumerate() {
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
    let order = along_curve(&starts.points);
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

#[cfg(test)]
mod tests {
    use crate::data::{Silent, TriangleSoup};
    use crate::math::Vec3;
    use crate::texture::{ProxyConfig, TextureConfig, texture};

    /// A grid of n × n squares of side 1, two triangles each.
    fn sheet(n: u32) -> TriangleSoup {
        let place = |k: u32| Vec3::new(f64::from(k % (n + 1)), f64::from(k / (n + 1)), 0.0);
        let quad = |k: u32| {
            let v = k / n * (n + 1) + k % n;
            [[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]
        };
        let places = (0..(n + 1) * (n + 1)).map(place).collect();
        TriangleSoup::new(places, (0..n * n).flat_map(quad).collect()).unwrap()
    }

    #[test]
    fn some_lines_are_spread_and_all_end_on_the_proxy() {
        let proxy = ProxyConfig { offset: Some(1.0), samples: Some(20), ..ProxyConfig::default() };
        let config = TextureConfig { proxy, ..TextureConfig::default() };
        let made = texture(sheet(8).into(), &config, &Silent).unwrap();
        let all = made.lines_to_proxy(None);
        assert_eq!(all.len(), 81);
        for line in (0..all.len()).map(|k| all.line(k)) {
            let end = line.last().unwrap();
            let on_proxy = made.anchors.of_starts.iter().any(|anchor| anchor.point == *end);
            assert!(line[0].z == 0.0 && on_proxy, "{line:?}");
        }
        let some = made.lines_to_proxy(Some(4));
        assert_eq!(some.len(), 4);
        let quarter = |k: usize| {
            let start = some.line(k)[0];
            (start.x > 4.0, start.y > 4.0)
        };
        let mut quarters = [0, 1, 2, 3].map(quarter);
        quarters.sort_unstable();
        assert_eq!(quarters, [(false, false), (false, true), (true, false), (true, true)]);
        assert!(made.lines_to_proxy(Some(0)).is_empty());
    }

    #[test]
    fn seams_are_as_long_as_the_atlas_says() {
        let proxy = ProxyConfig { offset: Some(1.0), samples: Some(16), ..ProxyConfig::default() };
        let config = TextureConfig { proxy, ..TextureConfig::default() };
        let made = texture(sheet(4).into(), &config, &Silent).unwrap();
        let mesh = &made.proxy.mesh;
        let seams = made.atlas.seams(mesh);
        assert!(seams.is_sorted() && seams.iter().all(|[a, b]| a < b));
        let length = |[a, b]: &[u32; 2]| mesh.positions[*a as usize].distance(mesh.positions[*b as usize]);
        let total: f64 = seams.iter().map(length).sum();
        assert!(total > 0.0 && (total / made.atlas.seam_length - 1.0).abs() < 1e-12, "{total}");
    }
}
