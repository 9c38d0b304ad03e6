//! Edges of the mesh across which the surface has a sharp edge: where they are cut.
use super::plane::{Plane, corner_of, edge_of};
use super::split::{Part, cut};
use super::{Evidence, Limits, Search};
use crate::data::{
    Cancelled, Monitor, SurfaceMesh, by_edge, edge_of_key, fill_in_blocks, opposite, sides_by_edge,
};
use crate::math::{Vec3, area_vector, barycentre};

/// Vertices keep this distance from the sharp edge of their plane, in cells: triangles between the two are not too thin.
const MARGIN: f64 = 0.2;
/// A sharp edge or corner lies no farther than this from the middle of what it cuts, in cells.
const REACH: f64 = 1.2;

/// Sine from which a plane ends an edge rather than runs along it.
const ASIDE: f64 = 0.1;

const NONE: u32 = u32::MAX;

/// An edge of the mesh between two planes.
struct Crease {
    ends: [u32; 2],
    /// The other corners of its triangles, [`NONE`] where there is no second.
    opposite: [u32; 2],
}

pub struct Creases<'a> {
    pub(super) mesh: &'a SurfaceMesh,
    planes: &'a [Option<Plane>],
    spacing: f64,
    limits: Limits,
    creases: Vec<Crease>,
    /// Of each side of each triangle, 3 t + k: its crease or [`NONE`].
    of_sides: Vec<u32>,
    /// Where vertices go.
    pub(super) moved: Vec<Vec3>,
    /// Which of them do.
    is_moved: Vec<bool>,
    /// Where creases are cut, if they are.
    cuts: Vec<Option<Vec3>>,
    /// Triangles between three planes, and their corner.
    corners: Vec<(u32, Option<Vec3>)>,
}

