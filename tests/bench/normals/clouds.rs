use fast_winding::data::TriangleSoup;
use fast_winding::math::{Aabb, Vec3};
use fast_winding::metrics::{SurfaceSamples, sample_surface};

/// Standard deviations along each axis, in longest edges of the box.
const NOISES: [f64; 3] = [0.0025, 0.005, 0.01];
/// Balls without points, and their radius in longest edges of the box.
const HOLES: (usize, f64) = (10, 0.07);

/// Samples so many points of a model.
pub type Distort = Box<dyn Fn(&TriangleSoup, usize) -> SurfaceSamples>;

/// All kinds of clouds, by name.
pub fn kinds() -> Vec<(String, Distort)> {
    let mut kinds: Vec<(String, Distort)> = vec![
        ("clean".into(), Box::new(sample)),
        ("uneven".into(), Box::new(uneven)),
        ("parts missing".into(), Box::new(holed)),
    ];
    for noise in NOISES {
        let noisy = move |soup: &TriangleSoup, count: usize| {
            let mut samples = sample(soup, count);
            let (size, mut random) = (size(&samples), Random(7));
            let mut shift = || noise * size * random.normal();
            samples.points.iter_mut().for_each(|p| *p += Vec3::new(shift(), shift(), shift()));
            samples
        };
        kinds.push((format!("noise {} %", 100.0 * noise), Box::new(noisy)));
    }
    kinds
}

fn sample(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    sample_surface(soup, count, 1).expect("the model has an area")
}

fn size(samples: &SurfaceSamples) -> f64 {
    Aabb::around(samples.points.iter().copied()).size().max_element()
}

/// Up to ten times as many points at one end as at the other.
fn uneven(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    let all = sample(soup, 3 * count);
    let bounds = Aabb::around(all.points.iter().copied());
    let mut random = Random(5);
    let mut kept =
        keep(all, |p| random.unit() < 0.1 + 0.9 * ((p.x - bounds.min.x) / bounds.size().x).powi(2));
    kept.points.truncate(count);
    kept.normals.truncate(count);
    kept
}

fn holed(soup: &TriangleSoup, count: usize) -> SurfaceSamples {
    let samples = sample(soup, count);
    let (radius, mut random) = (HOLES.1 * size(&samples), Random(9));
    let len = samples.points.len();
    let centers: Vec<Vec3> =
        (0..HOLES.0).map(|_| samples.points[(random.unit() * len as f64) as usize]).collect();
    keep(samples, |p| centers.iter().all(|c| c.distance(p) > radius))
}

fn keep(samples: SurfaceSamples, mut wanted: impl FnMut(Vec3) -> bool) -> SurfaceSamples {
    let (points, normals) =
        samples.points.into_iter().zip(samples.normals).filter(|(p, _)| wanted(*p)).unzip();
    SurfaceSamples { points, normals }
}

/// A linear congruential generator (Knuth's MMIX).
pub struct Random(pub u64);

impl Random {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Normally distributed, nearly: a sum of twelve.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.unit()).sum::<f64>() - 6.0
    }
}
