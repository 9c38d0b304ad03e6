use crate::math::Vec3;

/// How far from 0 a coordinate of a shape may be, in millimetres. Products of four differences of such coordinates, as areas have when
/// they are squared, stay finite.
pub const LARGEST_COORDINATE: f64 = 1e75;

/// Whether a shape may have this vertex or point.
pub(super) fn is_usable(p: Vec3) -> bool {
    p.abs().cmple(Vec3::splat(LARGEST_COORDINATE)).all()
}
