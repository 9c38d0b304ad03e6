//! What is measured: files, and shapes made to size.
use crate::common;
use fast_winding::data::TriangleSoup;
use fast_winding::io::{self, Geometry};
use fast_winding::math::{Aabb, Vec3};
use std::path::Path;
use std::sync::Arc;

#[derive(Clone)]
pub struct Model {
    pub name: String,
    pub soup: Arc<TriangleSoup>,
}

impl Model {
    fn new(name: impl Into<String>, soup: TriangleSoup) -> Model {
        Model { name: name.into(), soup: Arc::new(soup) }
    }

    /// Reads a file of triangles; it is named after the file.
    pub fn read(path: &str) -> Model {
        let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
        let name = Path::new(path).file_stem().expect("a file has a name").to_string_lossy();
        match io::read(&bytes).unwrap_or_else(|e| panic!("{path}: {e}")).geometry {
            Geometry::Soup(soup) => Model::new(name, soup),
            Geometry::Cloud(_) => panic!("{path} has no triangles"),
        }
    }
}

const SIZES: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// Closed and damaged shapes of a thousand to a million triangles.
pub fn growing() -> impl Iterator<Item = Model> {
    let spheres = SIZES.into_iter().map(|size| {
        let along_edge = (size as f64 / 8.0).sqrt().round() as usize; // 8 n² triangles
        Model::new("sphere", common::sphere(along_edge))
    });
    spheres.chain(SIZES.map(torus_of)).chain(SIZES.map(damaged_torus))
}

fn torus_of(size: usize) -> Model {
    Model::new("torus", torus(size))
}

/// A torus of about `size` triangles, with rings twice as fine as they are long.
fn torus(size: usize) -> TriangleSoup {
    let around = (size as f64 / 4.0).sqrt().round() as usize;
    common::torus(1.0, 0.4, 2 * around, around)
}

/// A tenth of the triangles lost, flipped and doubled each: nearly as many boundary edges as triangles.
pub fn damaged_torus(size: usize) -> Model {
    Model::new("damaged torus", common::damaged(&torus(size), 1))
}

/// Closed shapes that overlap, one of them inside out.
pub fn overlapping() -> Model {
    let cube = common::cuboid(Aabb { min: Vec3::splat(0.2), max: Vec3::splat(1.1) });
    Model::new("overlapping", common::joined(&[common::sphere(40), torus(10_000), common::flipped(&cube)]))
}
