use super::{LARGEST_COORDINATE, Warning, WarningKind, is_usable};
use crate::math::{Aabb, Vec3};

/// Points, perhaps with normals and areas, as a scanner or a file gives them.
///
/// Guarantees: no coordinate is beyond [`LARGEST_COORDINATE`]; normals and areas, where present, are as many as the points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointCloud {
    points: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
    areas: Option<Vec<f64>>,
}

/// Why arrays do not make a cloud.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CloudError {
    #[error("there are {found} {what} for {points} points: one for each point is needed")]
    LengthMismatch { what: &'static str, found: usize, points: usize },
    #[error(
        "point {point} is not finite, or too far away: every coordinate must be a number from −{LARGEST_COORDINATE:e} to {LARGEST_COORDINATE:e}"
    )]
    NonFinitePoint { point: usize },
    #[error("the normal of point {point} is zero or not finite")]
    BadNormal { point: usize },
    #[error("the area of point {point} is {area}: areas must be finite and not negative")]
    BadArea { point: usize, area: f64 },
}

fn check_length(what: &'static str, found: usize, points: usize) -> Result<(), CloudError> {
    if found == points { Ok(()) } else { Err(CloudError::LengthMismatch { what, found, points }) }
}

fn check_areas(areas: &[f64]) -> Result<(), CloudError> {
    match areas.iter().position(|a| !(a.is_finite() && *a >= 0.0)) {
        Some(point) => Err(CloudError::BadArea { point, area: areas[point] }),
        None => Ok(()),
    }
}

/// In place: a raw scan can fill half the memory there is.
fn keep<T>(mut values: Vec<T>, kept: &[bool]) -> Vec<T> {
    let mut kept = kept.iter();
    values.retain(|_| *kept.next().expect("there is a flag for each value"));
    values
}

impl PointCloud {
    /// Makes a cloud of what is usable: points that are not finite, or too far away, are dropped and counted; when any of the
    /// normals is zero or not finite, its point is dropped and counted too.
    ///
    /// # Errors
    /// If and only if normals or areas are not as many as the points, or an area is negative or not finite.
    pub fn cleaned(
        points: Vec<Vec3>,
        normals: Option<Vec<Vec3>>,
        areas: Option<Vec<f64>>,
    ) -> Result<(PointCloud, Vec<Warning>), CloudError> {
        if let Some(normals) = &normals {
            check_length("normals", normals.len(), points.len())?;
        }
        if let Some(areas) = &areas {
            check_length("areas", areas.len(), points.len())?;
            check_areas(areas)?;
        }
        let finite: Vec<bool> = points.iter().map(|p| is_usable(*p)).collect();
        let oriented = |i: usize| normals.as_ref().is_none_or(|n| n[i].try_normalize().is_some());
        let kept: Vec<bool> = (0..points.len()).map(|i| finite[i] && oriented(i)).collect();
        let lost_points = finite.iter().filter(|f| !**f).count();
        let lost_normals = kept.iter().filter(|k| !**k).count() - lost_points;
        let counts = [(WarningKind::NonFinitePoints, lost_points), (WarningKind::BadNormals, lost_normals)];
        let warnings = Warning::counted(counts);
        let cloud = PointCloud {
            points: keep(points, &kept),
            normals: normals.map(|n| keep(n, &kept).into_iter().map(Vec3::normalize).collect()),
            areas: areas.map(|a| keep(a, &kept)),
        };
        Ok((cloud, warnings))
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Unit normals, one for each point, if the cloud came with them.
    pub fn normals(&self) -> Option<&[Vec3]> {
        self.normals.as_deref()
    }

    /// Areas in square millimetres, one for each point, if the cloud came with them.
    pub fn areas(&self) -> Option<&[f64]> {
        self.areas.as_deref()
    }

    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.points.iter().copied())
    }
}

/// A cloud whose every point has a unit normal and an area: a discrete surface, which has a winding field
/// (Barill et al. 2018, eq. 5).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OrientedCloud {
    points: Vec<Vec3>,
    normals: Vec<Vec3>,
    areas: Vec<f64>,
}

impl OrientedCloud {
    /// Makes an oriented cloud; normals point outward and are scaled to length 1, areas are in square millimetres.
    ///
    /// # Errors
    /// If and only if the lengths differ, a point has a coordinate that is not finite or beyond
    /// [`LARGEST_COORDINATE`], a normal is zero or not finite, or an area is
    /// negative or not finite.
    pub fn new(points: Vec<Vec3>, normals: Vec<Vec3>, areas: Vec<f64>) -> Result<OrientedCloud, CloudError> {
        OrientedCloud::checked(points, normals, areas, Vec3::try_normalize)
    }

    /// As [`OrientedCloud::new`] of normals that have length 1 already, to rounding: they keep their bits.
    ///
    /// # Errors
    /// As there, or if and only if a normal is not of length 1.
    pub(crate) fn of_unit_normals(
        points: Vec<Vec3>,
        normals: Vec<Vec3>,
        areas: Vec<f64>,
    ) -> Result<OrientedCloud, CloudError> {
        let is_unit = |n: Vec3| (n.length_squared() - 1.0).abs() < 1e-9;
        OrientedCloud::checked(points, normals, areas, |n| is_unit(n).then_some(n))
    }

    /// With what `unit` makes of each normal, if it is one.
    fn checked(
        points: Vec<Vec3>,
        mut normals: Vec<Vec3>,
        areas: Vec<f64>,
        unit: impl Fn(Vec3) -> Option<Vec3>,
    ) -> Result<OrientedCloud, CloudError> {
        check_length("normals", normals.len(), points.len())?;
        check_length("areas", areas.len(), points.len())?;
        if let Some(point) = points.iter().position(|p| !is_usable(*p)) {
            return Err(CloudError::NonFinitePoint { point });
        }
        for (point, normal) in normals.iter_mut().enumerate() {
            *normal = unit(*normal).ok_or(CloudError::BadNormal { point })?;
        }
        check_areas(&areas)?;
        Ok(OrientedCloud { points, normals, areas })
    }

    /// Number of points.
    #[inline]
    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    #[inline]
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Unit normals.
    #[inline]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Areas in square millimetres.
    #[inline]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.points.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unusable_points_are_dropped_and_counted() {
        let points = vec![Vec3::ZERO, Vec3::NAN, Vec3::ONE];
        let normals = vec![Vec3::X * 3.0, Vec3::X, Vec3::ZERO];
        let (cloud, warnings) = PointCloud::cleaned(points, Some(normals), None).unwrap();
        assert_eq!((cloud.points(), cloud.normals().unwrap()), (&[Vec3::ZERO][..], &[Vec3::X][..]));
        let counts: Vec<_> = warnings.iter().map(|w| (w.kind, w.count)).collect();
        assert_eq!(counts, [(WarningKind::NonFinitePoints, 1), (WarningKind::BadNormals, 1)]);
    }
}
