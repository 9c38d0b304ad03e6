//! One chart of a mesh, with vertices of its own: those on seams are there once for each fan of its triangles around them.
use super::faces::Faces;
use super::segments::{NONE, Segments, grow, separate};
use crate::data::{Sets, map_tasks, next_side};
use crate::math::Vec3;
use rustc_hash::FxHashMap;

/// A chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Triangles of the mesh.
    pub faces: Vec<u32>,
    /// Its vertices.
    pub positions: Vec<Vec3>,
    /// In the order of `faces`.
    pub triangles: Vec<[u32; 3]>,
    /// Ends of the sides without a neighbour in the chart, in the direction of their triangles.
    pub rim: Vec<[u32; 2]>,
}

impl Chart {
    /// Whether it is a disk: connected, with an Euler number V − E + F of 1.
    pub fn is_disk(&self) -> bool {
        let sides = 3 * self.triangles.len() + self.rim.len();
        self.positions.len() as i64 - sides as i64 / 2 + self.triangles.len() as i64 == 1
    }

    /// The area-weighted mean of its normals.
    pub fn axis(&self) -> Vec3 {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.positions[v as usize]);
            (b - a).cross(c - a)
        };
        self.triangles.iter().map(area).sum::<Vec3>().normalize_or_zero()
    }
}

/// Triangles of each chart, ascending.
pub fn faces_of(found: &Segments) -> Vec<Vec<u32>> {
    let mut of = vec![Vec::new(); found.count as usize];
    (0..).zip(&found.charts).for_each(|(t, chart)| of[*chart as usize].push(t));
    of
}

/// The chart of some triangles, joined over sides where both are among them.
pub fn chart_of(faces: &Faces, of: Vec<u32>) -> Chart {
    let place: FxHashMap<u32, u32> = of.iter().copied().zip(0..).collect();
    let mut sets = Sets::new(3 * of.len());
    let mut rim_sides = Vec::new();
    for (local, t) in (0u32..).zip(&of) {
        for k in 0..3 {
            let other = faces.joined[(3 * t + k) as usize];
            let there = if other == Faces::NONE { None } else { place.get(&(other / 3)) };
            match there {
                // The two run along their edge in opposite directions.
                Some(there) => {
                    let (one, other) = (3 * local + k, 3 * there + other % 3);
                    sets.join(one, next_side(other));
                    sets.join(next_side(one), other);
                }
                None => rim_sides.push(3 * local + k),
            }
        }
    }
    let mut numbers = vec![NONE; 3 * of.len()];
    let mut positions = Vec::new();
    let corners: Vec<u32> = (0..3 * of.len() as u32)
        .map(|corner| {
            let number = &mut numbers[sets.find(corner) as usize];
            if *number == NONE {
                *number = positions.len() as u32;
                let vertex = faces.mesh.triangles[of[corner as usize / 3] as usize][corner as usize % 3];
                positions.push(faces.mesh.positions[vertex as usize]);
            }
            *number
        })
        .collect();
    let rim =
        rim_sides.iter().map(|side| [corners[*side as usize], corners[next_side(*side) as usize]]).collect();
    let triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    Chart { faces: of, positions, triangles, rim }
}

/// The charts, each of them a disk: others are halved until they are.
pub fn disks(faces: &Faces, found: &mut Segments) -> Vec<Chart> {
    separate(faces, found);
    let mut of = faces_of(found);
    let mut done = Vec::new();
    while !of.is_empty() {
        let made = map_tasks(of.len(), |k| chart_of(faces, of[k].clone()));
        of.clear();
        for chart in made {
            if chart.is_disk() || chart.faces.len() == 1 {
                done.push(chart);
            } else {
                of.extend(halves(faces, &chart.faces));
            }
        }
    }
    done
}

/// The connected halves of a chart: what is nearer to either of two triangles far apart.
pub fn halves(faces: &Faces, of: &[u32]) -> Vec<Vec<u32>> {
    let place: FxHashMap<u32, u32> = of.iter().copied().zip(0..).collect();
    let farthest = |from: u32| {
        // By number of sides crossed; of equal ones the one found last.
        let mut is_seen = vec![false; of.len()];
        let (mut ring, mut last) = (vec![from], from);
        is_seen[place[&from] as usize] = true;
        while !ring.is_empty() {
            let mut outer = Vec::new();
            for t in &ring {
                last = *t;
                for next in faces.neighbours(*t) {
                    if let Some(at) = place.get(&next)
                        && !std::mem::replace(&mut is_seen[*at as usize], true)
                    {
                        outer.push(next);
                    }
                }
            }
            ring = outer;
        }
        last
    };
    let one = farthest(of[0]);
    let other = farthest(one);
    let part = Part { faces, of, place: &place };
    part.split(one, other)
}

struct Part<'a> {
    faces: &'a Faces<'a>,
    of: &'a [u32],
    place: &'a FxHashMap<u32, u32>,
}

impl Part<'_> {
    /// Grows from two triangles; parts that do not hang together come singly.
    fn split(&self, one: u32, other: u32) -> Vec<Vec<u32>> {
        let mesh = self.faces.mesh;
        let local = |t: &u32| self.place.get(t).copied();
        let joined = self.of.iter().flat_map(|t| {
            (3 * t..3 * t + 3).map(|side| match self.faces.joined[side as usize] {
                Faces::NONE => Faces::NONE,
                other => local(&(other / 3)).map_or(Faces::NONE, |there| 3 * there + other % 3),
            })
        });
        let pick = |values: &[Vec3]| -> Vec<Vec3> { self.of.iter().map(|t| values[*t as usize]).collect() };
        let part = Faces {
            mesh,
            joined: joined.collect(),
            centers: pick(&self.faces.centers),
            areas: self.of.iter().map(|t| self.faces.areas[*t as usize]).collect(),
            normals: pick(&self.faces.normals),
        };
        let seed = |t: u32| (self.place[&t], Vec3::ZERO);
        let mut found = grow(&part, &[seed(one), seed(other)], -1.0);
        separate(&part, &mut found);
        let back = |part: Vec<u32>| part.into_iter().map(|t| self.of[t as usize]).collect();
        faces_of(&found).into_iter().map(back).collect()
    }
}
