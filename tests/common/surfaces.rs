//! Points sampled on analytic surfaces, with the area that each truly stands for.
use super::random;
use fast_winding::PointCloud;
use fast_winding::math::{Vec2, Vec3};
use fast_winding::metrics::NearestPoints;
use std::f64::consts::{PI, TAU};

/// A place on a surface, for two numbers in [0, 1].
#[derive(Clone, Copy)]
pub struct Place {
    pub point: Vec3,
    pub normal: Vec3,
    /// Area on the surface over that of the two numbers.
    pub stretch: f64,
    /// Places of other parts are no neighbours on the surface, near as they may be in space.
    pub part: usize,
}

/// How often a place is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sampling {
    /// Drawn by lot, everywhere as often.
    Random,
    /// Drawn by lot, e^{2.3 (x − 1)} as often, for x from −1 to 1: 100 times between the ends.
    Uneven,
    /// As scanned: drawn by lot, but none nearer to another than 0.7 of the mean distance.
    Spaced,
    /// Drawn by lot, each place six times, as the corners of loose triangles.
    SixTimes,
}

#[derive(Clone, Copy)]
pub struct Surface {
    pub name: &'static str,
    pub place: fn(f64, f64) -> Place,
    /// Whether it has an inside.
    pub is_closed: bool,
}

pub const SURFACES: [Surface; 5] = [
    Surface { name: "sphere", place: sphere_place, is_closed: true },
    Surface { name: "torus", place: torus_place, is_closed: true },
    Surface { name: "ellipsoid", place: ellipsoid_place, is_closed: true },
    Surface { name: "disk", place: disk_place, is_closed: false },
    Surface { name: "sheet", place: sheet_place, is_closed: false },
];

fn sphere_place(s: f64, t: f64) -> Place {
    let z = 1.0 - 2.0 * s;
    let (sin, cos) = (TAU * t).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    let point = Vec3::new(r * cos, r * sin, z);
    Place { point, normal: point, stretch: 4.0 * PI, part: 0 }
}

fn torus_place(s: f64, t: f64) -> Place {
    let ((sin_u, cos_u), (sin_v, cos_v)) = ((TAU * s).sin_cos(), (TAU * t).sin_cos());
    let normal = Vec3::new(cos_v * cos_u, cos_v * sin_u, sin_v);
    let around = 0.7 + 0.3 * cos_v;
    let point = Vec3::new(0.7 * cos_u, 0.7 * sin_u, 0.0) + 0.3 * normal;
    Place { point, normal, stretch: TAU * TAU * 0.3 * around, part: 0 }
}

/// Half axes 1, 0.6 and 0.3.
fn ellipsoid_place(s: f64, t: f64) -> Place {
    let axes = Vec3::new(1.0, 0.6, 0.3);
    let on_sphere = sphere_place(s, t).point;
    let normal = on_sphere / axes;
    let stretch = 4.0 * PI * axes.element_product() * normal.length();
    Place { point: on_sphere * axes, normal: normal.normalize(), stretch, part: 0 }
}

fn disk_place(s: f64, t: f64) -> Place {
    let point = (s.sqrt() * Vec2::from_angle(TAU * t)).extend(0.0);
    Place { point, normal: Vec3::Z, stretch: PI, part: 0 }
}

/// Both sides of a square of side 2 and thickness 0.01, without its rim.
fn sheet_place(s: f64, t: f64) -> Place {
    let part = usize::from(s >= 0.5);
    let along = 2.0 * s - part as f64;
    let side = if part == 1 { 1.0 } else { -1.0 };
    let point = Vec3::new(2.0 * along - 1.0, 2.0 * t - 1.0, 0.005 * side);
    Place { point, normal: Vec3::Z * side, stretch: 8.0, part }
}

/// `count` points on a surface.
pub fn sample(surface: &Surface, sampling: Sampling, count: usize, seed: u64) -> Vec<Place> {
    let mut next = random(seed);
    let most = (0..2000).map(|_| (surface.place)(next(), next()).stretch).fold(0.0, f64::max) * 1.01;
    let area: f64 = (0..2000).map(|_| (surface.place)(next(), next()).stretch / 2000.0).sum();
    let places = if sampling == Sampling::SixTimes { count / 6 } else { count };
    let nearest_allowed = 0.7 * (area / count as f64).sqrt();
    let mut found: Vec<Place> = Vec::with_capacity(count);
    while found.len() < places {
        let place = (surface.place)(next(), next());
        let wanted = match sampling {
            Sampling::Uneven => (2.3 * (place.point.x - 1.0)).exp(),
            _ => 1.0,
        };
        let is_clear = |p: &Place| p.part != place.part || p.point.distance(place.point) > nearest_allowed;
        let is_drawn = next() * most <= place.stretch * wanted;
        if is_drawn && (sampling != Sampling::Spaced || found.iter().all(is_clear)) {
            found.push(place);
        }
    }
    if sampling == Sampling::SixTimes { (0..6).flat_map(|_| found.clone()).collect() } else { found }
}

/// The area nearest to each of the places, on the surface: from a million points spread evenly over it (the plastic number's
/// sequence). Equal places share theirs.
pub fn true_areas(surface: &Surface, places: &[Place]) -> Vec<f64> {
    const DENSE: usize = 1 << 20;
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let dense: Vec<Place> = (1..=DENSE)
        .map(|k| [1.0, 2.0].map(|power| (0.5 + k as f64 / PLASTIC.powf(power)).fract()))
        .map(|[s, t]| (surface.place)(s, t))
        .collect();
    let mut areas = vec![0.0; places.len()];
    for part in 0..2 {
        let own: Vec<usize> = (0..places.len()).filter(|&i| places[i].part == part).collect();
        let points: Vec<Vec3> = own.iter().map(|&i| places[i].point).collect();
        let queries: Vec<&Place> = dense.iter().filter(|place| place.part == part).collect();
        let near = NearestPoints::new(&points).of(&queries.iter().map(|p| p.point).collect::<Vec<_>>());
        near.iter().zip(queries).for_each(|((i, _), q)| areas[own[*i]] += q.stretch / DENSE as f64);
    }
    let mut by_place = std::collections::HashMap::new();
    let key = |place: &Place| (place.part, place.point.to_array().map(f64::to_bits));
    for (place, area) in places.iter().zip(&areas) {
        let (sum, count) = by_place.entry(key(place)).or_insert((0.0, 0.0));
        (*sum, *count) = (*sum + area, *count + 1.0);
    }
    places.iter().map(|place| by_place[&key(place)]).map(|(sum, count)| sum / count).collect()
}

pub fn cloud_of(places: &[Place]) -> PointCloud {
    let (points, normals) = places.iter().map(|place| (place.point, place.normal)).unzip();
    PointCloud::cleaned(points, Some(normals), None).unwrap().0
}

/// Relative errors of areas: their median, the 95th of 100, and that of the sum.
#[derive(Clone, Copy, Debug)]
pub struct AreaErrors {
    pub median: f64,
    pub most: f64,
    pub sum: f64,
}

pub fn area_errors(areas: &[f64], truth: &[f64]) -> AreaErrors {
    let mut errors: Vec<f64> = areas.iter().zip(truth).map(|(a, t)| (a / t - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[(share * (errors.len() - 1) as f64) as usize];
    let sum = areas.iter().sum::<f64>() / truth.iter().sum::<f64>() - 1.0;
    AreaErrors { median: at(0.5), most: at(0.95), sum }
}
