//! Closed patches: outward, unless they are cavities of others.
use super::Scene;
use super::rays::{random_direction, random_of};
use crate::data::map_tasks;
use crate::math::{Ray, barycentre};

/// Where so much of a patch's area runs one way, that is no accident.
pub const EVIDENCE: f64 = 0.75;
/// Rays that tell in which patches another lies, and how many of them have to cross a patch an odd number of times.
const RAYS: usize = 24;
const MOST: usize = 18;

/// Sets for all closed patches whether they are to be turned against most of their area.
pub fn turn_closed(scene: &Scene, is_turned: &mut [bool]) {
    let patches = &scene.patches.list;
    let closed: Vec<usize> = (0..patches.len()).filter(|p| patches[*p].is_closed).collect();
    let is_alone = patches.len() == 1;
    let mut around =
        map_tasks(closed.len(), |k| if is_alone { Vec::new() } else { patches_around(scene, closed[k]) });
    let mut order: Vec<usize> = (0..closed.len()).collect();
    order.sort_by_key(|k| (around[*k].len(), *k));
    for k in order {
        let (own, around) = (closed[k], std::mem::take(&mut around[k]));
        let patch = &patches[own];
        let is_outward = patch.volume >= 0.0;
        // What is largest is outermost.
        let largest = around.iter().copied().max_by(|a, b| patches[*a].area().total_cmp(&patches[*b].area()));
        is_turned[own] = match largest {
            None => !is_outward,
            Some(outer) if patch.agreement >= EVIDENCE => {
                patches[outer].agreement >= EVIDENCE && is_turned[outer]
            }
            Some(_) => is_outward != (around.len() % 2 == 0),
        };
    }
}

/// The patches that a closed one lies in.
fn patches_around(scene: &Scene, own: usize) -> Vec<usize> {
    let faces = &scene.patches.list[own].faces;
    let mut random = random_of(own);
    let mut crossed: Vec<(usize, usize)> = Vec::new();
    for k in 0..RAYS {
        let face = faces[k * faces.len() / RAYS] as usize;
        let ray = Ray::new(barycentre(scene.soup.corners(face)), random_direction(&mut random));
        scene.bvh.for_each(
            |bounds| ray.enters(bounds) < f64::INFINITY,
            |t| {
                if scene.patches.is_kept(t)
                    && scene.patches.of_face(t) != own
                    && ray.meet(scene.soup.corners(t)).is_some()
                {
                    crossed.push((scene.patches.of_face(t), k));
                }
            },
        );
    }
    crossed.sort_unstable();
    let odd: Vec<usize> =
        crossed.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0].0).collect();
    odd.chunk_by(|a, b| a == b).filter(|rays| rays.len() >= MOST).map(|rays| rays[0]).collect()
}
