//! Both operands as triangles, cut along each other.
use super::{BooleanConfig, BooleanError, cloud};
use crate::arrangement::{Pairs, arrange};
use crate::data::{Cancelled, Monitor, Shape, SoupError, TriangleSoup};
use crate::math::Vec3;
use crate::winding::{WindingField, weld};
use rustc_hash::FxHashSet;

/// A field of triangles: that given, or of the surface traced for a cloud.
pub enum Operand<'a> {
    Given(&'a WindingField),
    Traced(Box<WindingField>),
}

impl<'a> Operand<'a> {
    pub fn new(
        field: &'a WindingField,
        config: &BooleanConfig,
        monitor: &dyn Monitor,
    ) -> Result<Operand<'a>, BooleanError> {
        match field.shape() {
            Shape::Soup(_) => Ok(Operand::Given(field)),
            Shape::Cloud(cloud) => {
                let surface = cloud::traced(field, cloud, config, monitor)?;
                Ok(Operand::Traced(Box::new(WindingField::new(surface, Default::default()))))
            }
        }
    }

    pub fn field(&self) -> &WindingField {
        match self {
            Operand::Given(field) => field,
            Operand::Traced(field) => field,
        }
    }

    pub fn soup(&self) -> &TriangleSoup {
        match self.field().shape() {
            Shape::Soup(soup) => soup,
            Shape::Cloud(_) => unreachable!("clouds are traced"),
        }
    }
}

/// The triangles of both operands, cut. Vertices of the first come before those of the second, new ones after both; those in one place are
/// all named by the lowest.
pub struct Pieces {
    pub positions: Vec<Vec3>,
    pub corners: Vec<[u32; 3]>,
    /// The triangle each is of, those of the second operand after those of the first.
    pub sources: Vec<u32>,
    /// Triangles of the first operand.
    pub first: usize,
    /// Edges along which the surfaces meet, or a level set cuts one: the lower vertex first.
    pub seams: FxHashSet<[u32; 2]>,
    pub unresolved: usize,
    /// For each given vertex, the lowest in its place.
    pub welded: Vec<u32>,
}

impl Pieces {
    /// Cuts the triangles of each operand along the other's, or all along all.
    pub fn cut(operands: &[Operand; 2], all: bool, monitor: &dyn Monitor) -> Result<Pieces, Cancelled> {
        let [a, b] = operands.each_ref().map(|o| o.soup());
        let positions = [a.positions(), b.positions()].concat();
        let welded = weld(&positions);
        let shift = a.positions().len() as u32;
        let of_b = b.triangles().iter().map(|t| t.map(|v| v + shift));
        let triangles: Vec<[u32; 3]> =
            a.triangles().iter().copied().chain(of_b).map(|t| t.map(|v| welded[v as usize])).collect();
        let pairs = if all { Pairs::All } else { Pairs::Between(a.len()) };
        let found = arrange(positions, &triangles, pairs, monitor)?;
        Ok(Pieces {
            positions: found.positions,
            corners: found.pieces,
            sources: found.sources,
            first: a.len(),
            seams: found.seams.into_iter().collect(),
            unresolved: found.unresolved,
            welded,
        })
    }

    /// Gives the given vertices the positions that they have in `operands`.
    pub fn restore(&mut self, operands: &[Operand; 2]) {
        let given = operands.iter().flat_map(|o| o.soup().positions());
        self.positions.iter_mut().zip(given).for_each(|(position, given)| *position = *given);
    }

    /// The operand that a piece is of: 0 or 1.
    pub fn operand(&self, piece: usize) -> usize {
        usize::from(self.sources[piece] as usize >= self.first)
    }

    pub fn places(&self, piece: usize) -> [Vec3; 3] {
        self.corners[piece].map(|v| self.positions[v as usize])
    }

    /// For each vertex, whether seams or both operands are there.
    pub fn is_cut(&self) -> Vec<bool> {
        let mut users = vec![0u8; self.positions.len()];
        for (piece, corners) in self.corners.iter().enumerate() {
            corners.iter().for_each(|v| users[*v as usize] |= 1 << self.operand(piece));
        }
        let mut is_cut: Vec<bool> = users.into_iter().map(|of| of == 3).collect();
        self.seams.iter().flatten().for_each(|v| is_cut[*v as usize] = true);
        is_cut
    }
}

/// Steps of the grid in the larger of the operands.
const GRID: f64 = (1u64 << 36) as f64;

pub fn largest_coordinate(operands: &[Operand; 2]) -> f64 {
    let bounds = operands[0].field().bounds().union(operands[1].field().bounds());
    bounds.min.abs().max(bounds.max.abs()).max_element()
}

/// The operands with their vertices moved to a common grid; new fields.
pub fn snapped<'a>(operands: &[Operand; 2]) -> Result<[Operand<'a>; 2], SoupError> {
    // A power of two, so that multiples of it are exact.
    let step = largest_coordinate(operands).max(f64::MIN_POSITIVE).log2().ceil().exp2() / GRID;
    let snap = |operand: &Operand| {
        let soup = operand.soup();
        let positions = soup.positions().iter().map(|p| (*p / step).round() * step).collect();
        let soup = TriangleSoup::new(positions, soup.triangles().to_vec())?;
        Ok(Operand::Traced(Box::new(WindingField::new(soup, Default::default()))))
    };
    Ok([snap(&operands[0])?, snap(&operands[1])?])
}
