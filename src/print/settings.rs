use super::PrintError;
use serde::{Deserialize, Serialize};

/// What fills the inside of a print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Infill {
    /// Parallel lines, turned by 90° from one layer to the next.
    #[default]
    Rectilinear,
    /// Both directions in each layer.
    Grid,
    /// Slices of the gyroid, a minimal surface: as stiff in all directions.
    Gyroid,
}

/// Where a closed wall starts and ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Seam {
    /// Where the nozzle gets to first.
    Nearest,
    /// At the largest y.
    Rear,
    /// Above the seam of the layer below, and at a corner where there is one.
    #[default]
    Aligned,
    /// Anywhere, by a hash of the layer and the wall: the same in each run.
    Random,
}

/// What becomes of walls that have no room for a line on either side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum ThinWalls {
    /// A single line along their middle, as wide as the wall.
    #[default]
    SingleLine,
    /// They are left out where they are narrower than a line, and reported; wider ones get both lines, which overlap.
    Report,
}

/// How layers are filled with lines. Lengths are in millimetres, angles in degrees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct ToolpathSettings {
    pub line_width: f64,
    /// Lines around each part.
    pub perimeters: usize,
    /// How far neighbouring walls overlap, as a share of the line's width.
    pub wall_overlap: f64,
    /// How far infill and skins reach into the innermost wall, as a share of the line's width.
    pub infill_overlap: f64,
    pub infill: Infill,
    /// Share of the inside that infill covers: 0 for none, 1 for solid.
    pub density: f64,
    /// Direction of infill, from +x towards +y; skins run along it and across.
    pub angle: f64,
    /// Solid layers over whatever is open below.
    pub bottom_layers: usize,
    /// Solid layers under whatever is open above.
    pub top_layers: usize,
    pub seam: Seam,
    /// Grows all contours by this, or shrinks them where it is negative: what a printer lays too wide or too narrow.
    pub xy_compensation: f64,
    /// Shrinks the first layer by this, which the bed presses wide.
    pub elephant_foot: f64,
    /// Parts of a layer that are narrower are left out, and reported; 0 for none.
    pub minimum_feature: f64,
    pub thin_walls: ThinWalls,
    /// Walls that lean out by more than this, from the vertical, are overhangs; 90 for none.
    pub overhang_angle: f64,
    /// Whether skins over nothing run straight from one support to the other.
    pub bridges: bool,
    /// Vertices go that lie within this of the line without them.
    pub detail: f64,
}

impl Default for ToolpathSettings {
    fn default() -> Self {
        ToolpathSettings {
            line_width: 0.4,
            perimeters: 2,
            wall_overlap: 0.0,
            infill_overlap: 0.15,
            infill: Infill::default(),
            density: 0.2,
            angle: 45.0,
            bottom_layers: 4,
            top_layers: 4,
            seam: Seam::default(),
            xy_compensation: 0.0,
            elephant_foot: 0.0,
            minimum_feature: 0.0,
            thin_walls: ThinWalls::default(),
            overhang_angle: 50.0,
            bridges: true,
            // A tenth of what a good machine repeats; half the vertices of a scan go at it.
            detail: 0.01,
        }
    }
}

impl ToolpathSettings {
    /// # Errors
    /// If and only if a number is out of its range; the error names it.
    pub fn check(&self) -> Result<(), PrintError> {
        let length = "a length from 0 to 10 mm";
        let ranges = [
            ("lineWidth", self.line_width, 0.01, 50.0, "a width from 0.01 to 50 mm"),
            ("wallOverlap", self.wall_overlap, 0.0, 0.5, "a share of the line's width from 0 to 0.5"),
            ("infillOverlap", self.infill_overlap, 0.0, 0.5, "a share of the line's width from 0 to 0.5"),
            ("density", self.density, 0.0, 1.0, "a share from 0 to 1"),
            ("angle", self.angle, -360.0, 360.0, "an angle from -360 to 360 degrees"),
            ("xyCompensation", self.xy_compensation, -10.0, 10.0, "a length from -10 to 10 mm"),
            ("elephantFoot", self.elephant_foot, 0.0, 10.0, length),
            ("minimumFeature", self.minimum_feature, 0.0, 10.0, length),
            ("overhangAngle", self.overhang_angle, 0.0, 90.0, "an angle from 0 to 90 degrees"),
            ("detail", self.detail, 0.0, 10.0, length),
        ];
        match ranges.into_iter().find(|(_, value, least, most, _)| !(least..=most).contains(&value)) {
            Some((setting, value, _, _, accepted)) => Err(PrintError::Setting { setting, value, accepted }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_range_is_named() {
        assert_eq!(ToolpathSettings::default().check(), Ok(()));
        let wrong = [
            (ToolpathSettings { line_width: 0.0, ..Default::default() }, "lineWidth"),
            (ToolpathSettings { density: 20.0, ..Default::default() }, "density"),
            (ToolpathSettings { angle: f64::NAN, ..Default::default() }, "angle"),
            (ToolpathSettings { overhang_angle: 91.0, ..Default::default() }, "overhangAngle"),
        ];
        for (settings, name) in wrong {
            assert!(
                matches!(settings.check(), Err(PrintError::Setting { setting, .. }) if setting == name),
                "{name}"
            );
        }
    }

    #[test]
    fn settings_are_read_from_json() {
        let read = |json: &str| serde_json::from_str::<ToolpathSettings>(json);
        let settings = read(r#"{ "lineWidth": 0.5, "infill": "gyroid", "seam": "rear" }"#).unwrap();
        assert_eq!((settings.line_width, settings.infill, settings.seam), (0.5, Infill::Gyroid, Seam::Rear));
        assert_eq!(settings.perimeters, 2);
        assert!(read(r#"{ "linewidth": 0.5 }"#).unwrap_err().to_string().contains("linewidth"));
    }
}
