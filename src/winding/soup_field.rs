//! The field of a soup: an exact integer by crossings, and a fraction of its closure (see [`super::closure`]).
use super::answers::{INSIDE, answers, least_of};
use super::boundary::BoundaryField;
use super::closure::{Closure, ClosureCounts, crossings_of_caps};
use super::curtain::{Curtain, LANES};
use super::exact::winding_of_soup;
use super::facets::Facets;
use super::gradient::edge_gradient;
use super::locate::Locator;
use super::many::Many;
use super::surface_rule::{share_of_touching, touches_inside};
use super::triangles::Triangles;
use crate::data::{BLOCK, Loader, SavedError, Saver, TriangleSoup};
use crate::math::{Aabb, Vec3, area_vector};
use crate::treecode::{Kernel, Order, Scratch, Tree, TreeConfig, direct_sums};
use std::convert::Infallible;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Arc, OnceLock};

/// Up to this many boundary edges are summed exactly whatever the tolerance: that costs less than a walk.
const FEW_EDGES: usize = 24;
/// Up to this many boundary edges, what the answers of cells leave open of inside tests of scattered points is summed at
/// once; with more, bounds of estimates are asked before.
const SUMMED_EDGES: usize = 2000;

/// The threshold of an inside test.
pub(super) const HALF: f64 = 0.5;
/// Exact sums this close to the threshold are ties, which count as inside: the missing face of an open box.
pub(super) const TIE: f64 = 1e-12;

pub struct SoupField {
    pub(super) soup: Arc<TriangleSoup>,
    pub(super) closure: Arc<Closure>,
    pub(super) curtain: Curtain,
    pub(super) boundary: BoundaryField,
    /// What the fraction is summed over, and the tree over it if it is worth one.
    sources: Triangles,
    needs_tree: bool,
    tree: OnceLock<Tree<Triangles>>,
    config: TreeConfig,
    /// The same sources for many points at once, if some are loose.
    pub(super) many: Option<Many>,
    locator: OnceLock<Locator>,
    answers: OnceLock<Answers>,
    /// Of the cells, if they were saved.
    saved_answers: Vec<i8>,
    refined: AtomicUsize,
}

/// What inside tests of scattered points need beside a locator; built when the first is asked for.
struct Answers {
    /// What is known of each cell of the locator for the threshold 1/2 (see [`answers`]); empty where that is its crossings
    /// or nothing.
    of_cells: Vec<i8>,
    /// Of all caps.
    cap_area: f64,
}

