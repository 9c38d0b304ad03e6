//! Lines of the field, followed from the surface outward: section 7.6.
use super::ElectricField;
use super::cells::Cells;
use super::lines::{FieldLines, Integrator, LineConfig, LineError};
use crate::bvh::along_curve;
use crate::data::{Monitor, map_tasks};
use crate::math::{Aabb, Vec3};
use std::ops::RangeInclusive;

/// Blocks of lines between two reports to the monitor.
const BLOCKS_PER_REPORT: usize = 8;
/// Steps get no shorter than this share of the whole one.
const SHORTEST: f64 = 1.0 / 16.0;
/// All steps lead this share of the diagonal away, if not told otherwise.
const REACH: f64 = 0.1;
const OFFSET: f64 = 0.1;
/// Lines that are followed together: more share more cubes, fewer keep more threads busy.
const TOGETHER: RangeInclusive<usize> = 256..=1024;
/// All lines are in as many parts, if those are neither too small nor too large.
const PARTS: usize = 16;
/// Fewer lines are followed without cubes.
const LEAST_IN_CUBES: usize = 32;
/// The edges of the smallest cubes are so many spacings of lines, or so many steps, whichever is more.
const SPACINGS_IN_CUBE: f64 = 1.6;
const STEPS_IN_CUBE: f64 = 6.4;

/// Whether line `.0` ends with the segment from `.1` to `.2`.
pub type Stop<'a> = &'a (dyn Fn(usize, Vec3, Vec3) -> bool + Sync);

/// The lines of the field from `starts`, points of the surface, into the half-spaces of `directions` (normals of any length).
///
/// A line begins with its start; where the field leads back through the surface at its second point, as beside a one-sided or
/// noisy soup, it first follows its direction.
///
/// # Errors
/// If and only if there is not one direction for each start, one is not finite, [`LineConfig::check`] refuses the configuration,
/// the lines have too many points, or `monitor` cancels.
pub fn trace(
    field: &ElectricField,
    starts: &[Vec3],
    directions: &[Vec3],
    config: &LineConfig,
    monitor: &dyn Monitor,
) -> Result<FieldLines, LineError> {
    trace_until(field, starts, directions, config, &|_, _, _| false, monitor)
}

/// [`trace`], with lines that also end as soon as `stop` says so: such as when they have met what they were to meet.
///
/// # Errors
/// Those of [`trace`].
pub fn trace_until(
    field: &ElectricField,
    starts: &[Vec3],
    directions: &[Vec3],
    config: &LineConfig,
    stop: Stop,
    monitor: &dyn Monitor,
) -> Result<FieldLines, LineError> {
    if starts.len() != directions.len() {
        return Err(LineError::Lengths { starts: starts.len(), directions: directions.len() });
    }
    if let Some(k) = (0..starts.len()).find(|k| !(starts[*k].is_finite() && directions[*k].is_finite())) {
        return Err(LineError::NonFinite(k));
    }
    config.check()?;
    let diagonal = field.soup().bounds().diagonal();
    let step = config.step.unwrap_or(REACH * diagonal / config.steps.max(1) as f64);
    let offset = config.start_offset.unwrap_or(OFFSET * step);
    if !(step > 0.0 && step.is_finite()) {
        return Err(LineError::BadLength { name: "step", value: step });
    }
    let order = along_curve(starts);
    let together = (starts.len() / PARTS).clamp(*TOGETHER.start(), *TOGETHER.end());
    let blocks: Vec<&[u32]> = order.chunks(together).collect();
    let tracer = Tracer { field, config, step, offset, stop };
    let mut lines = vec![Vec::new(); starts.len()];
    for (n, some) in blocks.chunks(BLOCKS_PER_REPORT).enumerate() {
        monitor.report((n * BLOCKS_PER_REPORT) as f64 / blocks.len() as f64, "field lines")?;
        let found = map_tasks(some.len(), |k| {
            let place = |list: &[Vec3]| some[k].iter().map(|i| list[*i as usize]).collect::<Vec<Vec3>>();
            tracer.block(some[k], &place(starts), &place(directions))
        });
        some.iter().zip(found).for_each(|(block, found)| {
            block.iter().zip(found).for_each(|(line, points)| lines[*line as usize] = points);
        });
    }
    monitor.report(1.0, "field lines")?;
    let points = lines.iter().map(Vec::len).sum::<usize>();
    if u32::try_from(points).is_err() {
        return Err(LineError::TooManyPoints { points });
    }
    let mut all =
        FieldLines { points: Vec::with_capacity(points), offsets: Vec::with_capacity(starts.len() + 1) };
    lines.iter().for_each(|line| all.push(line));
    Ok(all)
}

