//! Rounds of cutting triangles until no segment runs through a point or across another.
use super::contacts::edge;
use super::edges::Edges;
use super::points::Points;
use super::triangulate::{Cuts, Event, Pieces};
use crate::data::{Cancelled, Monitor, map_tasks};
use rustc_hash::{FxHashMap, FxHashSet};

/// Rounds of cutting; what is then still crossed stays so. Two or three are usual.
const ROUNDS: usize = 40;
/// A triangle is given up that has so many times the most events it had before, and this many more. Others have fewer from round to round,
/// or some more where segments come to light that others have hidden.
const GROWTH: usize = 2;
const FEW: usize = 64;
/// Triangles that make a task.
const TASK: usize = 16;
/// Triangles between two reports.
const REPORT: usize = 4096;

/// A segment in one of the triangles that it cuts: the triangle, and the points, the lower first.
pub type Record = (u32, [u32; 2]);

/// Triangles being cut.
pub struct Work<'a> {
    pub corners: &'a [[u32; 3]],
    pub points: Points,
    pub edges: Edges,
    /// Sorted, each once.
    pub segments: Vec<Record>,
    /// Points inside triangles that need not end a segment. Sorted, each once.
    pub inside: Vec<(u32, u32)>,
    /// Pieces of triangles that are cut.
    pub pieces: FxHashMap<u32, Pieces>,
    /// Edges wanted in triangles. Sorted.
    pub wishes: Vec<Record>,
    /// The most events that each triangle had in a round; `None` once it is given up.
    pub most_events: FxHashMap<u32, Option<usize>>,
    /// Segments and triangles that were given up.
    pub unresolved: usize,
}

fn of<T>(all: &[(u32, T)], triangle: u32) -> &[(u32, T)] {
    let first = all.partition_point(|record| record.0 < triangle);
    let count = all[first..].partition_point(|record| record.0 == triangle);
    &all[first..first + count]
}

