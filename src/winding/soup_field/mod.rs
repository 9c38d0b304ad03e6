//! The field of a soup: an exact integer by crossings, and a fraction of its closure (see [`super::closure`]).
mod answers;
mod boxes;
mod inside;
mod lattice;
mod loose;
mod values;

use super::boundary::BoundaryField;
use super::closure::{Closure, ClosureCounts};
use super::curtain::Curtain;
use super::facets::Facets;
use super::locate::Locator;
use super::many::Many;
use super::triangles::Triangles;
use crate::data::{Lazy, Loader, SavedError, Saver, TriangleSoup};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Tree, TreeConfig};
use inside::Answers;
use std::convert::Infallible;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
pub use values::FractionBy;

/// Up to this many boundary edges are summed exactly whatever the tolerance: that costs less than a walk.
const FEW_EDGES: usize = 24;
/// Up to this many boundary edges, what the answers of cells leave open of inside tests of scattered points is summed at
/// once; with more, bounds of estimates are asked before.
const SUMMED_EDGES: usize = 2000;

/// Exact sums this close to the threshold are ties, which count as inside: the missing face of an open box.
const TIE: f64 = 1e-12;

pub struct SoupField {
    soup: Arc<TriangleSoup>,
    pub(super) closure: Arc<Closure>,
    curtain: Curtain,
    boundary: BoundaryField,
    /// What the fraction is summed over, and the tree over it if it is worth one.
    sources: Triangles,
    needs_tree: bool,
    tree: Lazy<Tree<Triangles>>,
    config: TreeConfig,
    /// The same sources for many points at once, if some are loose.
    pub(super) many: Option<Many>,
    locator: Lazy<Locator>,
    answers: Lazy<Answers>,
    /// Of the cells, if they were saved.
    saved_answers: Vec<i8>,
    refined: AtomicUsize,
}

impl SoupField {
    pub fn new(soup: Arc<TriangleSoup>, config: &TreeConfig) -> SoupField {
        let closure = Closure::of(&soup);
        let built = SoupField::with(soup, closure, config, |sources| Ok::<_, Infallible>(Many::new(sources)));
        match built {
            Ok(field) => field,
            Err(never) => match never {},
        }
    }

    /// Adds what was built to saved bytes.
    pub fn save(&self, saver: &mut Saver) {
        self.closure.save(self.curtain.cycles(), saver);
        if let Some(many) = &self.many {
            many.save(saver);
        }
        let of_cells = self.answers.get().map_or(&self.saved_answers, |answers| &answers.of_cells);
        saver.numbers(of_cells);
    }

    /// # Errors
    /// If and only if the bytes end early or hold nothing that could be of the field of this soup.
    pub fn load(
        soup: Arc<TriangleSoup>,
        config: &TreeConfig,
        loader: &mut Loader,
    ) -> Result<SoupField, SavedError> {
        let closure = Closure::load(soup.len(), loader)?;
        let mut field = SoupField::with(soup, closure, config, |sources| Many::load(sources, loader))?;
        field.saved_answers = loader.numbers("the saved answers of cells")?;
        Ok(field)
    }

    fn with<E>(
        soup: Arc<TriangleSoup>,
        mut closure: Closure,
        config: &TreeConfig,
        many: impl FnOnce(Arc<Triangles>) -> Result<Many, E>,
    ) -> Result<SoupField, E> {
        let curtain = Curtain::new(std::mem::take(&mut closure.cycles));
        let needs_tree = !closure.loose.is_empty() || curtain.edges() > FEW_EDGES;
        let closure = Arc::new(closure);
        let sources = Triangles::of_fraction(soup.clone(), closure.clone());
        let many = if closure.loose.is_empty() { None } else { Some(many(Arc::new(sources.clone()))?) };
        Ok(SoupField {
            boundary: BoundaryField::new(curtain.cycles(), &closure.caps),
            needs_tree,
            tree: Lazy::new(),
            config: *config,
            many,
            soup,
            closure,
            curtain,
            sources,
            locator: Lazy::new(),
            answers: Lazy::new(),
            saved_answers: Vec::new(),
            refined: AtomicUsize::new(0),
        })
    }

    pub fn counts(&self) -> ClosureCounts {
        self.closure.counts
    }

    /// Boxes around boundary cycles, and one around all loose triangles.
    pub fn openings(&self) -> Vec<Aabb> {
        let around = |cycle: &Vec<Vec3>| Aabb::around(cycle.iter().copied());
        let loose = self.closure.loose.iter().flat_map(|t| self.soup.corners(*t as usize));
        let loose = (!self.closure.loose.is_empty()).then(|| Aabb::around(loose));
        self.curtain.cycles().iter().map(around).chain(loose).collect()
    }

    pub fn is_closed(&self) -> bool {
        self.closure.is_empty()
    }

    /// Whether the fraction takes so little time that cells have answers, and that estimates of it are not worth it.
    fn is_summed(&self) -> bool {
        self.closure.loose.is_empty() && self.curtain.edges() <= SUMMED_EDGES
    }

    /// Points whose classification needed an exact sum, since the field was built.
    pub fn refined(&self) -> usize {
        self.refined.load(Relaxed)
    }

    fn count_refined(&self, count: usize) {
        self.refined.fetch_add(count, Relaxed);
    }

    pub fn bytes(&self) -> usize {
        let locator = self.locator.get().map_or(0, Locator::bytes);
        let answers = self.answers.get().map_or(0, |a| a.of_cells.len());
        let answers = answers + self.saved_answers.len();
        let many = self.many.as_ref().map_or(0, Many::bytes);
        let tree = self.tree.get().map_or(0, Tree::bytes);
        self.closure.bytes() + self.boundary.bytes() + tree + many + locator + answers
    }

    pub fn nodes(&self) -> usize {
        self.many.as_ref().map_or(0, Many::clusters) + self.tree.get().map_or(0, Tree::nodes)
    }

    /// The tree over the sources of the fraction, if it is worth one.
    fn tree(&self) -> Option<&Tree<Triangles>> {
        let build = || Tree::build(&self.sources, &self.config);
        self.needs_tree.then(|| self.tree.get_or_build(build))
    }

    fn facets(&self) -> Facets<'_> {
        Facets { soup: &self.soup, closure: &self.closure }
    }

    /// Where scattered points lie.
    fn locator(&self) -> &Locator {
        // Caps span vertices of the soup.
        self.locator.get_or_build(|| Locator::new(self.facets(), self.soup.bounds()))
    }

    /// Builds what many scattered points need, if it is not there.
    pub fn prepare_points(&self) {
        self.locator();
        self.answers();
    }

    /// Builds what single points need, if it is not there.
    pub fn prepare_single_points(&self) {
        self.prepare_points();
        self.tree();
    }
}
