use super::SliceConfig;
use super::disjoint::polygons_of_disjoint;
use super::plane::Region;
use super::refine::refined;
use super::section::segment;
use crate::bvh::Bvh;
use crate::data::{Lattice, LatticeError, Polygon, Ring, Shape, TriangleSoup, map_items, sorted_pairs};
use crate::levelset::{At, PlaneGrid, trace_contours};
use crate::math::{Aabb, Vec2};
use crate::polygon::{Fill, enclosed, nest};
use crate::winding::{Scratch, WindingField};

/// Nodes along the longer side of the coarse scan for level sets that come near no geometry: the bulges in the openings
/// of a shape. Contours smaller than a 48th of the bounds there are missed.
const SCAN_NODES: usize = 48;

/// Contours on a grid, for clouds: their fields are smooth. Exact where contours cross the edges of the cells.
pub(super) struct GridTracer<'a> {
    field: &'a WindingField,
    grid: PlaneGrid,
    /// Cells that cover the bounds along x and y.
    cells: [i32; 2],
    bvh: Bvh,
    /// How far from the plane a point of a cloud still seeds a contour.
    reach: f64,
}

impl<'a> GridTracer<'a> {
    /// Whether there are cells such as a configuration asks for.
    pub fn check(field: &WindingField, config: &SliceConfig) -> Result<Lattice, LatticeError> {
        let bounds = field.bounds();
        let lattice = match config.spacing {
            Some(spacing) => {
                Lattice::with_spacing(Aabb { max: bounds.max.with_z(bounds.min.z), ..bounds }, spacing)
            }
            None => Lattice::with_resolution(bounds, config.resolution),
        }?;
        if let Shape::Cloud(cloud) = field.shape() {
            Lattice::check_area(cloud.areas().iter().sum(), lattice.spacing.x)?;
        }
        Ok(lattice)
    }

    pub fn new(field: &'a WindingField, config: &SliceConfig) -> Result<GridTracer<'a>, LatticeError> {
        let lattice = GridTracer::check(field, config)?;
        let spacing = lattice.spacing.x;
        let grid = PlaneGrid { origin: lattice.origin.truncate(), spacing };
        let cells = [lattice.counts[0] as i32, lattice.counts[1] as i32];
        let (boxes, reach): (Vec<Aabb>, f64) = match field.shape() {
            Shape::Soup(soup) => (map_items(soup.len(), |t| Aabb::around(soup.corners(t))), 0.0),
            Shape::Cloud(cloud) => {
                let boxes = cloud.points().iter().map(|p| Aabb { min: *p, max: *p }).collect();
                let mean_area = cloud.areas().iter().sum::<f64>() / cloud.len().max(1) as f64;
                (boxes, spacing.max(mean_area.sqrt()))
            }
        };
        Ok(GridTracer { field, grid, cells, bvh: Bvh::build(&boxes, 8), reach })
    }

    /// The polygons of a region at a height.
    pub fn polygons(&self, z: f64, region: Region) -> Vec<Polygon> {
        let mut scratch = Scratch::default();
        let level = region.level();
        let mut inside = |p: Vec2, at: At| {
            region.is_upward()
                == match at {
                    At::Node => self.field.is_above(p.extend(z), level, &mut scratch),
                    At::Edge => self.field.is_nearly_above(p.extend(z), level, &mut scratch),
                }
        };
        let mut seeds = self.seeds_of_geometry(z);
        seeds.extend(self.seeds_of_scan(&mut inside));
        // Biased, so that negative numbers come first.
        const BIAS: u32 = 1 << 31;
        let mut seeds = sorted_pairs(seeds.into_iter().map(|cell| cell.map(|c| c as u32 ^ BIAS)));
        seeds.dedup();
        let seeds = seeds.into_iter().map(|cell| cell.map(|c| (c ^ BIAS) as i32));
        let rings = trace_contours(&self.grid, seeds, &mut inside);
        if matches!(self.field.shape(), Shape::Soup(_)) {
            return nest(rings);
        }
        let mut edge = |p: Vec2| inside(p, At::Edge);
        let fine: Vec<Ring> = rings.iter().map(|ring| refined(ring, &mut edge)).collect();
        // Two contours in one cell may come to cross.
        polygons_of_disjoint(&fine).unwrap_or_else(|| enclosed(&fine, Fill::Positive))
    }

    /// Cells that hold a piece of the section of the soup, or lie next to a point of the cloud near the plane.
    fn seeds_of_geometry(&self, z: f64) -> Vec<[i32; 2]> {
        let mut seeds = Vec::new();
        let near = |b: &Aabb| b.min.z - self.reach <= z && z <= b.max.z + self.reach;
        match self.field.shape() {
            Shape::Soup(soup) => self.bvh.for_each(near, |t| self.cells_of_section(soup, t, z, &mut seeds)),
            Shape::Cloud(cloud) => self.bvh.for_each(near, |i| {
                let p = cloud.points()[i];
                if (p.z - z).abs() <= self.reach {
                    let [x, y] = self.grid.cell(p.truncate());
                    seeds.extend((0..9).map(|k| [x + k % 3 - 1, y + k / 3 - 1]));
                }
            }),
        }
        seeds
    }

    fn cells_of_section(&self, soup: &TriangleSoup, triangle: usize, z: f64, seeds: &mut Vec<[i32; 2]>) {
        let corners = soup.corners(triangle);
        if !corners.iter().any(|p| p.z <= z) || !corners.iter().any(|p| p.z > z) {
            return;
        }
        let [a, b] = segment(corners, z);
        let steps = (2.0 * a.distance(b) / self.grid.spacing).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let cell = self.grid.cell(a.lerp(b, step as f64 / steps as f64));
            if seeds.last() != Some(&cell) {
                seeds.push(cell);
            }
        }
    }

    /// Cells where the level set crosses the lines of a coarse scan over the bounds and a little beyond.
    fn seeds_of_scan(&self, inside: &mut impl FnMut(Vec2, At) -> bool) -> Vec<[i32; 2]> {
        let longest = self.cells[0].max(self.cells[1]);
        let stride = (longest as usize).div_ceil(SCAN_NODES) as i32;
        let [nx, ny] = self.cells.map(|c| c / stride + 4);
        let node = |i: i32, j: i32| [(i - 1) * stride, (j - 1) * stride];
        let mut at = |n: [i32; 2]| inside(self.grid.node(n), At::Node);
        let values: Vec<bool> = (0..nx * ny).map(|k| at(node(k % nx, k / nx))).collect();
        let mut seeds = Vec::new();
        for k in 0..nx * ny {
            let (i, j) = (k % nx, k / nx);
            for (di, dj) in [(1, 0), (0, 1)] {
                if i + di < nx && j + dj < ny && values[k as usize] != values[(k + di + dj * nx) as usize] {
                    let [x, y] = node(i, j);
                    // The first node on the way that differs from the start ends a crossed edge.
                    let differs = |s: &i32| at([x + s * di, y + s * dj]) != values[k as usize];
                    let s = (1..stride).find(differs).unwrap_or(stride) - 1;
                    seeds.push([x + s * di, y + s * dj]);
                }
            }
        }
        seeds
    }
}
