use crate::data::sort_keyed;
use crate::math::Vec3;
use std::borrow::Cow;

/// The places of points: points in the same place whose normals look to the same side are one, so that neighbours are
/// other places even where each point is there many times, as the corners of loose triangles are.
pub(super) struct Sites<'a> {
    pub points: Cow<'a, [Vec3]>,
    /// The normal of the first point in each place; empty without normals.
    pub normals: Cow<'a, [Vec3]>,
    /// The place of each point; empty if each has its own.
    of_points: Vec<u32>,
}

impl<'a> Sites<'a> {
    /// In the order of their first points. `normals` are as many as the points, or none.
    pub fn find(points: &'a [Vec3], normals: &'a [Vec3]) -> Sites<'a> {
        let firsts = first_in_place(points, normals);
        let is_first = |i: &usize| firsts[*i] as usize == *i;
        let kept: Vec<usize> = (0..points.len()).filter(is_first).collect();
        if kept.len() == points.len() {
            return Sites { points: points.into(), normals: normals.into(), of_points: vec![] };
        }
        let place = |first: &u32| kept.partition_point(|k| *k < *first as usize) as u32;
        let of_kept = |values: &[Vec3]| kept.iter().filter_map(|k| values.get(*k).copied()).collect();
        Sites {
            points: Cow::Owned(of_kept(points)),
            normals: Cow::Owned(of_kept(normals)),
            of_points: firsts.iter().map(place).collect(),
        }
    }

    /// The value of each point, from those of the places.
    pub fn spread<T: Copy>(&self, values: Vec<T>) -> Vec<T> {
        if self.of_points.is_empty() {
            return values;
        }
        self.of_points.iter().map(|site| values[*site as usize]).collect()
    }

    /// Equal shares of the values of the places, for each point.
    pub fn share(&self, values: Vec<f64>) -> Vec<f64> {
        if self.of_points.is_empty() {
            return values;
        }
        let mut counts = vec![0.0; values.len()];
        self.of_points.iter().for_each(|site| counts[*site as usize] += 1.0);
        self.of_points.iter().map(|site| values[*site as usize] / counts[*site as usize]).collect()
    }
}

/// For each point the first one in its place that looks to the same side.
fn first_in_place(points: &[Vec3], normals: &[Vec3]) -> Vec<u32> {
    let mut keyed: Vec<(u64, u32)> = points.iter().map(|p| mixed(*p)).zip(0..).collect();
    sort_keyed(&mut keyed);
    let mut firsts: Vec<u32> = (0..points.len() as u32).collect();
    let mut heads = Vec::new();
    for run in keyed.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1) {
        heads.clear();
        for &(_, i) in run {
            let [place, normal] = [points, normals].map(|values| values.get(i as usize));
            let is_same = |head: &u32| {
                let agrees = |n: &Vec3| n.dot(normals[*head as usize]) >= 0.0;
                Some(&points[*head as usize]) == place && normal.is_none_or(agrees)
            };
            match heads.iter().find(|head| is_same(head)) {
                Some(head) => firsts[i as usize] = *head,
                None => heads.push(i),
            }
        }
    }
    firsts
}

/// A number that equal places share, and hardly any others.
fn mixed(p: Vec3) -> u64 {
    let mix = |hash: u64, x: f64| {
        // Adding zero makes −0 equal to 0.
        let hash = (hash ^ (x + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash ^ hash >> 32
    };
    p.to_array().into_iter().fold(0, mix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_share_and_other_sides_do_not() {
        let points = [Vec3::ONE, Vec3::ZERO, Vec3::ONE, -Vec3::ZERO, Vec3::ONE];
        let normals = [Vec3::Z, Vec3::X, -Vec3::Z, Vec3::X, Vec3::Z];
        let sites = Sites::find(&points, &normals);
        assert_eq!(*sites.points, [Vec3::ONE, Vec3::ZERO, Vec3::ONE]);
        assert_eq!(*sites.normals, [Vec3::Z, Vec3::X, -Vec3::Z]);
        assert_eq!(sites.share(vec![4.0, 2.0, 3.0]), [2.0, 1.0, 3.0, 1.0, 2.0]);
        let sites = Sites::find(&points, &[]);
        assert_eq!(sites.spread(vec![Vec3::X, Vec3::Y]), [Vec3::X, Vec3::Y, Vec3::X, Vec3::Y, Vec3::X]);
        let sites = Sites::find(&points[..2], &[]);
        assert_eq!(sites.share(vec![4.0, 2.0]), [4.0, 2.0]);
    }
}
