mod inside;
mod values;

use super::cloud_field::CloudField;
use super::config::{FieldConfig, FieldReport};
use super::many::Many;
use super::soup_field::SoupField;
use super::triangles::Triangles;
use crate::data::{Lazy, Shape};
use crate::math::Aabb;
use crate::treecode::{Tree, TreeConfig};

/// A shape that can be asked how many times a point is inside it: built once, asked many times.
///
/// ```
/// use fast_winding::{TriangleSoup, WindingField, math::Vec3, winding::Accuracy};
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
/// let soup = TriangleSoup::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let field = WindingField::new(soup, Default::default());
/// assert!((field.at(Vec3::splat(0.2), Accuracy::EXACT) - 1.0).abs() < 1e-12);
/// assert!(field.contains_point(Vec3::splat(0.2)) && !field.contains_point(Vec3::ONE));
/// # Ok::<(), fast_winding::data::SoupError>(())
/// ```
pub struct WindingField {
    shape: Shape,
    config: TreeConfig,
    engine: Engine,
    /// The paper's evaluator of a soup, built when its parameters are asked for.
    of_paper: Lazy<Tree<Triangles>>,
    bounds: Aabb,
    report: FieldReport,
}

pub(super) enum Engine {
    Soup(Box<SoupField>),
    Cloud(Box<CloudField>),
}

impl WindingField {
    /// Builds the field, in parallel, in time linear in the triangles or points; what single points need besides, when
    /// the first of them is asked for.
    pub fn new(shape: impl Into<Shape>, config: FieldConfig) -> WindingField {
        let shape = shape.into();
        let (bounded, config) = (config.bounded, TreeConfig { leaf_size: config.leaf_size });
        let engine = match &shape {
            Shape::Soup(soup) => Engine::Soup(Box::new(SoupField::new(soup.clone(), &config))),
            Shape::Cloud(cloud) => Engine::Cloud(Box::new(CloudField::new(cloud.clone(), config, bounded))),
        };
        WindingField::of_engine(shape, config, engine)
    }

    pub(super) fn of_engine(shape: Shape, config: TreeConfig, engine: Engine) -> WindingField {
        let report = report(&shape, &engine);
        WindingField { bounds: shape.bounds(), shape, config, engine, of_paper: Lazy::new(), report }
    }

    /// How it was prepared.
    pub fn config(&self) -> FieldConfig {
        let bounded = matches!(&self.engine, Engine::Cloud(cloud) if cloud.is_bounded());
        FieldConfig { leaf_size: self.config.leaf_size, bounded }
    }

    pub(super) fn parts(&self) -> (&Engine, &TreeConfig) {
        (&self.engine, &self.config)
    }

    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The smallest box around the shape.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether it is the field of a soup without a boundary: w is an integer everywhere.
    pub fn is_closed(&self) -> bool {
        matches!(&self.engine, Engine::Soup(soup) if soup.is_closed())
    }

    /// Boxes around what bounds the openings of a soup: each cycle of boundary edges of the components that are capped, and all
    /// of those that are loose. None for closed soups and for clouds.
    pub fn openings(&self) -> Vec<Aabb> {
        match &self.engine {
            Engine::Soup(soup) => soup.openings(),
            Engine::Cloud(_) => Vec::new(),
        }
    }

    pub fn report(&self) -> &FieldReport {
        &self.report
    }

    /// Bytes that the field takes now, beside the shape: more than [`FieldReport::bytes`] once scattered points or the
    /// paper's evaluator were asked for.
    pub fn bytes(&self) -> usize {
        let of_paper = self.of_paper.get().map_or(0, Tree::bytes);
        of_paper
            + match &self.engine {
                Engine::Soup(soup) => soup.bytes(),
                Engine::Cloud(cloud) => cloud.bytes(),
            }
    }

    /// Points whose inside test needed an exact sum, in all tests so far.
    pub fn refined(&self) -> usize {
        match &self.engine {
            Engine::Soup(soup) => soup.refined(),
            Engine::Cloud(cloud) => cloud.refined(),
        }
    }

    /// Builds ahead of time what queries at scattered points need that are asked for one by one.
    pub fn prepare_points(&self) {
        if let Engine::Soup(soup) = &self.engine {
            soup.prepare_points();
        }
    }

    /// Builds ahead of time what single points and small batches of them need too, as tracing a level set asks for: for
    /// clouds and loose triangles the tree of Barill et al. 2018, some 220 bytes for each of them.
    pub fn prepare_single_points(&self) {
        match &self.engine {
            Engine::Soup(soup) => soup.prepare_single_points(),
            Engine::Cloud(cloud) => drop(cloud.few()),
        }
    }

    /// The paper's evaluator of a soup.
    fn of_paper(&self) -> &Tree<Triangles> {
        let Shape::Soup(soup) = &self.shape else { unreachable!("clouds have a tree of their own") };
        self.of_paper.get_or_build(|| Tree::build(&Triangles::new(soup.clone()), &self.config))
    }

    fn many(&self) -> Option<&Many> {
        match &self.engine {
            Engine::Soup(soup) => soup.many.as_ref(),
            Engine::Cloud(cloud) => Some(&cloud.many),
        }
    }
}

fn report(shape: &Shape, engine: &Engine) -> FieldReport {
    match engine {
        Engine::Cloud(cloud) => FieldReport {
            method: match cloud.is_bounded() {
                true => "fast bounded winding number of points",
                false => "fast winding number of points",
            },
            elements: shape.len(),
            nodes: cloud.many.clusters(),
            bytes: cloud.bytes(),
            ..FieldReport::default()
        },
        Engine::Soup(soup) => {
            let counts = soup.counts();
            let method = match (soup.is_closed(), counts.loose_components > 0, counts.capped_components > 0) {
                (true, ..) => "crossings: every component is closed",
                (_, false, _) => "crossings, and the field of caps over the openings",
                (_, true, false) => "solid angles: every open component has too many openings to be capped",
                (_, true, true) => "crossings and caps, and solid angles of components with many openings",
            };
            FieldReport {
                method,
                elements: shape.len(),
                boundary_edges: counts.boundary_edges,
                caps: soup.closure.caps.len(),
                capped_components: counts.capped_components,
                loose_components: counts.loose_components,
                nodes: soup.nodes(),
                bytes: soup.bytes(),
            }
        }
    }
}
