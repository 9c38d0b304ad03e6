//! The triangles under repair: vertices welded, each triangle with the one of the input that it is, or is a part of.
use super::RepairReport;
use super::edges::sides_with_length;
use crate::data::{TriangleSoup, by_edge, sorted};
use crate::math::{Vec3, area_vector, normal_signs};
use crate::winding::weld;

/// Stands for the source of a triangle that has none: it closes a hole.
pub const NEW: u32 = u32::MAX;

/// More than this share of the area cancels: the soup has each face from both sides, and one of each is meant.
const DOUBLE_SIDED: f64 = 0.5;

#[derive(Clone, Debug)]
pub struct Faces {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Of each triangle, its number in the input, or [`NEW`].
    pub sources: Vec<u32>,
}

impl Faces {
    /// The triangles of a soup, vertices welded by exact position.
    pub fn of(soup: &TriangleSoup) -> Faces {
        let welded = weld(soup.positions());
        Faces {
            positions: soup.positions().to_vec(),
            triangles: soup.triangles().iter().map(|t| t.map(|v| welded[v as usize])).collect(),
            sources: (0..soup.len() as u32).collect(),
        }
    }

    pub fn corners(&self, t: usize) -> [Vec3; 3] {
        self.triangles[t].map(|v| self.positions[v as usize])
    }

    pub fn push(&mut self, triangle: [u32; 3], source: u32) {
        self.triangles.push(triangle);
        self.sources.push(source);
    }

    /// Keeps the triangles for which `wanted` holds.
    pub fn retain(&mut self, wanted: impl Fn(usize) -> bool) {
        let kept: Vec<usize> = (0..self.triangles.len()).filter(|t| wanted(*t)).collect();
        self.triangles = kept.iter().map(|t| self.triangles[*t]).collect();
        self.sources = kept.iter().map(|t| self.sources[*t]).collect();
    }

    /// A soup of the triangles, without the vertices that none uses; the others keep their order.
    pub fn to_soup(&self) -> TriangleSoup {
        let mut numbers = vec![u32::MAX; self.positions.len()];
        self.triangles.iter().flatten().for_each(|v| numbers[*v as usize] = 0);
        let used = (0..numbers.len()).filter(|v| numbers[*v] == 0).collect::<Vec<usize>>();
        used.iter().enumerate().for_each(|(number, v)| numbers[*v] = number as u32);
        let positions = used.into_iter().map(|v| self.positions[v]).collect();
        let triangles = self.triangles.iter().map(|t| t.map(|v| numbers[v as usize])).collect();
        TriangleSoup::derived(positions, triangles)
            .expect("vertices of a soup are finite, and all are numbered")
    }

    pub fn area(&self, t: usize) -> f64 {
        area_vector(self.corners(t)).length()
    }

    /// Edges with one triangle alone.
    pub fn open_edges(&self) -> usize {
        by_edge(&sides_with_length(&self.triangles)).filter(|sides| sides.len() == 1).count()
    }

    /// Drops triangles without area.
    pub fn drop_degenerate(&mut self, report: &mut RepairReport) {
        let has_area = |faces: &Faces, t: usize| {
            let [a, b, c] = faces.triangles[t];
            a != b && b != c && c != a && normal_signs(faces.corners(t)) != [0; 3]
        };
        let before = self.triangles.len();
        let kept: Vec<bool> = (0..before).map(|t| has_area(self, t)).collect();
        self.retain(|t| kept[t]);
        report.degenerate += before - self.triangles.len();
    }

    /// Of triangles with the same three corners, those of opposite orientation cancel, and one is kept of what is left: w has the same
    /// two sides then. Of soups that have each face from both sides, one of each is kept.
    pub fn merge_coincident(&mut self, report: &mut RepairReport) {
        let mut found: Vec<([u32; 3], u32)> = self.triangles.iter().map(|t| sorted(*t)).zip(0..).collect();
        found.sort_unstable();
        let is_up = |t: u32| is_even(self.triangles[t as usize]);
        let (mut cancelled, mut area) = (0.0, 0.0);
        for same in found.chunk_by(|one, other| one.0 == other.0) {
            let up = same.iter().filter(|(_, t)| is_up(*t)).count();
            let size = self.area(same[0].1 as usize);
            area += size;
            cancelled += if 2 * up == same.len() { size } else { 0.0 };
        }
        let is_double_sided = cancelled > DOUBLE_SIDED * area;
        let mut kept = vec![false; self.triangles.len()];
        for same in found.chunk_by(|one, other| one.0 == other.0) {
            let up = same.iter().filter(|(_, t)| is_up(*t)).count();
            let down = same.len() - up;
            let first = same.iter().find(|(_, t)| up == down || is_up(*t) == (up > down));
            if up != down || is_double_sided {
                first.iter().for_each(|(_, t)| kept[*t as usize] = true);
                report.duplicates += same.len() - 1;
            } else {
                report.cancelled += same.len();
            }
        }
        self.retain(|t| kept[t]);
    }
}

/// Whether a triangle runs through its vertices in rising order.
fn is_even([a, b, c]: [u32; 3]) -> bool {
    [a < b, b < c, c < a].into_iter().filter(|rises| *rises).count() == 2
}
