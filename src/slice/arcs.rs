//! Smooth parts of a contour, where the surface is missing: the level curve followed from end to end.
//!
//! A step looks for the place on a circle around the last point where the inside begins, so that every vertex is a root; it is
//! halved until the level curve is as near to the chord as asked.
use super::kept::Directed;
use super::plane::Plane;
use crate::math::{Vec2, orient};
use std::f64::consts::{PI, TAU};

/// How far the level curve may lie off its chords, in sizes of the section.
const TOLERANCE: f64 = 5e-5;
/// The longest step, in sizes.
const LONGEST: f64 = 1.0 / 64.0;
/// The shortest step, in the distance at which sides of pieces are looked at.
const SHORTEST: f64 = 64.0;
/// In shortest steps: an end this near is reached.
const NEAR: f64 = 8.0;
/// Within the tolerance an end is reached if all others are this many times as far.
const ALONE: f64 = 16.0;
/// Places on the circle around the end of a path where an arc may start.
const AROUND: usize = 40;
/// Angles to both sides of a part that ends at the middle of a circle at which it is looked at besides.
const BESIDE: [f64; 4] = [1e-5, 3e-4, 5e-3, 0.04];
/// Steps to a root on a circle.
const MOST_ROOT_STEPS: usize = 160;
/// Differences from the threshold that are none.
const FLAT: f64 = 1e-8;
/// Angles to both sides of the last step in which the next is looked for.
const TURNS: [f64; 4] = [0.05, 0.35, 1.0, 2.2];
/// Steps of an arc.
const MOST_STEPS: usize = 1_000;

/// A level curve between two ends of the section.
pub(super) struct Arc {
    /// After the start; the last is the end.
    pub points: Vec<Vec2>,
    pub end: Vec2,
}

