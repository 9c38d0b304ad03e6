//! Which triangles did not simply go where their lines meet the proxy, by number: for a list, or a picture of them.
use super::correct::{Outcome, Placed};
use crate::data::{Cancelled, Monitor, TriangleSoup, fill_in_blocks};
use crate::texture::{Anchors, MappingReport, SoupLines};
use crate::winding::{FieldConfig, WindingField};

/// Triangles of the textured soup, each list ascending.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Affected {
    /// Their corners meet different charts.
    pub across: Vec<u32>,
    /// Of those, put into one chart by the closest points of it.
    pub moved: Vec<u32>,
    /// Flipped or flat where their lines meet one chart; put into the one in front of them, if they lie well there.
    pub folded: Vec<u32>,
    /// More than 8 times as long as wide, against what they are in space, or as large or small, where their lines meet one chart; put into
    /// the one in front of them likewise.
    pub squashed: Vec<u32>,
    /// Laid into a chart as they are in space.
    pub unfolded: Vec<u32>,
    /// Flipped or flat at last.
    pub flipped: Vec<u32>,
    /// [`MappingReport::TORN`] times as large or as small as they should be at last.
    pub torn: Vec<u32>,
    /// With a corner whose line meets no proxy.
    pub lost: Vec<u32>,
    /// With a corner whose line was replaced, as it ran along the surface.
    pub tangential: Vec<u32>,
    /// In narrow places that the lines do not lead out of well: the field is weaker than [`MappingReport::WEAK`] of its median at a corner
    /// that is not inside of the shape, and a line is lost, or where they meet the proxy the triangle was folded, squashed or torn.
    pub weak: Vec<u32>,
}

impl Affected {
    /// # Errors
    /// If and only if the monitor cancels.
    pub(super) fn new(
        soup: &TriangleSoup,
        lines: &SoupLines,
        anchors: &Anchors,
        scale: f64,
        placed: &[Placed],
        monitor: &dyn Monitor,
    ) -> Result<Affected, Cancelled> {
        let which = |is: &dyn Fn(usize, &Placed) -> bool| -> Vec<u32> {
            placed.iter().enumerate().filter(|(t, p)| is(*t, p)).map(|(t, _)| t as u32).collect()
        };
        let any = |t: usize, is: &dyn Fn(u32) -> bool| lines.starts.corners[t].iter().any(|s| is(*s));
        let ratio = |t: usize, p: &Placed| p.area_ratio(soup.corners(t), scale);
        let is_torn = |ratio: f64| !(1.0 / MappingReport::TORN..=MappingReport::TORN).contains(&ratio);
        let is_lost = |t: usize| any(t, &|s| anchors.is_lost[s as usize]);
        let is_weak = |s: u32| lines.strength[s as usize] < MappingReport::WEAK;
        let mut weak = which(&|t, p| {
            any(t, &is_weak)
                && (is_lost(t) || p.outcome == Outcome::Unfolded || ratio(t, p).is_some_and(is_torn))
        });
        let candidates: Vec<u32> =
            weak.iter().flat_map(|t| lines.starts.corners[*t as usize]).filter(|s| is_weak(*s)).collect();
        let buried = buried(soup, lines, candidates, monitor)?;
        weak.retain(|t| any(*t as usize, &|s| is_weak(s) && buried.binary_search(&s).is_err()));
        Ok(Affected {
            across: which(&|_, p| p.is_across),
            moved: which(&|_, p| p.is_across && p.outcome == Outcome::Moved),
            folded: which(&|_, p| p.is_folded),
            squashed: which(&|_, p| p.is_squashed),
            unfolded: which(&|_, p| p.outcome == Outcome::Unfolded),
            flipped: which(&|t, p| p.is_flat(soup.corners(t), scale)),
            torn: which(&|t, p| ratio(t, p).is_some_and(is_torn)),
            lost: which(&|t, _| is_lost(t)),
            tangential: which(&|t, _| any(t, &|s| anchors.tangential.binary_search(&s).is_ok())),
            weak,
        })
    }
}

impl Affected {
    /// How many triangles have a texture that breaks off from that of their neighbours, or is no good itself.
    pub fn bad(&self) -> usize {
        let mut all = [&self.unfolded[..], &self.flipped, &self.torn].concat();
        all.sort_unstable();
        all.dedup();
        all.len()
    }
}

/// Those of some starts around which the shape is, as of parts that lie within others; ascending.
fn buried(
    soup: &TriangleSoup,
    lines: &SoupLines,
    mut starts: Vec<u32>,
    monitor: &dyn Monitor,
) -> Result<Vec<u32>, Cancelled> {
    starts.sort_unstable();
    starts.dedup();
    if starts.is_empty() {
        return Ok(starts);
    }
    let field = WindingField::new(soup.clone(), FieldConfig::default());
    let mut is_inside = vec![false; starts.len()];
    let inside = |k: usize, _: &mut ()| field.contains_point(lines.starts.beside(starts[k], soup));
    fill_in_blocks(&mut is_inside, inside, "texture", monitor)?;
    Ok(starts.into_iter().zip(is_inside).filter(|(_, inside)| *inside).map(|(start, _)| start).collect())
}
