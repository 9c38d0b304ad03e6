//! The clusters of the tree over the elements, and their moments.
use super::elements::Elements;
use super::moments::{Moments, Series};
use crate::bvh::{Child, WIDTH};
use crate::data::{map_items, set_each};
use crate::math::Vec3;

/// Nodes whose moments one task computes.
const NODES_PER_TASK: usize = 64;

/// Where the clusters are: the children of node n are clusters 4n to 4n + 3.
pub struct Clusters {
    /// Middles of their areas.
    pub centers: Vec<Vec3>,
    /// No element of theirs is farther from there.
    pub radii: Vec<f64>,
}

impl Clusters {
    pub fn of(elements: &Elements) -> Clusters {
        let nodes = elements.bvh.nodes();
        let mut sums = vec![(0.0, Vec3::ZERO); WIDTH * nodes.len()];
        for (n, node) in nodes.iter().enumerate().rev() {
            for (k, child) in node.children.into_iter().enumerate() {
                let add = |sum: (f64, Vec3), other: (f64, Vec3)| (sum.0 + other.0, sum.1 + other.1);
                sums[WIDTH * n + k] = match child {
                    Child::Empty => (0.0, Vec3::ZERO),
                    Child::Inner(below) => {
                        let first = WIDTH * below as usize;
                        sums[first..first + WIDTH].iter().copied().fold((0.0, Vec3::ZERO), add)
                    }
                    Child::Leaf { .. } => {
                        let places = elements.bvh.places(child);
                        let part = |i: usize| (elements.areas[i], elements.areas[i] * elements.centers[i]);
                        places.map(part).fold((0.0, Vec3::ZERO), add)
                    }
                };
            }
        }
        let centers: Vec<Vec3> =
            sums.iter().map(|(area, sum)| if *area > 0.0 { *sum / *area } else { Vec3::ZERO }).collect();
        // Of leaves to their farthest corners; else the smaller of what their boxes and their parts tell.
        let mut radii = vec![0.0; centers.len()];
        for c in (0..centers.len()).rev() {
            let (child, bounds) = (nodes[c / WIDTH].children[c % WIDTH], nodes[c / WIDTH].bounds[c % WIDTH]);
            let center = centers[c];
            radii[c] = match child {
                Child::Empty => 0.0,
                Child::Leaf { .. } => {
                    let corners = elements.bvh.places(child).flat_map(|i| elements.corners[i]);
                    corners.map(|corner| corner.distance(center)).fold(0.0, f64::max)
                }
                Child::Inner(below) => {
                    let first = WIDTH * below as usize;
                    let reach = |k: usize| centers[k].distance(center) + radii[k];
                    let by_parts =
                        (first..first + WIDTH).filter(|k| radii[*k] > 0.0).map(reach).fold(0.0, f64::max);
                    by_parts.min((center - bounds.min).max(bounds.max - center).length())
                }
            };
        }
        Clusters { centers, radii }
    }

    /// The series of all clusters about their centres, given the charges of the elements.
    pub fn series(&self, elements: &Elements, own: &[Moments], charges: &[f64]) -> Vec<Series> {
        let bvh = &elements.bvh;
        let mut moments = vec![[Moments::default(); WIDTH]; bvh.nodes().len()];
        for level in bvh.levels().iter().rev() {
            let (upper, lower) = moments.split_at_mut(level.end);
            set_each(&mut upper[level.clone()], NODES_PER_TASK, |offset, slots| {
                let n = level.start + offset;
                for (k, (slot, child)) in slots.iter_mut().zip(bvh.nodes()[n].children).enumerate() {
                    let center = self.centers[WIDTH * n + k];
                    match child {
                        Child::Empty => {}
                        Child::Inner(below) => {
                            let parts = &lower[below as usize - level.end];
                            for (j, part) in parts.iter().enumerate() {
                                slot.add(part, 1.0, self.centers[WIDTH * below as usize + j] - center);
                            }
                        }
                        Child::Leaf { .. } => {
                            for i in bvh.places(child) {
                                slot.add(&own[i], charges[i], elements.centers[i] - center);
                            }
                        }
                    }
                }
            });
        }
        map_items(WIDTH * moments.len(), |c| moments[c / WIDTH][c % WIDTH].series())
    }
}
