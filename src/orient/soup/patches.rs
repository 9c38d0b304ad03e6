//! Pieces of a soup in which each face says how the others run.
use crate::data::{LeftOut, Topology, TriangleSoup};
use crate::math::{area_vector, signed_volume};
use crate::winding::weld;

pub struct Patch {
    /// In ascending order.
    pub faces: Vec<u32>,
    /// Sums of the areas of the faces up to each.
    pub area_to: Vec<f64>,
    pub is_closed: bool,
    pub is_orientable: bool,
    /// What the faces enclose when all run as most of the area does.
    pub volume: f64,
    /// The share of the area that runs as most of it does.
    pub agreement: f64,
}

impl Patch {
    pub fn area(&self) -> f64 {
        self.area_to.last().copied().unwrap_or(0.0)
    }
}

/// All patches, by their first faces. Copies of faces belong to the patch of the first.
pub struct Patches {
    pub list: Vec<Patch>,
    topology: Topology,
    /// Of each patch, whether its first face runs against most of the area.
    is_first_against: Vec<bool>,
}

impl Patches {
    pub fn new(soup: &TriangleSoup) -> Patches {
        let topology = Topology::new(soup.triangles(), &weld(soup.positions()), LeftOut::AllCopies);
        let count = topology.is_orientable.len();
        let empty = |is_orientable: &bool| Patch {
            faces: Vec::new(),
            area_to: Vec::new(),
            is_closed: true,
            is_orientable: *is_orientable,
            volume: 0.0,
            agreement: 1.0,
        };
        let mut list: Vec<Patch> = topology.is_orientable.iter().map(empty).collect();
        let mut areas = vec![[0.0; 2]; count];
        let anchor = soup.bounds().center();
        for t in (0..soup.len()).filter(|t| topology.is_kept(*t)) {
            let number = topology.shells[t] as usize;
            let patch = &mut list[number];
            let area = area_vector(soup.corners(t)).length();
            patch.area_to.push(patch.area() + area);
            patch.faces.push(t as u32);
            areas[number][usize::from(topology.is_turned[t])] += area;
            let volume = signed_volume(soup.corners(t), anchor);
            patch.volume += if topology.is_turned[t] { -volume } else { volume };
            let is_joined = |side: usize| topology.joined[3 * t + side] != Topology::NONE;
            patch.is_closed &= (0..3).all(is_joined) && patch.is_orientable;
        }
        let mut is_first_against = vec![false; count];
        for (number, patch) in list.iter_mut().enumerate() {
            let [with, against] = areas[number];
            is_first_against[number] = against > with;
            if is_first_against[number] {
                patch.volume = -patch.volume;
            }
            patch.agreement = if with + against > 0.0 { with.max(against) / (with + against) } else { 1.0 };
        }
        Patches { list, topology, is_first_against }
    }

    /// Whether a face counts for rays: copies do not.
    pub fn is_kept(&self, face: usize) -> bool {
        self.topology.is_kept(face)
    }

    /// The patch of a face that has one.
    pub fn of_face(&self, face: usize) -> usize {
        let first = self.topology.first_copies[face] as usize;
        self.topology.shells[first] as usize
    }

    /// Whether a face runs against most of the area of its patch; of a copy, whether the first does, so that it turns with that.
    /// None for faces with two corners in one place.
    pub fn is_against_most(&self, face: usize) -> Option<bool> {
        let first = self.topology.first_copies[face];
        (first != Topology::COLLAPSED)
            .then(|| self.topology.is_turned[first as usize] ^ self.is_first_against[self.of_face(face)])
    }
}
