//! The exact winding number by divide and conquer: Jacobson, Kavan & Sorkine-Hornung 2013, *Robust Inside-Outside
//! Segmentation using Generalized Winding Numbers*, section 4.
//!
//! Seen from outside a convex box, a surface in it has the same solid angle as any other surface in the box with the same
//! boundary: the two make a closed one, whose winding number is 0 out there. So each box of a hierarchy keeps a *stand-in*
//! for its triangles, a cone over their boundary, which for a connected piece of m triangles has about √m. A query adds the
//! stand-ins of the boxes that it is outside of, and the triangles of the leaves that it is in.
//!
//! Exact, and fast where the pieces hold together; a soup of loose triangles, whose boundary is as large as itself, costs
//! as much as the direct sum. It is the baseline of Barill et al. 2018 (fig. 10, section 3.3).
use crate::bvh::{Bvh, Child, Stack, WIDTH};
use crate::data::{Monitor, TriangleSoup, fill_in_blocks, map_items, set_each, zeroed};
use crate::math::{Aabb, Vec3};
use crate::treecode::{Kernel, Lanes};
use crate::winding::FieldError;
use crate::winding::chain::weld;
use crate::winding::triangles::{TriangleBlock, Triangles};
use std::cmp::Ordering;
use std::ops::Range;
use wide::f64x4;

/// Triangles in a leaf: the 2013 paper's choice.
const LEAF_SIZE: usize = 100;

/// The hierarchy: built once, asked many times.
pub struct ExactHierarchy {
    bvh: Bvh,
    /// Box and stand-in of the whole soup.
    whole: (Aabb, Stand),
    /// What stands for each child of each node, seen from outside its box.
    stands: Vec<[Stand; WIDTH]>,
    /// The triangles of the leaves, four to a block; none for an inner child.
    leaves: Vec<[Range<usize>; WIDTH]>,
    blocks: Vec<TriangleBlock>,
}

/// Blocks to sum for a box from outside; none where it takes fewer to look into it.
type Stand = Option<Range<usize>>;

impl ExactHierarchy {
    /// Builds the hierarchy, in parallel.
    pub fn new(soup: &TriangleSoup) -> ExactHierarchy {
        let boxes: Vec<Aabb> = map_items(soup.len(), |t| Aabb::around(soup.corners(t)));
        let bvh = Bvh::build(&boxes, LEAF_SIZE);
        let builder = Builder { soup, bvh: &bvh, welded: weld(soup.positions()) };
        let (whole, pieces) = builder.pieces();
        let mut packing = Packing { soup, blocks: Vec::new() };
        let whole = (soup.bounds(), packing.stand(&whole));
        let stands = pieces.iter().map(|four| four.each_ref().map(|piece| packing.stand(piece))).collect();
        let leaves = (bvh.nodes().iter())
            .map(|node| {
                node.children.map(|child| match child {
                    Child::Leaf { .. } => packing.leaf(&bvh.items()[bvh.places(child)]),
                    _ => 0..0,
                })
            })
            .collect();
        let blocks = packing.blocks;
        ExactHierarchy { bvh, whole, stands, leaves, blocks }
    }

    /// The winding number at `q`, equal to that of [`crate::winding::winding_of_soup`] up to rounding. NaN where `q` is not finite.
    pub fn at(&self, q: Vec3) -> f64 {
        self.at_with(q, &mut Stack::new())
    }

    /// Winding numbers at `points`, in their order, in parallel.
    ///
    /// # Errors
    /// If and only if `monitor` cancels or the values do not fit in memory.
    pub fn evaluate(&self, points: &[Vec3], monitor: &dyn Monitor) -> Result<Vec<f64>, FieldError> {
        let mut values = zeroed(points.len())?;
        let value = |i: usize, stack: &mut Stack| self.at_with(points[i], stack);
        fill_in_blocks(&mut values, value, "winding numbers", monitor)?;
        Ok(values)
    }

    fn at_with(&self, q: Vec3, stack: &mut Stack) -> f64 {
        if !q.is_finite() {
            return f64::NAN;
        }
        let lanes: Lanes = q.to_array().map(f64x4::splat);
        let total = |sum| Triangles::total(sum);
        let add = |sum: &mut _, blocks: &Range<usize>| {
            self.blocks[blocks.clone()].iter().for_each(|b| Triangles::add(sum, b, &lanes));
        };
        let mut sum = Triangles::sum(());
        if let (bounds, Some(stand)) = &self.whole
            && !bounds.contains(q)
        {
            add(&mut sum, stand);
            return total(sum);
        }
        let mut inner = Triangles::sum(());
        let visit = |node: usize, ()| {
            let bounds = &self.bvh.nodes()[node].bounds;
            let mut open = 0;
            for (k, stand) in self.stands[node].iter().enumerate() {
                match stand {
                    Some(stand) if !bounds[k].contains(q) => add(&mut sum, stand),
                    _ => open |= 1 << k,
                }
            }
            (open, [(); WIDTH])
        };
        let leaf = |node: usize, k: usize, ()| add(&mut inner, &self.leaves[node][k]);
        self.bvh.traverse(stack, (), visit, leaf);
        total(sum) + total(inner)
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.bvh.bytes()
            + size_of_val(&self.blocks[..])
            + size_of_val(&self.stands[..])
            + size_of_val(&self.leaves[..])
    }
}