struct Tracer<'a> {
    field: &'a ElectricField,
    config: &'a LineConfig,
    step: f64,
    offset: f64,
    stop: Stop<'a>,
}

/// A line while it is followed.
struct Line {
    number: usize,
    points: Vec<Vec3>,
    /// Where the field led at its last point.
    direction: Vec3,
    /// How far it is still to go, and the next step: in whole steps, so that no length is too large or small to be counted.
    rest: f64,
    share: f64,
}

impl Line {
    fn end(&self) -> Vec3 {
        *self.points.last().expect("a line has a start")
    }
}

impl Tracer<'_> {
    /// Lines that begin close together: they are asked for together at each step.
    fn block(&self, numbers: &[u32], starts: &[Vec3], directions: &[Vec3]) -> Vec<Vec<Vec3>> {
        let mut cells = self.cells(starts);
        let mut lines: Vec<Line> = (0..starts.len())
            .map(|k| {
                let direction = directions[k].normalize_or_zero();
                let points = vec![starts[k], starts[k] + self.offset * direction];
                let rest = self.config.steps as f64;
                Line { number: numbers[k] as usize, points, direction, rest, share: 1.0 }
            })
            .collect();
        // Which lines go on. Half a step may be lost to rounding, no more.
        let mut open: Vec<usize> =
            (0..lines.len()).filter(|k| self.config.steps > 0 && directions[*k] != Vec3::ZERO).collect();
        let mut is_first = true;
        while !open.is_empty() {
            let at: Vec<Vec3> = open.iter().map(|k| lines[*k].end()).collect();
            let mut fields = self.directions(&at, &mut cells);
            if is_first {
                for (field, k) in fields.iter_mut().zip(&open) {
                    if field.dot(lines[*k].direction) <= 0.0 {
                        *field = lines[*k].direction;
                    }
                }
                is_first = false;
            }
            if self.config.integrator == Integrator::Midpoint {
                let steps = open.iter().zip(&fields).zip(&at);
                let middles: Vec<Vec3> =
                    steps.map(|((k, field), at)| *at + 0.5 * lines[*k].share * self.step * *field).collect();
                let ahead = self.directions(&middles, &mut cells);
                // A charged surface between turns the field round: what leads to it is the field on this side.
                for (field, ahead) in fields.iter_mut().zip(ahead) {
                    if field.dot(ahead) >= 0.0 {
                        *field = ahead;
                    }
                }
            }
            let mut fields = fields.iter();
            open.retain(|k| self.advance(&mut lines[*k], *fields.next().expect("one for each line")));
        }
        lines.into_iter().map(|line| line.points).collect()
    }

    /// Cubes that are asked often enough: they hold some lines, and some steps of each.
    fn cells(&self, starts: &[Vec3]) -> Cells {
        let spacing = Aabb::around(starts.iter().copied()).diagonal() / (starts.len() as f64).sqrt();
        let is_worth = starts.len() >= LEAST_IN_CUBES;
        self.field.cells(if is_worth {
            (SPACINGS_IN_CUBE * spacing).max(STEPS_IN_CUBE * self.step)
        } else {
            f64::INFINITY
        })
    }

    fn directions(&self, points: &[Vec3], cells: &mut Cells) -> Vec<Vec3> {
        self.field.at_moving(points, cells).into_iter().map(|(_, field)| field.normalize_or_zero()).collect()
    }

    /// Adds a point to a line; whether it goes on from there.
    fn advance(&self, line: &mut Line, direction: Vec3) -> bool {
        let from = line.end();
        let to = from + line.share * self.step * direction;
        if direction == Vec3::ZERO || !to.is_finite() {
            return false;
        }
        line.points.push(to);
        line.rest -= line.share;
        if let Some(largest) = self.config.largest_turn {
            let turn = line.direction.angle_between(direction);
            let wanted = line.share * (largest / turn.max(1e-3 * largest)).clamp(0.5, 2.0);
            line.share = wanted.clamp(SHORTEST, 1.0);
        }
        line.direction = direction;
        let is_inside = self.config.bounds.is_none_or(|bounds| bounds.contains(to));
        let has_way = line.rest > 0.5 * SHORTEST;
        line.share = line.share.min(line.rest);
        has_way && is_inside && !(self.stop)(line.number, from, to)
    }
}
