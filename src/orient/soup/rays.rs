//! Which side of a patch is inside, by rays from both.
use super::nesting::EVIDENCE;
use super::{FaceMethod, Scene};
use crate::data::{Cancelled, Monitor, fill_in_blocks};
use crate::math::{Random, Ray, Vec3, area_vector};
use std::f64::consts::TAU;

/// Rays from either side before it is asked whether they agree.
const BATCH: usize = 8;
const FEW_FACES: usize = 4;
/// Where so much more of them say one thing than the other, no more are cast.
const SURE: f64 = 0.7;
/// Where not even so much more do, they say nothing: of patches whose faces run either way, and of others of some faces, most of
/// which run one way for a reason.
const UNSURE: f64 = 0.2;
const UNSURE_OF_MOST: f64 = 0.5;
const SOME_FACES: usize = 16;
/// The same for how far they get, as a share of that.
const UNSURE_DISTANCE: f64 = 0.25;
/// Hits nearer than this share of the diagonal are at the place where the ray begins.
const NEAR: f64 = 1e-12;

/// What rays from one side of a patch meet.
#[derive(Clone, Copy, Default)]
struct Votes {
    rays: f64,
    /// Rays that cross the patch itself an odd number of times, and all faces.
    own_odd: f64,
    all_odd: f64,
    /// Sum of how far they get, in shares of the diagonal.
    distance: f64,
}

/// Whether each of some patches is to be turned against most of its area.
pub fn turns(
    scene: &Scene,
    patches: &[usize],
    method: FaceMethod,
    most_rays: usize,
    monitor: &dyn Monitor,
) -> Result<Vec<bool>, Cancelled> {
    let mut turns = vec![false; patches.len()];
    let turn = |i: usize, (): &mut ()| is_to_turn(scene, patches[i], method, most_rays);
    fill_in_blocks(&mut turns, turn, "orientation", monitor)?;
    Ok(turns)
}

fn is_to_turn(scene: &Scene, patch: usize, method: FaceMethod, most_rays: usize) -> bool {
    let mut sides = [Votes::default(); 2];
    let mut random = random_of(patch);
    let of_patch = &scene.patches.list[patch];
    let is_small = of_patch.faces.len() <= FEW_FACES;
    let has_reason = of_patch.faces.len() >= SOME_FACES && of_patch.agreement >= EVIDENCE;
    let unsure = if has_reason { UNSURE_OF_MOST } else { UNSURE };
    let mut cast = 0;
    while cast < most_rays.max(BATCH) {
        for k in 0..BATCH {
            cast_ray(scene, patch, &mut random, k % 2 == 0, &mut sides[k % 2]);
        }
        cast += BATCH;
        let [own, all, distance] = opinions(&sides);
        let is_sure = match method {
            FaceMethod::Visibility => distance.abs() > SURE,
            // Few faces hardly meet each other.
            _ => own.abs() > SURE || own.abs() < UNSURE && all.abs() > SURE && (is_small || cast > BATCH),
        };
        if is_sure {
            break;
        }
    }
    let [own, all, distance] = opinions(&sides);
    let by_distance = if distance.abs() > UNSURE_DISTANCE * unsure { distance } else { 0.0 };
    let opinion = match method {
        FaceMethod::Visibility => by_distance,
        _ if own.abs() > unsure => own,
        _ if all.abs() > unsure => all,
        _ => by_distance,
    };
    opinion < 0.0
}

/// How much more the front of most of the patch is outside than its back: by its own crossings, by all, and by distances;
/// each within ±1.
fn opinions([front, back]: &[Votes; 2]) -> [f64; 3] {
    let share = |side: &Votes, of: fn(&Votes) -> f64| of(side) / side.rays.max(1.0);
    let more = |of: fn(&Votes) -> f64| share(back, of) - share(front, of);
    let [far, near] = [front, back].map(|side| share(side, |v| v.distance));
    [more(|v| v.own_odd), more(|v| v.all_odd), (far - near) / (far + near).max(f64::MIN_POSITIVE)]
}

fn cast_ray(scene: &Scene, patch: usize, random: &mut Random, is_front: bool, votes: &mut Votes) {
    let of_patch = &scene.patches.list[patch];
    // A place evenly drawn from the patch's area.
    let wanted = random.below_one() * of_patch.area();
    let place = of_patch.area_to.partition_point(|area| *area <= wanted).min(of_patch.faces.len() - 1);
    let face = of_patch.faces[place] as usize;
    let corners = scene.soup.corners(face);
    let [a, b, c] = corners;
    let root = random.below_one().sqrt();
    let along = random.below_one();
    let origin = a + root * (1.0 - along) * (b - a) + root * along * (c - a);
    let mut normal = area_vector(corners).normalize_or_zero();
    if normal == Vec3::ZERO {
        return;
    }
    if scene.patches.is_against_most(face) == Some(is_front) {
        normal = -normal;
    }
    // As much as surfaces shine: more rays go straight away.
    let (x, y) = normal.any_orthonormal_pair();
    let (sin, cos) = libm::sincos(TAU * random.below_one());
    let tilt = random.below_one();
    let direction = tilt.sqrt() * (cos * x + sin * y) + (1.0 - tilt).sqrt() * normal;
    let ray = Ray::new(origin, direction);
    let diagonal = scene.bounds.diagonal();
    let (mut own, mut all, mut nearest) = (0u32, 0u32, diagonal);
    scene.bvh.for_each(
        |bounds| ray.enters(bounds) < f64::INFINITY,
        |t| {
            if t == face || !scene.patches.is_kept(t) {
                return;
            }
            if let Some((distance, _)) = ray.meet(scene.soup.corners(t)).filter(|hit| hit.0 > NEAR * diagonal)
            {
                all += 1;
                own += u32::from(scene.patches.of_face(t) == patch);
                nearest = nearest.min(distance);
            }
        },
    );
    votes.rays += 1.0;
    votes.own_odd += f64::from(own % 2);
    votes.all_odd += f64::from(all % 2);
    votes.distance += nearest / diagonal;
}

/// What is drawn for a patch; the factor keeps the sequences of different ones apart.
pub fn random_of(patch: usize) -> Random {
    Random::new((patch as u64).wrapping_mul(0xd134_2543_de82_ef95))
}

/// A unit vector, evenly distributed (Archimedes' cylinder).
pub fn random_direction(random: &mut Random) -> Vec3 {
    let z = 1.0 - 2.0 * random.below_one();
    let (sin, cos) = libm::sincos(TAU * random.below_one());
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * cos, r * sin, z)
}
