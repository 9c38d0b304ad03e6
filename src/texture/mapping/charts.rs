//! The charts of a proxy as the triangles of a soup are put into them.
use crate::data::{Cancelled, Monitor, Shape, SurfaceMesh, TriangleSoup};
use crate::distance::{Closest, DistanceTree};
use crate::math::Vec2;
use crate::texture::{Anchor, Atlas, Proxy};
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The charts of a proxy, with a search for the closest point of those that need one.
pub struct Charts<'a> {
    pub proxy: &'a Proxy,
    pub atlas: &'a Atlas,
    /// The box of each chart in the texture.
    pub boxes: Vec<[Vec2; 2]>,
    /// Triangles of each chart, in the order of its tree's.
    faces: Vec<Vec<u32>>,
    trees: Vec<Option<DistanceTree>>,
}

impl<'a> Charts<'a> {
    pub fn new(proxy: &'a Proxy, atlas: &'a Atlas) -> Charts<'a> {
        let mut faces = vec![Vec::new(); atlas.chart_count];
        let mut boxes = vec![[Vec2::INFINITY, Vec2::NEG_INFINITY]; atlas.chart_count];
        for (t, chart) in (0u32..).zip(&atlas.charts) {
            faces[*chart as usize].push(t);
            let [low, high] = &mut boxes[*chart as usize];
            for p in atlas.corners_of(t) {
                (*low, *high) = (low.min(p), high.max(p));
            }
        }
        Charts { proxy, atlas, boxes, trees: faces.iter().map(|_| None).collect(), faces }
    }

    pub fn chart(&self, anchor: &Anchor) -> u32 {
        self.atlas.charts[anchor.face as usize]
    }

    /// Makes the searches of some charts, where they are not yet there.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn prepare(
        &mut self,
        charts: impl Iterator<Item = u32>,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let mut needed: Vec<u32> = charts.filter(|chart| self.trees[*chart as usize].is_none()).collect();
        needed.sort_unstable();
        needed.dedup();
        for (k, chart) in needed.iter().enumerate() {
            monitor.report(k as f64 / needed.len() as f64, "texture")?;
            let soup = part(&self.proxy.mesh, &self.faces[*chart as usize]);
            self.trees[*chart as usize] = Some(DistanceTree::new(&Shape::Soup(Arc::new(soup))));
        }
        Ok(())
    }

    /// The point of a chart that was prepared that is closest to an anchor: itself, if it lies there.
    pub fn closest(&self, chart: u32, anchor: &Anchor) -> Anchor {
        if self.chart(anchor) == chart {
            return *anchor;
        }
        let found = self.trees[chart as usize].as_ref().and_then(|tree| tree.closest(anchor.point));
        let of_chart = |nearest: Closest| Anchor {
            face: self.faces[chart as usize][nearest.element as usize],
            barycentric: nearest.barycentric,
            point: nearest.point,
        };
        found.map_or(*anchor, of_chart)
    }

    pub fn uv(&self, anchor: &Anchor) -> Vec2 {
        self.atlas.at(anchor.face, anchor.barycentric)
    }
}

/// The soup of some triangles of a mesh.
fn part(mesh: &SurfaceMesh, faces: &[u32]) -> TriangleSoup {
    let mut numbers = FxHashMap::default();
    let mut positions = Vec::new();
    let mut number = |v: u32| {
        *numbers.entry(v).or_insert_with(|| {
            positions.push(mesh.positions[v as usize]);
            positions.len() as u32 - 1
        })
    };
    let triangles = faces.iter().map(|t| mesh.triangles[*t as usize].map(&mut number)).collect();
    TriangleSoup::new(positions, triangles).expect("meshes of this crate are finite and indexed")
}
