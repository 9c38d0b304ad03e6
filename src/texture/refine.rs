//! Soups whose triangles run through each other, split there (Schier et al. 2018, section 12.1): the pieces of a triangle that is cut
//! belong to different parts of the proxy.
use crate::arrangement::{Pairs, arrange};
use crate::data::{Cancelled, Monitor, TriangleSoup, Warning, WarningKind};
use crate::winding::weld;

/// A soup whose triangles meet only in whole edges and vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Refined {
    pub soup: TriangleSoup,
    /// The triangle that each of them is a part of.
    pub sources: Vec<u32>,
    pub warnings: Vec<Warning>,
}

/// Splits the triangles of a soup along each other.
///
/// # Errors
/// If and only if the monitor cancels.
pub fn refined(soup: &TriangleSoup, monitor: &dyn Monitor) -> Result<Refined, Cancelled> {
    let welded = weld(soup.positions());
    let triangles: Vec<[u32; 3]> = soup.triangles().iter().map(|t| t.map(|v| welded[v as usize])).collect();
    let cut = arrange(soup.positions().to_vec(), &triangles, Pairs::All, monitor)?;
    let (soup, mut warnings) = TriangleSoup::cleaned(cut.positions, cut.pieces);
    if cut.unresolved > 0 {
        warnings.push(Warning::new(WarningKind::CrossingFaces, cut.unresolved));
    }
    Ok(Refined { soup, sources: cut.sources, warnings })
}
