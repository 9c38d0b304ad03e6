use crate::data::Silent;
use crate::math::{Aabb, Vec2};
use crate::winding::{Accuracy, Scratch, WindingField};
use std::cell::RefCell;

/// A plane through a field, and what counts as inside there.
pub(super) struct Plane<'a> {
    field: &'a WindingField,
    pub z: f64,
    pub region: Region,
    /// The longer side of the bounds in the plane.
    pub size: f64,
    /// How far from a piece of the section its sides are looked at.
    pub aside: f64,
    scratch: RefCell<Scratch>,
}

/// Which winding numbers are inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Region {
    /// This much or more.
    AtLeast(f64),
    /// Less than this.
    Below(f64),
}

impl Region {
    /// Where it begins or ends.
    pub fn level(self) -> f64 {
        let (Region::AtLeast(level) | Region::Below(level)) = self;
        level
    }

    /// Whether it holds what is at its level or above it, rather than what is below.
    pub fn is_upward(self) -> bool {
        matches!(self, Region::AtLeast(_))
    }
}

/// Share of the size, and of a hundredth of the coordinates.
const TINY: f64 = 1e-10;

/// Far above the rounding of coordinates within bounds, far below anything that is meant.
pub(super) fn tiny(bounds: Aabb) -> f64 {
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    TINY * bounds.size().max_element().max(1e-2 * largest)
}

impl<'a> Plane<'a> {
    pub fn new(field: &'a WindingField, z: f64, region: Region) -> Plane<'a> {
        let bounds = field.bounds();
        let size = bounds.size().truncate().max_element();
        Plane { field, z, region, size, aside: tiny(bounds), scratch: RefCell::default() }
    }

    pub fn is_inside(&self, p: Vec2) -> bool {
        let mut scratch = self.scratch.borrow_mut();
        self.field.exceeds(p.extend(self.z), self.region.level(), &mut scratch) == self.region.is_upward()
    }

    /// How far the field is on the inside's side of the threshold at four points, which cost little more than one.
    pub fn depths(&self, points: [Vec2; 4]) -> [f64; 4] {
        let mut values = [0.0; 4];
        let points = points.map(|p| p.extend(self.z));
        self.field.at_block(&points, &mut values, Accuracy::EXACT, &mut self.scratch.borrow_mut());
        values.map(|w| match self.region {
            Region::AtLeast(level) => w - level,
            Region::Below(level) => level - w,
        })
    }

    pub fn all_inside(&self, points: &[Vec2]) -> Vec<bool> {
        let level = self.region.level();
        let points: Vec<_> = points.iter().map(|p| p.extend(self.z)).collect();
        let singly = |_| {
            let mut scratch = self.scratch.borrow_mut();
            points.iter().map(|q| self.field.exceeds(*q, level, &mut scratch)).collect()
        };
        let above: Vec<bool> = self.field.classify(&points, level, &Silent).unwrap_or_else(singly);
        above.into_iter().map(|above| above == self.region.is_upward()).collect()
    }
}
