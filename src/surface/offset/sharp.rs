//! Sharp edges of a region: where the places that are nearest on the shape change from one part of it to another.
use super::region::{Probe, Region};
use crate::math::Vec3;
use crate::surface::sharp::{Evidence, Plane, Search, meeting_of};

/// How far off the region's surface a sharp edge or corner may lie, in cells: none is invented where the surface is round.
const OFF: f64 = 0.05;

impl Region<'_> {
    fn probed<T>(&self, search: &mut Search, question: impl FnOnce(&mut Probe) -> T) -> T {
        let mut probe = Probe { search: std::mem::take(&mut search.distances), ..Probe::default() };
        let answer = question(&mut probe);
        search.distances = probe.search;
        answer
    }
}

impl Evidence for Region<'_> {
    fn normal(&self, place: Vec3, search: &mut Search) -> Option<Vec3> {
        let normal = self.probed(search, |probe| self.normal(place, probe));
        (normal != Vec3::ZERO).then_some(normal)
    }

    fn plane(&self, place: Vec3, outward: Vec3, search: &mut Search) -> Option<Plane> {
        let (normal, value) =
            self.probed(search, |probe| (self.normal(place, probe), self.value(place, probe)));
        // Triangles may be flipped, the mesh is not.
        let normal = if normal.dot(outward) < 0.0 { -normal } else { normal };
        (normal != Vec3::ZERO && value.is_finite()).then(|| Plane { point: place + value * normal, normal })
    }

    fn meeting(&self, place: Vec3, planes: &[Plane], search: &mut Search) -> Option<Vec3> {
        let met = meeting_of(planes, place)?;
        let value = self.probed(search, |probe| self.value(met, probe));
        (value.abs() <= OFF * self.spacing).then_some(met)
    }
}
