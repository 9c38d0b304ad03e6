//! What a printer does, one move after the other: G-code writes it down, estimates time it.
use super::path::{Approach, Path, PathKind, Toolpaths};
use super::profile::{PrinterProfile, Speeds};
use crate::math::{Vec2, Vec3};
use std::f64::consts::PI;

/// Ways shorter than this, in millimetres, are none: G-code is written to micrometres.
pub(super) const SHORTEST: f64 = 5e-4;

/// One thing after the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    /// A layer begins, the first is 0.
    Layer {
        number: usize,
        z: f64,
        height: f64,
    },
    /// Lines of another kind or width begin.
    Feature {
        kind: PathKind,
        width: f64,
    },
    /// Share of the fan's full speed.
    Fan(f64),
    Travel {
        to: Vec3,
        speed: f64,
    },
    /// Filament drawn back, where negative, or pushed, in millimetres.
    Filament {
        length: f64,
        speed: f64,
    },
    /// A line, and millimetres of filament for it.
    Extrude {
        to: Vec2,
        filament: f64,
        speed: f64,
    },
}

impl PrinterProfile {
    /// Square millimetres.
    pub(super) fn filament_area(&self) -> f64 {
        0.25 * PI * self.filament_diameter * self.filament_diameter
    }
}

impl Speeds {
    fn of(&self, kind: PathKind) -> f64 {
        match kind {
            PathKind::OuterWall | PathKind::ThinWall => self.outer_wall,
            PathKind::InnerWall | PathKind::Gap => self.inner_wall,
            PathKind::Overhang => self.overhang,
            PathKind::Bottom | PathKind::Solid => self.solid,
            PathKind::Top => self.top,
            PathKind::Bridge => self.bridge,
            PathKind::Infill => self.infill,
        }
    }
}

/// Calls `step` for all that a print takes, moved by `shift`.
pub(super) fn for_each_step(
    paths: &Toolpaths,
    profile: &PrinterProfile,
    shift: Vec3,
    step: &mut dyn FnMut(Step),
) {
    let mut at: Option<Vec2> = None;
    let shift_2d = shift.truncate();
    for (number, layer) in paths.layers.iter().filter(|layer| !layer.paths.is_empty()).enumerate() {
        let z = layer.z + shift.z;
        step(Step::Layer { number, z, height: layer.height });
        let mut feature = None;
        if number == 1 && profile.fan > 0.0 {
            step(Step::Fan(profile.fan));
        }
        let mut is_new_layer = true;
        for path in &layer.paths {
            let Some(start) = path.points.first().map(|p| *p + shift_2d) else { continue };
            travel(at, (start, path.approach), z, is_new_layer, profile, step);
            is_new_layer = false;
            if feature != Some((path.kind, path.width)) {
                feature = Some((path.kind, path.width));
                step(Step::Feature { kind: path.kind, width: path.width });
            }
            let first_speed = profile.speeds.first_layer;
            let speed = if number == 0 { first_speed } else { profile.speeds.of(path.kind) };
            let section = path.width * layer.height / profile.filament_area();
            at = Some(extrude(path, start, shift_2d, |to, length| {
                step(Step::Extrude { to, filament: section * length, speed });
            }));
        }
    }
}

/// To the start of a path, with the filament drawn back where it is far.
fn travel(
    from: Option<Vec2>,
    (to, approach): (Vec2, Approach),
    z: f64,
    is_new_layer: bool,
    profile: &PrinterProfile,
    step: &mut dyn FnMut(Step),
) {
    let speed = profile.speeds.travel;
    let Some(from) = from else {
        // Up first: wherever the start template has left it, the nozzle must not scratch the bed.
        step(Step::Travel { to: to.extend(z), speed });
        return;
    };
    let distance = from.distance(to);
    let retraction = &profile.retraction;
    let is_seen = approach == Approach::Across || is_new_layer;
    let draws_back = is_seen && distance >= retraction.minimum_travel && retraction.length > 0.0;
    let lift = if draws_back { retraction.lift.min(profile.height - z).max(0.0) } else { 0.0 };
    if draws_back {
        step(Step::Filament { length: -retraction.length, speed: retraction.speed });
    }
    if is_new_layer || lift > 0.0 {
        step(Step::Travel { to: from.extend(z + lift), speed });
    }
    if distance > SHORTEST {
        step(Step::Travel { to: to.extend(z + lift), speed });
    }
    if lift > 0.0 {
        step(Step::Travel { to: to.extend(z), speed });
    }
    if draws_back {
        step(Step::Filament { length: retraction.length, speed: retraction.speed });
    }
}

/// Calls `line` for each line of a path with its end and length; gives where the path ends. What is too short for a move of its
/// own is added to the next.
fn extrude(path: &Path, start: Vec2, shift: Vec2, mut line: impl FnMut(Vec2, f64)) -> Vec2 {
    let closing = path.points.first().filter(|_| path.closed);
    let count = path.points.len() - 1 + usize::from(path.closed);
    let (mut before, mut at, mut length) = (start, start, 0.0);
    for (k, point) in path.points.iter().skip(1).chain(closing).enumerate() {
        let to = *point + shift;
        length += before.distance(to);
        before = to;
        if at.distance(to) > SHORTEST || k + 1 == count && length > 0.0 {
            line(to, length);
            (at, length) = (to, 0.0);
        }
    }
    at
}
