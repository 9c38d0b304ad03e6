use super::motion::{Step, for_each_step};
use super::path::Toolpaths;
use super::profile::PrinterProfile;
use super::{PrintError, ProfileError};
use crate::math::Vec3;
use serde::Serialize;

/// What a print takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Estimate {
    /// Without heating. Moves speed up and slow down at the profile's acceleration; they take corners as fast as Marlin's junction
    /// deviation allows.
    pub seconds: f64,
    /// Millimetres.
    pub filament_length: f64,
    /// Cubic millimetres.
    pub filament_volume: f64,
    /// Grams.
    pub filament_mass: f64,
    /// Millimetres of lines.
    pub extruded_length: f64,
    /// Millimetres that the nozzle moves without laying anything.
    pub travel_length: f64,
    pub retractions: usize,
}

impl Toolpaths {
    /// Time and filament that a printer takes for them.
    ///
    /// # Errors
    /// If and only if a value of the profile is out of range.
    #[inline(never)]
    pub fn estimate(&self, profile: &PrinterProfile) -> Result<Estimate, PrintError> {
        profile.check().map_err(|error: ProfileError| PrintError::Profile(error))?;
        let mut estimate = Estimate::default();
        let mut planner = Planner {
            acceleration: profile.acceleration,
            deviation: profile.junction_deviation,
            moves: Vec::new(),
            seconds: 0.0,
        };
        let mut at: Option<Vec3> = None;
        for_each_step(self, profile, Vec3::ZERO, &mut |step| match step {
            Step::Layer { .. } => planner.stop(),
            Step::Feature { .. } | Step::Fan(_) => {}
            Step::Travel { to, speed } => {
                // How the nozzle gets to the first line is not known.
                let way = at.map_or(Vec3::ZERO, |at| to - at);
                estimate.travel_length += way.length();
                planner.add(way, speed);
                at = Some(to);
            }
            Step::Filament { length, speed } => {
                estimate.retractions += usize::from(length < 0.0);
                planner.stop();
                planner.add(Vec3::new(length.abs(), 0.0, 0.0), speed);
                planner.stop();
            }
            Step::Extrude { to, filament, speed } => {
                let before = at.unwrap_or_default();
                let to = to.extend(before.z);
                estimate.extruded_length += before.distance(to);
                estimate.filament_length += filament;
                planner.add(to - before, speed);
                at = Some(to);
            }
        });
        planner.stop();
        estimate.seconds = planner.seconds;
        estimate.filament_volume = estimate.filament_length * profile.filament_area();
        estimate.filament_mass = 1e-3 * estimate.filament_volume * profile.filament_density;
        Ok(estimate)
    }
}

/// Moves from one stop to the next.
struct Planner {
    acceleration: f64,
    deviation: f64,
    moves: Vec<Move>,
    seconds: f64,
}

struct Move {
    direction: Vec3,
    length: f64,
    speed: f64,
    /// The largest square of the speed at its start.
    entry: f64,
}

impl Planner {
    fn add(&mut self, way: Vec3, speed: f64) {
        let length = way.length();
        if length == 0.0 {
            return;
        }
        let direction = way / length;
        let entry = self.moves.last().map_or(0.0, |before| {
            let corner = self.corner(before.direction.dot(direction));
            corner.min(speed * speed).min(before.speed * before.speed)
        });
        self.moves.push(Move { direction, length, speed, entry });
    }

    /// The square of the speed on a circle that touches both ways and passes the corner at the deviation.
    fn corner(&self, cosine: f64) -> f64 {
        let half_sine = (0.5 * (1.0 + cosine).max(0.0)).sqrt();
        if half_sine > 1.0 - 1e-9 {
            return f64::INFINITY;
        }
        self.acceleration * self.deviation * half_sine / (1.0 - half_sine)
    }

    /// Times what has come, which ends in a stop.
    fn stop(&mut self) {
        let twice = 2.0 * self.acceleration;
        let mut next = 0.0;
        for step in self.moves.iter_mut().rev() {
            step.entry = step.entry.min(next + twice * step.length);
            next = step.entry;
        }
        let mut entry: f64 = 0.0;
        for k in 0..self.moves.len() {
            let Move { length, speed, .. } = self.moves[k];
            let wanted = self.moves.get(k + 1).map_or(0.0, |next| next.entry);
            let exit = wanted.min(entry + twice * length);
            self.seconds += trapezoid(entry, exit, speed, length, self.acceleration);
            entry = exit;
        }
        self.moves.clear();
    }
}

/// Time of a way with the squares of the speeds at its ends, and the speed it is taken at between if it is long enough.
fn trapezoid(entry: f64, exit: f64, speed: f64, length: f64, acceleration: f64) -> f64 {
    let peak = (0.5 * (entry + exit) + acceleration * length).min(speed * speed).max(entry).max(exit);
    let top = peak.sqrt();
    let ramps = (2.0 * peak - entry - exit) / (2.0 * acceleration);
    let changing = (2.0 * top - entry.sqrt() - exit.sqrt()) / acceleration;
    changing + (length - ramps).max(0.0) / top
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planner() -> Planner {
        Planner { acceleration: 1000.0, deviation: 0.02, moves: Vec::new(), seconds: 0.0 }
    }

    #[test]
    fn a_long_way_has_two_ramps() {
        let mut planner = planner();
        planner.add(Vec3::new(100.0, 0.0, 0.0), 50.0);
        planner.stop();
        // 100 mm at 50 mm/s, and for the ramps once more half of 50 mm/s over 1,000 mm/s² each.
        assert!((planner.seconds - (2.0 + 0.05)).abs() < 1e-12, "{}", planner.seconds);
    }

    #[test]
    fn a_short_way_never_gets_to_its_speed() {
        let mut planner = planner();
        planner.add(Vec3::new(1.0, 0.0, 0.0), 1000.0);
        planner.stop();
        assert!((planner.seconds - 2.0 * (1.0_f64 / 1000.0).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_straight_way_in_pieces_takes_as_long_as_whole() {
        let mut planner = planner();
        (0..100).for_each(|_| planner.add(Vec3::new(1.0, 0.0, 0.0), 50.0));
        planner.stop();
        assert!((planner.seconds - 2.05).abs() < 1e-9);
    }

    #[test]
    fn corners_take_time() {
        let mut there_and_back = planner();
        there_and_back.add(Vec3::new(50.0, 0.0, 0.0), 50.0);
        there_and_back.add(Vec3::new(-50.0, 0.0, 0.0), 50.0);
        there_and_back.stop();
        assert!((there_and_back.seconds - 2.1).abs() < 1e-9);
        let mut square = planner();
        square.add(Vec3::new(50.0, 0.0, 0.0), 50.0);
        square.add(Vec3::new(0.0, 50.0, 0.0), 50.0);
        square.stop();
        assert!((2.06..2.1).contains(&square.seconds), "{}", square.seconds);
    }
}
