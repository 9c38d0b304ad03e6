use crate::math::Aabb;
use serde::Serialize;

/// What is wrong with a soup, and what its winding field makes of it. Lengths in millimetres; faces and vertices by their
/// number in the soup, vertices in one place by the lowest of theirs.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct CheckReport {
    pub verdict: Verdict,
    pub triangles: usize,
    /// Different places of corners.
    pub vertices: usize,
    /// Vertices of no triangle.
    pub unused_vertices: usize,
    /// Edges of the faces that make the surface: of those that are not copies and do not have two corners in one place. All
    /// that follows on edges, vertices and shells is about these faces.
    pub edges: usize,
    pub bounds: Bounds,
    /// How the model lies in the bed that was asked for.
    pub bed: Option<BedFit>,
    /// Of all faces.
    pub area: f64,
    /// ∫ w: what the faces enclose, as often as they do; exact for closed surfaces.
    pub volume: f64,
    /// Faces with the corners of an earlier one, turning the same way.
    pub duplicate_faces: List<u32>,
    /// Faces without area.
    pub degenerate_faces: List<u32>,
    /// Faces with area that are very thin for their length.
    pub sliver_faces: List<u32>,
    pub boundary: Boundary,
    /// Edges of more than two faces.
    pub non_manifold_edges: List<[u32; 2]>,
    /// Vertices at which faces meet that no edges there lead from one to the other.
    pub non_manifold_vertices: List<u32>,
    /// Edges of two faces that run along them in the same direction: one is flipped.
    pub inconsistent_edges: List<[u32; 2]>,
    /// Pieces that share no vertex.
    pub components: usize,
    /// Pieces that hang together by edges of two faces, largest area first.
    pub shells: List<Shell>,
    /// Shells without an open edge.
    pub closed_shells: usize,
    /// Closed shells in others, as cavities or as solids in the solid.
    pub nested_shells: usize,
    /// Shells that are inside out.
    pub inverted_shells: usize,
    /// Pairs of faces whose insides have a point in common.
    pub self_intersections: Option<List<[u32; 2]>>,
    /// V − E + F, summed over the shells.
    pub euler_number: i64,
    /// Handles of all shells together, if all are closed and have two sides.
    pub genus: Option<u64>,
    /// Faces to turn so that the surface bounds a solid from outside: the fewer ones of a shell that do not run with the
    /// others, and all others of shells that are inside out.
    pub flipped_faces: List<u32>,
    /// Shells that have such faces.
    pub flipped_shells: usize,
    /// Faces both of whose sides are inside.
    pub internal_faces: List<u32>,
    /// Faces both of whose sides are outside.
    pub outside_faces: List<u32>,
    pub field: Option<FieldCheck>,
    pub thickness: Option<Thickness>,
    pub overhangs: Overhangs,
}

/// The first of a kind, and how many there are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct List<T> {
    pub count: usize,
    pub list: Vec<T>,
}

impl<T> Default for List<T> {
    fn default() -> Self {
        List { count: 0, list: Vec::new() }
    }
}

