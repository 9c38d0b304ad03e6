//! Where the lines of a soup meet a proxy: the point of it that each corner corresponds to (Schier et al. 2018, section 7.6).
use super::{Proxy, SoupLines};
use crate::charge::{FieldLines, Hit, first_hits_with};
use crate::data::{Cancelled, Monitor, Parts, Shape, fill_in_blocks};
use crate::distance::DistanceTree;
use crate::math::Vec3;
use std::sync::Arc;

/// A point of a proxy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Anchor {
    pub face: u32,
    pub barycentric: [f64; 3],
    pub point: Vec3,
}

/// The points of a proxy that belong to the starts of lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Anchors {
    pub of_starts: Vec<Anchor>,
    /// Starts whose lines meet no proxy, as they are inside of the shape: they have the point nearest to them.
    pub is_lost: Vec<bool>,
    pub lost: usize,
    /// Starts of lines from a boundary that ran along the surface, replaced by straight ones in the direction of their neighbours;
    /// ascending.
    pub tangential: Vec<u32>,
}

/// A line runs along the surface if the cosine of its angle to the normal is below this.
const TANGENTIAL: f64 = 0.3;
/// A straight line reaches this many diagonals of the proxy.
const REACH: f64 = 2.0;

impl Anchors {
    /// Intersects the lines with a proxy.
    ///
    /// # Errors
    /// If and only if the monitor cancels.
    pub fn new(lines: &SoupLines, proxy: &Proxy, monitor: &dyn Monitor) -> Result<Anchors, Cancelled> {
        let monitor = &Parts::new(monitor);
        let mesh = proxy.soup();
        let starts = &lines.starts;
        monitor.begin(0.0, 0.6);
        let mut hits = first_hits_with(&lines.lines, &mesh, monitor)?;
        let replaced = replacements(lines, &hits);
        let reach = REACH * mesh.bounds().diagonal();
        let mut straight = FieldLines::default();
        for (start, direction) in &replaced {
            let from = starts.points[*start as usize];
            straight.push(&[from, from + reach * *direction]);
        }
        monitor.begin(0.6, 0.8);
        for ((start, _), hit) in replaced.iter().zip(first_hits_with(&straight, &mesh, monitor)?) {
            hits[*start as usize] = hit.or(hits[*start as usize]);
        }
        let is_lost: Vec<bool> = hits.iter().map(|hit| hit.is_none()).collect();
        let lost = is_lost.iter().filter(|lost| **lost).count();
        let tree = (lost > 0).then(|| DistanceTree::new(&Shape::Soup(Arc::new(mesh))));
        let anchor = |start: usize, _: &mut ()| match (hits[start], &tree) {
            (Some(Hit { face, barycentric, point, .. }), _) => Anchor { face, barycentric, point },
            (None, tree) => {
                let nearest = tree.as_ref().and_then(|tree| tree.closest(starts.points[start]));
                let nearest = nearest.unwrap_or_default();
                Anchor { face: nearest.element, barycentric: nearest.barycentric, point: nearest.point }
            }
        };
        let mut of_starts = vec![Anchor::default(); hits.len()];
        monitor.begin(0.8, 1.0);
        fill_in_blocks(&mut of_starts, anchor, "meeting the proxy", monitor)?;
        let tangential = replaced.into_iter().map(|(start, _)| start).collect();
        Ok(Anchors { of_starts, is_lost, lost, tangential })
    }
}

/// Starts on a boundary whose lines run along the surface, with the directions that they get: the mean of those of the other corners of
/// their triangles that do not, or the normal (section 12.4).
fn replacements(lines: &SoupLines, hits: &[Option<Hit>]) -> Vec<(u32, Vec3)> {
    let starts = &lines.starts;
    let direction = |start: usize| match hits[start] {
        Some(hit) => (hit.point - starts.points[start]).normalize_or_zero(),
        None => Vec3::ZERO,
    };
    let is_tangential =
        |start: usize| starts.on_boundary[start] && direction(start).dot(starts.normals[start]) < TANGENTIAL;
    let which: Vec<bool> = (0..hits.len()).map(is_tangential).collect();
    let mut sums = vec![Vec3::ZERO; hits.len()];
    for corners in &starts.corners {
        for k in 0..3 {
            let at = corners[k] as usize;
            if which[at] {
                let others = [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|c| c as usize);
                sums[at] += others.into_iter().filter(|o| !which[*o]).map(direction).sum::<Vec3>();
            }
        }
    }
    let given = |start: usize| {
        let mean = sums[start].normalize_or_zero();
        if mean.dot(starts.normals[start]) < TANGENTIAL { starts.normals[start] } else { mean }
    };
    (0..hits.len()).filter(|start| which[*start]).map(|start| (start as u32, given(start))).collect()
}
