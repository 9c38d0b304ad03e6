//! Binary STL: a header of 80 bytes, a count, and records of 50 bytes (normal, three corners, an attribute).
use crate::data::WarningKind;
use crate::io::parsed::{Parsed, Tally};
use crate::io::sniff::is_text;
use crate::math::Vec3;

const HEADER: usize = 80;
/// Header and count.
const START: usize = HEADER + 4;
const RECORD: usize = 50;
/// The corners of a record, between its normal and its attribute.
const CORNERS: std::ops::Range<usize> = 12..48;

/// Magnitudes of coordinates in files, zero aside. Of random bits a quarter look like that, so nine numbers
/// together tell a record from other data.
const USUAL_MAGNITUDES: std::ops::Range<f32> = 1e-12..1e12;
/// Records that are looked at when the length does not follow from the count.
const INSPECTED: usize = 64;

fn count(bytes: &[u8]) -> Option<usize> {
    let field = bytes.get(HEADER..START)?.try_into().expect("the range has 4 bytes");
    Some(u32::from_le_bytes(field) as usize)
}

fn coordinates(record: &[u8]) -> impl Iterator<Item = f32> + '_ {
    record[CORNERS].chunks_exact(4).map(|c| f32::from_le_bytes(c.try_into().expect("chunks have 4 bytes")))
}

fn is_plausible(record: &[u8]) -> bool {
    coordinates(record).all(|c| c == 0.0 || USUAL_MAGNITUDES.contains(&c.abs()))
}

/// Whether `bytes` are binary STL, even if they begin with "solid" as text does: the length is what the count
/// says, or they are not text and most of the first records look like triangles.
pub(in crate::io) fn is_binary(bytes: &[u8]) -> bool {
    let Some(count) = count(bytes) else { return false };
    if bytes.len() - START == count.saturating_mul(RECORD) {
        return true;
    }
    let records = || bytes[START..].chunks_exact(RECORD).take(INSPECTED);
    !is_text(bytes) && 2 * records().filter(|r| is_plausible(r)).count() > records().count()
}

/// How many records to read of `bytes`, which hold `complete` of them but declare `declared`.
fn usable_records(bytes: &[u8], declared: usize, complete: usize, tally: &mut Tally) -> usize {
    let body = bytes.len() - START;
    if declared > complete {
        tally.add(WarningKind::CountMismatch, declared - complete);
        tally.add(WarningKind::TruncatedRecord, usize::from(!body.is_multiple_of(RECORD)));
        return complete;
    }
    let next = bytes[START..].chunks_exact(RECORD).nth(declared);
    // Either the count is wrong, as from writers that never go back to fill it in, or something else follows.
    if body.is_multiple_of(RECORD) && next.is_some_and(is_plausible) {
        tally.add(WarningKind::CountMismatch, complete - declared);
        return complete;
    }
    tally.add(WarningKind::TrailingBytes, body - declared * RECORD);
    declared
}

/// Reads what [`is_binary`] accepts.
pub(super) fn read(bytes: &[u8]) -> Parsed {
    let declared = count(bytes).expect("binary STL has a header and a count");
    let complete = (bytes.len() - START) / RECORD;
    let mut tally = Tally::default();
    let records = usable_records(bytes, declared, complete, &mut tally);
    let mut positions = Vec::with_capacity(3 * records);
    for record in bytes[START..].chunks_exact(RECORD).take(records) {
        let mut c = coordinates(record).map(f64::from);
        positions.extend(std::iter::from_fn(|| Some(Vec3::new(c.next()?, c.next()?, c.next()?))));
    }
    let triangles = (0..records as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Parsed { positions, triangles: Some(triangles), tally, ..Parsed::default() }
}

#[cfg(test)]
mod tests {
    use crate::data::{Warning, WarningKind};
    use crate::io::{Geometry, Imported, ReadError, read};
    use crate::math::Vec3;

    fn file(header: &[u8], declared: u32, corners: &[[f32; 9]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend(declared.to_le_bytes());
        for triangle in corners {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flat_map(|c| c.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    const A: [f32; 9] = [0.0, 0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 2.5, 0.0];
    const B: [f32; 9] = [0.0, 0.0, 1.0, 1.5, 0.0, 1.0, 0.0, 2.5, 1.0];

    fn outcome(bytes: &[u8]) -> (usize, Vec<Warning>) {
        let Imported { geometry, warnings, .. } = read(bytes).unwrap();
        (geometry.len(), warnings)
    }

    #[test]
    fn file_that_begins_with_solid_is_still_binary() {
        let Geometry::Soup(soup) = read(&file(b"solid box", 2, &[A, B])).unwrap().geometry else { panic!() };
        assert_eq!(soup.corners(1), [Vec3::Z, Vec3::new(1.5, 0.0, 1.0), Vec3::new(0.0, 2.5, 1.0)]);
    }

    #[test]
    fn wrong_counts_are_told_from_trailing_bytes() {
        let warning = |kind, count| vec![Warning::new(kind, count)];
        assert_eq!(outcome(&file(b"solid", 9, &[A, B])), (2, warning(WarningKind::CountMismatch, 7)));
        assert_eq!(outcome(&file(b"", 0, &[A, B])), (2, warning(WarningKind::CountMismatch, 2)));
        let mut appended = file(b"", 2, &[A, B]);
        appended.extend(b"made by hand");
        assert_eq!(outcome(&appended), (2, warning(WarningKind::TrailingBytes, 12)));
    }

    #[test]
    fn short_last_record_is_dropped() {
        let bytes = file(b"solid", 2, &[A, B]);
        let expected =
            vec![Warning::new(WarningKind::CountMismatch, 1), Warning::new(WarningKind::TruncatedRecord, 1)];
        assert_eq!(outcome(&bytes[..bytes.len() - 1]), (1, expected));
    }

    #[test]
    fn nan_corners_drop_their_triangle_only() {
        let mut bad = B;
        bad[4] = f32::NAN;
        let bytes = file(b"", 2, &[A, bad]);
        assert_eq!(outcome(&bytes), (1, vec![Warning::new(WarningKind::NonFiniteFaces, 1)]));
        let only_bad = read(&file(b"", 1, &[bad])).unwrap_err();
        assert!(matches!(only_bad, ReadError::EmptyInput { dropped, .. } if dropped.len() == 1));
    }
}