impl<T> List<T> {
    pub(super) fn new(all: impl IntoIterator<Item = T>, limit: usize) -> List<T> {
        let mut found = List::default();
        for item in all {
            found.count += 1;
            if found.count <= limit {
                found.list.push(item);
            }
        }
        found
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Bounds {
    pub min: [f64; 3],
    pub max: [f64; 3],
}

impl From<Aabb> for Bounds {
    fn from(bounds: Aabb) -> Bounds {
        Bounds { min: bounds.min.to_array(), max: bounds.max.to_array() }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BedFit {
    pub size: [f64; 3],
    pub fits: bool,
    /// Whether it fits with width and depth exchanged.
    pub fits_turned: bool,
}

/// Where the surface is open: edges of one face.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Boundary {
    pub edges: usize,
    pub length: f64,
    /// The longest first.
    pub loops: List<Loop>,
}

/// A walk along open edges around a hole, or to where more than two faces meet.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Loop {
    pub edges: usize,
    pub length: f64,
    /// That of a flat hole; a slit, as at a vertex on another face's side, has none.
    pub area: f64,
    pub is_closed: bool,
    /// In their order along the hole, as many as the limit of lists lets through.
    pub vertices: Vec<u32>,
}

/// What a shell is in the solid {w ≥ 1/2}, by most of its area.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum ShellRole {
    /// It bounds the solid, with its faces turned outward.
    Boundary,
    /// It bounds the solid, but its faces are turned inward.
    Reversed,
    /// Inside of the solid.
    Internal,
    /// Inside out: both of its sides are outside, and w is negative on that to which its faces are turned.
    Inverted,
    /// Both of its sides are outside, and it encloses nothing.
    Outside,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Shell {
    /// The lowest of its faces.
    pub first_face: u32,
    pub faces: usize,
    pub area: f64,
    pub is_closed: bool,
    /// Whether it has two sides.
    pub is_orientable: bool,
    /// What a closed one encloses; negative if its faces are turned inward.
    pub volume: Option<f64>,
    pub euler_number: i64,
    /// Handles of a closed one with two sides.
    pub genus: Option<u64>,
    /// How many closed shells a closed one is in.
    pub depth: Option<usize>,
    pub role: ShellRole,
}

/// Where w is what it is not around a clean solid. By w in the middles of the cells of a lattice over the bounds, and of
/// eight parts of each cell that is of another kind than one beside it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FieldCheck {
    /// The side of a cell.
    pub cell: f64,
    /// Volume of the bounds.
    pub box_volume: f64,
    /// Volume with w ≥ 1/2.
    pub solid_volume: f64,
    /// Volume with 0.1 < w < 0.9: neither inside nor outside for certain. None in closed surfaces.
    pub ambiguous_volume: f64,
    /// The same as a share of the box's volume.
    pub ambiguous_share: f64,
    /// Volume with w ≥ 1.9: enclosed more than once.
    pub overlap_volume: f64,
    /// Volume with w ≤ −0.9: enclosed inside out.
    pub inverted_volume: f64,
    /// The cells of these three kinds that hang together, largest first.
    pub regions: List<Region>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum RegionKind {
    Ambiguous,
    Overlap,
    Inverted,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Region {
    pub kind: RegionKind,
    pub volume: f64,
    pub bounds: Bounds,
    /// Least and greatest w in the middles of its cells.
    pub least: f64,
    pub greatest: f64,
}

/// How far it is from points of the surface, straight into the solid, to where that ends.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Thickness {
    /// Points of faces with the solid on one side, from which a ray met the other end.
    pub samples: usize,
    /// Points from which a ray left through an opening.
    pub unbounded: usize,
    pub minimum: f64,
    /// The face and the place with that.
    pub thinnest_face: u32,
    pub thinnest_point: [f64; 3],
    /// `[share of the area in percent, thickness that so much of it does not exceed]`.
    pub percentiles: Vec<[f64; 2]>,
    /// The thickness below which faces are listed, and those.
    pub threshold: f64,
    pub thin_faces: List<u32>,
    /// Of the surface that is thinner.
    pub thin_area: f64,
}

/// Faces under which there is no solid. What lies on the bed does not count.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Overhangs {
    /// Degrees from the vertical.
    pub angle: f64,
    /// Of faces that lean out by more.
    pub area: f64,
    pub faces: List<u32>,
    /// `[degrees from the vertical, area of the faces that lean out by more]`, every 5 degrees.
    pub by_angle: Vec<[f64; 2]>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Rating {
    /// Closed, consistent, without intersections.
    Clean,
    /// Not clean, but the field makes a solid of it that looks as the surface does.
    PrintsAsSeen,
    /// What is made of it may not be what was meant.
    Doubtful,
    /// Nothing is inside.
    NoSolid,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum ReasonKind {
    NoSolid,
    DoesNotFit,
    FlippedFaces,
    Ambiguous,
    Holes,
    Inverted,
    InternalFaces,
    Overlaps,
    OutsideFaces,
    SelfIntersections,
    NonManifold,
    DuplicateFaces,
    DegenerateFaces,
    Thin,
    Overhangs,
}

/// One reason for a verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Reason {
    pub kind: ReasonKind,
    /// How many faces, holes, pairs, … it is about.
    pub count: usize,
    pub text: String,
}

/// Whether it will print, in words.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Verdict {
    pub rating: Rating,
    pub text: String,
    /// The weightiest first.
    pub reasons: Vec<Reason>,
}
