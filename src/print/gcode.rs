use super::motion::{Step, for_each_step};
use super::path::{PathKind, Toolpaths};
use super::profile::{Placement, PrinterProfile};
use super::{Estimate, PrintError};
use crate::data::{Warning, WarningKind};
use crate::math::{Aabb, Vec2, Vec3};
use std::fmt::Write;

/// What templates may name.
pub(super) const NAMES: [&str; 10] = [
    "nozzleTemperature",
    "bedTemperature",
    "nozzleDiameter",
    "filamentDiameter",
    "bedWidth",
    "bedDepth",
    "height",
    "layerCount",
    "time",
    "filament",
];
/// Lines narrower than this part of the nozzle's bore do not come out even.
const NARROWEST: f64 = 0.6;
/// Written filament is a whole number of these in a millimetre.
const FILAMENT_STEPS: f64 = 1e5;

/// A program for a printer.
#[derive(Clone, Debug, PartialEq)]
pub struct GCode {
    pub text: String,
    /// What was added to the model's coordinates.
    pub shift: Vec3,
    pub warnings: Vec<Warning>,
}

/// G-code in Marlin's dialect: millimetres, absolute positions, relative extrusion, comments that viewers know (`;LAYER:`,
/// `;TYPE:`). The lowest layer lies on the bed.
///
/// In the profile's templates `{nozzleTemperature}`, `{bedTemperature}`, `{nozzleDiameter}`, `{filamentDiameter}`, `{bedWidth}`,
/// `{bedDepth}`, `{height}`, `{layerCount}`, `{time}` (seconds) and `{filament}` (millimetres) are replaced.
///
/// # Errors
/// If and only if a value of the profile is out of range, there is nothing to print, the print does not fit the printer or is off the
/// bed and may not be moved, or a template names something else.
#[inline(never)]
pub fn gcode(paths: &Toolpaths, profile: &PrinterProfile) -> Result<GCode, PrintError> {
    profile.check()?;
    let (shift, is_moved) = place(paths, profile)?;
    let estimate = paths.estimate(profile)?;
    let mut writer = Writer::default();
    header(&mut writer.text, paths, &estimate);
    let start = filled("start", &profile.start, paths, profile, &estimate)?;
    let end = filled("end", &profile.end, paths, profile, &estimate)?;
    let modes = "G21 ; millimetres\nG90 ; absolute positions\nM83 ; relative extrusion\n";
    writer.text.push_str(modes);
    push_lines(&mut writer.text, &start);
    writer.text.push_str(modes);
    // Writing to a string cannot fail, here and below.
    let _ = writeln!(writer.text, "M204 S{}\nM107\nG92 E0", Number(profile.acceleration, 0));
    let count = printed_layers(paths);
    let _ = writeln!(writer.text, ";LAYER_COUNT:{count}");
    for_each_step(paths, profile, shift, &mut |step| writer.step(step));
    push_lines(&mut writer.text, &end);
    writer.text.push_str(";End of Gcode\n");
    // Without a minus before zero.
    let shift = shift + Vec3::ZERO;
    Ok(GCode { text: writer.text, shift, warnings: warnings(paths, profile, is_moved) })
}

fn printed_layers(paths: &Toolpaths) -> usize {
    paths.layers.iter().filter(|layer| !layer.paths.is_empty()).count()
}

/// What to add to the paths' coordinates, and whether they were off the bed.
fn place(paths: &Toolpaths, profile: &PrinterProfile) -> Result<(Vec3, bool), PrintError> {
    let bounds = bounds(paths);
    if bounds.is_empty() {
        return Err(PrintError::Empty);
    }
    profile.fits(bounds)?;
    let reach = profile.reach();
    let down = Vec3::new(0.0, 0.0, -bounds.min.z);
    let to_center = (reach.center() - bounds.center()).truncate().extend(-bounds.min.z);
    let off = [('x', 0), ('y', 1)].into_iter().find_map(|(axis, k)| {
        let (least, most) = (reach.min[k], reach.max[k]);
        let value = if bounds.min[k] < least - 1e-6 { bounds.min[k] } else { bounds.max[k] };
        (value < least - 1e-6 || value > most + 1e-6).then_some(PrintError::OffBed {
            axis,
            value,
            least,
            most,
        })
    });
    match (profile.placement, off) {
        (Placement::Centered, _) => Ok((to_center, false)),
        (Placement::AsIs, Some(error)) => Err(error),
        (Placement::OnBed, Some(_)) => Ok((to_center, true)),
        (_, None) => Ok((down, false)),
    }
}

