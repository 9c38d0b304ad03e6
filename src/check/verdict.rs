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
    let solid = report.field.as_ref().map_or(1.0, |field| field.solid_volume);
    let ambiguous = report.field.as_ref().map_or(0.0, |f| f.ambiguous_volume / f.solid_volume.max(1e-300));
    let mut found = Findings {
        report,
        has_solid: has_solid(report),
        does_not_fit: report.bed.is_some_and(|bed| !bed.fits && !bed.fits_turned),
        ambiguous: ambiguous.min(1e3),
        reasons: Vec::new(),
    };
    found.of_the_solid();
    found.of_what_is_left_out(solid);
    found.of_the_mesh();
    found.of_the_print();
    let rating = found.rating();
    let Findings { reasons, .. } = found;
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

/// What is to be said, the gravest first.
struct Findings<'a> {
    report: &'a CheckReport,
    has_solid: bool,
    does_not_fit: bool,
    /// The volume in which inside and outside are not clear, as a share of the solid's.
    ambiguous: f64,
    reasons: Vec<Reason>,
}

impl Findings<'_> {
    fn say(&mut self, kind: ReasonKind, count: usize, text: String) {
        if count > 0 {
            self.reasons.push(Reason { kind, count, text });
        }
    }

    fn is_doubtful(&self) -> bool {
        self.ambiguous > DOUBTFUL
    }

    fn of_the_solid(&mut self) {
        let report = self.report;
        let text = "nothing is inside: the faces bound no solid".to_owned();
        self.say(ReasonKind::NoSolid, usize::from(!self.has_solid), text);
        let bed = report.bed.map_or([0.0; 3], |bed| bed.size).map(rounded).join(" × ");
        let text = format!("does not fit into {bed} mm");
        self.say(ReasonKind::DoesNotFit, usize::from(self.does_not_fit), text);
        let flipped = report.flipped_faces.count;
        let shells = counted(report.flipped_shells.max(1), "shell", "shells");
        self.say(ReasonKind::FlippedFaces, flipped, format!("flip {} in {shells}", faces(flipped)));
        let ambiguous = rounded(100.0 * self.ambiguous);
        let text = format!("inside or outside is not clear in a volume of {ambiguous} % of the solid");
        self.say(ReasonKind::Ambiguous, usize::from(self.is_doubtful()), text);
        let closed_by =
            if self.is_doubtful() { "closed by the field as well as it can" } else { "closed by the field" };
        let (holes, open) = (report.boundary.loops.count, report.shells.count - report.closed_shells);
        let text = if open > MANY_PIECES && 10 * open > report.triangles {
            format!("{} with gaps between them, {closed_by}", counted(open, "loose piece", "loose pieces"))
        } else {
            format!("{} {closed_by}", counted(holes, "hole is", "holes are"))
        };
        self.say(ReasonKind::Holes, holes, text);
    }

    fn of_what_is_left_out(&mut self, solid_volume: f64) {
        let report = self.report;
        let [inverted, overlap] =
            report.field.as_ref().map_or([0.0; 2], |field| [field.inverted_volume, field.overlap_volume]);
        let is_inverted = inverted > 0.0 && report.inverted_shells == 0 && report.flipped_faces.count == 0;
        let text = format!("{} mm³ are enclosed inside out, and empty", rounded(inverted));
        self.say(ReasonKind::Inverted, usize::from(is_inverted), text);
        let internal = report.internal_faces.count;
        let text = format!("{} inside of the solid and left out", counted(internal, "face is", "faces are"));
        self.say(ReasonKind::InternalFaces, internal, text);
        let text = format!("{} mm³ are enclosed more than once, and filled once", rounded(overlap));
        self.say(ReasonKind::Overlaps, usize::from(overlap > NOTABLE * solid_volume), text);
        let outside = if self.has_solid { report.outside_faces.count } else { 0 };
        let text = format!("{} no solid and left out", counted(outside, "face bounds", "faces bound"));
        self.say(ReasonKind::OutsideFaces, outside, text);
    }

    fn of_the_mesh(&mut self) {
        let report = self.report;
        let crossing = report.self_intersections.as_ref().map_or(0, |list| list.count);
        let pairs = counted(crossing, "pair of faces crosses", "pairs of faces cross");
        let text = format!("{pairs} or overlap: what they enclose together is printed");
        self.say(ReasonKind::SelfIntersections, crossing, text);
        let (edges, vertices) = (report.non_manifold_edges.count, report.non_manifold_vertices.count);
        let parts = [counted(edges, "edge", "edges"), counted(vertices, "vertex", "vertices")];
        let parts: Vec<String> =
            parts.into_iter().zip([edges, vertices]).filter(|p| p.1 > 0).map(|p| p.0).collect();
        let verb = if edges + vertices == 1 { "is" } else { "are" };
        let text = format!("{} {verb} not manifold, which the field does not mind", parts.join(" and "));
        self.say(ReasonKind::NonManifold, edges + vertices, text);
        let duplicates = report.duplicate_faces.count;
        let text = format!("{} there twice", counted(duplicates, "face is", "faces are"));
        self.say(ReasonKind::DuplicateFaces, duplicates, text);
        let degenerate = report.degenerate_faces.count;
        let text = format!("{} no area", counted(degenerate, "face has", "faces have"));
        self.say(ReasonKind::DegenerateFaces, degenerate, text);
    }

    fn of_the_print(&mut self) {
        let report = self.report;
        if let Some(thickness) = &report.thickness {
            let thin = counted(thickness.thin_faces.count, "face is", "faces are");
            let [least, limit] = [thickness.minimum, thickness.threshold].map(rounded);
            let text = format!("{thin} thinner than {limit} mm: {least} mm at the thinnest");
            self.say(ReasonKind::Thin, thickness.thin_faces.count, text);
        }
        let overhangs = &report.overhangs;
        let [area, angle] = [overhangs.area, overhangs.angle].map(rounded);
        let text = format!("{area} mm² lean out by more than {angle}°");
        self.say(ReasonKind::Overhangs, overhangs.faces.count, text);
    }

    fn rating(&self) -> Rating {
        let harmless = [ReasonKind::Thin, ReasonKind::Overhangs];
        if !self.has_solid && self.report.inverted_shells == 0 {
            Rating::NoSolid
        } else if self.is_doubtful() || self.does_not_fit || self.report.flipped_faces.count > 0 {
            Rating::Doubtful
        } else if self.reasons.iter().all(|reason| harmless.contains(&reason.kind)) {
            Rating::Clean
        } else {
            Rating::PrintsAsSeen
        }
    }
}

fn has_solid(report: &CheckReport) -> bool {
    let by_volume = report.field.as_ref().is_some_and(|field| field.solid_volume > 0.0);
    let bounds = |role: ShellRole| role == ShellRole::Boundary || role == ShellRole::Reversed;
    by_volume || report.shells.list.iter().any(|shell| bounds(shell.role))
}
