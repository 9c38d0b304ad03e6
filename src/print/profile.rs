use crate::math::Aabb;
use serde::{Deserialize, Serialize};

/// Where a printer's x = 0, y = 0 is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Origin {
    /// The front left corner of the bed.
    #[default]
    Corner,
    Center,
}

/// Where a print goes on the bed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Placement {
    /// Where its coordinates say, if that is on the bed; else in the middle, with a warning.
    #[default]
    OnBed,
    /// Where its coordinates say; an error if that is off the bed.
    AsIs,
    /// In the middle.
    Centered,
}

/// Millimetres a second.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Speeds {
    pub travel: f64,
    /// Everything in the first layer.
    pub first_layer: f64,
    pub outer_wall: f64,
    /// Inner walls, and gaps between walls.
    pub inner_wall: f64,
    pub infill: f64,
    /// Solid inside, and bottoms.
    pub solid: f64,
    pub top: f64,
    pub bridge: f64,
    pub overhang: f64,
}

impl Default for Speeds {
    fn default() -> Self {
        Speeds {
            travel: 150.0,
            first_layer: 20.0,
            outer_wall: 40.0,
            inner_wall: 60.0,
            infill: 80.0,
            solid: 60.0,
            top: 40.0,
            bridge: 25.0,
            overhang: 20.0,
        }
    }
}

/// How filament is drawn back before a travel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct Retraction {
    /// Millimetres of filament; 0 for none.
    pub length: f64,
    /// Millimetres a second.
    pub speed: f64,
    /// Shorter travels go without, in millimetres.
    pub minimum_travel: f64,
    /// How far the nozzle is lifted while the filament is drawn back, in millimetres.
    pub lift: f64,
}

impl Default for Retraction {
    fn default() -> Self {
        Retraction { length: 0.8, speed: 35.0, minimum_travel: 1.5, lift: 0.0 }
    }
}

/// A machine and what is loaded: lengths in millimetres, temperatures in °C.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct PrinterProfile {
    pub name: String,
    /// Along x.
    pub bed_width: f64,
    /// Along y.
    pub bed_depth: f64,
    /// The largest z.
    pub height: f64,
    pub origin: Origin,
    pub placement: Placement,
    pub nozzle_diameter: f64,
    pub filament_diameter: f64,
    /// Grams per cubic centimetre.
    pub filament_density: f64,
    pub nozzle_temperature: f64,
    pub bed_temperature: f64,
    /// Speed of the fan from the second layer on, from 0 to 1.
    pub fan: f64,
    pub speeds: Speeds,
    /// Millimetres per second squared.
    pub acceleration: f64,
    /// How far a corner may be cut in the planner's model, in millimetres: Marlin's junction deviation.
    pub junction_deviation: f64,
    pub retraction: Retraction,
    /// G-code before and after the print; `{nozzleTemperature}` and the like are replaced (see
    /// [`gcode`](super::gcode())).
    pub start: String,
    pub end: String,
}

impl Default for PrinterProfile {
    fn default() -> Self {
        let start = "M140 S{bedTemperature}\nM104 S{nozzleTemperature}\nM190 S{bedTemperature} ; wait for the bed\n\
                     M109 S{nozzleTemperature} ; wait for the nozzle\nG28 ; home\nG92 E0\n";
        let end = "M104 S0\nM140 S0\nM107\nM84 ; motors off\n";
        PrinterProfile {
            name: "generic Marlin printer".into(),
            bed_width: 220.0,
            bed_depth: 220.0,
            height: 250.0,
            origin: Origin::Corner,
            placement: Placement::OnBed,
            nozzle_diameter: 0.4,
            filament_diameter: 1.75,
            filament_density: 1.24,
            nozzle_temperature: 210.0,
            bed_temperature: 60.0,
            fan: 1.0,
            speeds: Speeds::default(),
            acceleration: 1000.0,
            junction_deviation: 0.02,
            retraction: Retraction::default(),
            start: start.into(),
            end: end.into(),
        }
    }
}

/// Why there is no such printer, or no room on it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProfileError {
    #[error("{field} cannot be {value}: {accepted} is wanted")]
    BadValue { field: &'static str, value: f64, accepted: &'static str },
    #[error("the model is {model} mm {extent}, the {part} {room} mm", model = tidy(*.model), room = tidy(*.room))]
    TooLarge { extent: &'static str, model: f64, part: &'static str, room: f64 },
}

/// To a hundredth, without zeros that say nothing.
fn tidy(millimetres: f64) -> f64 {
    (millimetres * 100.0).round() / 100.0
}