/// All that the lines cover.
fn bounds(paths: &Toolpaths) -> Aabb {
    let mut bounds = Aabb::around([]);
    for layer in &paths.layers {
        for path in &layer.paths {
            let half = Vec2::splat(0.5 * path.width);
            for p in &path.points {
                bounds = bounds.including((*p - half).extend(layer.z - layer.height));
                bounds = bounds.including((*p + half).extend(layer.z));
            }
        }
    }
    bounds
}

fn warnings(paths: &Toolpaths, profile: &PrinterProfile, is_moved: bool) -> Vec<Warning> {
    let nozzle = profile.nozzle_diameter;
    let high = paths.layers.iter().filter(|l| !l.paths.is_empty() && l.height > nozzle + 1e-9).count();
    let walls = |kind: PathKind| kind != PathKind::ThinWall && kind != PathKind::Gap;
    let all = paths.layers.iter().flat_map(|l| &l.paths);
    let narrow = all.filter(|p| walls(p.kind) && p.width < NARROWEST * nozzle).count();
    let counts = [
        (WarningKind::MovedToBed, usize::from(is_moved)),
        (WarningKind::HighLayers, high),
        (WarningKind::NarrowLines, narrow),
    ];
    let mut warnings = paths.report.warnings();
    warnings.extend(Warning::counted(counts));
    warnings
}

fn header(text: &mut String, paths: &Toolpaths, estimate: &Estimate) {
    let height = paths.layers.iter().find(|l| !l.paths.is_empty()).map_or(0.0, |l| l.height);
    let _ = write!(
        text,
        ";FLAVOR:Marlin\n;TIME:{}\n;Filament used: {}m\n;Layer height: {}\n;Generated with fast-winding {}\n",
        estimate.seconds.round(),
        Number(estimate.filament_length / 1000.0, 5),
        Number(height, 3),
        env!("CARGO_PKG_VERSION"),
    );
}

/// A template with its names replaced. Braces around anything but a name stay as they are.
fn filled(
    template: &'static str,
    text: &str,
    paths: &Toolpaths,
    profile: &PrinterProfile,
    estimate: &Estimate,
) -> Result<String, PrintError> {
    let values = [
        profile.nozzle_temperature,
        profile.bed_temperature,
        profile.nozzle_diameter,
        profile.filament_diameter,
        profile.bed_width,
        profile.bed_depth,
        profile.height,
        printed_layers(paths) as f64,
        estimate.seconds.round(),
        estimate.filament_length,
    ];
    let mut result = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        result.push_str(before);
        let name = after.split_once('}').map(|(name, _)| name);
        match name.filter(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')) {
            Some(name) => {
                let Some(place) = NAMES.iter().position(|known| *known == name) else {
                    return Err(PrintError::Placeholder { template, name: name.to_owned() });
                };
                let _ = write!(result, "{}", Number(values[place], 3));
                rest = &after[name.len() + 1..];
            }
            None => {
                result.push('{');
                rest = after;
            }
        }
    }
    result.push_str(rest);
    Ok(result)
}

fn push_lines(text: &mut String, lines: &str) {
    text.push_str(lines);
    if !lines.is_empty() && !lines.ends_with('\n') {
        text.push('\n');
    }
}

/// What viewers call the kinds of lines: the words of Cura.
fn type_of(kind: PathKind) -> &'static str {
    match kind {
        PathKind::OuterWall | PathKind::ThinWall | PathKind::Overhang => "WALL-OUTER",
        PathKind::InnerWall | PathKind::Gap => "WALL-INNER",
        PathKind::Bottom | PathKind::Top | PathKind::Solid | PathKind::Bridge => "SKIN",
        PathKind::Infill => "FILL",
    }
}

