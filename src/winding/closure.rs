//! What closes a soup: triangles C with ∂C = −∂M, so that the winding number of M is an integer, the crossings of M ∪ C by
//! any ray, less that of C; and for which components that is worth it.
use super::chain::{components, cycles, net_edges, weld};
use crate::data::{Loader, SavedError, Saver, TriangleSoup};
use crate::math::{Vec3, covers, orient_yz, perturbed_side_of_plane};

/// A component whose closure has more than this share of its triangles is *loose*: summing its own triangles costs less
/// than closing it. On the bunny with 1, 10 and 50 % of its triangles deleted the shares are 0.014, 0.12 and 0.98, and
/// closing pays for the first two only.
const LOOSE_SHARE: f64 = 0.25;

/// Soups with up to this many boundary edges are closed whatever their share: so few cost little, and classifications are
/// then proven.
const FEW_EDGES: usize = 2000;

/// How a soup is taken apart.
#[derive(Clone, Debug, Default)]
pub struct Closure {
    /// Cycles of boundary edges of the components that are closed by caps, each vertex once, in the direction in which the
    /// soup's triangles run through them.
    pub cycles: Vec<Vec<Vec3>>,
    /// The closure's triangles turned around: their boundary is ∂M.
    pub caps: Vec<[Vec3; 3]>,
    /// One flag for each triangle of the soup, set for those of loose components; empty when there is none.
    pub is_loose: Vec<bool>,
    /// The same triangles, by number.
    pub loose: Vec<u32>,
    pub counts: ClosureCounts,
}

/// What [`Closure`] has found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ClosureCounts {
    /// Net boundary edges of the whole soup.
    pub boundary_edges: usize,
    /// Components that have boundary edges and are closed by caps.
    pub capped_components: usize,
    /// Components whose triangles are summed singly.
    pub loose_components: usize,
}

/// A component, by the lowest of its vertices; flat, as a soup of loose triangles has one for each.
#[derive(Clone, Copy, Default)]
struct Component {
    triangles: u32,
    cycles: u32,
    caps: u32,
}

impl Component {
    fn is_loose(&self) -> bool {
        f64::from(self.caps) > LOOSE_SHARE * f64::from(self.triangles)
    }
}

impl Closure {
    pub fn of(soup: &TriangleSoup) -> Closure {
        let welded = weld(soup.positions());
        let edges = net_edges(soup, &welded);
        if edges.is_empty() {
            return Closure::default();
        }
        let roots = components(soup, &welded);
        let mut cycles = cycles(&edges);
        let mut of_root = vec![Component::default(); roots.len()];
        for cycle in &cycles {
            let component = &mut of_root[roots[cycle[0] as usize] as usize];
            component.cycles += 1;
            component.caps += cycle.len().saturating_sub(2) as u32;
        }
        for corners in soup.triangles() {
            of_root[roots[corners[0] as usize] as usize].triangles += 1;
        }
        let mut closure = Closure::default();
        closure.counts.boundary_edges = edges.len();
        if edges.len() > FEW_EDGES {
            closure.set_loose(soup, &roots, &of_root);
        }
        let open = of_root.iter().filter(|c| c.cycles > 0).count();
        closure.counts.capped_components = open - closure.counts.loose_components;
        if closure.counts.loose_components > 0 {
            cycles.retain(|cycle| !of_root[roots[cycle[0] as usize] as usize].is_loose());
        }
        let places = |cycle: Vec<u32>| cycle.into_iter().map(|v| soup.positions()[v as usize]).collect();
        closure.set_cycles(cycles.into_iter().map(places).collect());
        closure
    }

    fn set_cycles(&mut self, mut cycles: Vec<Vec<Vec3>>) {
        // They may lie where many more did, which were not worth closing.
        cycles.shrink_to_fit();
        cycles.iter().for_each(|cycle| cap(cycle, 0, cycle.len() - 1, &mut self.caps));
        self.cycles = cycles;
    }

    /// Adds a closure to saved bytes, of which the cycles are elsewhere. Caps follow from these.
    pub fn save(&self, cycles: &[Vec<Vec3>], saver: &mut Saver) {
        let counts = self.counts;
        for count in [counts.boundary_edges, counts.capped_components, counts.loose_components] {
            saver.number(count as u64);
        }
        let lengths: Vec<u32> = cycles.iter().map(|cycle| cycle.len() as u32).collect();
        saver.numbers(&lengths);
        saver.vectors(&cycles.concat());
        saver.numbers(&self.loose);
    }