/// A piece of the soup while the hierarchy is built.
#[derive(Clone, Default)]
struct Piece {
    /// Net count of each edge (lower vertex, higher vertex) of the boundary, upward positive; sorted, none is 0.
    boundary: Vec<([u32; 2], i32)>,
    /// Triangles that a query outside the piece's box has to sum.
    cost: usize,
    /// The cone over the boundary, where it is smaller than everything below.
    cone: Option<Vec<[u32; 3]>>,
}

struct Builder<'a> {
    soup: &'a TriangleSoup,
    bvh: &'a Bvh,
    welded: Vec<u32>,
}

impl Builder<'_> {
    /// The whole soup, and the pieces below each node, bottom-up.
    fn pieces(&self) -> (Piece, Vec<[Piece; WIDTH]>) {
        let mut pieces: Vec<[Piece; WIDTH]> = vec![Default::default(); self.bvh.nodes().len()];
        for level in self.bvh.levels().iter().rev() {
            let (upper, lower) = pieces.split_at_mut(level.end);
            set_each(&mut upper[level.clone()], 16, |offset, slots| {
                let node = &self.bvh.nodes()[level.start + offset];
                for (slot, child) in slots.iter_mut().zip(node.children) {
                    *slot = match child {
                        Child::Empty => Piece::default(),
                        Child::Inner(index) => Piece::joined(&lower[index as usize - level.end]),
                        Child::Leaf { .. } => self.leaf(&self.bvh.items()[self.bvh.places(child)]),
                    };
                }
            });
            // Boundaries below have been used.
            lower.iter_mut().flatten().for_each(|piece| piece.boundary = Vec::new());
        }
        (pieces.first().map_or_else(Piece::default, Piece::joined), pieces)
    }

    fn leaf(&self, triangles: &[u32]) -> Piece {
        let mut edges = Vec::with_capacity(3 * triangles.len());
        for &t in triangles {
            let [a, b, c] = self.soup.triangles()[t as usize].map(|i| self.welded[i as usize]);
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from != to {
                    edges.push(([from.min(to), from.max(to)], if from < to { 1 } else { -1 }));
                }
            }
        }
        edges.sort_unstable();
        let net = edges.chunk_by(|x, y| x.0 == y.0).map(|same| (same[0].0, same.iter().map(|e| e.1).sum()));
        Piece::new(net.filter(|(_, count)| *count != 0).collect(), triangles.len())
    }
}

impl Piece {
    /// A piece with a boundary, whose parts cost `below` to sum.
    fn new(boundary: Vec<([u32; 2], i32)>, below: usize) -> Piece {
        // Any apex serves; a vertex of the boundary saves the triangles at it, and keeps the cone in the box.
        let Some(&([apex, _], _)) = boundary.first() else {
            return Piece { boundary, cost: 0, cone: Some(Vec::new()) };
        };
        let away = || boundary.iter().filter(move |(edge, _)| !edge.contains(&apex));
        let size: usize = away().map(|(_, count)| count.unsigned_abs() as usize).sum();
        if size >= below {
            return Piece { boundary, cost: below, cone: None };
        }
        let triangles = away().flat_map(|([low, high], count)| {
            let edge = if *count > 0 { [apex, *low, *high] } else { [apex, *high, *low] };
            std::iter::repeat_n(edge, count.unsigned_abs() as usize)
        });
        Piece { cost: size, cone: Some(triangles.collect()), boundary }
    }

    fn joined(parts: &[Piece; WIDTH]) -> Piece {
        let [a, b, c, d] = parts.each_ref().map(|part| &part.boundary[..]);
        let boundary = sum_of_chains(&sum_of_chains(a, b), &sum_of_chains(c, d));
        Piece::new(boundary, parts.iter().map(|part| part.cost).sum())
    }
}

/// Merges two sorted chains; edges that cancel drop out.
fn sum_of_chains(a: &[([u32; 2], i32)], b: &[([u32; 2], i32)]) -> Vec<([u32; 2], i32)> {
    let mut sum = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() && j < b.len() {
        match a[i].0.cmp(&b[j].0) {
            Ordering::Less => sum.push(a[i]),
            Ordering::Greater => sum.push(b[j]),
            Ordering::Equal if a[i].1 + b[j].1 != 0 => sum.push((a[i].0, a[i].1 + b[j].1)),
            Ordering::Equal => {}
        }
        let order = a[i].0.cmp(&b[j].0);
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    sum.extend_from_slice(&a[i..]);
    sum.extend_from_slice(&b[j..]);
    sum
}

/// Collects blocks of four triangles.
struct Packing<'a> {
    soup: &'a TriangleSoup,
    blocks: Vec<TriangleBlock>,
}

impl Packing<'_> {
    fn leaf(&mut self, triangles: &[u32]) -> Range<usize> {
        self.pack(triangles.iter().map(|t| self.soup.corners(*t as usize)).collect())
    }

    fn stand(&mut self, piece: &Piece) -> Stand {
        let cone = piece.cone.as_ref()?;
        let corners = |t: &[u32; 3]| t.map(|v| self.soup.positions()[v as usize]);
        Some(self.pack(cone.iter().map(corners).collect()))
    }

    fn pack(&mut self, triangles: Vec<[Vec3; 3]>) -> Range<usize> {
        let start = self.blocks.len();
        let block = |four: &[[Vec3; 3]]| TriangleBlock::new(std::array::from_fn(|k| four.get(k).copied()));
        self.blocks.extend(triangles.chunks(WIDTH).map(block));
        start..self.blocks.len()
    }
}