/// Where the printer is, as it was told.
#[derive(Default)]
struct Writer {
    text: String,
    at: Option<[i64; 3]>,
    /// Millimetres a minute.
    feed: f64,
    kind: &'static str,
    width: f64,
    /// Filament not written yet: what rounding left.
    owed: f64,
}

impl Writer {
    fn step(&mut self, step: Step) {
        match step {
            Step::Layer { number, z, height } => {
                (self.kind, self.width) = ("", 0.0);
                let _ = writeln!(
                    self.text,
                    ";LAYER:{number}\n;Z:{}\n;HEIGHT:{}",
                    Number(z, 3),
                    Number(height, 3)
                );
            }
            Step::Feature { kind, width } => {
                if self.kind != type_of(kind) {
                    self.kind = type_of(kind);
                    let _ = writeln!(self.text, ";TYPE:{}", self.kind);
                }
                if self.width != width {
                    self.width = width;
                    let _ = writeln!(self.text, ";WIDTH:{}", Number(width, 3));
                }
            }
            Step::Fan(speed) => {
                let _ = writeln!(self.text, "M106 S{}", Number(255.0 * speed, 0));
            }
            Step::Travel { to, speed } => self.travel(to, speed),
            Step::Filament { length, speed } => {
                self.text.push_str("G1");
                self.filament(length);
                self.feed(speed);
                self.text.push('\n');
            }
            Step::Extrude { to, filament, speed } => {
                self.text.push_str("G1");
                self.place([Some(to.x), Some(to.y), None]);
                self.filament(filament);
                self.feed(speed);
                self.text.push('\n');
            }
        }
    }

    fn travel(&mut self, to: Vec3, speed: f64) {
        let places = if self.at.is_none() {
            vec![[None, None, Some(to.z)], [Some(to.x), Some(to.y), None]]
        } else {
            vec![[Some(to.x), Some(to.y), Some(to.z)]]
        };
        for place in places {
            self.text.push_str("G0");
            self.feed(speed);
            self.place(place);
            self.text.push('\n');
        }
    }

    /// Writes the coordinates that change, in micrometres.
    fn place(&mut self, to: [Option<f64>; 3]) {
        let before = self.at.unwrap_or([i64::MIN; 3]);
        let mut at = before;
        for (k, axis) in ['X', 'Y', 'Z'].into_iter().enumerate() {
            let Some(value) = to[k] else { continue };
            at[k] = (1000.0 * value).round() as i64;
            if at[k] != before[k] {
                let _ = write!(self.text, " {axis}{}", Number(at[k] as f64 / 1000.0, 3));
            }
        }
        self.at = Some(at);
    }

    /// What is rounded off is added to the next.
    fn filament(&mut self, length: f64) {
        let steps = ((length + self.owed) * FILAMENT_STEPS).round();
        self.owed += length - steps / FILAMENT_STEPS;
        let _ = write!(self.text, " E{}", Number(steps / FILAMENT_STEPS, 5));
    }

    fn feed(&mut self, speed: f64) {
        let feed = (60.0 * speed).round().max(1.0);
        if feed != self.feed {
            self.feed = feed;
            let _ = write!(self.text, " F{}", Number(feed, 0));
        }
    }
}

/// A number with so many decimals at most, without zeros at their end or a minus before zero.
struct Number(f64, usize);

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let scale = 10_f64.powi(self.1 as i32);
        let mut digits = (self.0.abs() * scale).round() as u64;
        if self.0 < 0.0 && digits > 0 {
            f.write_char('-')?;
        }
        let mut places = self.1;
        while places > 0 && digits.is_multiple_of(10) {
            digits /= 10;
            places -= 1;
        }
        let unit = 10_u64.pow(places as u32);
        if places == 0 {
            write!(f, "{digits}")
        } else {
            write!(f, "{}.{:0places$}", digits / unit, digits % unit)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        let text = |x: f64, places: usize| Number(x, places).to_string();
        assert_eq!(text(12.3, 3), "12.3");
        assert_eq!(text(-0.0004, 3), "0");
        assert_eq!(text(-1.0005, 3), "-1.001");
        assert_eq!(text(0.01234, 5), "0.01234");
        assert_eq!(text(9000.0, 0), "9000");
        assert_eq!(text(100.0, 3), "100");
    }
}
