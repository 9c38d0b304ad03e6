use serde::Serialize;
use std::fmt;

/// Something in the input that was put right or left out, with how often: never a reason to refuse it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Warning {
    pub kind: WarningKind,
    /// How many faces, points, records or bytes it concerns.
    pub count: usize,
}

/// What a [`Warning`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WarningKind {
    /// Faces that used a NaN or infinite vertex, or one beyond [`LARGEST_COORDINATE`](super::LARGEST_COORDINATE), were dropped.
    NonFiniteFaces,
    /// Faces that named a vertex which does not exist were dropped.
    IndexOutOfRange,
    /// Points with a NaN or infinite coordinate, or one beyond [`LARGEST_COORDINATE`](super::LARGEST_COORDINATE), were dropped.
    NonFinitePoints,
    /// Normals of length zero or not finite were replaced by estimates, or the points dropped.
    BadNormals,
    /// The header promised another number of records than the file holds: what is there was read.
    CountMismatch,
    /// The last record was cut short and dropped.
    TruncatedRecord,
    /// Bytes after the last record were ignored.
    TrailingBytes,
    /// Columns of a point file that are neither coordinates nor normals, such as colours, were left out.
    IgnoredColumns,
    /// Faces with fewer than three corners, or lines and other elements, were skipped.
    SkippedElements,
    /// The model's diagonal is below 1 mm: are its units metres or inches?
    TinyModel,
    /// The model's diagonal is above 2,000 mm: are its units micrometres?
    HugeModel,
    /// Points carried no normals: they were estimated and oriented, which can fail on
    /// thin or sparse parts.
    EstimatedNormals,
    /// All points of a cloud without normals lie in a plane, on a line or in one place: it bounds no volume.
    FlatCloud,
    /// Triangles without area give no points of a cloud.
    DegenerateFaces,
    /// Vertices that no triangle with an area uses give no points of a cloud.
    UnusedVertices,
    /// Parts of layers are too thin for a line along either side: they got a single one, or none.
    ThinWalls,
    /// Parts of layers narrower than the least feature asked for were left out.
    DroppedFeatures,
    /// Parts of layers hang over nothing: they want support.
    Overhangs,
    /// The print lay off the bed and was moved to its middle.
    MovedToBed,
    /// Layers are higher than the nozzle is wide: their lines hardly stick.
    HighLayers,
    /// Lines are much narrower than the nozzle.
    NarrowLines,
    /// Nothing is left of the operands.
    EmptyResult,
    /// One operand is that many times as large as the other: are their units the same?
    DifferentScales,
    /// Net boundary edges of operands: where triangles are missing, the other operand is cut along a level set.
    OpenOperands,
    /// An operand crosses itself where it is cut: what does not bound the result was dropped.
    SelfCrossing,
    /// Operands nearly coincide: they were cut as if their vertices lay on a grid.
    SnappedOperands,
    /// Faces whose pieces still cross, as coordinates are rounded.
    CrossingFaces,
    /// The samples that a proxy's offset needs: it has fewer.
    CoarseProxy,
    /// Parts of a soup are farther apart than two offsets: its proxy has that many components.
    SeveralProxies,
    /// Field lines that meet no proxy: their starts are inside the shape, or buried in it. They got the nearest point.
    LostLines,
    /// Lines from a boundary that ran along the triangles: they got the direction of their neighbours.
    TangentialLines,
    /// Triangles in narrow places where the field is weak, and whose lines do not lead out well: a smaller offset would follow them closer.
    WeakField,
    /// Triangles that were laid flat by themselves, or whose texture is torn or flipped.
    BadTexture,
}

impl Warning {
    pub fn new(kind: WarningKind, count: usize) -> Warning {
        Warning { kind, count }
    }

