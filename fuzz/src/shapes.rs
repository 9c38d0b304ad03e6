//! Soups and clouds out of bytes.
use super::source::Source;
use fast_winding::data::{LARGEST_COORDINATE, OrientedCloud, PointCloud, Shape, TriangleSoup};
use fast_winding::math::{Aabb, Affine, Vec3};

/// A shape, and whether its numbers are such that results can be held against sums.
pub struct Made<T> {
    pub shape: T,
    pub is_tame: bool,
}

/// Most triangles that are given one by one.
const TRIANGLES: usize = 24;
const POINTS: usize = 60;

impl Source<'_> {
    /// Cuboids and tetrahedra on the grid: closed, oriented outward, often overlapping, touching or flat.
    fn parts(&mut self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        for _ in 0..1 + self.below(3) {
            let first = positions.len() as u32;
            if self.flag() {
                let corners = [self.grid_point(), self.grid_point(), self.grid_point(), self.grid_point()];
                let [a, b, c, d] = corners;
                let faces = match (b - a).cross(c - a).dot(d - a) > 0.0 {
                    true => [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
                    false => [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]],
                };
                positions.extend(corners);
                triangles.extend(faces.map(|face: [u32; 3]| face.map(|k| first + k)));
            } else {
                let (a, b) = (self.grid_point(), self.grid_point());
                let bounds = Aabb { min: a.min(b), max: a.max(b) };
                let corner = |k: usize| {
                    let side = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 1 { high } else { low };
                    let (low, high) = (bounds.min, bounds.max);
                    Vec3::new(side(0, low.x, high.x), side(1, low.y, high.y), side(2, low.z, high.z))
                };
                positions.extend((0..8).map(corner));
                for [a, b, c, d] in
                    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
                {
                    triangles.extend([[a, b, c], [a, c, d]].map(|face: [u32; 3]| face.map(|k| first + k)));
                }
            }
        }
        (positions, triangles)
    }

    /// Where a shape lies: mostly where it is, sometimes turned, moved, or scaled beyond reason; and whether it is within reason.
    fn frame(&mut self) -> (Affine, bool) {
        let kind = self.byte();
        let scale = match kind >> 4 {
            0..=9 => 1.0,
            10 => 0.01,
            11 => 100.0,
            12 => 1e-160,
            13 => 1e70,
            14 => 1e-300,
            _ => 1e71,
        };
        let shift = match kind >> 2 & 3 {
            0 | 1 => 0.0,
            2 => 0.7,
            _ if scale < 1.0 => 1e7,
            _ => 1e3,
        };
        let turn = match kind & 3 {
            0 | 1 => Affine::IDENTITY,
            2 => Affine::from_axis_angle(Vec3::new(1.0, 2.0, 3.0).normalize(), 0.3),
            _ => Affine::from_axis_angle(Vec3::Z, 1e-9),
        };
        let moved =
            Affine::from_scale(Vec3::splat(scale)) * Affine::from_translation(Vec3::splat(shift)) * turn;
        (moved, (0.001..1000.0).contains(&scale) && shift < 1e3)
    }

    /// A closed soup.
    pub fn solid(&mut self) -> Made<TriangleSoup> {
        let (positions, triangles) = self.parts();
        let (frame, is_tame) = self.frame();
        Made { shape: moved(positions, triangles, &frame), is_tame }
    }

    /// Vertices and indices as a program might hand them over: any numbers, indices beyond the end.
    pub fn arrays(&mut self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let vertices = 1 + self.below(12);
        let is_on_grid = self.flag();
        let positions: Vec<Vec3> =
            (0..vertices).map(|_| if is_on_grid { self.grid_point() } else { self.any_point() }).collect();
        let slack = self.below(2);
        let index = |source: &mut Self| source.below(vertices + slack) as u32;
        let count = self.below(TRIANGLES);
        let triangles = (0..count).map(|_| [index(self), index(self), index(self)]).collect();
        (positions, triangles)
    }

    /// Any soup: closed, damaged, loose, or of any numbers.
    pub fn soup(&mut self) -> Made<TriangleSoup> {
        match self.below(4) {
            0 => self.solid(),
            1 => {
                let (positions, triangles) = self.parts();
                let fate = |[a, b, c]: [u32; 3]| match self.byte() {
                    0..=200 => vec![[a, b, c]],
                    201..=220 => vec![],
                    221..=240 => vec![[a, c, b]],
                    _ => vec![[a, b, c], [b, c, a]],
                };
                let triangles = triangles.into_iter().flat_map(fate).collect();
                let (frame, is_tame) = self.frame();
                Made { shape: moved(positions, triangles, &frame), is_tame }
            }
            2 => {
                let count = self.below(TRIANGLES) as u32;
                let positions = (0..3 * count).map(|_| self.grid_point()).collect();
                let triangles = (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
                let (frame, is_tame) = self.frame();
                Made { shape: moved(positions, triangles, &frame), is_tame }
            }
            _ => {
                let (positions, triangles) = self.arrays();
                let soup = TriangleSoup::cleaned(positions, triangles).0;
                let is_tame = soup.triangles().iter().flatten().all(|v| {
                    let place = soup.positions()[*v as usize];
                    place.abs().max_element() < 1e3 && place == place.round()
                });
                Made { shape: soup, is_tame }
            }
        }
    }

    /// Points with or without normals and areas, often several in a place, on a line or in a plane.
    pub fn cloud(&mut self) -> Made<PointCloud> {
        let count = self.below(POINTS);
        let kind = self.below(4);
        let flat = self.pick(&[Vec3::ONE, Vec3::ONE, Vec3::new(1.0, 1.0, 0.0), Vec3::X]);
        let (frame, is_tame) = self.frame();
        let points: Vec<Vec3> = (0..count)
            .map(|_| match kind {
                0 => frame.transform_point3(flat * self.grid_point()),
                1 | 2 => frame.transform_point3(flat * Vec3::new(self.share(), self.share(), self.share())),
                _ => self.any_point(),
            })
            .collect();
        let normals = self.flag().then(|| (0..count).map(|_| self.normal()).collect());
        let areas = self
            .flag()
            .then(|| (0..count).map(|_| self.pick(&[1.0, 0.5, 0.0, 1e-300, 1e300, 2.0])).collect());
        let has_areas = areas.is_some();
        let cloud =
            PointCloud::cleaned(points, normals, areas).expect("there is one of each for every point").0;
        Made { shape: cloud, is_tame: is_tame && kind != 3 && !has_areas }
    }

    fn normal(&mut self) -> Vec3 {
        match self.below(8) {
            0 => self.any_point(),
            1 => Vec3::Z,
            _ => self.grid_point() - Vec3::splat(1.5),
        }
    }

    /// A cloud with unit normals and areas.
    pub fn oriented_cloud(&mut self) -> Made<OrientedCloud> {
        let Made { shape: cloud, is_tame } = self.cloud();
        let is_usable = |p: &Vec3| p.abs().max_element() <= LARGEST_COORDINATE;
        let points: Vec<Vec3> = cloud.points().iter().copied().filter(is_usable).collect();
        let normals = points.iter().map(|_| self.normal().try_normalize().unwrap_or(Vec3::X)).collect();
        let areas = points.iter().map(|_| if is_tame { self.share() } else { self.number() });
        let areas = areas.map(|a| if a.is_finite() { a.abs() } else { 0.0 }).collect();
        let shape = OrientedCloud::new(points, normals, areas).expect("points, normals and areas are fit");
        Made { shape, is_tame }
    }

    pub fn shape(&mut self) -> Made<Shape> {
        match self.below(3) {
            0 => {
                let Made { shape, is_tame } = self.oriented_cloud();
                Made { shape: shape.into(), is_tame }
            }
            _ => {
                let Made { shape, is_tame } = self.soup();
                Made { shape: shape.into(), is_tame }
            }
        }
    }

    /// Points around a box, none of them where the grid's planes meet it.
    pub fn queries(&mut self, bounds: Aabb, count: usize) -> Vec<Vec3> {
        let size = bounds.size();
        let at = |source: &mut Self| {
            let share = Vec3::new(source.share(), source.share(), source.share());
            bounds.min - 0.25 * size + 1.5 * size * share
        };
        (0..count).map(|_| at(self)).collect()
    }
}

fn moved(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>, frame: &Affine) -> TriangleSoup {
    let positions = positions.into_iter().map(|p| frame.transform_point3(p)).collect();
    TriangleSoup::new(positions, triangles).expect("grid points stay finite, and indices are in range")
}
