use crate::data::{Ring, Warning, WarningKind};
use crate::math::Vec2;
use serde::Serialize;

/// What a line of a print is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum PathKind {
    OuterWall,
    InnerWall,
    /// The only line of a wall too thin for two.
    ThinWall,
    /// Between walls that have no room for another one.
    Gap,
    /// A wall or a skin with nothing below.
    Overhang,
    /// A skin that lies on the bed, or on what bridges reach over.
    Bottom,
    /// A skin open to above.
    Top,
    /// Solid layers behind the skins.
    Solid,
    /// A skin from one support to another with nothing between.
    Bridge,
    Infill,
}

/// How the nozzle gets to a path from the end of the one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Approach {
    /// Over the outline or a wall: what drips shows.
    #[default]
    Across,
    /// All over the inside of its layer: filament need not be drawn back.
    Inside,
}

/// A line of a print: of one width, as high as its layer. Its cross-section is a rectangle, so its volume is width × height
/// × length.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    pub kind: PathKind,
    /// Where the middle of the nozzle goes. A closed path does not repeat its first point.
    pub points: Vec<Vec2>,
    pub closed: bool,
    pub width: f64,
    pub approach: Approach,
}

impl Path {
    /// Millimetres, with the way back to the start where it is closed.
    pub fn length(&self) -> f64 {
        length_of(&self.points, self.closed)
    }

    /// Where the nozzle is when it is done.
    pub fn end(&self) -> Option<Vec2> {
        if self.closed { self.points.first().copied() } else { self.points.last().copied() }
    }
}

pub(super) fn length_of(points: &[Vec2], closed: bool) -> f64 {
    let way = points.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
    match points {
        [first, .., last] if closed => way + last.distance(*first),
        _ => way,
    }
}

/// The lines of one layer in the order they are laid; from the end of each to the start of the next the nozzle travels, if they
/// differ.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayerPaths {
    /// Where the nozzle lays them, in the model's frame.
    pub z: f64,
    /// Thickness of the layer.
    pub height: f64,
    pub paths: Vec<Path>,
}

impl LayerPaths {
    /// Cubic millimetres.
    pub fn volume(&self) -> f64 {
        self.height * self.paths.iter().map(|path| path.width * path.length()).sum::<f64>()
    }
}

/// All lines of a print, bottom to top, and what was found on the way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Toolpaths {
    pub layers: Vec<LayerPaths>,
    pub report: Report,
}

impl Toolpaths {
    /// Cubic millimetres.
    pub fn volume(&self) -> f64 {
        self.layers.iter().map(LayerPaths::volume).sum()
    }
}

/// How often something was met in all layers, and how much of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Regions {
    pub count: usize,
    /// Square millimetres, summed over layers.
    pub area: f64,
}

impl Regions {
    pub(super) fn add(&mut self, other: Regions) {
        self.count += other.count;
        self.area += other.area;
    }
}

/// What a print asks of its printer, and what it does without.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Report {
    /// Parts that have no room for a line along either side.
    pub thin_walls: Regions,
    /// Those of them that got a single line.
    pub single_lines: usize,
    /// Parts narrower than the least feature asked for.
    pub dropped: Regions,
    /// Skins over nothing that reach from support to support.
    pub bridges: Regions,
    /// Skins over nothing that do not: they want support.
    pub overhangs: Regions,
    /// Millimetres of walls that lean out too far, which want support.
    pub overhanging_walls: f64,
}

impl Report {
    pub(super) fn add(&mut self, other: &Report) {
        self.thin_walls.add(other.thin_walls);
        self.single_lines += other.single_lines;
        self.dropped.add(other.dropped);
        self.bridges.add(other.bridges);
        self.overhangs.add(other.overhangs);
        self.overhanging_walls += other.overhanging_walls;
    }

    /// What a user wants to know before printing.
    pub fn warnings(&self) -> Vec<Warning> {
        let counts = [
            (WarningKind::ThinWalls, self.thin_walls.count),
            (WarningKind::DroppedFeatures, self.dropped.count),
            (WarningKind::Overhangs, self.overhangs.count),
        ];
        Warning::counted(counts)
    }
}

/// A closed wall before its start is chosen.
#[derive(Clone, Debug)]
pub(super) struct Loop {
    pub ring: Ring,
    /// 0 for the outermost.
    pub depth: usize,
}