    /// Of those kinds that there are any of, in their order.
    pub(crate) fn counted(counts: impl IntoIterator<Item = (WarningKind, usize)>) -> Vec<Warning> {
        let some = counts.into_iter().filter(|(_, count)| *count > 0);
        some.map(|(kind, count)| Warning { kind, count }).collect()
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let n = self.count;
        let of = |one: &'static str, more: &'static str| if n == 1 { one } else { more };
        let faces = of("face", "faces");
        let were = of("was", "were");
        let points = of("point", "points");
        let triangles = of("triangle", "triangles");
        let parts = of("part", "parts");
        let layers = of("layer", "layers");
        let lines = of("line", "lines");
        match self.kind {
            WarningKind::NonFiniteFaces => {
                write!(f, "{n} {faces} with a NaN or infinite vertex, or one too far away, {were} dropped")
            }
            WarningKind::IndexOutOfRange => {
                let name = of("names", "name");
                write!(f, "{n} {faces} that {name} a vertex which does not exist {were} dropped")
            }
            WarningKind::NonFinitePoints => {
                write!(
                    f,
                    "{n} {points} with a NaN or infinite coordinate, or one too far away, {were} dropped"
                )
            }
            WarningKind::BadNormals => write!(f, "{n} {points} had no usable normal"),
            WarningKind::CountMismatch => {
                let records = of("record", "records");
                write!(f, "the header's count is off by {n} {records}; what the file holds was read")
            }
            WarningKind::TruncatedRecord => {
                write!(f, "{n} {} at the end {were} cut short and dropped", of("record", "records"))
            }
            WarningKind::TrailingBytes => {
                write!(f, "{n} {} after the last record {were} ignored", of("byte", "bytes"))
            }
            WarningKind::IgnoredColumns => {
                write!(f, "columns of {n} {points} that are neither coordinates nor normals were left out")
            }
            WarningKind::SkippedElements => {
                let elements = of("element that is", "elements that are");
                write!(f, "{n} {elements} neither faces nor points {were} skipped")
            }
            WarningKind::TinyModel => {
                write!(f, "the model is smaller than 1 mm across: check its unit (read as millimetres)")
            }
            WarningKind::HugeModel => {
                write!(f, "the model is larger than 2,000 mm across: check its unit (read as millimetres)")
            }
            WarningKind::EstimatedNormals => {
                write!(
                    f,
                    "normals of {n} {points} were estimated; thin or sparse parts may come out inverted"
                )
            }
            WarningKind::FlatCloud => write!(f, "the {n} {points} lie in one plane: they bound no volume"),
            WarningKind::DegenerateFaces => {
                write!(f, "{n} {triangles} without area {} no points", of("gives", "give"))
            }
            WarningKind::UnusedVertices => {
                let vertices = of("vertex of no triangle gives", "vertices of no triangle give");
                write!(f, "{n} {vertices} no points")
            }
            WarningKind::ThinWalls => {
                let are = of("is", "are");
                write!(f, "{n} {parts} of layers {are} too thin for a line along either side")
            }
            WarningKind::DroppedFeatures => {
                write!(f, "{n} {parts} of layers narrower than the least feature {were} left out")
            }
            WarningKind::Overhangs => {
                let hang = of("hangs over nothing: it wants", "hang over nothing: they want");
                write!(f, "{n} {parts} of layers {hang} support")
            }
            WarningKind::MovedToBed => write!(f, "the print lay off the bed and was moved to its middle"),
            WarningKind::HighLayers => {
                write!(f, "{n} {layers} {} higher than the nozzle is wide", of("is", "are"))
            }
            WarningKind::NarrowLines => {
                write!(f, "{n} {lines} {} narrower than 0.6 of the nozzle", of("is", "are"))
            }
            WarningKind::EmptyResult => write!(f, "nothing is left of the operands"),
            WarningKind::DifferentScales => {
                write!(f, "one operand is {n} times as large as the other: check their units")
            }
            WarningKind::OpenOperands => {
                let edges = of("edge", "edges");
                write!(f, "{n} boundary {edges}: operands are open, and cut along level sets there")
            }
            WarningKind::SelfCrossing => {
                write!(f, "an operand crosses itself at the cut: only what bounds the result is left")
            }
            WarningKind::SnappedOperands => {
                write!(f, "surfaces nearly coincide: they were cut as if vertices lay on a fine grid")
            }
            WarningKind::CrossingFaces => write!(f, "pieces of {n} {faces} cross after rounding"),
            WarningKind::CoarseProxy => {
                write!(
                    f,
                    "the proxy has too few samples for its offset: {n} along the longest side are needed"
                )
            }
            WarningKind::SeveralProxies => {
                write!(f, "the proxy has {n} components: gaps are wider than two offsets")
            }
            WarningKind::LostLines => {
                let meet = of("meets no proxy: its vertex", "meet no proxy: their vertices");
                write!(f, "{n} field {lines} {meet} got the nearest point of it")
            }
            WarningKind::TangentialLines => {
                let own = of("its", "their");
                write!(f, "{n} field {lines} from a boundary got the direction of {own} neighbours")
            }
            WarningKind::WeakField => {
                let (lie, them) = (of("lies", "lie"), of("it", "them"));
                write!(
                    f,
                    "{n} {triangles} {lie} in narrow places: a smaller offset would follow {them} closer"
                )
            }
            WarningKind::BadTexture => {
                let (are, by) = (of("is", "are"), of("itself", "themselves"));
                write!(f, "{n} {triangles} {are} laid flat by {by} or torn: the texture breaks off there")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_told_in_the_singular() {
        let told = |kind: WarningKind, count: usize| Warning::new(kind, count).to_string();
        assert_eq!(
            [told(WarningKind::LostLines, 1), told(WarningKind::LostLines, 2)],
            [
                "1 field line meets no proxy: its vertex got the nearest point of it",
                "2 field lines meet no proxy: their vertices got the nearest point of it"
            ]
        );
        assert_eq!(told(WarningKind::Overhangs, 1), "1 part of layers hangs over nothing: it wants support");
        assert_eq!(
            told(WarningKind::IndexOutOfRange, 3),
            "3 faces that name a vertex which does not exist were dropped"
        );
    }
}
