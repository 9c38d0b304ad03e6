//! Pieces that hang together by edges of two faces: their shape, which is in which, and what they are in the solid.
use super::faces::Face;
use super::report::{Shell, ShellRole};
use super::sides::FaceSides;
use crate::bvh::Bvh;
use crate::data::{Topology, TriangleSoup, map_tasks};
use crate::math::{Aabb, Vec3, meet, signed_volume};

/// Shells, and the faces to turn.
pub struct Shells {
    /// By their numbers in the topology.
    pub shells: Vec<Shell>,
    pub is_flipped: Vec<bool>,
}

/// The share of its area with which a shell has to be outside to bound nothing.
const MOST: f64 = 0.5;
/// The mean of w on both sides of a shell, below which it is inside out: it is −1/2 there, and 0 at a sheet.
const INSIDE_OUT: f64 = -0.25;

pub fn shells(
    soup: &TriangleSoup,
    topology: &Topology,
    faces: &[Face],
    sides: &FaceSides,
    bvh: &Bvh,
) -> Shells {
    let count = topology.is_orientable.len();
    let mut all: Vec<Shell> =
        topology.is_orientable.iter().map(|is_orientable| empty(*is_orientable)).collect();
    // Area that runs with the first face and against it; area of each kind of sides, of those with the first and of the others.
    let mut with_first = vec![[0.0; 2]; count];
    let mut kinds = vec![[[0.0; 4]; 2]; count];
    let mut means = vec![[0.0; 2]; count];
    let mut volumes = vec![0.0; count];
    let anchor = soup.bounds().center();
    let members = || (0..soup.len()).filter(|t| topology.is_kept(*t));
    for t in members() {
        let number = topology.shells[t] as usize;
        let (shell, turned) = (&mut all[number], usize::from(topology.is_turned[t]));
        shell.first_face = shell.first_face.min(t as u32);
        shell.faces += 1;
        shell.area += faces[t].area;
        with_first[number][turned] += faces[t].area;
        let volume = signed_volume(soup.corners(t), anchor);
        volumes[number] += if turned == 0 { volume } else { -volume };
        means[number][turned] += sides.mean(t);
        kinds[number][turned].iter_mut().zip(sides.areas(t)).for_each(|(sum, area)| *sum += area);
        for side in 3 * t as u32..3 * t as u32 + 3 {
            shell.is_closed &= topology.joined[side as usize] != Topology::NONE;
        }
    }
    count_euler(topology, &mut all);
    let mut is_flipped = vec![false; soup.len()];
    let mut flips = vec![[false; 2]; count];
    for (number, shell) in all.iter_mut().enumerate() {
        let most = usize::from(with_first[number][1] > with_first[number][0]);
        let is_closed = shell.is_closed && shell.is_orientable;
        // Collapsed to a face and its other side, it encloses nothing.
        shell.volume = is_closed.then_some(if most == 0 { volumes[number] } else { -volumes[number] });
        shell.genus = is_closed.then(|| (2 - shell.euler_number).max(0) as u64 / 2);
        shell.role = role(kinds[number][most], means[number][most]);
        if shell.is_orientable {
            let is_inverted = shell.role == ShellRole::Inverted;
            flips[number][most] = is_inverted;
            flips[number][1 - most] = !is_inverted;
        }
    }
    members().for_each(|t| {
        is_flipped[t] = flips[topology.shells[t] as usize][usize::from(topology.is_turned[t])];
    });
    set_depths(soup, topology, bvh, &mut all);
    Shells { shells: all, is_flipped }
}

fn empty(is_orientable: bool) -> Shell {
    Shell {
        first_face: u32::MAX,
        faces: 0,
        area: 0.0,
        is_closed: true,
        is_orientable,
        volume: None,
        euler_number: 0,
        genus: None,
        depth: None,
        role: ShellRole::Outside,
    }
}

/// By the area for which w ≥ 1/2 on neither side, on that of the normal, on the other, on both; and the area times the mean of w.
fn role([outside, reversed, bounding, internal]: [f64; 4], mean: f64) -> ShellRole {
    let total = outside + reversed + bounding + internal;
    if outside > MOST * total {
        return if mean < INSIDE_OUT * total { ShellRole::Inverted } else { ShellRole::Outside };
    }
    let most = reversed.max(bounding).max(internal);
    match most {
        _ if total == 0.0 => ShellRole::Outside,
        _ if most == bounding => ShellRole::Boundary,
        _ if most == reversed => ShellRole::Reversed,
        _ => ShellRole::Internal,
    }
}

/// V − E + F: a vertex for each fan, an edge for two joined sides or a single one.
fn count_euler(topology: &Topology, shells: &mut [Shell]) {
    let mut fans = topology.fans(false);
    for t in (0..topology.corners.len()).filter(|t| topology.is_kept(*t)) {
        let shell = &mut shells[topology.shells[t] as usize];
        shell.euler_number += 1;
        for side in 3 * t as u32..3 * t as u32 + 3 {
            let joined = topology.joined[side as usize];
            shell.euler_number +=
                i64::from(fans.find(side) == side) - i64::from(joined == Topology::NONE || side < joined);
        }
    }
}

/// How many other closed shells are around each closed one: by the parity of the crossings of a ray from one of its vertices
/// along −x, exactly.
fn set_depths(soup: &TriangleSoup, topology: &Topology, bvh: &Bvh, shells: &mut [Shell]) {
    let closed: Vec<usize> = (0..shells.len()).filter(|s| shells[*s].is_closed).collect();
    if closed.len() == 1 {
        shells[closed[0]].depth = Some(0);
        return;
    }
    let depths = map_tasks(closed.len(), |k| {
        let own = closed[k];
        let q = soup.corners(shells[own].first_face as usize)[0];
        let mut crossed: Vec<u32> = Vec::new();
        bvh.for_each(
            |bounds| is_on_ray(q, bounds),
            |t| {
                let shell = topology.shells[t];
                if topology.is_kept(t)
                    && shell as usize != own
                    && shells[shell as usize].is_closed
                    && meet(q, soup.corners(t)).0 != 0
                {
                    crossed.push(shell);
                }
            },
        );
        crossed.sort_unstable();
        crossed.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).count()
    });
    closed.iter().zip(depths).for_each(|(s, depth)| shells[*s].depth = Some(depth));
}

/// Whether a box meets the ray from `q` along −x.
fn is_on_ray(q: Vec3, bounds: &Aabb) -> bool {
    bounds.min.x <= q.x
        && bounds.min.y <= q.y
        && q.y <= bounds.max.y
        && bounds.min.z <= q.z
        && q.z <= bounds.max.z
}
