//! What is wrong with a soup, and whether it prints.
mod boundary;
mod components;
mod config;
mod crossings;
mod edges;
mod faces;
mod overhangs;
mod report;
mod shells;
mod sides;
mod thickness;
mod verdict;
mod volume;

pub use boundary::boundary_edges;
pub use components::components;
pub use config::{CheckConfig, CheckError};
pub use report::{
    BedFit, Boundary, Bounds, CheckReport, FieldCheck, List, Loop, Overhangs, Rating, Reason, ReasonKind,
    Region, RegionKind, Shell, ShellRole, Thickness, Verdict,
};

use crate::bvh::Bvh;
use crate::data::{LeftOut, Monitor, Parts, Shape, Topology, TriangleSoup, map_items};
use crate::math::{Aabb, Vec3, signed_volume};
use crate::winding::{WindingField, weld};
use components::components_of;
use faces::Face;

/// Most triangles in a leaf of the tree.
const LEAF_SIZE: usize = 4;

/// Looks a soup over: its faces, edges and shells, and what its field makes of it.
///
/// Topology by exact predicates, vertices welded by exact position. The field tells which faces bound the solid {w ≥ 1/2}, so
/// that thickness and overhangs are those of the solid whatever else is there.
///
/// # Errors
/// If and only if the field is that of a cloud, a setting is out of its range, memory does not suffice or `monitor` cancels.
pub fn check(
    field: &WindingField,
    config: &CheckConfig,
    monitor: &dyn Monitor,
) -> Result<CheckReport, CheckError> {
    config.check()?;
    let Shape::Soup(soup) = field.shape() else {
        return Err(CheckError::Cloud { points: field.shape().len() });
    };
    let limit = config.limit;
    let monitor = &Parts::new(monitor);
    let stage = |name: &'static str, from: f64, to: f64| {
        move |fraction: f64, _: &str| monitor.report(from + (to - from) * fraction, name).is_ok()
    };
    monitor.report(0.0, "faces")?;
    let faces = faces::faces(soup);
    let boxes = map_items(soup.len(), |t| Aabb::around(soup.corners(t)));
    let bvh = Bvh::build(&boxes, LEAF_SIZE);
    monitor.report(0.05, "edges")?;
    let welded = weld(soup.positions());
    let topology = Topology::new(soup.triangles(), &welded, LeftOut::Repeated);
    monitor.report(0.15, "self-intersections")?;
    let self_intersections = if config.self_intersections {
        let stage = stage("self-intersections", 0.15, 0.35);
        let (count, list) = crossings::crossings(soup, &faces, &topology.first_copies, &bvh, limit, &stage)?;
        Some(List { count, list })
    } else {
        None
    };
    let samples =
        sides::sample(field, soup, &faces, &bvh, config.samples, &stage("sides of faces", 0.35, 0.6))?;
    let sides = sides::FaceSides::new(&samples, soup.len());
    let found = shells::shells(soup, &topology, &faces, &sides, &bvh);
    let thickness = if config.thickness {
        let wanted = (config.minimum_thickness, limit);
        thickness::thickness(soup, &faces, &bvh, &samples, wanted, &stage("thickness", 0.6, 0.85))?
    } else {
        None
    };
    let overhangs = overhangs::overhangs(soup, &faces, &samples, config.overhang_angle, limit);
    let volume = volume::field_check(field, config.resolution, limit, &stage("volume", 0.85, 1.0))?;
    let mut report = CheckReport {
        self_intersections,
        thickness,
        overhangs,
        field: volume,
        internal_faces: faces_where(soup, limit, |t| sides.is_internal(t)),
        outside_faces: faces_where(soup, limit, |t| sides.is_outside(t) && !found.is_flipped[t]),
        ..of_topology(soup, (&topology, &welded), &faces, found, config)
    };
    report.verdict = verdict::verdict(&report);
    monitor.report(1.0, "check")?;
    Ok(report)
}