    /// The closure that was saved, of a soup of so many triangles.
    ///
    /// # Errors
    /// If and only if the bytes end early, cycles are shorter than triangles or not finite, or loose triangles are none of the soup's.
    pub fn load(triangles: usize, loader: &mut Loader) -> Result<Closure, SavedError> {
        let [mut boundary_edges, mut capped_components, mut loose_components] = [0; 3];
        for count in [&mut boundary_edges, &mut capped_components, &mut loose_components] {
            *count = loader.number::<u64>("the saved counts of openings")? as usize;
        }
        let counts = ClosureCounts { boundary_edges, capped_components, loose_components };
        let mut closure = Closure { counts, ..Closure::default() };
        let lengths: Vec<u32> = loader.numbers("the saved lengths of openings")?;
        let points = loader.vectors("the saved openings")?;
        let total: u64 = lengths.iter().map(|n| u64::from(*n)).sum();
        let are_rings = total == points.len() as u64 && lengths.iter().all(|n| *n > 2);
        if !are_rings || !points.iter().all(|p| p.is_finite()) {
            return Err(SavedError::Inconsistent("the saved openings are no rings of finite points"));
        }
        let mut rest = &points[..];
        let ring = |length: &u32| {
            let (ring, others) = rest.split_at(*length as usize);
            rest = others;
            ring.to_vec()
        };
        closure.set_cycles(lengths.iter().map(ring).collect());
        closure.loose = loader.numbers("the saved loose triangles")?;
        let is_there = closure.loose.last().is_none_or(|t| (*t as usize) < triangles);
        if !is_there || closure.loose.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(SavedError::Inconsistent("the saved loose triangles are none of the saved soup"));
        }
        if !closure.loose.is_empty() {
            closure.is_loose = vec![false; triangles];
            closure.loose.iter().for_each(|t| closure.is_loose[*t as usize] = true);
        }
        Ok(closure)
    }

    fn set_loose(&mut self, soup: &TriangleSoup, roots: &[u32], of_root: &[Component]) {
        self.counts.loose_components = of_root.iter().filter(|c| c.is_loose()).count();
        if self.counts.loose_components == 0 {
            return;
        }
        let is_loose = |corners: &[u32; 3]| of_root[roots[corners[0] as usize] as usize].is_loose();
        self.is_loose = soup.triangles().iter().map(is_loose).collect();
        self.loose = (0..soup.len() as u32).filter(|t| self.is_loose[*t as usize]).collect();
        self.loose.shrink_to_fit();
    }

    /// Whether every component is closed.
    pub fn is_empty(&self) -> bool {
        self.caps.is_empty() && self.loose.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let cycles: usize = self.cycles.iter().map(|c| size_of_val(&c[..])).sum();
        cycles + size_of_val(&self.caps[..]) + self.is_loose.len() + size_of_val(&self.loose[..])
    }
}

/// Triangulates the polygon first … last of a cycle by halves: most triangles are small and near the rim. Their boundary
/// runs along the cycle.
pub(super) fn cap(cycle: &[Vec3], first: usize, last: usize, caps: &mut Vec<[Vec3; 3]>) {
    if last - first < 2 {
        return;
    }
    let middle = (first + last) / 2;
    caps.push([cycle[first], cycle[middle], cycle[last]]);
    cap(cycle, first, middle, caps);
    cap(cycle, middle, last, caps);
}

/// Crossings by the ray from `q` along −x of caps, turned around so that they close the soup.
pub fn crossings_of_caps(caps: &[[Vec3; 3]], q: Vec3) -> i32 {
    let one = |cap: &[Vec3; 3]| {
        let corners = [cap[0], cap[2], cap[1]];
        let [low, high] = [cap[0].min(cap[1]).min(cap[2]), cap[0].max(cap[1]).max(cap[2])];
        if q.y < low.y || q.y > high.y || q.z < low.z || q.z > high.z || !covers(q, corners) {
            return 0;
        }
        let facing = orient_yz(corners[0], corners[1], corners[2]);
        if perturbed_side_of_plane(q, corners) == facing { -facing } else { 0 }
    };
    caps.iter().map(one).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn soup(positions: &[Vec3], triangles: &[[u32; 3]]) -> TriangleSoup {
        TriangleSoup::new(positions.to_vec(), triangles.to_vec()).unwrap()
    }

    /// A strip around the z axis of `sides` quads, open above and below.
    fn tube(sides: u32) -> TriangleSoup {
        let rim = |i: u32| {
            let angle = std::f64::consts::TAU * f64::from(i / 2) / f64::from(sides);
            Vec3::new(angle.cos(), angle.sin(), f64::from(i % 2))
        };
        let positions: Vec<Vec3> = (0..2 * sides).map(rim).collect();
        let quad = |i: u32| {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3].map(|v| v % (2 * sides));
            [[a, c, b], [b, c, d]]
        };
        soup(&positions, &(0..sides).flat_map(quad).collect::<Vec<_>>())
    }

    #[test]
    fn caps_have_the_boundary_of_the_soup() {
        let tube = tube(1025);
        // A tube has as many caps as triangles, less four: loose on its own, it is capped beside enough closed triangles.
        assert_eq!(Closure::of(&tube).loose.len(), 2050);
        let mut positions = tube.positions().to_vec();
        let mut triangles = tube.triangles().to_vec();
        for k in 0..2000u32 {
            let first = positions.len() as u32;
            positions.extend([
                tube.positions()[0],
                Vec3::splat(f64::from(k)),
                Vec3::X * f64::from(k),
                Vec3::Y,
            ]);
            let [o, a, b, c] = [0, 1, 2, 3].map(|i| first + i);
            triangles.extend([[o, a, b], [o, b, c], [o, c, a], [a, c, b]]);
        }
        let joined = soup(&positions, &triangles);
        let closure = Closure::of(&joined);
        assert_eq!((closure.loose.len(), closure.caps.len(), closure.cycles.len()), (0, 2046, 2));
        assert_eq!(closure.counts.boundary_edges, 2050);
        let closed: Vec<[Vec3; 3]> = (0..joined.len())
            .map(|t| joined.corners(t))
            .chain(closure.caps.iter().map(|[a, b, c]| [*a, *c, *b]))
            .collect();
        let numbers: Vec<[u32; 3]> =
            (0..closed.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        let closed = soup(&closed.concat(), &numbers);
        assert!(net_edges(&closed, &weld(closed.positions())).is_empty());
    }

    #[test]
    fn few_loose_triangles_are_their_own_caps() {
        let closure = Closure::of(&soup(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]));
        assert_eq!((closure.loose.len(), closure.caps.len(), closure.counts.capped_components), (0, 1, 1));
        let corners = |k: u32| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p + 2.0 * f64::from(k) * Vec3::Z);
        let positions: Vec<Vec3> = (0..1000).flat_map(corners).collect();
        let numbers: Vec<[u32; 3]> = (0..1000).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
        assert_eq!(Closure::of(&soup(&positions, &numbers)).counts.loose_components, 1000);
    }
}