impl PrinterProfile {
    /// # Errors
    /// If and only if a number is out of its range; the error names its field.
    pub fn check(&self) -> Result<(), ProfileError> {
        let room = "a length above 0 and up to 100,000 mm";
        let fine = "a length from 0.01 to 50 mm";
        let (speed, pause) = ("a speed above 0 and up to 10,000 mm/s", "a length from 0 to 100 mm");
        let s = &self.speeds;
        let above_zero = f64::MIN_POSITIVE;
        let ranges = [
            ("bedWidth", self.bed_width, above_zero, 1e5, room),
            ("bedDepth", self.bed_depth, above_zero, 1e5, room),
            ("height", self.height, above_zero, 1e5, room),
            ("nozzleDiameter", self.nozzle_diameter, 0.01, 50.0, fine),
            ("filamentDiameter", self.filament_diameter, 0.01, 50.0, fine),
            ("filamentDensity", self.filament_density, above_zero, 30.0, "a density up to 30 g/cm³"),
            ("nozzleTemperature", self.nozzle_temperature, 0.0, 600.0, "a temperature from 0 to 600 °C"),
            ("bedTemperature", self.bed_temperature, 0.0, 300.0, "a temperature from 0 to 300 °C"),
            ("fan", self.fan, 0.0, 1.0, "a share from 0 to 1"),
            ("acceleration", self.acceleration, above_zero, 1e6, "an acceleration up to 1,000,000 mm/s²"),
            ("junctionDeviation", self.junction_deviation, above_zero, 10.0, "a length up to 10 mm"),
            ("retraction.length", self.retraction.length, 0.0, 100.0, pause),
            ("retraction.speed", self.retraction.speed, above_zero, 1e4, speed),
            ("retraction.minimumTravel", self.retraction.minimum_travel, 0.0, 1e5, "a length of 0 or more"),
            ("retraction.lift", self.retraction.lift, 0.0, 100.0, pause),
            ("speeds.travel", s.travel, above_zero, 1e4, speed),
            ("speeds.firstLayer", s.first_layer, above_zero, 1e4, speed),
            ("speeds.outerWall", s.outer_wall, above_zero, 1e4, speed),
            ("speeds.innerWall", s.inner_wall, above_zero, 1e4, speed),
            ("speeds.infill", s.infill, above_zero, 1e4, speed),
            ("speeds.solid", s.solid, above_zero, 1e4, speed),
            ("speeds.top", s.top, above_zero, 1e4, speed),
            ("speeds.bridge", s.bridge, above_zero, 1e4, speed),
            ("speeds.overhang", s.overhang, above_zero, 1e4, speed),
        ];
        match ranges.into_iter().find(|(_, value, least, most, _)| !(least..=most).contains(&value)) {
            Some((field, value, _, _, accepted)) => Err(ProfileError::BadValue { field, value, accepted }),
            None => Ok(()),
        }
    }

    /// Whether there is room for a model of these bounds, wherever it lies now.
    ///
    /// # Errors
    /// If and only if the model is larger than the printer along an axis.
    pub fn fits(&self, model: Aabb) -> Result<(), ProfileError> {
        let size = model.size();
        let extents = [
            ("wide", size.x, "bed", self.bed_width),
            ("deep", size.y, "bed", self.bed_depth),
            ("high", size.z, "printer", self.height),
        ];
        // A hundredth of a micrometre is rounding.
        let too_large = extents.into_iter().find(|(_, model, _, room)| *model > room + 1e-5);
        match too_large {
            Some((extent, model, part, room)) => Err(ProfileError::TooLarge { extent, model, part, room }),
            None => Ok(()),
        }
    }

    /// All that the nozzle can reach.
    pub fn reach(&self) -> Aabb {
        use crate::math::Vec3;
        let size = Vec3::new(self.bed_width, self.bed_depth, self.height);
        let min = match self.origin {
            Origin::Corner => Vec3::ZERO,
            Origin::Center => Vec3::new(-0.5 * size.x, -0.5 * size.y, 0.0),
        };
        Aabb { min, max: min + size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;

    #[test]
    fn a_model_that_is_too_large_is_told_how_much() {
        let profile = PrinterProfile::default();
        let of = |x: f64, y: f64, z: f64| Aabb { min: Vec3::ZERO, max: Vec3::new(x, y, z) };
        assert_eq!(profile.fits(of(220.0, 100.0, 250.0)), Ok(()));
        let message = |bounds| profile.fits(bounds).unwrap_err().to_string();
        assert_eq!(message(of(260.0, 1.0, 1.0)), "the model is 260 mm wide, the bed 220 mm");
        assert_eq!(message(of(1.0, 1.0, 250.126)), "the model is 250.13 mm high, the printer 250 mm");
    }

    #[test]
    fn impossible_values_are_named() {
        assert_eq!(PrinterProfile::default().check(), Ok(()));
        let profile = PrinterProfile { nozzle_diameter: 0.0, ..Default::default() };
        let message = profile.check().unwrap_err().to_string();
        assert_eq!(message, "nozzleDiameter cannot be 0: a length from 0.01 to 50 mm is wanted");
        let speeds = Speeds { top: f64::NAN, ..Default::default() };
        let wrong = PrinterProfile { speeds, ..Default::default() }.check();
        assert!(matches!(wrong, Err(ProfileError::BadValue { field: "speeds.top", .. })));
    }

    #[test]
    fn a_profile_is_read_from_json() {
        let json = r#"{ "bedWidth": 180, "origin": "center", "speeds": { "travel": 200 } }"#;
        let profile: PrinterProfile = serde_json::from_str(json).unwrap();
        assert_eq!((profile.bed_width, profile.bed_depth, profile.speeds.travel), (180.0, 220.0, 200.0));
        assert_eq!(profile.reach().min, Vec3::new(-90.0, -110.0, 0.0));
        let message = serde_json::from_str::<PrinterProfile>(r#"{ "bed": 180 }"#).unwrap_err().to_string();
        assert!(message.contains("`bed`") && message.contains("bedWidth"), "{message}");
        let back: PrinterProfile = serde_json::from_str(&serde_json::to_string(&profile).unwrap()).unwrap();
        assert_eq!(back, profile);
    }
}
