use crate::math::Vec2;

/// A closed polygon without its first point repeated.
pub type Ring = Vec<Vec2>;

/// An outer ring, counter-clockwise seen from +z, and the holes in it, clockwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polygon {
    pub outer: Ring,
    pub holes: Vec<Ring>,
}

impl Polygon {
    /// The outer ring, then the holes.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> + Clone {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    /// Area in square millimetres, holes taken off.
    pub fn area(&self) -> f64 {
        signed_area(&self.outer) + self.holes.iter().map(|hole| signed_area(hole)).sum::<f64>()
    }
}

/// One slice of a solid: the polygons of {w ≥ 1/2} in the plane z = `z_sample`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    pub z_bottom: f64,
    /// Where a printer's nozzle lays this layer.
    pub z_top: f64,
    /// Where the field was asked.
    pub z_sample: f64,
    pub polygons: Vec<Polygon>,
}

impl Layer {
    /// Area in square millimetres.
    pub fn area(&self) -> f64 {
        self.polygons.iter().map(Polygon::area).sum()
    }
}

/// The sides of a ring, each from its first end to its second; the last one leads back to the start.
pub fn sides(ring: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

/// Area of a ring: positive when it runs counter-clockwise.
pub fn signed_area(ring: &[Vec2]) -> f64 {
    let Some(&anchor) = ring.first() else { return 0.0 };
    // Relative to the first point: no cancellation far from the origin.
    0.5 * ring.windows(2).map(|e| (e[0] - anchor).perp_dot(e[1] - anchor)).sum::<f64>()
}
