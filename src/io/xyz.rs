//! XYZ: one point a line, as three columns, or six with a normal; blanks, commas or semicolons between them.
//!
//! Files as they are found also have a line of column names or the number of points at the top, and columns with
//! colours or intensities, which are left out.
use super::parsed::{Parsed, Tally};
use super::text::{Commas, Continuation, Syntax, Tokens, number};
use super::{Format, ReadError};
use crate::data::WarningKind;
use crate::math::Vec3;

static SYNTAX: Syntax = Syntax {
    format: Format::Xyz,
    commas: Commas::Separate,
    comments: &[b"#", b"//"],
    continuation: Continuation::Never,
};

const WITH_NORMAL: usize = 6;

/// One line: its first values, and how many columns it has in all.
struct Row {
    values: [f64; WITH_NORMAL],
    columns: usize,
}

pub(super) fn read(bytes: &[u8]) -> Result<Parsed, ReadError> {
    let mut tokens = Tokens::new(bytes, &SYNTAX);
    let (mut points, mut normals, mut tally) = (Vec::new(), Vec::new(), Tally::default());
    skip_names(&mut tokens);
    let declared = read_count(&mut tokens);
    let mut columns = None;
    while let Some(first) = tokens.next() {
        let Some(row) = read_row(&mut tokens, first, columns)? else {
            tally.add(WarningKind::TruncatedRecord, 1);
            break;
        };
        let [x, y, z, nx, ny, nz] = row.values;
        points.push(Vec3::new(x, y, z));
        if row.columns == WITH_NORMAL {
            normals.push(Vec3::new(nx, ny, nz));
        }
        columns = Some(row.columns);
    }
    tally.add(WarningKind::CountMismatch, declared.map_or(0, |count| points.len().abs_diff(count)));
    let normals = (columns == Some(WITH_NORMAL) && !are_colours(&normals)).then_some(normals);
    let has_ignored = columns.is_some_and(|columns| columns > 3) && normals.is_none();
    tally.add(WarningKind::IgnoredColumns, if has_ignored { points.len() } else { 0 });
    Ok(Parsed { positions: points, normals, triangles: None, tally })
}

/// Moves past a first line of column names.
fn skip_names(tokens: &mut Tokens) {
    let mut ahead = tokens.clone();
    if ahead.next().is_some_and(|first| number(first).is_none()) {
        ahead.end_line();
        *tokens = ahead;
    }
}

/// The number of points, if it stands alone in the next line, which is then passed.
fn read_count(tokens: &mut Tokens) -> Option<usize> {
    let mut ahead = tokens.clone();
    let count = std::str::from_utf8(ahead.next()?).ok()?.parse().ok()?;
    if ahead.next_in_line().is_some() || ahead.is_at_end() {
        return None;
    }
    *tokens = ahead;
    Some(count)
}

/// The line that begins with `first` and should have as many `columns` as those before; `None` when the end of
/// the file cut it.
fn read_row(tokens: &mut Tokens, first: &[u8], columns: Option<usize>) -> Result<Option<Row>, ReadError> {
    let mut row = Row { values: [f64::NAN; WITH_NORMAL], columns: 0 };
    let mut token = Some(first);
    while let Some(text) = token {
        let value = number(text);
        if row.columns < 3 && value.is_none() {
            return if tokens.is_at_end() { Ok(None) } else { Err(tokens.expected("a coordinate", token)) };
        }
        if let (Some(slot), Some(value)) = (row.values.get_mut(row.columns), value) {
            *slot = value;
        }
        row.columns += 1;
        token = tokens.next_in_line();
    }
    let is_complete = row.columns >= 3 && columns.is_none_or(|columns| columns == row.columns);
    if !is_complete && tokens.is_at_end() {
        return Ok(None);
    }
    if !is_complete {
        let what =
            columns.map_or("3 columns or more".to_owned(), |n| format!("{n} columns as in the lines before"));
        return Err(tokens.error(format!("{what}, found {}", row.columns)));
    }
    Ok(Some(row))
}

