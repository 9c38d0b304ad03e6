use serde::{Deserialize, Serialize};

/// What is looked for, and how closely.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct CheckConfig {
    /// Most entries of each list of defects; the count beside a list is the true one.
    pub limit: usize,
    /// A face is a sliver if its least height is below this share of its longest side.
    pub sliver_ratio: f64,
    /// Whether pairs of faces that go through each other are looked for.
    pub self_intersections: bool,
    /// Points on the surface at which the field and the thickness are taken, by area; each face has at least one.
    pub samples: usize,
    /// Whether rays measure how thick the solid is.
    pub thickness: bool,
    /// Faces with a thickness below this are listed, in millimetres.
    pub minimum_thickness: f64,
    /// Faces that lean out by more than this, in degrees from the vertical, are overhangs; 90 for none.
    pub overhang_angle: f64,
    /// Width, depth and height of the space that the model is to fit in, in millimetres.
    pub bed: Option<[f64; 3]>,
    /// Cells along the longest side of the lattice that the volume is judged by; 0 leaves that out.
    pub resolution: usize,
}

impl Default for CheckConfig {
    fn default() -> Self {
        CheckConfig {
            limit: 10_000,
            sliver_ratio: 0.01,
            self_intersections: true,
            samples: 10_000,
            thickness: true,
            // Two lines of a nozzle of 0.4 mm.
            minimum_thickness: 0.8,
            overhang_angle: 50.0,
            bed: None,
            resolution: 48,
        }
    }
}

impl CheckConfig {
    /// # Errors
    /// If and only if a number is out of its range; the error names it.
    pub fn check(&self) -> Result<(), CheckError> {
        let ranges = [
            ("sliverRatio", self.sliver_ratio, 0.0, 1.0, "a ratio from 0 to 1"),
            ("minimumThickness", self.minimum_thickness, 0.0, 1e6, "a length from 0 to 1,000,000 mm"),
            ("overhangAngle", self.overhang_angle, 0.0, 90.0, "an angle from 0 to 90 degrees"),
            ("resolution", self.resolution as f64, 0.0, 512.0, "0 to 512 cells"),
            ("samples", self.samples as f64, 0.0, 1e8, "0 to 100,000,000 points"),
        ];
        let bed = self.bed.iter().flatten().map(|size| ("bed", *size, 1e-6, 1e6, "lengths above 0 mm"));
        match ranges
            .into_iter()
            .chain(bed)
            .find(|(_, value, least, most, _)| !(least..=most).contains(&value))
        {
            Some((setting, value, _, _, accepted)) => Err(CheckError::Setting { setting, value, accepted }),
            None => Ok(()),
        }
    }
}

/// Why a shape could not be checked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CheckError {
    #[error("{points} points have no faces to check: extract their surface and check that")]
    Cloud { points: usize },
    #[error("{setting} is {value}: {accepted} is accepted")]
    Setting { setting: &'static str, value: f64, accepted: &'static str },
    #[error(transparent)]
    Field(#[from] crate::winding::FieldError),
    #[error(transparent)]
    Cancelled(#[from] crate::data::Cancelled),
}
