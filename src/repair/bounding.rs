//! Which triangles of a closed soup bound the inside: those with w ≥ 1/2 behind and w < 1/2 in front.
use super::RepairReport;
use super::edges::sides_with_length;
use super::faces::{Faces, NEW};
use crate::data::{Monitor, Sets, by_edge, sorted, turn_alike};
use crate::math::{Vec3, area_vector, barycentre, side_of_plane};
use crate::winding::{Accuracy, FieldError, THRESHOLD, WindingField};

/// Triangles of a patch that are asked: the largest ones, as next to slivers rounding may take one side for the other.
const ASKED: usize = 5;

/// Pieces with the same corners, taken as one.
struct Sheet {
    /// The corners, so that `copies` is positive.
    triangle: [u32; 3],
    copies: i32,
    /// The range of its pieces among those sorted by corners.
    pieces: std::ops::Range<usize>,
}

/// The pieces of closed `faces` that bound {w ≥ 1/2}; `pieces.sources` are triangles of `faces`. Each edge of the result is run through
/// as often in one direction as in the other. Patches, pieces joined by edges that no third piece has, stay or go as a whole.
pub fn bounding(
    faces: &Faces,
    pieces: &Faces,
    report: &mut RepairReport,
    monitor: &dyn Monitor,
) -> Result<Faces, FieldError> {
    let mut order: Vec<([u32; 3], u32)> = pieces.triangles.iter().map(|t| sorted(*t)).zip(0..).collect();
    order.sort_unstable();
    let sheets = sheets_of(pieces, &order, report);
    let patches = patches_of(&sheets);
    let field = WindingField::new(faces.to_soup(), Default::default());
    let mut asked = largest_of(pieces, &sheets, &patches);
    asked.sort_unstable();
    let middle = |s: &usize| barycentre(sheets[*s].triangle.map(|v| pieces.positions[v as usize]));
    let places: Vec<Vec3> = asked.iter().map(middle).collect();
    let values = field.evaluate(&places, Accuracy::EXACT, monitor)?;
    // Votes for and against, weighted by area: of being bounding, and of lying within.
    let mut votes = vec![[0.0; 3]; sheets.len()];
    for ((s, q), value) in asked.iter().zip(&places).zip(values) {
        let sheet = &sheets[*s];
        let before = value
            - order[sheet.pieces.clone()]
                .iter()
                .map(|piece| behind(faces, pieces, sheet, piece.1, *q))
                .sum::<f64>();
        let back = before + f64::from(sheet.copies);
        let answer = if before >= THRESHOLD {
            1
        } else if back >= THRESHOLD {
            0
        } else {
            2
        };
        votes[patches[*s] as usize][answer] += weight(pieces, sheet);
    }
    let mut kept = Faces { positions: pieces.positions.clone(), triangles: vec![], sources: vec![] };
    let mut found: Vec<([u32; 3], u32, u32)> = Vec::new();
    for (s, sheet) in sheets.iter().enumerate() {
        let [bounds, within, without] = votes[patches[s] as usize];
        if bounds >= within.max(without) {
            let own = order[sheet.pieces.clone()].iter().map(|piece| piece.1);
            let same = own.clone().find(|p| turn_alike(pieces.triangles[*p as usize], sheet.triangle));
            let piece = same.unwrap_or(order[sheet.pieces.start].1);
            found.push((
                if same.is_some() { pieces.triangles[piece as usize] } else { sheet.triangle },
                source(faces, pieces, piece),
                piece,
            ));
        } else if within >= without {
            report.internal += 1;
        } else {
            report.outside += 1;
        }
    }
    found.sort_unstable_by_key(|(_, _, piece)| *piece);
    found.into_iter().for_each(|(triangle, source, _)| kept.push(triangle, source));
    Ok(kept)
}

fn source(faces: &Faces, pieces: &Faces, piece: u32) -> u32 {
    match pieces.sources[piece as usize] {
        NEW => NEW,
        face => faces.sources[face as usize],
    }
}

/// Pieces with the same corners as one; those that cancel are left out.
fn sheets_of(pieces: &Faces, order: &[([u32; 3], u32)], report: &mut RepairReport) -> Vec<Sheet> {
    let mut sheets = Vec::new();
    let mut first = 0;
    for same in order.chunk_by(|one, other| one.0 == other.0) {
        let triangle = pieces.triangles[same[0].1 as usize];
        let turn = |piece: u32| if turn_alike(pieces.triangles[piece as usize], triangle) { 1 } else { -1 };
        let copies: i32 = same.iter().map(|(_, piece)| turn(*piece)).sum();
        let [a, b, c] = triangle;
        if copies == 0 {
            report.cancelled += same.len();
        } else {
            let triangle = if copies > 0 { triangle } else { [a, c, b] };
            sheets.push(Sheet { triangle, copies: copies.abs(), pieces: first..first + same.len() });
            report.duplicates += same.len() - 1;
        }
        first += same.len();
    }
    sheets
}

/// Of each sheet, the least one of its patch.
fn patches_of(sheets: &[Sheet]) -> Vec<u32> {
    let triangles: Vec<[u32; 3]> = sheets.iter().map(|sheet| sheet.triangle).collect();
    let sides = sides_with_length(&triangles);
    let mut sets = Sets::new(sheets.len());
    for pair in by_edge(&sides).filter(|sides| sides.len() == 2) {
        let [one, other] = [pair[0].1 / 3, pair[1].1 / 3];
        if sheets[one as usize].copies == sheets[other as usize].copies {
            sets.join(one, other);
        }
    }
    sets.into_least()
}

fn weight(pieces: &Faces, sheet: &Sheet) -> f64 {
    // Above zero, so that a patch without area has an answer too.
    area_vector(sheet.triangle.map(|v| pieces.positions[v as usize])).length() + f64::MIN_POSITIVE
}

/// The largest sheets of each patch.
fn largest_of(pieces: &Faces, sheets: &[Sheet], patches: &[u32]) -> Vec<usize> {
    let mut all: Vec<(u32, f64, usize)> =
        (0..sheets.len()).map(|s| (patches[s], -weight(pieces, &sheets[s]), s)).collect();
    all.sort_unstable_by(|one, other| one.partial_cmp(other).expect("areas are numbers"));
    all.chunk_by(|one, other| one.0 == other.0)
        .flat_map(|patch| patch.iter().take(ASKED).map(|s| s.2))
        .collect()
}

/// What w falls by on the way from `q` through the triangle of a piece to the front of its sheet, if q is not there.
fn behind(faces: &Faces, pieces: &Faces, sheet: &Sheet, piece: u32, q: Vec3) -> f64 {
    let turn = if turn_alike(pieces.triangles[piece as usize], sheet.triangle) { 1 } else { -1 };
    let side = turn * side_of_plane(q, faces.corners(pieces.sources[piece as usize] as usize));
    f64::from(turn) * 0.5 * f64::from(1 - side)
}