/// Whether columns 4 to 6 are colours rather than normals: whole numbers from 0 to 255, not all of them 0 or 1; or numbers from
/// 0 to 1 that seldom are the coordinates of a unit vector.
fn are_colours(columns: &[Vec3]) -> bool {
    let values = || columns.iter().flat_map(|c| c.to_array());
    let is_byte = |v: f64| v.fract() == 0.0 && (0.0..=255.0).contains(&v);
    let are_bytes = values().all(is_byte) && values().any(|v| v > 1.0);
    let units = columns.iter().filter(|c| (c.length() - 1.0).abs() < UNIT_WITHIN).count();
    let are_shares = values().all(|v| (0.0..=1.0).contains(&v)) && values().any(|v| v > 0.0);
    are_bytes || (are_shares && 2 * units < columns.len())
}

/// How far from 1 the length of a normal may be that was written with few digits.
const UNIT_WITHIN: f64 = 0.02;

#[cfg(test)]
mod tests {
    use crate::data::{PointCloud, Warning, WarningKind};
    use crate::io::{Format, Geometry, Imported, Location, ReadError, read};
    use crate::math::Vec3;

    fn cloud(file: &str) -> (PointCloud, Vec<Warning>) {
        match read(file.as_bytes()).unwrap() {
            Imported { geometry: Geometry::Cloud(cloud), warnings, format: Format::Xyz } => (cloud, warnings),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn separators_comments_and_first_lines_make_no_difference() {
        let plain = cloud("0 0 9\n1 2 3.5\n");
        assert_eq!(plain.0.points(), [Vec3::Z * 9.0, Vec3::new(1.0, 2.0, 3.5)]);
        assert_eq!(plain.1, []);
        let files = [
            "# a\n0,0,9\r\n\r\n1, 2,3.5 // b",
            "//X Y Z\n0;0;9\n1\t2 3.5",
            "x,y,z\n0,0,9,\n1,2,3.5,",
            "2\n0 0 9\n1 2 3.5",
        ];
        for file in files {
            assert_eq!(cloud(file), plain, "{file}");
        }
        assert_eq!(cloud("7\n0 0 9\n1 2 3.5").1, [Warning::new(WarningKind::CountMismatch, 5)]);
    }

    #[test]
    fn six_columns_are_normals_unless_they_are_colours() {
        let (with_normals, warnings) = cloud("0 0 9 0 0 2\n1 0 9 -3 0 0\n");
        assert_eq!((with_normals.normals(), warnings), (Some(&[Vec3::Z, -Vec3::X][..]), vec![]));
        for coloured in
            ["0 0 9 0 128 255\n1 0 9 0 0 0\n", "0 0 9 0.2 0.5 0.4\n1 0 9 1 0 0.3\n", "0 0 9 0.7\n1 0 9 0.1\n"]
        {
            let (without, warnings) = cloud(coloured);
            assert_eq!((without.len(), without.normals()), (2, None));
            assert_eq!(warnings, [Warning::new(WarningKind::IgnoredColumns, 2)]);
        }
    }

    #[test]
    fn normals_that_are_all_zero_are_no_normals() {
        let (bare, warnings) = cloud("0 0 9 0 0 0\n1 0 9 0 0 0\n");
        assert_eq!((bare.len(), bare.normals()), (2, None));
        assert_eq!(warnings, [Warning::new(WarningKind::BadNormals, 2)]);
    }

    #[test]
    fn short_line_is_an_error_unless_the_file_ends_there() {
        let (cut, warnings) = cloud("0 0 9\n1 0 9\n2 0");
        assert_eq!((cut.len(), warnings), (2, vec![Warning::new(WarningKind::TruncatedRecord, 1)]));
        match read(b"# cloud\n0 0 9\n1 0\n2 0 9\n").unwrap_err() {
            ReadError::Parse { at, .. } => assert_eq!(at, Location::Line(3)),
            other => panic!("{other:?}"),
        }
    }
}