fn faces_where(soup: &TriangleSoup, limit: usize, wanted: impl Fn(usize) -> bool) -> List<u32> {
    List::new((0..soup.len()).filter(|t| wanted(*t)).map(|t| t as u32), limit)
}

/// The part of the report that is not about the field.
fn of_topology(
    soup: &TriangleSoup,
    (topology, welded): (&Topology, &[u32]),
    faces: &[Face],
    found: shells::Shells,
    config: &CheckConfig,
) -> CheckReport {
    let limit = config.limit;
    let mut is_used = vec![false; welded.len()];
    let mut is_place = vec![false; welded.len()];
    for vertex in soup.triangles().iter().flatten() {
        is_used[*vertex as usize] = true;
        is_place[welded[*vertex as usize] as usize] = true;
    }
    let count = |flags: &[bool]| flags.iter().filter(|flag| **flag).count();
    let anchor = soup.bounds().center();
    let volume = (0..soup.len()).map(|t| signed_volume(soup.corners(t), anchor)).sum();
    let is_copy = |t: usize| !topology.is_kept(t) && topology.first_copies[t] != Topology::COLLAPSED;
    let mut shells = found.shells;
    let mut flipped_shells: Vec<u32> =
        (0..soup.len()).filter(|t| found.is_flipped[*t]).map(|t| topology.shells[t]).collect();
    flipped_shells.sort_unstable();
    flipped_shells.dedup();
    let is_whole = |shell: &Shell| shell.is_closed && shell.is_orientable;
    let genus = (!shells.is_empty() && shells.iter().all(is_whole))
        .then(|| shells.iter().filter_map(|s| s.genus).sum());
    shells.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.first_face.cmp(&b.first_face)));
    CheckReport {
        verdict: Verdict { rating: Rating::NoSolid, text: String::new(), reasons: Vec::new() },
        triangles: soup.len(),
        vertices: count(&is_place),
        unused_vertices: is_used.len() - count(&is_used),
        edges: topology.edges.len(),
        bounds: soup.bounds().into(),
        bed: config.bed.map(|size| bed_fit(soup.bounds(), size)),
        area: faces.iter().map(|face| face.area).sum(),
        volume,
        duplicate_faces: faces_where(soup, limit, is_copy),
        degenerate_faces: faces_where(soup, limit, |t| faces[t].is_degenerate),
        sliver_faces: faces_where(soup, limit, |t| {
            !faces[t].is_degenerate && faces[t].slimness < config.sliver_ratio
        }),
        boundary: edges::boundary(topology, soup, limit),
        non_manifold_edges: edges::edges_where(topology, limit, |edge| edge.count > 2),
        non_manifold_vertices: edges::non_manifold_vertices(topology, welded.len(), limit),
        inconsistent_edges: edges::edges_where(topology, limit, |edge| {
            edges::is_inconsistent(topology, edge)
        }),
        components: components_of(soup, welded),
        closed_shells: shells.iter().filter(|shell| shell.is_closed).count(),
        nested_shells: shells.iter().filter(|shell| shell.depth.is_some_and(|depth| depth > 0)).count(),
        inverted_shells: shells.iter().filter(|shell| shell.role == ShellRole::Inverted).count(),
        euler_number: shells.iter().map(|shell| shell.euler_number).sum(),
        genus,
        shells: List::new(shells, limit),
        flipped_faces: faces_where(soup, limit, |t| found.is_flipped[t]),
        flipped_shells: flipped_shells.len(),
        self_intersections: None,
        internal_faces: List::default(),
        outside_faces: List::default(),
        field: None,
        thickness: None,
        overhangs: Overhangs::default(),
    }
}

fn bed_fit(bounds: Aabb, size: [f64; 3]) -> BedFit {
    let model = bounds.size();
    let fits = |bed: [f64; 3]| model.cmple(Vec3::from_array(bed)).all();
    BedFit { size, fits: fits(size), fits_turned: fits([size[1], size[0], size[2]]) }
}
