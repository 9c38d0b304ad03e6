use serde::Serialize;

/// How a mesh was repaired.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RepairMethod {
    /// The triangles of the input, put right.
    #[default]
    Conserve,
    /// A new mesh of the surface of {w ≥ 1/2}.
    Remesh,
}

/// What a repair has changed, and what came of it. Numbers are of triangles if they do not say otherwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RepairReport {
    pub method: RepairMethod,
    /// Within which open edges were stitched, in millimetres.
    pub tolerance: f64,
    /// Dropped, as another has the same corners and the same orientation; or the opposite one, in soups that have each face from both
    /// sides.
    pub duplicates: usize,
    /// Dropped in pairs of opposite orientation: w is the same on both sides.
    pub cancelled: usize,
    /// Dropped for want of an area.
    pub degenerate: usize,
    /// Vertices of open edges welded to others within the tolerance.
    pub stitched_vertices: usize,
    /// Vertices within the tolerance of another's open edge, which was split there.
    pub split_edges: usize,
    /// Turned over.
    pub flipped: usize,
    /// Cycles of boundary edges closed by caps, the triangles of these, and square millimetres.
    pub holes: usize,
    pub cap_triangles: usize,
    pub cap_area: f64,
    pub largest_cap_area: f64,
    /// Of the closed soup: those that others cut, and into how many parts.
    pub intersecting: usize,
    pub parts: usize,
    /// Of these, those that still cross as coordinates are rounded.
    pub unresolved: usize,
    /// Dropped, as the inside is on both sides; or on neither.
    pub internal: usize,
    pub outside: usize,
    /// Pieces of the result without thickness, dropped.
    pub sheets: usize,
    /// Vertices put in the place of others, where the surface touched itself.
    pub separated_vertices: usize,
    /// Of the result: those that are triangles of the input or parts of them, and those that are new.
    pub kept: usize,
    pub new: usize,
    /// Whether each edge of the result has two triangles, which run through it in opposite directions.
    pub closed: bool,
    /// Cubic millimetres in the result.
    pub volume: f64,
    /// Of all places that are inside of the result or have w ≥ 1/2, the share that is both, on a lattice.
    pub agreement: f64,
    /// Why the surface was made anew, though the triangles of the input were to be kept.
    pub fallback: Option<Fallback>,
    /// How far from the input the result is, if it was made anew.
    pub distances: Option<Distances>,
}

/// Why triangles of the input could not be kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Fallback {
    /// Closed by caps, they bound another solid than {w ≥ 1/2}: the input has gaps between parts that belong together.
    Disagrees,
    /// They bound nothing.
    Empty,
    /// They could not be closed.
    Open,
}

/// How far a remeshed surface is from its input, in millimetres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Distances {
    /// Edge of a cell.
    pub spacing: f64,
    /// Share of the vertices that lie on the input, to a thousandth of a cell.
    pub on_input: f64,
    /// From those that are nearer to it than a cell: the mean and the largest distance.
    pub mean_to_input: f64,
    pub most_to_input: f64,
    /// From places spread evenly over the triangles of the input that have w ≥ 1/2 on one side alone: the mean, the distance below which
    /// 99 % are, and the largest.
    pub mean_from_input: f64,
    pub p99_from_input: f64,
    pub most_from_input: f64,
}
