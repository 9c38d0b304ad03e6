//! Charts placed in a square: each turned into its smallest box, boxes packed by the guillotine method at the largest scale that fits.
use super::AtlasError;
use crate::data::{Monitor, ascending};
use crate::math::Vec2;
use guillotiere::{AtlasAllocator, size2};

/// Halvings of the range of scales that is searched.
const HALVINGS: usize = 14;

/// Where the vertices of each chart come to lie, from 0 to 1 in both directions.
pub struct Packed {
    pub places: Vec<Vec<Vec2>>,
    /// Texels for a millimetre.
    pub scale: f64,
}

/// Packs charts given by places in millimetres into a square of `side` texels, at least `margin` texels apart and half of that from its
/// sides.
///
/// # Errors
/// If and only if they do not fit at any scale, as each takes a texel and its margin, or the monitor cancels.
pub fn packed(
    charts: Vec<Vec<Vec2>>,
    side: u32,
    margin: u32,
    monitor: &dyn Monitor,
) -> Result<Packed, AtlasError> {
    let charts: Vec<Vec<Vec2>> = charts.into_iter().map(upright).collect();
    let sizes: Vec<Vec2> =
        charts.iter().map(|chart| chart.iter().fold(Vec2::ZERO, |size, p| size.max(*p))).collect();
    // The tallest first; of equal ones the widest.
    let mut order = ascending(sizes.iter().map(|s| -(s.y + 1e-6 * s.x)));
    order.truncate(sizes.len());
    let area: f64 = sizes.iter().map(|s| s.x * s.y).sum();
    let largest = sizes.iter().fold(0.0, |m: f64, s| m.max(s.max_element()));
    let texels = f64::from(side);
    let mut high = (texels / area.sqrt()).min(texels / largest.max(f64::MIN_POSITIVE));
    if !high.is_finite() {
        high = texels;
    }
    let (mut low, mut best) = (0.0, None);
    for halving in 0..HALVINGS {
        monitor.report(halving as f64 / HALVINGS as f64, "packing")?;
        let scale = if best.is_none() { 0.5 * high } else { 0.5 * (low + high) };
        match placed(&sizes, &order, scale, side, margin) {
            Some(places) => {
                low = scale;
                best = Some((scale, places));
            }
            None => high = scale,
        }
    }
    let Some((scale, corners)) = best else {
        return Err(AtlasError::DoesNotFit { charts: charts.len(), side, margin });
    };
    let at = |(chart, corner): (Vec<Vec2>, &Vec2)| {
        chart.into_iter().map(|p| (scale * p + *corner) / texels).collect()
    };
    monitor.report(1.0, "packing")?;
    Ok(Packed { places: charts.into_iter().zip(&corners).map(at).collect(), scale })
}

/// The lower left corners of all boxes in texels, if they fit.
fn placed(sizes: &[Vec2], order: &[u32], scale: f64, side: u32, margin: u32) -> Option<Vec<Vec2>> {
    let mut free = AtlasAllocator::new(size2(side as i32, side as i32));
    let mut corners = vec![Vec2::ZERO; sizes.len()];
    for chart in order {
        let texels = (scale * sizes[*chart as usize]).ceil() + f64::from(margin);
        let place = free.allocate(size2((texels.x as i32).max(1), (texels.y as i32).max(1)))?.rectangle.min;
        let corner = Vec2::new(f64::from(place.x), f64::from(place.y));
        corners[*chart as usize] = corner + 0.5 * f64::from(margin);
    }
    Some(corners)
}

/// A chart turned so that its box is the smallest, wider than high, with a corner at 0.
fn upright(chart: Vec<Vec2>) -> Vec<Vec2> {
    let outline = hull(&chart);
    let mut best = (f64::INFINITY, Vec2::X);
    for k in 0..outline.len() {
        // One side of the smallest box lies along a side of the convex hull (Freeman & Shapira 1975).
        let along = (outline[(k + 1) % outline.len()] - outline[k]).normalize_or_zero();
        if along == Vec2::ZERO {
            continue;
        }
        let (low, high) = extent(&outline, along);
        let size = high - low;
        if size.x * size.y < best.0 {
            best = (size.x * size.y, if size.x < size.y { -along.perp() } else { along });
        }
    }
    let (low, _) = extent(&outline, best.1);
    chart.iter().map(|p| turned(*p, best.1) - low).collect()
}

/// In a frame with its first axis along a unit vector.
fn turned(p: Vec2, along: Vec2) -> Vec2 {
    Vec2::new(p.dot(along), p.dot(along.perp()))
}

fn extent(points: &[Vec2], along: Vec2) -> (Vec2, Vec2) {
    let none = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    points.iter().map(|p| turned(*p, along)).fold(none, |(low, high), p| (low.min(p), high.max(p)))
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(points: &[Vec2]) -> Vec<Vec2> {
    let mut sorted = points.to_vec();
    sorted.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let half = |points: &mut dyn Iterator<Item = &Vec2>| {
        let mut chain: Vec<Vec2> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(*p - a) <= 0.0
            {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut sorted.iter());
    hull.extend(half(&mut sorted.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    #[test]
    fn a_turned_rectangle_gets_its_own_box() {
        let angle = Vec2::from_angle(0.7);
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]].map(Vec2::from_array);
        let chart = upright(corners.iter().map(|p| angle.rotate(*p)).collect());
        let (low, high) = extent(&chart, Vec2::X);
        assert!(low.length() < 1e-12 && high.distance(Vec2::new(3.0, 1.0)) < 1e-12, "{low} {high}");
    }

    #[test]
    fn boxes_lie_apart_and_cover_most_of_the_square() {
        let square = |a: f64, b: f64| [[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]].map(Vec2::from_array).to_vec();
        let charts: Vec<Vec<Vec2>> =
            (0..40).map(|k| square(1.0 + f64::from(k % 5), 1.0 + f64::from(k % 3))).collect();
        let area: f64 = (0..40).map(|k| (1.0 + f64::from(k % 5)) * (1.0 + f64::from(k % 3))).sum();
        let found = packed(charts, 1024, 4, &Silent).unwrap();
        let boxes: Vec<(Vec2, Vec2)> = found.places.iter().map(|chart| extent(chart, Vec2::X)).collect();
        for (k, (low, high)) in boxes.iter().enumerate() {
            assert!(low.cmpge(Vec2::ZERO).all() && high.cmple(Vec2::ONE).all());
            for (other_low, other_high) in &boxes[..k] {
                let gap = (*low - *other_high).max(*other_low - *high).max_element();
                assert!(gap > 3.99 / 1024.0, "{gap}");
            }
        }
        assert!(area * found.scale.powi(2) / 1024f64.powi(2) > 0.7);
        assert!(packed(vec![square(1.0, 1.0); 100], 16, 4, &Silent).is_err());
    }
}