impl<'a> Creases<'a> {
    pub fn between(
        mesh: &'a SurfaceMesh,
        planes: &'a [Option<Plane>],
        spacing: f64,
        limits: Limits,
    ) -> Creases<'a> {
        let differ = |a: u32, b: u32| match (&planes[a as usize], &planes[b as usize]) {
            (Some(a), Some(b)) => a.normal.dot(b.normal) < limits.sharp,
            _ => false,
        };
        let sides = sides_by_edge(&mesh.triangles, |_, [a, b]| differ(a, b));
        let mut creases = Vec::new();
        let mut of_sides = vec![NONE; 3 * mesh.triangles.len()];
        for pair in by_edge(&sides) {
            let (key, side) = pair[0];
            let opposite = |side: u32| opposite(&mesh.triangles, side);
            let opposite = [Some(side), pair.get(1).map(|p| p.1)].map(|s| s.map_or(NONE, opposite));
            pair.iter().for_each(|(_, side)| of_sides[*side as usize] = creases.len() as u32);
            creases.push(Crease { ends: edge_of_key(key), opposite });
        }
        let is_corner = |t: &u32| (0..3).all(|k| of_sides[3 * *t as usize + k] != NONE);
        let corners = (0..mesh.triangles.len() as u32).filter(is_corner).map(|t| (t, None)).collect();
        let cuts = vec![None; creases.len()];
        let mut found = Creases {
            mesh,
            planes,
            spacing,
            limits,
            creases,
            of_sides,
            moved: mesh.positions.clone(),
            is_moved: vec![false; mesh.positions.len()],
            cuts,
            corners,
        };
        found.move_vertices();
        found
    }

    /// Into their planes, and off the edges of these.
    fn move_vertices(&mut self) {
        for (place, plane) in self.moved.iter_mut().zip(self.planes) {
            *place = plane.map_or(*place, |plane| plane.projected(*place));
        }
        // Twice: next to corners there are two edges to keep off.
        for _ in 0..2 {
            for crease in &self.creases {
                let [a, b] = crease.ends;
                for (own, other) in [(a, b), (b, a)] {
                    if let (Some(plane), Some(other)) = (self.plane(own), self.plane(other)) {
                        let place = &mut self.moved[own as usize];
                        *place = plane.kept_off(*place, other, MARGIN * self.spacing);
                    }
                }
            }
        }
    }

    pub(super) fn plane(&self, vertex: u32) -> Option<&'a Plane> {
        self.planes.get(vertex as usize)?.as_ref()
    }

    /// Finds where to cut.
    pub fn place(&mut self, evidence: &dyn Evidence, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let mut cuts = vec![None; self.creases.len()];
        let place = |k: usize, search: &mut Search| self.cut_of(&self.creases[k], evidence, search);
        fill_in_blocks(&mut cuts, place, "sharp edges", monitor)?;
        let mut places = vec![None; self.corners.len()];
        let place = |k: usize, search: &mut Search| self.corner_in(self.corners[k].0, evidence, search);
        fill_in_blocks(&mut places, place, "sharp edges", monitor)?;
        self.corners.iter_mut().zip(places).for_each(|(corner, place)| corner.1 = place);
        self.cuts = cuts;
        for (crease, _) in self.creases.iter().zip(&self.cuts).filter(|(_, cut)| cut.is_some()) {
            crease.ends.iter().for_each(|v| self.is_moved[*v as usize] = true);
        }
        // What is next to them is rounded too.
        self.is_moved = super::ring(self.mesh, &self.is_moved);
        let has_plane = self.planes.iter().map(Option::is_some);
        self.is_moved.iter_mut().zip(has_plane).for_each(|(moved, has_plane)| *moved &= has_plane);
        Ok(())
    }

    fn cut_of(&self, crease: &Crease, evidence: &dyn Evidence, search: &mut Search) -> Option<Vec3> {
        let (a, b) = (self.plane(crease.ends[0])?, self.plane(crease.ends[1])?);
        let ends = crease.ends.map(|v| self.moved[v as usize]);
        let mut place = self.crossing(crease.ends)?;
        let line = a.normal.cross(b.normal);
        let sine = line.length();
        let line = line / sine;
        let differs = |c: &&Plane| [a, b].iter().all(|p| p.normal.dot(c.normal) < self.limits.sharp);
        for other in crease.opposite.iter().filter_map(|v| self.plane(*v)).filter(differs) {
            // The edge ends where it meets a third plane, and lies on the side of it where both ends are; in a saddle, where one edge
            // bends the other way than the two others, on that of the end which it shares with that one.
            let [from, to] = ends.map(|end| other.distance(end).signum());
            let side = if b.bend(other) == a.bend(b) { from } else { to };
            let (slope, margin) = (line.dot(other.normal), MARGIN * self.spacing);
            if side * other.distance(place) < margin && slope.abs() > ASIDE {
                place += (side * margin - other.distance(place)) / slope * line;
            }
        }
        // Farther off in wedges.
        let reach = REACH * self.spacing / if a.normal.dot(b.normal) < 0.0 { sine } else { 1.0 };
        let middle = 0.5 * (ends[0] + ends[1]);
        evidence.meeting(place, &[*a, *b], search).filter(|place| place.distance(middle) <= reach)
    }

    /// Where an edge of the mesh crosses that between its ends' planes, were both laid flat: neighbours stay in their order.
    pub(super) fn crossing(&self, ends: [u32; 2]) -> Option<Vec3> {
        let (a, b) = (self.plane(ends[0])?, self.plane(ends[1])?);
        let ends = ends.map(|v| self.moved[v as usize]);
        let [from, to] = [edge_of(a, b, ends[0])?, edge_of(a, b, ends[1])?];
        let [before, after] = [from.distance(ends[0]), to.distance(ends[1])];
        // Both on it: anywhere between them.
        let share = if before + after > 0.0 { before / (before + after) } else { 0.5 };
        Some(from + share * (to - from))
    }

    fn corner_in(&self, triangle: u32, evidence: &dyn Evidence, search: &mut Search) -> Option<Vec3> {
        let corners = self.mesh.triangles[triangle as usize];
        let [a, b, c] = corners.map(|v| self.plane(v).copied());
        let planes = [a?, b?, c?];
        let middle = barycentre(corners.map(|v| self.moved[v as usize]));
        let place = corner_of(&planes, middle)?;
        let [a, b, c] = planes.map(|plane| plane.normal);
        let reach = REACH * self.spacing / a.dot(b.cross(c)).abs();
        evidence.meeting(place, &planes, search).filter(|place| place.distance(middle) <= reach)
    }

    /// The vertices of the result: those of the mesh, of cuts and of corners; and the number of each cut.
    fn vertices(&self) -> (Vec<Vec3>, Vec<Option<u32>>) {
        let own = self.mesh.positions.iter().zip(&self.moved).zip(&self.is_moved);
        let mut all: Vec<Vec3> = own.map(|((old, new), is)| if *is { *new } else { *old }).collect();
        let number = |cut: &Option<Vec3>| {
            cut.map(|place| {
                all.push(place);
                all.len() as u32 - 1
            })
        };
        let numbers = self.cuts.iter().map(number).collect();
        (all, numbers)
    }

    /// The vertices and triangles of the result; `seen` is told of each triangle that is touched, with its parts.
    fn build(&self, mut seen: impl FnMut(usize, &[Vec3], &[Part])) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (mut positions, numbers) = self.vertices();
        let mut corners = self.corners.iter().peekable();
        let mut triangles = Vec::with_capacity(self.mesh.triangles.len());
        for (t, old) in self.mesh.triangles.iter().enumerate() {
            let sides = [0, 1, 2].map(|k| numbers.get(self.of_sides[3 * t + k] as usize).copied().flatten());
            let corner = corners.next_if(|corner| corner.0 as usize == t).and_then(|corner| corner.1);
            let corner = corner.filter(|_| sides.iter().all(Option::is_some));
            let amid = corner.map(|place| {
                positions.push(place);
                positions.len() as u32 - 1
            });
            let parts = cut(*old, sides, amid, |v| positions[v as usize]);
            if parts.len() > 1 || old.iter().any(|v| self.is_moved[*v as usize]) {
                seen(t, &positions, &parts);
            }
            triangles.extend(parts.iter().map(|part| part.0));
        }
        (positions, triangles)
    }

    /// Triangles of which a part would not face the way its plane does.
    pub fn turned(&self) -> Vec<usize> {
        let mut turned = Vec::new();
        self.build(|t, positions, parts| {
            let old = self.mesh.triangles[t];
            if self.turns(old, parts, |v| positions[v as usize]) {
                turned.push(t);
            }
        });
        turned
    }

    pub(super) fn turns(&self, old: [u32; 3], parts: &[Part], at: impl Fn(u32) -> Vec3) -> bool {
        let before = area_vector(old.map(|v| self.mesh.positions[v as usize]));
        parts.iter().any(|(part, owner)| {
            let normal = self.plane(old[*owner]).map_or(before, |plane| plane.normal);
            area_vector(part.map(&at)).dot(normal) <= 0.0
        })
    }

    /// Leaves the vertices of those triangles where they were, and those uncut whose vertices are; whether there were any.
    pub fn leave_out(&mut self, turned: &[usize]) -> bool {
        let moved_before = self.is_moved.clone();
        let mut is_changed = false;
        for t in turned {
            let corners = self.mesh.triangles[*t].map(|v| v as usize);
            let had_moved = corners.iter().any(|v| moved_before[*v]);
            for (k, vertex) in corners.into_iter().enumerate() {
                is_changed |= std::mem::replace(&mut self.is_moved[vertex], false);
                let cut = self.cuts.get_mut(self.of_sides[3 * t + k] as usize).filter(|_| !had_moved);
                is_changed |= cut.is_some_and(|cut| cut.take().is_some());
            }
        }
        is_changed
    }

    pub(super) fn differ(&self, [a, b]: [u32; 2]) -> bool {
        match (self.plane(a), self.plane(b)) {
            (Some(a), Some(b)) => a.normal.dot(b.normal) < self.limits.sharp,
            _ => false,
        }
    }

    pub fn cut(&self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        self.build(|_, _, _| {})
    }
}
