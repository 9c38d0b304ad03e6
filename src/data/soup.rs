use super::{LARGEST_COORDINATE, Warning, WarningKind, is_usable};
use crate::math::{Aabb, Vec3};

/// Triangles without any promise about how they fit together: holes, flips, duplicates and
/// self-intersections are all allowed.
///
/// Guarantees: every index names a vertex, and every vertex that a triangle uses is finite. Of soups that are given, no coordinate of
/// these is beyond [`LARGEST_COORDINATE`]; what is made of them may reach a little farther.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleSoup {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

/// Why positions and triangles do not make a [`TriangleSoup`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SoupError {
    #[error("triangle {triangle} names vertex {index}, but there are only {vertices} vertices (0 to {max})", max = vertices.saturating_sub(1))]
    IndexOutOfRange { triangle: usize, index: u32, vertices: usize },
    #[error(
        "vertex {vertex} is not finite, or too far away: every coordinate must be a number from −{LARGEST_COORDINATE:e} to {LARGEST_COORDINATE:e}"
    )]
    NonFiniteVertex { vertex: usize },
    #[error("{0} vertices are too many: at most 4,294,967,295 can be indexed")]
    TooManyVertices(usize),
}

impl TriangleSoup {
    /// Makes a soup of `positions` (millimetres) and `triangles` (three vertex indices each, counter-clockwise
    /// seen from outside).
    ///
    /// # Errors
    /// If and only if an index names no vertex, or a triangle uses a vertex with a coordinate that is not finite or beyond
    /// [`LARGEST_COORDINATE`].
    pub fn new(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<TriangleSoup, SoupError> {
        check_indices(&positions, &triangles)?;
        match first_not(is_usable, &positions, &triangles) {
            Some(vertex) => Err(SoupError::NonFiniteVertex { vertex }),
            None => Ok(TriangleSoup { positions, triangles }),
        }
    }

    /// As [`TriangleSoup::new`] of vertices that were made of those of a shape, and may lie around it.
    ///
    /// # Errors
    /// If and only if an index names no vertex, or a triangle uses a vertex that is not finite.
    pub(crate) fn derived(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<TriangleSoup, SoupError> {
        check_indices(&positions, &triangles)?;
        match first_not(Vec3::is_finite, &positions, &triangles) {
            Some(vertex) => Err(SoupError::NonFiniteVertex { vertex }),
            None => Ok(TriangleSoup { positions, triangles }),
        }
    }

    /// Makes a soup of arrays that a program hands over: a wrong index is its mistake, but triangles with a vertex that
    /// is not finite, or too far away, are dropped and counted in the warnings.
    ///
    /// # Errors
    /// If and only if an index names no vertex, or no triangle is left of those given.
    pub fn usable(
        positions: Vec<Vec3>,
        triangles: Vec<[u32; 3]>,
    ) -> Result<(TriangleSoup, Vec<Warning>), SoupError> {
        check_indices(&positions, &triangles)?;
        let non_finite = first_not(is_usable, &positions, &triangles);
        let (soup, warnings) = TriangleSoup::cleaned(positions, triangles);
        match non_finite {
            Some(vertex) if soup.is_empty() => Err(SoupError::NonFiniteVertex { vertex }),
            _ => Ok((soup, warnings)),
        }
    }

    /// Makes a soup of what is usable: triangles with an index out of range or a vertex that is not finite, or
    /// too far away, are dropped and counted in the warnings.
    pub fn cleaned(positions: Vec<Vec3>, mut triangles: Vec<[u32; 3]>) -> (TriangleSoup, Vec<Warning>) {
        let (mut out_of_range, mut non_finite) = (0, 0);
        triangles.retain(|corners| {
            let vertices = corners.map(|i| positions.get(i as usize));
            let in_range = vertices.iter().all(|v| v.is_some());
            let finite = vertices.iter().flatten().all(|v| is_usable(**v));
            out_of_range += usize::from(!in_range);
            non_finite += usize::from(in_range && !finite);
            in_range && finite
        });
        let counts =
            [(WarningKind::IndexOutOfRange, out_of_range), (WarningKind::NonFiniteFaces, non_finite)];
        let warnings = Warning::counted(counts);
        (TriangleSoup { positions, triangles }, warnings)
    }

    /// Number of triangles.
    pub fn len(&self) -> usize {
        self.triangles.len()
    }

    pub fn is_empty(&self) -> bool {
        self.triangles.is_empty()
    }

    /// All vertices, also those that no triangle uses.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The three corners of triangle `index`.
    #[inline]
    pub fn corners(&self, index: usize) -> [Vec3; 3] {
        let [a, b, c] = self.triangles[index];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }

    /// The smallest box around all triangles; vertices that no triangle uses do not count.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.triangles.iter().flatten().map(|&i| self.positions[i as usize]))
    }
}

fn check_indices(positions: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), SoupError> {
    let vertices = positions.len();
    if vertices > u32::MAX as usize {
        return Err(SoupError::TooManyVertices(vertices));
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|index| **index as usize >= vertices) {
            return Err(SoupError::IndexOutOfRange { triangle, index, vertices });
        }
    }
    Ok(())
}

/// The first vertex that a triangle uses and that is not as it has to be; the indices are in range.
fn first_not(is_good: impl Fn(Vec3) -> bool, positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<usize> {
    triangles.iter().flatten().map(|index| *index as usize).find(|index| !is_good(positions[*index]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_faces_are_dropped_and_counted() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(f64::NAN)];
        let faces = vec![[0, 1, 2], [0, 1, 3], [0, 1, 9], [3, 9, 9]];
        let (soup, warnings) = TriangleSoup::cleaned(positions.clone(), faces);
        assert_eq!(soup.len(), 1);
        let counts: Vec<_> = warnings.iter().map(|w| (w.kind, w.count)).collect();
        assert_eq!(counts, [(WarningKind::IndexOutOfRange, 2), (WarningKind::NonFiniteFaces, 1)]);
        assert_eq!(
            TriangleSoup::new(positions.clone(), vec![[0, 1, 2], [0, 7, 2]]),
            Err(SoupError::IndexOutOfRange { triangle: 1, index: 7, vertices: 4 })
        );
        assert_eq!(
            TriangleSoup::new(positions, vec![[0, 3, 2]]),
            Err(SoupError::NonFiniteVertex { vertex: 3 })
        );
    }

    #[test]
    fn arrays_may_hold_a_few_vertices_that_are_not_finite() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::INFINITY];
        let (soup, warnings) = TriangleSoup::usable(positions.clone(), vec![[0, 1, 2], [0, 1, 3]]).unwrap();
        assert_eq!((soup.len(), warnings), (1, vec![Warning::new(WarningKind::NonFiniteFaces, 1)]));
        let none_left = TriangleSoup::usable(positions.clone(), vec![[0, 1, 3]]);
        assert_eq!(none_left, Err(SoupError::NonFiniteVertex { vertex: 3 }));
        let wrong_index = TriangleSoup::usable(positions, vec![[0, 1, 2], [4, 1, 3]]);
        assert_eq!(wrong_index, Err(SoupError::IndexOutOfRange { triangle: 1, index: 4, vertices: 4 }));
        assert!(TriangleSoup::usable(vec![], vec![]).unwrap().0.is_empty());
    }
}
