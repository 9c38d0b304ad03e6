//! Shapes for textures: closed ones to be torn apart, assemblies, plates.
use super::{cuboid, joined, random, sphere, torus};
use fast_winding::TriangleSoup;
use fast_winding::math::{Aabb, Vec3};
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Each triangle with corners of its own, moved in all directions by `noise` diagonals of the bounds in the mean.
pub fn torn(soup: &TriangleSoup, noise: f64, seed: u64) -> TriangleSoup {
    let mut next = random(seed);
    // The mean length of a vector from a cube of half side 1 is 0.9606.
    let half = noise * soup.bounds().diagonal() / 0.9606;
    let mut jitter = || half * Vec3::new(2.0 * next() - 1.0, 2.0 * next() - 1.0, 2.0 * next() - 1.0);
    let positions: Vec<Vec3> = (0..soup.len()).flat_map(|t| soup.corners(t)).map(|p| p + jitter()).collect();
    let triangles = (0..soup.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    TriangleSoup::new(positions, triangles).unwrap()
}

/// The unit cube from −1 to 1, each side a grid of n × n squares; closed.
pub fn gridded_cube(n: usize) -> TriangleSoup {
    let mut shape = Quads::default();
    let step = 2.0 / n as f64;
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let at = |i: usize, j: usize| {
                let mut p = Vec3::ZERO;
                p[axis] = side;
                p[(axis + 1) % 3] = -1.0 + step * i as f64;
                p[(axis + 2) % 3] = -1.0 + step * j as f64;
                p
            };
            for k in 0..n * n {
                let (i, j) = (k / n, k % n);
                let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                shape.add(if side > 0.0 { quad } else { [quad[3], quad[2], quad[1], quad[0]] });
            }
        }
    }
    shape.soup()
}

/// A plate bent round an axis, with five holes: closed, of genus 5. Cells of it are divided into n × n squares.
pub fn genus_five(n: usize) -> TriangleSoup {
    let (columns, rows) = (11 * n, 3 * n);
    let is_solid = |i: i64, j: i64| {
        let inside = i >= 0 && j >= 0 && i < columns as i64 && j < rows as i64;
        inside && !(j as usize / n == 1 && i as usize / n % 2 == 1)
    };
    let at = |i: i64, j: i64, top: bool| {
        let angle = 4.0 * i as f64 / columns as f64;
        let radius = if top { 4.0 } else { 3.2 };
        Vec3::new(radius * angle.cos(), radius * angle.sin(), 4.0 * j as f64 / rows as f64)
    };
    let mut shape = Quads::default();
    for k in 0..(columns * rows) as i64 {
        let (i, j) = (k / rows as i64, k % rows as i64);
        if !is_solid(i, j) {
            continue;
        }
        let ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        shape.add(ring.map(|(i, j)| at(i, j, true)));
        shape.add([3, 2, 1, 0].map(|k| at(ring[k].0, ring[k].1, false)));
        let neighbours = [(i, j - 1), (i + 1, j), (i, j + 1), (i - 1, j)];
        for (side, _) in neighbours.iter().enumerate().filter(|(_, (i, j))| !is_solid(*i, *j)) {
            let (a, b) = (ring[side], ring[(side + 1) % 4]);
            shape.add([at(b.0, b.1, true), at(a.0, a.1, true), at(a.0, a.1, false), at(b.0, b.1, false)]);
        }
    }
    shape.soup()
}

/// A solid of revolution about z through points of (radius, height), ends on the axis.
pub fn turned(profile: &[(f64, f64)], count: usize) -> TriangleSoup {
    let at = |k: usize, j: usize| {
        let angle = TAU * (j % count) as f64 / count as f64;
        Vec3::new(profile[k].0 * angle.cos(), profile[k].0 * angle.sin(), profile[k].1)
    };
    let mut shape = Quads::default();
    for k in 0..profile.len() - 1 {
        for j in 0..count {
            shape.add([at(k, j), at(k, j + 1), at(k + 1, j + 1), at(k + 1, j)]);
        }
    }
    shape.soup()
}

fn moved(soup: &TriangleSoup, by: Vec3, scale: f64) -> TriangleSoup {
    let positions = soup.positions().iter().map(|p| scale * *p + by).collect();
    TriangleSoup::new(positions, soup.triangles().to_vec()).unwrap()
}

/// A gear selector of overlapping parts: a turned handle, a ball that sinks into it, a collar around it with a gap, and a plate that the
/// handle runs through.
pub fn selector() -> TriangleSoup {
    let arc = |k: usize| (0.0, 0.0, k as f64 / 8.0);
    let mut profile = vec![(0.0, 0.0)];
    profile.extend((0..=24).map(|k| {
        let t = arc(k).2 / 3.0;
        (0.8 + 0.25 * (5.0 * t).sin(), 7.0 * t)
    }));
    profile.push((0.0, 7.0));
    let handle = turned(&profile, 40);
    let ball = moved(&sphere(14), Vec3::new(0.0, 0.0, 7.6), 1.3);
    let collar = moved(&torus(1.0, 0.22, 40, 14), Vec3::new(0.0, 0.0, 1.6), 1.2);
    let plate = cuboid(Aabb { min: Vec3::new(-2.2, -3.0, -0.25), max: Vec3::new(2.2, 3.0, 0.35) });
    joined(&[handle, ball, collar, plate])
}

/// Two plates of side 2 that meet in an edge at an angle, one triangle mesh for each side: a narrow V.
pub fn wedge(degrees: f64, n: usize) -> TriangleSoup {
    let (cos, sin) = (degrees.to_radians().cos(), degrees.to_radians().sin());
    let plate = |tilt: bool| {
        let at = move |i: usize, j: usize| {
            let (along, across) = (2.0 * i as f64 / n as f64, 2.0 * j as f64 / n as f64);
            if tilt { Vec3::new(along * cos, across, along * sin) } else { Vec3::new(along, across, 0.0) }
        };
        let mut shape = Quads::default();
        for k in 0..n * n {
            let (i, j) = (k / n, k % n);
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            shape.add(quad);
            shape.add([quad[3], quad[2], quad[1], quad[0]]);
        }
        shape.soup()
    };
    joined(&[plate(false), plate(true)])
}

/// Squares that share vertices in the same place.
#[derive(Default)]
struct Quads {
    numbers: HashMap<[i64; 3], u32>,
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Quads {
    /// Corners that coincide leave a triangle.
    fn add(&mut self, corners: [Vec3; 4]) {
        let [a, b, c, d] = corners.map(|p| {
            let key = p.to_array().map(|x| (x * 1e6).round() as i64);
            *self.numbers.entry(key).or_insert_with(|| {
                self.positions.push(p);
                self.positions.len() as u32 - 1
            })
        });
        let distinct = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
        self.triangles.extend([[a, b, c], [a, c, d]].into_iter().filter(distinct));
    }

    fn soup(self) -> TriangleSoup {
        TriangleSoup::new(self.positions, self.triangles).unwrap()
    }
}
