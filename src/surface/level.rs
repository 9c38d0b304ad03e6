use crate::data::{Monitor, Shape, ascending};
use crate::math::{area_vector, barycentre};
use crate::treecode::PointTargets;
use crate::winding::{Accuracy, FieldError, THRESHOLD, WindingField};

/// Tolerance of the winding numbers of which the level is the median.
const TOLERANCE: f64 = 1e-2;

/// The level at which half of the shape's area lies inside its own level set: the median, weighted by areas, of the winding
/// numbers at the points of a cloud or at the barycentres of a soup's triangles. They are principal values: the point or the
/// triangle itself contributes nothing, so that w is the mean of both its sides.
///
/// It is about 1/2 for closed surfaces, somewhat less for clouds where they are thin or hollow. It is less the less of a closed
/// surface there is: an open scan takes up less of the solid angle around its own points. At that level the surface passes through
/// the points; at 1/2 it would lie inside of them. It is never above 1/2: parts within others have 3/2. The median and not the
/// mean, as two points that nearly coincide have values without bounds. 1/2 if there is nothing with an area.
///
/// # Errors
/// If and only if `monitor` cancels or memory does not suffice.
pub fn suggested_level(field: &WindingField, monitor: &dyn Monitor) -> Result<f64, FieldError> {
    let (values, areas) = match field.shape() {
        Shape::Cloud(cloud) => {
            let targets = PointTargets::new(cloud.points());
            let values = field.evaluate_targets(&targets, cloud.len(), TOLERANCE, monitor)?;
            (values, cloud.areas().to_vec())
        }
        Shape::Soup(soup) => {
            let middles: Vec<_> = (0..soup.len()).map(|t| barycentre(soup.corners(t))).collect();
            let values = field.evaluate(&middles, Accuracy::Tolerance(TOLERANCE), monitor)?;
            (values, (0..soup.len()).map(|t| area_vector(soup.corners(t)).length()).collect())
        }
    };
    Ok(median(&values, &areas).map_or(THRESHOLD, |median| median.min(THRESHOLD)))
}

/// The value below which half of the weight lies.
fn median(values: &[f64], weights: &[f64]) -> Option<f64> {
    let half = 0.5 * weights.iter().sum::<f64>();
    let mut below = 0.0;
    let reaches = |place: &u32| {
        below += weights[*place as usize];
        below >= half && below > 0.0
    };
    ascending(values.iter().copied()).into_iter().find(reaches).map(|place| values[place as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_move_the_median() {
        assert_eq!(median(&[3.0, 1.0, 2.0], &[1.0, 1.0, 1.0]), Some(2.0));
        assert_eq!(median(&[3.0, 1.0, 2.0], &[5.0, 1.0, 1.0]), Some(3.0));
        assert_eq!(median(&[3.0, 1.0], &[0.0, 0.0]), None);
        assert_eq!(median(&[], &[]), None);
    }
}
