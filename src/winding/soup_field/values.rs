//! The winding number of a soup at points: crossings and fraction, on the surface the principal value; and its gradient.
use super::SoupField;
use crate::data::BLOCK;
use crate::math::Vec3;
use crate::treecode::{Kernel, Order, Scratch, direct_sums};
use crate::winding::closure::crossings_of_caps;
use crate::winding::curtain::LANES;
use crate::winding::exact::winding_of_soup;
use crate::winding::gradient::{edge_gradient, rim_gradient};
use crate::winding::surface_rule::share_of_touching;

/// How the fraction is summed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FractionBy {
    /// Boundary edges and loose triangles, each exactly.
    Edges,
    /// The tree over caps and loose triangles.
    Tree { order: Order, beta: f64 },
}

impl SoupField {
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

    /// The gradient of w, which is that of the boundary chain: closed components have none.
    pub fn gradient(&self, q: Vec3, by: FractionBy, scratch: &mut Scratch) -> Vec3 {
        if !q.is_finite() {
            return Vec3::NAN;
        }
        if let FractionBy::Tree { order, beta } = by
            && let Some(tree) = self.tree()
        {
            let gradient = tree.gradient(q, order, beta, scratch);
            // It has none next to edges of caps, of which most are no edges of the boundary chain.
            if gradient.is_finite() {
                return gradient;
            }
        }
        let rim = |t: &u32| rim_gradient(q, self.soup.corners(*t as usize));
        let capped: Vec3 = self.curtain.each_edge().map(|[a, b]| edge_gradient(q, a, b)).sum();
        capped + self.closure.loose.iter().map(rim).sum::<Vec3>()
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

    pub(super) fn corners(&self, facets: &[u32]) -> Vec<[Vec3; 3]> {
        facets.iter().map(|t| self.soup.corners(*t as usize)).collect()
    }

    /// The principal value at a sample on the surface.
    pub(super) fn principal_at(&self, q: Vec3) -> f64 {
        self.principal(q, &self.locator().locate(self.facets(), q, true).touching)
    }
}