impl Work<'_> {
    pub fn segments_of(&self, triangle: u32) -> impl Iterator<Item = [u32; 2]> {
        of(&self.segments, triangle).iter().map(|(_, ends)| *ends)
    }

    pub fn inside_of(&self, triangle: u32) -> impl Iterator<Item = u32> {
        of(&self.inside, triangle).iter().map(|(_, point)| *point)
    }

    pub fn cut(&self, triangle: u32) -> Pieces {
        let list = |records: &[Record]| records.iter().map(|(_, ends)| *ends).collect::<Vec<_>>();
        let inside: Vec<u32> = self.inside_of(triangle).collect();
        let cuts = Cuts {
            corners: self.corners[triangle as usize],
            segments: &list(of(&self.segments, triangle)),
            inside: &inside,
            wishes: &list(of(&self.wishes, triangle)),
        };
        cuts.pieces(&self.edges, &self.points)
    }

    /// The triangles that have one of these edges.
    pub fn around(&self, edges: &FxHashSet<[u32; 2]>) -> Vec<u32> {
        let mut is_end = vec![false; self.points.positions().len()];
        edges.iter().flatten().for_each(|end| is_end[*end as usize] = true);
        let has = |corners: &[u32; 3]| {
            (0..3).any(|k| {
                is_end[corners[k] as usize]
                    && is_end[corners[(k + 1) % 3] as usize]
                    && edges.contains(&edge(*corners, k))
            })
        };
        (0..self.corners.len() as u32).filter(|t| has(&self.corners[*t as usize])).collect()
    }

    /// Cuts triangles, and those that this changes in turn.
    pub fn refine(&mut self, changed: Vec<u32>, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let mut dirty = changed;
        for round in 0..ROUNDS {
            dirty.sort_unstable();
            dirty.dedup();
            if dirty.is_empty() {
                return Ok(());
            }
            let mut events: Vec<Event> = Vec::new();
            for (block, triangles) in dirty.chunks(REPORT).enumerate() {
                let done = block as f64 * REPORT as f64 / dirty.len() as f64;
                monitor.report((round as f64 + done) / ROUNDS as f64, "cutting triangles")?;
                let pieces = map_tasks(triangles.len().div_ceil(TASK), |task| {
                    let some = &triangles[task * TASK..triangles.len().min((task + 1) * TASK)];
                    some.iter().map(|t| self.cut(*t)).collect::<Vec<_>>()
                });
                for (triangle, pieces) in triangles.iter().zip(pieces.into_iter().flatten()) {
                    if self.settles(*triangle, pieces.events.len()) {
                        events.extend(&pieces.events);
                    }
                    self.pieces.insert(*triangle, pieces);
                }
            }
            events.sort_unstable();
            events.dedup();
            dirty = self.apply(&events);
        }
        self.unresolved += dirty.len();
        Ok(())
    }

    /// Whether a triangle that has so many events now is on the way to none. Where rounding lets each segment run through nearly every
    /// point, as in needles with very many cuts, they multiply from round to round: such a triangle stays as it is then, and counts
    /// as unresolved.
    fn settles(&mut self, triangle: u32, events: usize) -> bool {
        let most = match self.most_events.get(&triangle) {
            None => Some(events),
            Some(None) => None,
            Some(Some(most)) if events > GROWTH * most + FEW => {
                self.unresolved += 1;
                None
            }
            Some(Some(most)) => Some(events.max(*most)),
        };
        self.most_events.insert(triangle, most);
        most.is_some()
    }

    /// Splits segments; gives the triangles that this concerns.
    fn apply(&mut self, events: &[Event]) -> Vec<u32> {
        let mut splits: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
        let mut split = |ends: [u32; 2], point: u32| {
            if !ends.contains(&point) {
                splits.entry(ends).or_default().push(point);
            }
        };
        for event in events {
            match *event {
                Event::Through(ends, point) => split(ends, point),
                Event::Cross(e, f) => {
                    let [share, of_other] = [self.points.share(e, f), self.points.share(f, e)];
                    let within = -1e-6..=1.0 + 1e-6;
                    let is_between = within.contains(&share.high) && within.contains(&of_other.high);
                    let place = self.points.between(e, share);
                    if let Some(point) = is_between.then(|| self.points.add(place)).flatten() {
                        split(e, point);
                        split(f, point);
                    }
                }
            }
        }
        self.split(splits)
    }

    fn split(&mut self, mut splits: FxHashMap<[u32; 2], Vec<u32>>) -> Vec<u32> {
        for (ends, between) in &mut splits {
            let share = |point: &u32| self.points.share_at(*ends, *point);
            between.sort_unstable();
            between.dedup();
            between.sort_by(|a, b| {
                let (a, b) = (share(a), share(b));
                a.high.total_cmp(&b.high).then(a.low.total_cmp(&b.low))
            });
        }
        let (mut segments, mut on_edges, mut dirty) = (Vec::new(), Vec::new(), Vec::new());
        for (triangle, ends) in &self.segments {
            let Some(between) = splits.get(ends) else {
                segments.push((*triangle, *ends));
                continue;
            };
            dirty.push(*triangle);
            let chain: Vec<u32> =
                [ends[0]].into_iter().chain(between.iter().copied()).chain([ends[1]]).collect();
            segments.extend(
                chain.windows(2).map(|pair| (*triangle, [pair[0].min(pair[1]), pair[0].max(pair[1])])),
            );
            let corners = self.corners[*triangle as usize];
            for rim in (0..3).map(|k| edge(corners, k)) {
                if ends.iter().all(|end| self.edges.holds(rim, *end)) {
                    on_edges.extend(between.iter().map(|point| (rim, *point)));
                }
            }
        }
        segments.sort_unstable();
        segments.dedup();
        self.segments = segments;
        let changed = self.edges.add(on_edges, &self.points);
        if !changed.is_empty() {
            dirty.extend(self.around(&changed));
        }
        dirty
    }
}
