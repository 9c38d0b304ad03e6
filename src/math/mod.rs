//! Vectors, boxes, triangles, exact predicates and small matrices: no knowledge of files, trees or fields.
mod aabb;
mod chebyshev;
mod closest;
mod plane;
mod predicates;
mod random;
mod ray;
mod registers;
mod triangle;
mod triangles_meet;
mod twofold;

pub use aabb::Aabb;
pub use chebyshev::{Nodes, bernstein, lebesgue};
pub use closest::{Feature, OnTriangle, closest_on_triangle, squared_distance_to_triangle};
pub use glam::{DAffine3 as Affine, DMat3 as Mat3, DVec2 as Vec2, DVec3 as Vec3};
pub use plane::{PlaneFit, fit_plane};
pub use predicates::{
    Sign, covers, meet, normal_signs, orient, orient_yz, perturbed_side_of_plane, side_of_edge,
    side_of_plane, tie_break, touches, touches_segment,
};
pub(crate) use random::{Random, fraction, hashed, mixed};
pub use ray::Ray;
pub use registers::{Floats, Plain, Registers, Work, in_widest_registers};
pub use triangle::{area_vector, barycentre, distance_to_triangle, normal, signed_volume, solid_angle};
pub use triangles_meet::triangles_meet;
pub(crate) use twofold::{Place, Twofold};
