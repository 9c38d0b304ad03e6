//! Whether a repaired mesh bounds what its field says.
use crate::data::{Lattice, Monitor, TriangleSoup};
use crate::winding::{FieldError, THRESHOLD, WindingField};

/// Samples along the longest side.
const RESOLUTION: usize = 64;
/// Around both, in diagonals.
const MARGIN: f64 = 7.3e-3;

/// Of the samples of a lattice over both that are inside of a closed soup or have w ≥ 1/2, the share that is both; 1 if there are none.
pub fn agreement(
    soup: &TriangleSoup,
    field: &WindingField,
    monitor: &dyn Monitor,
) -> Result<f64, FieldError> {
    let bounds = soup.bounds().union(field.bounds());
    // Askew to what lies in planes between samples or on them.
    let bounds = bounds.padded(MARGIN * bounds.diagonal());
    let lattice = Lattice::with_resolution(bounds, RESOLUTION)?;
    let of_result = WindingField::new(soup.clone(), Default::default());
    let [a, b] = [&of_result, field].map(|field| field.classify_lattice(&lattice, THRESHOLD, monitor));
    let (a, b) = (a?, b?);
    let count =
        |join: fn(u8, u8) -> u8| -> u32 { a.iter().zip(&b).map(|(a, b)| join(*a, *b).count_ones()).sum() };
    let (both, any) = (count(|a, b| a & b), count(|a, b| a | b));
    Ok(if any == 0 { 1.0 } else { f64::from(both) / f64::from(any) })
}
