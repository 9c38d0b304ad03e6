//! Clusters to bytes and back.
use super::Sources;
use super::clusters::{Ball, Clusters, Series, extents};
use super::moments::COEFFICIENTS;
use crate::data::{Loader, SavedError, Saver};
use crate::math::Aabb;
use crate::treecode::frame::Frame;
use crate::treecode::links::{Link, checked_spans};

/// Numbers of a cluster: its ball, its area and spreads, its factors.
const NUMBERS: usize = 7 + COEFFICIENTS;

impl Clusters {
    pub fn save(&self, saver: &mut Saver) {
        saver.numbers(&self.items);
        saver.number(self.roots.len() as u64);
        let links: Vec<[u32; 2]> = self.links.iter().map(Link::parts).collect();
        saver.groups(&links);
        let numbers = |(ball, series): (&Ball, &Series)| {
            let mut all = [0.0; NUMBERS];
            all[..4].copy_from_slice(ball);
            all[4] = series.area;
            all[5..7].copy_from_slice(&series.spread);
            all[7..].copy_from_slice(&series.factors);
            all
        };
        let numbers: Vec<[f32; NUMBERS]> = self.balls.iter().zip(&self.series).map(numbers).collect();
        saver.groups(&numbers);
    }

    /// # Errors
    /// If and only if the bytes end early, or what they hold is no tree over `sources` with at most `leaf_size` of them in
    /// a leaf, and finite numbers.
    pub fn load(
        sources: &dyn Sources,
        leaf_size: usize,
        loader: &mut Loader,
    ) -> Result<Clusters, SavedError> {
        let inconsistent = || SavedError::Inconsistent("the saved clusters are no tree over the saved shape");
        let items: Vec<u32> = loader.numbers("the saved items of clusters")?;
        let roots = loader.count("the saved roots of clusters")?;
        let parts: Vec<[u32; 2]> = loader.groups("the saved links of clusters")?;
        let numbers: Vec<[f32; NUMBERS]> = loader.groups("the saved series of clusters")?;
        let links: Vec<Link> =
            parts.into_iter().map(Link::of_parts).collect::<Option<_>>().ok_or_else(inconsistent)?;
        let mut is_there = vec![false; sources.len()];
        for item in &items {
            *is_there.get_mut(*item as usize).ok_or_else(inconsistent)? = true;
        }
        let is_whole = items.len() == sources.len() && !is_there.contains(&false);
        // Radii, areas and spreads are no less than 0.
        let is_good =
            |n: &[f32; NUMBERS]| n.iter().all(|x| x.is_finite()) && n[3..7].iter().all(|x| *x >= 0.0);
        let is_small = |link: &Link| !link.is_leaf() || link.range().len() <= leaf_size;
        if !is_whole
            || !links.iter().all(is_small)
            || numbers.len() != links.len()
            || !numbers.iter().all(is_good)
        {
            return Err(inconsistent());
        }
        let spans = checked_spans(&links, roots, items.len()).ok_or_else(inconsistent)?;
        let balls = numbers.iter().map(|n| [n[0], n[1], n[2], n[3]]).collect();
        let series = numbers
            .iter()
            .map(|n| Series { area: n[4], spread: [n[5], n[6]], factors: std::array::from_fn(|k| n[7 + k]) })
            .collect();
        let bounds = Aabb::around((0..sources.len()).flat_map(|i| sources.corners(i)));
        let frame = Frame::around(&bounds);
        let extents = extents(sources, &spans, &items, frame.scale);
        Ok(Clusters { balls, links, series, extents, roots: 0..roots, items, frame })
    }
}
