//! Triangles laid into a chart as they are in space.
use super::charts::Charts;
use crate::math::{Vec2, Vec3, area_vector, barycentre};
use crate::texture::Anchor;
use crate::texture::jacobian::Rest;
use glam::DQuat;

/// A triangle turned by the least angle into the plane of the face of an anchor, and laid into the texture as that is, with its middle at
/// the anchor; then moved into the chart's box.
pub fn laid(charts: &Charts, corners: [Vec3; 3], at: &Anchor) -> [Vec2; 3] {
    let mesh = &charts.proxy.mesh;
    let places = mesh.triangles[at.face as usize].map(|v| mesh.positions[v as usize]);
    let middle = charts.uv(at);
    let Some(rest) = Rest::new(places) else { return [middle; 3] };
    let [dx, dy] = rest.jacobian(charts.atlas.corners_of(at.face));
    let (normal, own) = (area_vector(places).normalize_or_zero(), area_vector(corners).normalize_or_zero());
    let x = (places[1] - places[0]).normalize_or_zero();
    let y = normal.cross(x);
    let turn = DQuat::from_rotation_arc(own, normal);
    let center = barycentre(corners);
    let uv = corners.map(|p| {
        let p = turn * (p - center);
        middle + p.dot(x) * dx + p.dot(y) * dy
    });
    kept(uv, charts.boxes[charts.chart(at) as usize])
}

/// A triangle moved as little as it takes to lie in a box of the texture, where it is no larger than that, and in the texture: one that is
/// larger than that is made smaller.
fn kept(uv: [Vec2; 3], around: [Vec2; 2]) -> [Vec2; 3] {
    let [low, high] = extent(uv);
    let shrunk = (high - low).max_element().max(1.0).recip();
    let middle = 0.5 * (low + high);
    let uv = within(uv.map(|p| middle + shrunk * (p - middle)), around);
    within(uv, [Vec2::ZERO, Vec2::ONE]).map(|p| p.clamp(Vec2::ZERO, Vec2::ONE))
}

/// A triangle moved as little as it takes to lie in a box; where it is larger, middle on middle.
fn within(uv: [Vec2; 3], [low, high]: [Vec2; 2]) -> [Vec2; 3] {
    let [least, most] = extent(uv);
    let centred = 0.5 * (low + high - least - most);
    let least_move = (low - least).max(Vec2::ZERO) + (high - most).min(Vec2::ZERO);
    let shift = Vec2::select((most - least).cmpgt(high - low), centred, least_move);
    uv.map(|p| p + shift)
}

fn extent([a, b, c]: [Vec2; 3]) -> [Vec2; 2] {
    [a.min(b).min(c), a.max(b).max(c)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_are_moved_into_the_box_or_over_its_middle_and_never_leave_the_texture() {
        let v = |x: f64, y: f64| Vec2::new(x, y);
        let around = [v(0.5, 0.125), v(0.75, 0.25)];
        let small = [v(0.8125, 0.0), v(0.875, 0.0), v(0.8125, 0.0625)];
        assert_eq!(kept(small, around), small.map(|p| p + v(-0.125, 0.125)));
        // As wide as the texture, and low: over the middle of the box, as far as the texture reaches.
        let wide = [v(0.0, 0.125), v(1.0, 0.125), v(0.5, 0.25)];
        assert_eq!(kept(wide, around), wide);
        let huge = [v(-1.0, 0.0), v(3.0, 0.0), v(-1.0, 2.0)];
        assert_eq!(kept(huge, around), [v(0.0, 0.0), v(1.0, 0.0), v(0.0, 0.5)]);
    }
}
