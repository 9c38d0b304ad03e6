//! What the findings come to, in words.
use super::report::{CheckReport, Rating, Reason, ReasonKind, ShellRole, Verdict};

/// Shares of the solid's volume: with more of it ambiguous a model is doubtful, and with less it is not worth a word.
const DOUBTFUL: f64 = 0.05;
const NOTABLE: f64 = 1e-3;
/// More open pieces of ten triangles or fewer have no holes worth a count.
const MANY_PIECES: usize = 20;

/// A number with commas between thousands.
fn number(n: usize) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count with its noun.
fn counted(n: usize, one: &str, many: &str) -> String {
    format!("{} {}", number(n), if n == 1 { one } else { many })
}

fn faces(n: usize) -> String {
    counted(n, "face", "faces")
}

/// A length or area with no more digits than tell something.
fn rounded(x: f64) -> String {
    if x >= 100.0 {
        return number(x.round() as usize);
    }
    let decimals = (2 - x.abs().log10().floor().clamp(-6.0, 2.0) as i32).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

pub fn verdict(report: &CheckReport) -> Verdict {
    let mut reasons = Vec::new();
    let mut say = |kind: ReasonKind, count: usize, text: String| {
        if count > 0 {
            reasons.push(Reason { kind, count, text });
        }
    };
    let has_solid = has_solid(report);
    say(
        ReasonKind::NoSolid,
        usize::from(!has_solid),
        "nothing is inside: the faces bound no solid".to_owned(),
    );
    let does_not_fit = report.bed.is_some_and(|bed| !bed.fits && !bed.fits_turned);
    let bed = report.bed.map_or([0.0; 3], |bed| bed.size).map(rounded).join(" × ");
    say(ReasonKind::DoesNotFit, usize::from(does_not_fit), format!("does not fit into {bed} mm"));

    let flipped = report.flipped_faces.count;
    let shells = report.flipped_shells.max(1);
    say(
        ReasonKind::FlippedFaces,
        flipped,
        format!("flip {} in {}", faces(flipped), counted(shells, "shell", "shells")),
    );
    let field = report.field.as_ref();
    let ambiguous = field.map_or(0.0, |f| f.ambiguous_volume / f.solid_volume.max(1e-300)).min(1e3);
    let is_doubtful = ambiguous > DOUBTFUL;
    say(
        ReasonKind::Ambiguous,
        usize::from(is_doubtful),
        format!(
            "inside or outside is not clear in a volume of {} % of the solid",
            rounded(100.0 * ambiguous)
        ),
    );
    let holes = report.boundary.loops.count;
    let closed_by = if is_doubtful { "closed by the field as well as it can" } else { "closed by the field" };
    let open = report.shells.count - report.closed_shells;
    let text = if open > MANY_PIECES && 10 * open > report.triangles {
        format!("{} with gaps between them, {closed_by}", counted(open, "loose piece", "loose pieces"))
    } else {
        format!("{} {closed_by}", counted(holes, "hole is", "holes are"))
    };
    say(ReasonKind::Holes, holes, text);
    let inverted = field.map_or(0.0, |f| f.inverted_volume);
    say(
        ReasonKind::Inverted,
        usize::from(inverted > 0.0 && report.inverted_shells == 0 && flipped == 0),
        format!("{} mm³ are enclosed inside out, and empty", rounded(inverted)),
    );
    let internal = report.internal_faces.count;
    say(
        ReasonKind::InternalFaces,
        internal,
        format!("{} inside of the solid and left out", counted(internal, "face is", "faces are")),
    );
    let overlap = field.map_or(0.0, |f| f.overlap_volume);
    say(
        ReasonKind::Overlaps,
        usize::from(overlap > NOTABLE * field.map_or(1.0, |f| f.solid_volume)),
        format!("{} mm³ are enclosed more than once, and filled once", rounded(overlap)),
    );
    let outside = report.outside_faces.count;
    say(
        ReasonKind::OutsideFaces,
        if has_solid { outside } else { 0 },
        format!("{} no solid and left out", counted(outside, "face bounds", "faces bound")),
    );
    let crossing = report.self_intersections.as_ref().map_or(0, |list| list.count);
    let pairs = counted(crossing, "pair of faces crosses", "pairs of faces cross");
    say(
        ReasonKind::SelfIntersections,
        crossing,
        format!("{pairs} or overlap: what they enclose together is printed"),
    );
    let (edges, vertices) = (report.non_manifold_edges.count, report.non_manifold_vertices.count);
    let parts = [counted(edges, "edge", "edges"), counted(vertices, "vertex", "vertices")];
    let parts: Vec<String> =
        parts.into_iter().zip([edges, vertices]).filter(|p| p.1 > 0).map(|p| p.0).collect();
    let verb = if edges + vertices == 1 { "is" } else { "are" };
    let text = format!("{} {verb} not manifold, which the field does not mind", parts.join(" and "));
    say(ReasonKind::NonManifold, edges + vertices, text);
    let duplicates = report.duplicate_faces.count;
    say(
        ReasonKind::DuplicateFaces,
        duplicates,
        format!("{} there twice", counted(duplicates, "face is", "faces are")),
    );
    let degenerate = report.degenerate_faces.count;
    say(
        ReasonKind::DegenerateFaces,
        degenerate,
        format!("{} no area", counted(degenerate, "face has", "faces have")),
    );
    if let Some(thickness) = &report.thickness {
        let thin = thickness.thin_faces.count;
        let text = format!(
            "{} thinner than {} mm: {} mm at the thinnest",
            counted(thin, "face is", "faces are"),
            rounded(thickness.threshold),
            rounded(thickness.minimum)
        );
        say(ReasonKind::Thin, thin, text);
    }
    let overhangs = &report.overhangs;
    say(
        ReasonKind::Overhangs,
        overhangs.faces.count,
        format!("{} mm² lean out by more than {}°", rounded(overhangs.area), rounded(overhangs.angle)),
    );
    let rating = rating(report, &reasons, has_solid, is_doubtful || does_not_fit);
    let said = reasons.iter().take(3).map(|reason| reason.text.as_str()).collect::<Vec<_>>().join("; ");
    let text = match (rating, said.is_empty()) {
        (Rating::Clean, true) => "clean: prints as it is".to_owned(),
        (Rating::Clean, false) => format!("clean: prints as it is; {said}"),
        (Rating::PrintsAsSeen, _) => format!("prints as seen: {said}"),
        (Rating::Doubtful, _) => format!("doubtful: {said}"),
        (Rating::NoSolid, _) => format!("no solid: {said}"),
    };
    Verdict { rating, text, reasons }
}

fn has_solid(report: &CheckReport) -> bool {
    let by_volume = report.field.as_ref().is_some_and(|field| field.solid_volume > 0.0);
    let bounds = |role: ShellRole| role == ShellRole::Boundary || role == ShellRole::Reversed;
    by_volume || report.shells.list.iter().any(|shell| bounds(shell.role))
}

fn rating(report: &CheckReport, reasons: &[Reason], has_solid: bool, is_doubtful: bool) -> Rating {
    let harmless = [ReasonKind::Thin, ReasonKind::Overhangs];
    if !has_solid && report.inverted_shells == 0 {
        Rating::NoSolid
    } else if is_doubtful || report.flipped_faces.count > 0 {
        Rating::Doubtful
    } else if reasons.iter().all(|reason| harmless.contains(&reason.kind)) {
        Rating::Clean
    } else {
        Rating::PrintsAsSeen
    }
}
