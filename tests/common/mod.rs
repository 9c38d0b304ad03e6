//! Shapes with known answers, and the real scan that the tests share.
#![allow(dead_code, reason = "each test file uses some of these")]
use fast_winding::data::{OrientedCloud, SurfaceMesh, TriangleSoup};
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Aabb, Vec3, area_vector, barycentre};
use std::collections::{HashMap, HashSet};
use std::f64::consts::{PI, TAU};

pub mod parts;
pub mod prints;
pub mod surfaces;

/// An axis-aligned box of twelve triangles.
pub fn cuboid(bounds: Aabb) -> TriangleSoup {
    let corner = |c: usize| Vec3::select(bits(c), bounds.max, bounds.min);
    let faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect();
    TriangleSoup::new((0..8).map(corner).collect(), triangles).unwrap()
}

fn bits(c: usize) -> glam::BVec3 {
    glam::BVec3::new(c & 1 == 1, c & 2 == 2, c & 4 == 4)
}

pub fn cube(half: f64) -> TriangleSoup {
    cuboid(Aabb { min: Vec3::splat(-half), max: Vec3::splat(half) })
}

/// A closed grid of `nu` × `nv` quads, periodic in both directions.
pub fn torus(major: f64, minor: f64, nu: usize, nv: usize) -> TriangleSoup {
    let vertex = |i: usize| {
        let (u, v) = (TAU * (i / nv) as f64 / nu as f64, TAU * (i % nv) as f64 / nv as f64);
        let r = major + minor * v.cos();
        Vec3::new(r * u.cos(), r * u.sin(), minor * v.sin())
    };
    let at = |i: usize, j: usize| ((i % nu) * nv + j % nv) as u32;
    let quad = |k: usize| {
        let (i, j) = (k / nv, k % nv);
        [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]
    };
    TriangleSoup::new((0..nu * nv).map(vertex).collect(), (0..nu * nv).flat_map(quad).collect()).unwrap()
}

/// The unit sphere as an octahedron subdivided `n` times along each edge.
pub fn sphere(n: usize) -> TriangleSoup {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for octant in 0..8usize {
        let sign = Vec3::select(bits(octant), -Vec3::ONE, Vec3::ONE);
        let flipped = sign.x * sign.y * sign.z < 0.0;
        let corner =
            |i: usize, j: usize| sign * Vec3::new(i as f64, j as f64, (n - i - j) as f64).normalize();
        let mut add = |t: [Vec3; 3]| {
            let first = positions.len() as u32;
            positions.extend(t);
            triangles.push(if flipped {
                [first, first + 2, first + 1]
            } else {
                [first, first + 1, first + 2]
            });
        };
        for i in 0..n {
            for j in 0..n - i {
                add([corner(i, j), corner(i + 1, j), corner(i, j + 1)]);
                if i + j + 1 < n {
                    add([corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
                }
            }
        }
    }
    TriangleSoup::new(positions, triangles).unwrap()
}

pub fn flipped(soup: &TriangleSoup) -> TriangleSoup {
    let triangles = soup.triangles().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    TriangleSoup::new(soup.positions().to_vec(), triangles).unwrap()
}

pub fn joined(parts: &[TriangleSoup]) -> TriangleSoup {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for part in parts {
        let first = positions.len() as u32;
        positions.extend_from_slice(part.positions());
        triangles.extend(part.triangles().iter().map(|t| t.map(|i| i + first)));
    }
    TriangleSoup::new(positions, triangles).unwrap()
}

/// The soup without the triangles for which `dropped` holds.
pub fn without(soup: &TriangleSoup, dropped: impl Fn(usize) -> bool) -> TriangleSoup {
    let kept = soup.triangles().iter().enumerate().filter(|(i, _)| !dropped(*i)).map(|(_, t)| *t).collect();
    TriangleSoup::new(soup.positions().to_vec(), kept).unwrap()
}

/// The soup with a tenth of its triangles missing, a tenth flipped and a tenth twice, drawn by lot.
pub fn damaged(soup: &TriangleSoup, seed: u64) -> TriangleSoup {
    let mut next = random(seed);
    let fate = |[a, b, c]: [u32; 3]| match (10.0 * next()) as u32 {
        0 => vec![],
        1 => vec![[a, c, b]],
        2 => vec![[a, b, c], [b, c, a]],
        _ => vec![[a, b, c]],
    };
    let triangles = soup.triangles().iter().copied().flat_map(fate).collect();
    TriangleSoup::new(soup.positions().to_vec(), triangles).unwrap()
}

/// `count` points spread evenly over the unit sphere, each standing for its share of 4π.
pub fn sphere_cloud(count: usize) -> OrientedCloud {
    let golden = PI * (3.0 - 5f64.sqrt());
    let point = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (sin, cos) = (golden * i as f64).sin_cos();
        let r = (1.0 - z * z).sqrt();
        Vec3::new(r * cos, r * sin, z)
    };
    let points: Vec<Vec3> = (0..count).map(point).collect();
    OrientedCloud::new(points.clone(), points, vec![4.0 * PI / count as f64; count]).unwrap()
}

/// The barycentres of every `step`-th triangle with its normal and `step` times its area.
pub fn barycentre_cloud(soup: &TriangleSoup, step: usize) -> OrientedCloud {
    let (mut points, mut normals, mut areas) = (vec![], vec![], vec![]);
    for t in (0..soup.len()).step_by(step) {
        let area = area_vector(soup.corners(t));
        if area.length() > 0.0 {
            points.push(barycentre(soup.corners(t)));
            normals.push(area);
            areas.push(step as f64 * area.length());
        }
    }
    OrientedCloud::new(points, normals, areas).unwrap()
}

/// The Stanford bunny as it was scanned: 69,451 triangles, 223 boundary edges in five holes. From the npm package
/// `stl-models`, which `npm --prefix www ci` installs.
pub fn bunny() -> TriangleSoup {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/www/node_modules/stl-models/objects/bunny.bin.stl");
    let bytes =
        std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}; run `npm --prefix www ci` first"));
    match io::read(&bytes).unwrap().geometry {
        Geometry::Soup(soup) => soup,
        Geometry::Cloud(_) => panic!("the bunny has triangles"),
    }
}