/// An angle on a circle, and how far inside the field is there.
#[derive(Clone, Copy)]
struct End {
    angle: f64,
    depth: f64,
}

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

    /// The level curves from a point where `count` more kept parts end than start, each to one of the points where they start: their
    /// points after the first, and the number of that end. None if some do not come to one.
    pub fn departing_from(&self, start: Vec2, count: usize, ends: &[Vec2]) -> Option<Vec<Arc>> {
        let clear = ends.iter().map(|e| e.distance(start)).fold(LONGEST * self.plane.size, f64::min);
        let mut radius = 0.25 * clear;
        while radius > self.shortest() {
            // As many as there have to be: on a large circle others come in between.
            let departures = self.departures(start, radius);
            if departures.len() == count {
                let mut left = ends.to_vec();
                let arcs: Option<Vec<Arc>> =
                    departures.iter().map(|d| self.follow_from(start, *d, radius, &mut left)).collect();
                if arcs.is_some() {
                    return arcs;
                }
            }
            radius *= 0.125;
        }
        None
    }

    /// Takes the end that it comes to from those that are left.
    fn follow_from(&self, start: Vec2, direction: Vec2, radius: f64, left: &mut Vec<Vec2>) -> Option<Arc> {
        let first = start + radius * direction;
        let (mut points, end) = self.follow(first, direction, radius, left, None)?;
        points.insert(0, first);
        Some(Arc { points, end: left.swap_remove(end) })
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
        let mut angles: Vec<f64> =
            (0..AROUND).map(|k| TAU * (k as f64 + 0.37) / AROUND as f64 - PI).collect();
        // Next to parts that end there the level curve may be nearly as steep as they are.
        for [a, b] in self.kept.iter().filter(|part| part[0] == center || part[1] == center) {
            let along = (if *a == center { *b - *a } else { *a - *b }).to_angle();
            let aside = BESIDE.into_iter().flat_map(|turn| [along - turn, along + turn]);
            angles.extend(
                aside.map(|angle| if angle.abs() > PI { angle - TAU.copysign(angle) } else { angle }),
            );
        }
        angles.sort_by(f64::total_cmp);
        angles.push(angles[0] + TAU);
        let circle: Vec<Vec2> =
            angles.iter().map(|angle| center + radius * Vec2::from_angle(*angle)).collect();
        let inside = self.plane.all_inside(&circle);
        let begins = (0..angles.len() - 1).filter(|k| !inside[*k] && inside[k + 1]);
        begins
            .map(|k| {
                let ends = [angles[k], angles[k + 1], angles[k], angles[k + 1]];
                let depths = self.depths(center, radius, ends);
                let [from, to] = [0, 1].map(|i| End { angle: ends[i], depth: depths[i] });
                Vec2::from_angle(self.root(center, radius, from, to))
            })
            .filter(|direction| !self.is_on_section(center + radius * *direction))
            .collect()
    }

    fn depths(&self, center: Vec2, radius: f64, angles: [f64; 4]) -> [f64; 4] {
        self.plane.depths(angles.map(|angle| center + radius * Vec2::from_angle(angle)))
    }

    /// The angle between two, outside and inside, at which the inside begins: by false position with a place on each side of it, and
    /// by halves where the field jumps.
    fn root(&self, center: Vec2, radius: f64, outside: End, inside: End) -> f64 {
        let (mut low, mut high) = (outside, inside);
        let mut beside = 0.02;
        for _ in 0..MOST_ROOT_STEPS {
            let width = high.angle - low.angle;
            if width.abs() * radius < 1e-2 * self.plane.aside {
                break;
            }
            let share = (low.depth / (low.depth - high.depth)).clamp(beside, 1.0 - beside);
            let mut shares = [share - beside, share, share + beside, 0.5];
            shares.sort_by(f64::total_cmp);
            let angles = shares.map(|share| low.angle + share * width);
            let depths = self.depths(center, radius, angles);
            for (angle, depth) in angles.into_iter().zip(depths) {
                if depth.abs() < FLAT {
                    return angle;
                }
                if depth >= 0.0 {
                    high = End { angle, depth };
                    break;
                }
                low = End { angle, depth };
            }
            beside = (0.02 * beside).max(1e-6);
        }
        high.angle
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
        // Of the curve, and the last chord's length: the next one turns by what lies between the middles of both.
        let (mut curvature, mut before) = (0.0f64, step);
        let mut points = Vec::new();
        while points.len() < MOST_STEPS {
            if left.is_some_and(|left| left.distance(at) > 2.5 * step) {
                left = None;
            }
            let distance =
                |k: usize| if left == Some(ends[k]) { f64::INFINITY } else { ends[k].distance(at) };
            let nearest = (0..ends.len()).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
            let to_end = distance(nearest);
            let is_alone = || (0..ends.len()).all(|k| k == nearest || distance(k) > ALONE * to_end);
            if to_end <= NEAR * self.shortest() || to_end <= TOLERANCE * self.plane.size && is_alone() {
                points.push(ends[nearest]);
                return Some((points, nearest));
            }
            // So that no end is stepped over.
            step = step.min(longest).min((0.8 * to_end).max(self.shortest()));
            loop {
                let ahead = heading + (0.5 * curvature * (before + step)).clamp(-0.5, 0.5);
                if let Some(angle) = self.step(at, ahead, step) {
                    let next = at + step * Vec2::from_angle(angle);
                    let is_short = step <= self.shortest();
                    if (is_short || self.is_near_chord(at, next)) && !self.is_crossed(at, next) {
                        points.push(next);
                        let turn = Vec2::from_angle(heading).angle_to(Vec2::from_angle(angle));
                        (curvature, before) = (turn / (0.5 * (before + step)), step);
                        (at, heading) = (next, angle);
                        break;
                    }
                }
                step *= 0.5;
                if step < 0.25 * self.shortest() {
                    // Next to an end the curve may be nearer to a part of the section than a step is long.
                    points.push(ends[nearest]);
                    return (to_end < TOLERANCE * self.plane.size).then_some((points, nearest));
                }
            }
            // A chord of an arc is h²/8r off; a little less than is allowed, as the curvature changes.
            let fitting = (4.0 * TOLERANCE * self.plane.size / curvature.abs()).sqrt();
            step = fitting.clamp(0.5 * step, 2.0 * step);
        }
        None
    }

    /// The angle of the next step of a length.
    fn step(&self, at: Vec2, heading: f64, length: f64) -> Option<f64> {
        let (from, to) = TURNS.into_iter().find_map(|turn| {
            let angles = [heading - turn, heading - 0.2 * turn, heading + 0.2 * turn, heading + turn];
            let depths = self.depths(at, length, angles);
            let end = |k: usize| End { angle: angles[k], depth: depths[k] };
            let begins = (0..3).find(|k| depths[*k] < 0.0 && depths[k + 1] >= 0.0)?;
            (depths[0] < 0.0 && depths[3] >= 0.0).then(|| (end(begins), end(begins + 1)))
        })?;
        let angle = self.root(at, length, from, to);
        let on_section = self.is_on_section(at + length * Vec2::from_angle(angle));
        (!on_section).then_some(if angle > PI { angle - TAU } else { angle })
    }

    /// Whether the level curve is as near to a chord as asked, in its middle.
    fn is_near_chord(&self, from: Vec2, to: Vec2) -> bool {
        let (middle, along) = (0.5 * (from + to), to - from);
        // Next to an end the field changes over shorter distances than the tolerance.
        let aside =
            (TOLERANCE * self.plane.size).min(0.1 * along.length()) * along.normalize_or_zero().perp();
        let [left, right, ..] =
            self.plane.depths([middle + aside, middle - aside, middle + aside, middle - aside]);
        left >= 0.0 && right < 0.0
    }
}
