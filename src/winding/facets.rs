use super::closure::Closure;
use crate::data::TriangleSoup;
use crate::math::Vec3;

/// What a triangle is to the integer part of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Counts where a ray crosses it.
    Surface,
    /// Its solid angle is summed: no crossing, but a query may lie on it.
    Loose,
    /// Counts where a ray crosses it, but is no part of the surface.
    Cap,
}

/// The triangles of a soup and behind them those of its closure, by number.
#[derive(Clone, Copy)]
pub struct Facets<'a> {
    pub soup: &'a TriangleSoup,
    pub closure: &'a Closure,
}

impl Facets<'_> {
    /// Number of triangles of the soup and its closure.
    pub fn len(&self) -> usize {
        self.soup.len() + self.closure.caps.len()
    }

    pub fn role(&self, facet: usize) -> Role {
        if facet >= self.soup.len() {
            Role::Cap
        } else if !self.closure.is_loose.is_empty() && self.closure.is_loose[facet] {
            Role::Loose
        } else {
            Role::Surface
        }
    }

    /// Corners, oriented so that the soup and its caps together are closed.
    pub fn corners(&self, facet: usize) -> [Vec3; 3] {
        match facet.checked_sub(self.soup.len()) {
            None => self.soup.corners(facet),
            Some(cap) => {
                let [a, b, c] = self.closure.caps[cap];
                [a, c, b]
            }
        }
    }
}
