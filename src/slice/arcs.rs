//! Smooth parts of a contour, where the surface is missing: the level curve followed from end to end.
//!
//! A step looks for the place on a circle around the last point where the inside begins, so that every vertex is a root; it is
//! halved until the level curve is as near to the chord as asked.
use super::kept::Directed;
use super::plane::Plane;
use crate::math::{Vec2, orient};
use std::f64::consts::{PI, TAU};

/// How far the level curve may lie off its chords, in sizes of the section.
const TOLERANCE: f64 = 2e-5;
/// The longest step, in sizes.
const LONGEST: f64 = 1.0 / 64.0;
/// The shortest step, in the distance at which sides of pieces are looked at.
const SHORTEST: f64 = 64.0;
/// Places on the circle around the end of a path where an arc may start.
const AROUND: usize = 64;
/// Steps of bisection on a circle.
const BISECTIONS: usize = 40;
/// Angles to both sides of the last step in which the next is looked for.
const TURNS: [f64; 3] = [0.35, 1.0, 2.2];
/// Steps of an arc.
const MOST_STEPS: usize = 20_000;

/// Follows arcs.
pub(super) struct Arcs<'a> {
    plane: &'a Plane<'a>,
    /// The parts of the section that bound the inside: no chord crosses them.
    kept: &'a [Directed],
}

impl<'a> Arcs<'a> {
    pub fn new(plane: &'a Plane<'a>, kept: &'a [Directed]) -> Arcs<'a> {
        Arcs { plane, kept }
    }

    fn shortest(&self) -> f64 {
        SHORTEST * self.plane.aside
    }

    /// The level curve from a point where the kept parts end to one of those where they start: its points after the first, and which
    /// of `ends` it comes to. None if it comes to none.
    pub fn from_end(&self, start: Vec2, ends: &[Vec2]) -> Option<(Vec<Vec2>, usize)> {
        let clear = ends.iter().map(|e| e.distance(start)).fold(LONGEST * self.plane.size, f64::min);
        if clear <= self.shortest() {
            let nearest = (0..ends.len()).min_by(|a, b| {
                ends[*a].distance_squared(start).total_cmp(&ends[*b].distance_squared(start))
            })?;
            return Some((vec![ends[nearest]], nearest));
        }
        let mut radius = 0.25 * clear;
        while radius > self.shortest() {
            for direction in self.departures(start, radius) {
                let first = start + radius * direction;
                if let Some((mut points, end)) = self.follow(first, direction, radius, ends, None) {
                    points.insert(0, first);
                    return Some((points, end));
                }
            }
            radius *= 0.125;
        }
        None
    }

    /// A level curve that comes back to a point on it.
    pub fn around(&self, start: Vec2) -> Option<Vec<Vec2>> {
        let radius = LONGEST / 4.0 * self.plane.size;
        let direction = *self.departures(start, radius).first()?;
        let first = start + radius * direction;
        let (mut points, _) = self.follow(first, direction, radius, &[start], Some(start))?;
        points.insert(0, first);
        Some(points)
    }

    /// Directions in which the level curve leaves a point, the inside on its left.
    fn departures(&self, center: Vec2, radius: f64) -> Vec<Vec2> {
        let angle = |k: usize| TAU * (k as f64 + 0.37) / AROUND as f64;
        let circle: Vec<Vec2> = (0..AROUND).map(|k| center + radius * Vec2::from_angle(angle(k))).collect();
        let inside = self.plane.all_inside(&circle);
        let begins = (0..AROUND).filter(|k| !inside[*k] && inside[(k + 1) % AROUND]);
        begins
            .map(|k| Vec2::from_angle(self.root(center, radius, angle(k), angle(k + 1))))
            .filter(|direction| !self.is_on_section(center + radius * *direction))
            .collect()
    }

    /// The angle between two, outside and inside, at which the inside begins.
    fn root(&self, center: Vec2, radius: f64, mut outside: f64, mut inside: f64) -> f64 {
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (outside + inside);
            let is_inside = self.plane.is_inside(center + radius * Vec2::from_angle(middle));
            *(if is_inside { &mut inside } else { &mut outside }) = middle;
        }
        inside
    }

    /// Whether the inside begins at a point because a part of the section runs through it.
    fn is_on_section(&self, p: Vec2) -> bool {
        let reach = 4.0 * self.plane.aside;
        self.kept.iter().any(|[a, b]| {
            let (low, high) = (a.min(*b) - reach, a.max(*b) + reach);
            let near = low.cmple(p).all() && p.cmple(high).all();
            near && {
                let along = *b - *a;
                let share = ((p - *a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                (*a + share * along).distance(p) < reach
            }
        })
    }

    /// Whether a part of the section crosses a chord.
    fn is_crossed(&self, from: Vec2, to: Vec2) -> bool {
        let (low, high) = (from.min(to), from.max(to));
        self.kept.iter().any(|[a, b]| {
            let apart = a.max(*b).cmplt(low).any() || high.cmplt(a.min(*b)).any();
            !apart
                && orient(from, to, *a) * orient(from, to, *b) < 0
                && orient(*a, *b, from) * orient(*a, *b, to) < 0
        })
    }

    /// Follows the level curve until it comes to one of `ends`; `left` is one that it has just left.
    fn follow(
        &self,
        start: Vec2,
        direction: Vec2,
        step: f64,
        ends: &[Vec2],
        mut left: Option<Vec2>,
    ) -> Option<(Vec<Vec2>, usize)> {
        let longest = LONGEST * self.plane.size;
        let (mut at, mut heading, mut step) = (start, direction.to_angle(), step);
        let mut points = Vec::new();
        while points.len() < MOST_STEPS {
            if left.is_some_and(|left| left.distance(at) > 2.5 * step) {
                left = None;
            }
            let distance =
                |k: usize| if left == Some(ends[k]) { f64::INFINITY } else { ends[k].distance(at) };
            let nearest = (0..ends.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
            let to_end = distance(nearest);
            if to_end <= self.shortest() {
                points.push(ends[nearest]);
                return Some((points, nearest));
            }
            // So that no end is stepped over.
            step = step.min(longest).min((0.5 * to_end).max(0.5 * self.shortest()));
            loop {
                if let Some(angle) = self.step(at, heading, step) {
                    let next = at + step * Vec2::from_angle(angle);
                    let is_short = step <= self.shortest();
                    if (is_short || self.is_near_chord(at, next)) && !self.is_crossed(at, next) {
                        points.push(next);
                        (at, heading) = (next, angle);
                        break;
                    }
                }
                step *= 0.5;
                if step < 0.25 * self.shortest() {
                    return None;
                }
            }
            step *= 2.0;
        }
        None
    }

    /// The angle of the next step of a length.
    fn step(&self, at: Vec2, heading: f64, length: f64) -> Option<f64> {
        let inside = |angle: f64| self.plane.is_inside(at + length * Vec2::from_angle(angle));
        let turn = TURNS.into_iter().find(|turn| !inside(heading - turn) && inside(heading + turn))?;
        let angle = self.root(at, length, heading - turn, heading + turn);
        let on_section = self.is_on_section(at + length * Vec2::from_angle(angle));
        (!on_section).then_some(if angle > PI { angle - TAU } else { angle })
    }

    /// Whether the level curve is as near to a chord as asked, in its middle.
    fn is_near_chord(&self, from: Vec2, to: Vec2) -> bool {
        let middle = 0.5 * (from + to);
        let aside = TOLERANCE * self.plane.size * (to - from).normalize_or_zero().perp();
        self.plane.is_inside(middle + aside) && !self.plane.is_inside(middle - aside)
    }
}
