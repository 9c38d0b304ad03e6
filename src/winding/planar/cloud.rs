use crate::math::Vec2;

/// Points of a curve in a plane, each with a unit normal, outward, and the length of curve that it stands for.
///
/// Guarantees: as many normals and lengths as points; all finite, lengths not negative, normals of length 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlanarCloud {
    points: Vec<Vec2>,
    normals: Vec<Vec2>,
    lengths: Vec<f64>,
}

/// Why arrays do not make a cloud of a plane.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanarError {
    #[error("there are {found} {what} for {points} points: one for each point is needed")]
    CountMismatch { what: &'static str, found: usize, points: usize },
    #[error("point {point} is not finite: both coordinates must be finite numbers")]
    NonFinitePoint { point: usize },
    #[error("the normal of point {point} is zero or not finite")]
    BadNormal { point: usize },
    #[error("the length of point {point} is {length}: lengths must be finite and not negative")]
    BadLength { point: usize, length: f64 },
}

impl PlanarCloud {
    /// Makes a cloud of points, normals of any length but zero, and lengths in millimetres.
    ///
    /// # Errors
    /// If and only if normals or lengths are not as many as the points, a point is not finite, a normal is zero or not
    /// finite, or a length is negative or not finite. The first such point is named.
    pub fn new(points: Vec<Vec2>, normals: Vec<Vec2>, lengths: Vec<f64>) -> Result<PlanarCloud, PlanarError> {
        for (what, found) in [("normals", normals.len()), ("lengths", lengths.len())] {
            if found != points.len() {
                return Err(PlanarError::CountMismatch { what, found, points: points.len() });
            }
        }
        if let Some(point) = points.iter().position(|p| !p.is_finite()) {
            return Err(PlanarError::NonFinitePoint { point });
        }
        let unit =
            |(point, normal): (usize, Vec2)| normal.try_normalize().ok_or(PlanarError::BadNormal { point });
        let normals = normals.into_iter().enumerate().map(unit).collect::<Result<_, _>>()?;
        if let Some(point) = lengths.iter().position(|l| !(l.is_finite() && *l >= 0.0)) {
            return Err(PlanarError::BadLength { point, length: lengths[point] });
        }
        Ok(PlanarCloud { points, normals, lengths })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Unit normals.
    pub fn normals(&self) -> &[Vec2] {
        &self.normals
    }

    /// Lengths in millimetres.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }
}