/// Evenly distributed numbers in [0, 1): the same sequence for the same seed.
pub fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1);
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mixed = (state ^ (state >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        (mixed >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// `count` points spread evenly at random over `bounds`.
pub fn scattered(bounds: Aabb, count: usize, seed: u64) -> Vec<Vec3> {
    let mut next = random(seed);
    (0..count).map(|_| bounds.min + bounds.size() * Vec3::new(next(), next(), next())).collect()
}

/// Asserts that no directed edge appears twice and that the triangles around each vertex form one fan; gives V − E + F and the
/// number of edges with one triangle.
pub fn topology(mesh: &SurfaceMesh) -> (i64, usize) {
    let sides = |t: &[u32; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
    let directed: HashSet<(u32, u32)> = mesh.triangles.iter().flat_map(sides).collect();
    assert_eq!(directed.len(), 3 * mesh.triangles.len(), "an edge is used twice in one direction");
    let open = directed.iter().filter(|&&(a, b)| !directed.contains(&(b, a))).count();
    let mut fans: HashMap<u32, HashMap<u32, u32>> = HashMap::new();
    for t in &mesh.triangles {
        (0..3).for_each(|k| {
            fans.entry(t[k]).or_default().insert(t[(k + 1) % 3], t[(k + 2) % 3]);
        });
    }
    for (vertex, next) in &fans {
        let ends: HashSet<u32> = next.values().copied().collect();
        let first = next.keys().find(|v| !ends.contains(v)).or(next.keys().next()).unwrap();
        let (mut at, mut steps) = (*first, 0);
        while let Some(to) = next.get(&at).filter(|_| steps < next.len()) {
            (at, steps) = (*to, steps + 1);
        }
        assert_eq!(steps, next.len(), "vertex {vertex} joins two fans");
    }
    let edges = (directed.len() + open) / 2;
    assert_eq!(fans.len(), mesh.positions.len(), "a vertex has no triangle");
    (fans.len() as i64 - edges as i64 + mesh.triangles.len() as i64, open)
}
