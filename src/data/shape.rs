use super::{OrientedCloud, TriangleSoup};
use crate::math::Aabb;
use std::sync::Arc;

/// Geometry that has a winding field.
#[derive(Clone, Debug)]
pub enum Shape {
    Soup(Arc<TriangleSoup>),
    Cloud(Arc<OrientedCloud>),
}

impl Shape {
    /// The smallest box around all triangles or points.
    pub fn bounds(&self) -> Aabb {
        match self {
            Shape::Soup(soup) => soup.bounds(),
            Shape::Cloud(cloud) => cloud.bounds(),
        }
    }

    /// Number of triangles or points.
    pub fn len(&self) -> usize {
        match self {
            Shape::Soup(soup) => soup.len(),
            Shape::Cloud(cloud) => cloud.len(),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl From<TriangleSoup> for Shape {
    fn from(soup: TriangleSoup) -> Self {
        Shape::Soup(Arc::new(soup))
    }
}

impl From<OrientedCloud> for Shape {
    fn from(cloud: OrientedCloud) -> Self {
        Shape::Cloud(Arc::new(cloud))
    }
}

impl From<Arc<TriangleSoup>> for Shape {
    fn from(soup: Arc<TriangleSoup>) -> Self {
        Shape::Soup(soup)
    }
}

impl From<Arc<OrientedCloud>> for Shape {
    fn from(cloud: Arc<OrientedCloud>) -> Self {
        Shape::Cloud(cloud)
    }
}
