//! What a boolean gives.
use super::operands::{Operand, Pieces};
use super::sides::Fate;
use crate::data::{TriangleSoup, Warning};
use crate::math::Vec3;

/// A combination of two solids, and where its triangles come from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BooleanMesh {
    pub positions: Vec<Vec3>,
    /// Counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The operand of each triangle: 0 for the first, 1 for the second.
    pub operands: Vec<u8>,
    /// The triangle of the operand that each is, or is a piece of; for a cloud, of the surface traced for it.
    pub faces: Vec<u32>,
    pub warnings: Vec<Warning>,
}

impl BooleanMesh {
    /// A soup as it is.
    pub(super) fn of(soup: &TriangleSoup) -> BooleanMesh {
        BooleanMesh {
            positions: soup.positions().to_vec(),
            triangles: soup.triangles().to_vec(),
            operands: vec![0; soup.len()],
            faces: (0..soup.len() as u32).collect(),
            warnings: Vec::new(),
        }
    }

    /// The pieces that stay, the first operand's first. Vertices are those of the operands where triangles have them.
    pub(super) fn assembled(pieces: &Pieces, operands: &[Operand; 2], kept: &[Fate]) -> BooleanMesh {
        let shift = operands[0].soup().positions().len() as u32;
        let mut mesh = BooleanMesh::default();
        let mut numbers = vec![u32::MAX; pieces.positions.len()];
        for (piece, fate) in kept.iter().enumerate().filter(|(_, fate)| **fate != Fate::Dropped) {
            let operand = pieces.operand(piece);
            let face = pieces.sources[piece] - if operand == 1 { pieces.first as u32 } else { 0 };
            let given = operands[operand].soup().triangles()[face as usize]
                .map(|v| v + if operand == 1 { shift } else { 0 });
            let mut corners = pieces.corners[piece].map(|vertex| {
                // What is welded to the other operand's vertex shares that.
                let own = |v: &u32| pieces.welded[*v as usize] == vertex && (*v < shift) == (vertex < shift);
                let vertex = given.iter().copied().find(own).unwrap_or(vertex);
                let number = &mut numbers[vertex as usize];
                if *number == u32::MAX {
                    *number = mesh.positions.len() as u32;
                    mesh.positions.push(pieces.positions[vertex as usize]);
                }
                *number
            });
            if *fate == Fate::Turned {
                corners.swap(1, 2);
            }
            mesh.triangles.push(corners);
            mesh.operands.push(operand as u8);
            mesh.faces.push(face);
        }
        mesh
    }

    /// The triangles as a soup.
    pub fn soup(&self) -> TriangleSoup {
        TriangleSoup::derived(self.positions.clone(), self.triangles.clone())
            .expect("booleans make finite, indexed triangles")
    }
}