/// How the fraction is summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FractionBy {
    /// Boundary edges and loose triangles, each exactly.
    Edges,
    /// The tree over caps and loose triangles.
    Tree { order: Order, beta: f64 },
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
            tree: OnceLock::new(),
            config: *config,
            many,
            soup,
            closure,
            curtain,
            sources,
            locator: OnceLock::new(),
            answers: OnceLock::new(),
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

    pub(super) fn count_refined(&self, count: usize) {
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

    /// The tree over the sources of the fraction, if it is worth one; built when it is first needed, outside of the cell
    /// that holds it, as the [`SoupField::locator`].
    fn tree(&self) -> Option<&Tree<Triangles>> {
        if self.needs_tree && self.tree.get().is_none() {
            let _ = self.tree.set(Tree::build(&self.sources, &self.config));
        }
        self.tree.get()
    }

    pub(super) fn facets(&self) -> Facets<'_> {
        Facets { soup: &self.soup, closure: &self.closure }
    }

    /// How a fraction of the given expansion is summed, or of none: exactly.
    pub fn fraction_by(&self, expansion: Option<(Order, f64)>) -> FractionBy {
        match expansion {
            Some((order, beta)) if self.needs_tree => FractionBy::Tree { order, beta },
            _ => FractionBy::Edges,
        }
    }

    /// Fractions at up to [`BLOCK`] points that lie close together, to which the crossings of the surface, for
    /// [`FractionBy::Tree`] those of the caps too, are to be added.
    pub fn fractions(&self, points: &[Vec3], by: FractionBy, results: &mut [f64], scratch: &mut Scratch) {
        if let FractionBy::Tree { order, beta } = by
            && let Some(tree) = self.tree()
        {
            tree.at_block(points, results, order, beta, scratch);
        } else {
            self.exact_fractions(points, results);
        }
    }

    pub(super) fn exact_fractions(&self, points: &[Vec3], results: &mut [f64]) {
        for (four, results) in points.chunks(LANES).zip(results.chunks_mut(LANES)) {
            let queries = std::array::from_fn(|k| four[k.min(four.len() - 1)]);
            let fractions =
                if self.curtain.edges() == 0 { [0.0; LANES] } else { self.curtain.fractions(&queries) };
            results.iter_mut().zip(fractions).for_each(|(result, fraction)| *result = fraction);
        }
        if !self.closure.loose.is_empty() {
            let loose = self.closure.caps.len()..self.sources.len();
            for (points, results) in points.chunks(BLOCK).zip(results.chunks_mut(BLOCK)) {
                results
                    .iter_mut()
                    .zip(direct_sums(&self.sources, loose.clone(), points))
                    .for_each(|(r, w)| *r += w);
            }
        }
    }

    /// Where scattered points lie. Built outside of the cell that holds it: a thread that waited for another to build could
    /// be the one whose help that other waits for.
    fn locator(&self) -> &Locator {
        if let Some(locator) = self.locator.get() {
            return locator;
        }
        // Caps span vertices of the soup.
        let _ = self.locator.set(Locator::new(self.facets(), self.soup.bounds()));
        self.locator.get().expect("it was set just now, here or by another thread")
    }

    /// Built as [`SoupField::locator`] is.
    fn answers(&self) -> &Answers {
        if let Some(answers) = self.answers.get() {
            return answers;
        }
        let is_known = self.is_closed() || !self.is_summed();
        let of_cells = if is_known {
            vec![]
        } else if self.saved_answers.len() == self.locator().cells().len() {
            self.saved_answers.clone()
        } else {
            answers(self, self.locator())
        };
        let cap_area = self.closure.caps.iter().map(|cap| area_vector(*cap).length()).sum();
        let _ = self.answers.set(Answers { of_cells, cap_area });
        self.answers.get().expect("it was set just now, here or by another thread")
    }

    /// The gradient of w, which is that of the boundary chain: closed components have none.
    pub fn gradient(&self, q: Vec3, by: FractionBy, scratch: &mut Scratch) -> Vec3 {
        if !q.is_finite() {
            return Vec3::NAN;
        }
        if let FractionBy::Tree { order, beta } = by
            && let Some(tree) = self.tree()
        {
            return tree.gradient(q, order, beta, scratch);
        }
        let sides = |t: &u32| {
            let [a, b, c] = self.soup.corners(*t as usize);
            edge_gradient(q, a, b) + edge_gradient(q, b, c) + edge_gradient(q, c, a)
        };
        let capped: Vec3 = self.curtain.each_edge().map(|[a, b]| edge_gradient(q, a, b)).sum();
        capped + self.closure.loose.iter().map(sides).sum::<Vec3>()
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

    /// Crossings of the surface and the caps by the ray from `q`; none if `q` lies on the surface.
    pub(super) fn crossings_at(&self, q: Vec3) -> Option<i32> {
        let locator = self.locator();
        locator.at_a_glance(q).or_else(|| {
            let location = locator.locate(self.facets(), q, true);
            location.touching.is_empty().then_some(location.crossings)
        })
    }

    /// Crossings of the caps by the ray from `q` along −x.
    pub(super) fn cap_crossings(&self, q: Vec3) -> i32 {
        crossings_of_caps(&self.closure.caps, q)
    }

    /// The winding number at up to [`BLOCK`] points.
    pub fn values(&self, points: &[Vec3], by: FractionBy, values: &mut [f64], scratch: &mut Scratch) {
        let locator = self.locator();
        if self.is_closed() {
            values.fill(0.0);
        } else {
            self.fractions(points, by, values, scratch);
        }
        let with_caps = by != FractionBy::Edges;
        for (q, value) in points.iter().zip(values) {
            if !q.is_finite() {
                *value = f64::NAN;
                continue;
            }
            if let Some(crossings) =
                locator.at_a_glance(*q).filter(|_| with_caps || self.closure.caps.is_empty())
            {
                *value += f64::from(crossings);
                continue;
            }
            let location = locator.locate(self.facets(), *q, with_caps);
            if location.touching.is_empty() {
                *value += f64::from(location.crossings);
            } else {
                *value = self.principal(*q, &location.touching);
            }
        }
    }

    /// The principal value at a point on the surface.
    pub(super) fn principal(&self, q: Vec3, touching: &[u32]) -> f64 {
        if !self.closure.loose.is_empty() || self.curtain.touches(q) {
            return winding_of_soup(&self.soup, q);
        }
        let crossings = self.locator().locate(self.facets(), q, false).crossings;
        f64::from(crossings) + self.curtain.fraction(q) - share_of_touching(q, &self.corners(touching))
    }

    fn corners(&self, facets: &[u32]) -> Vec<[Vec3; 3]> {
        facets.iter().map(|t| self.soup.corners(*t as usize)).collect()
    }

    /// Whether a point on the surface counts as inside: a region that touches it is.
    pub(super) fn touches_inside(&self, q: Vec3, threshold: f64) -> bool {
        let location = self.locator().locate(self.facets(), q, true);
        let principal = self.principal(q, &location.touching);
        touches_inside(q, &self.corners(&location.touching), principal, threshold)
    }

    /// [`SoupField::touches_inside`] without the fraction, of a soup without loose components; beside the point, `least` is
    /// the least number of crossings, of surface and caps, that is inside.
    pub(super) fn is_inside_on_surface(&self, q: Vec3, least: i32, threshold: f64) -> bool {
        let location = self.locator().locate(self.facets(), q, true);
        let corners = self.corners(&location.touching);
        let principal = if self.curtain.touches(q) {
            winding_of_soup(&self.soup, q)
        } else {
            // As good as the fraction itself: with this one, too, `least` crossings and no fewer reach the threshold.
            let fraction = threshold - f64::from(least);
            f64::from(location.crossings) + fraction - share_of_touching(q, &corners)
        };
        touches_inside(q, &corners, principal, threshold)
    }

    /// The principal value at a sample on the surface.
    pub(super) fn principal_at(&self, q: Vec3) -> f64 {
        self.principal(q, &self.locator().locate(self.facets(), q, true).touching)
    }

    /// Whether w ≥ `threshold`: by crossings alone where the fraction does not matter, elsewhere by sums; where it is not
    /// `exactly` that is asked, by estimates of these that may be wrong next to the threshold.
    pub fn classify(
        &self,
        points: &[Vec3],
        threshold: f64,
        exactly: bool,
        results: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let answers = self.answers();
        let mut open = Vec::new();
        self.glance(answers, points, threshold, results, &mut open);
        open.retain(|k| {
            let decided = self.by_crossings(answers, points[*k], threshold);
            results[*k] = decided.unwrap_or(false);
            decided.is_none()
        });
        for some in open.chunks(BLOCK) {
            let queries: Vec<Vec3> = some.iter().map(|k| points[*k]).collect();
            let mut inside = [false; BLOCK];
            self.classify_by_sums(&queries, threshold, exactly, &mut inside, scratch);
            some.iter().zip(inside).for_each(|(k, inside)| results[*k] = inside);
        }
    }

    /// Whether w ≥ `threshold` at up to [`BLOCK`] points beside the surface: by bounds of estimates, at last exactly.
    fn classify_by_sums(
        &self,
        points: &[Vec3],
        threshold: f64,
        exactly: bool,
        results: &mut [bool],
        scratch: &mut Scratch,
    ) {
        let mut open: Vec<usize> = (0..points.len()).collect();
        if let Some(tree) = self.tree().filter(|_| !self.is_summed()) {
            open.retain(|k| {
                let crossings = self.crossings_at(points[*k]).unwrap_or(0);
                let reaches = tree.reaches(points[*k], threshold - f64::from(crossings), scratch);
                results[*k] = reaches.threshold;
                exactly && !reaches.is_proven
            });
        }
        self.count_refined(open.len());
        let mut values = [0.0; BLOCK];
        let exact: Vec<Vec3> = open.iter().map(|k| points[*k]).collect();
        self.values(&exact, FractionBy::Edges, &mut values[..exact.len()], scratch);
        open.iter().zip(values).for_each(|(k, w)| results[*k] = w >= threshold - TIE);
    }

    /// Decides what can be told from the cells of the points alone; gives the others by number.
    fn glance(
        &self,
        answers: &Answers,
        points: &[Vec3],
        threshold: f64,
        results: &mut [bool],
        open: &mut Vec<usize>,
    ) {
        let is_known = threshold.abs() < 100.0 && self.is_closed();
        let (table, outside, least) = if is_known {
            // Where a negative integer is inside, so is all of space: points that are not finite are looked at singly.
            let least = threshold.ceil() as i8;
            (self.locator().cells(), if least > 0 { 0 } else { i8::MIN }, least)
        } else if threshold == HALF && !answers.of_cells.is_empty() {
            (&answers.of_cells[..], i8::MIN, INSIDE)
        } else {
            open.extend(0..points.len());
            return;
        };
        self.locator().glance(points, (table, outside), least, results, |k| open.push(k));
    }

    /// Decides without the fraction, where that can be.
    fn by_crossings(&self, answers: &Answers, q: Vec3, threshold: f64) -> Option<bool> {
        if !q.is_finite() {
            return Some(false);
        }
        // So far away the caps span too small a solid angle for w to reach the threshold from 0.
        let reach = 4.0 * PI * threshold.abs() * self.locator().distance_squared(q);
        if self.closure.loose.is_empty() && reach > answers.cap_area * (1.0 + 1e-9) {
            return Some(threshold < 0.0);
        }
        let least = if self.is_closed() {
            Some(threshold.ceil().clamp(-1e9, 1e9) as i32)
        } else if threshold == HALF && !answers.of_cells.is_empty() {
            self.locator().cell(q).and_then(|cell| least_of(answers.of_cells[cell]))
        } else {
            None
        };
        if let Some(crossings) = self.locator().at_a_glance(q) {
            return least.map(|least| crossings >= least); // near no triangle
        }
        let location = self.locator().locate(self.facets(), q, true);
        if !location.touching.is_empty() {
            let principal = self.principal(q, &location.touching);
            return Some(touches_inside(q, &self.corners(&location.touching), principal, threshold));
        }
        least.map(|least| location.crossings >= least)
    }
}
