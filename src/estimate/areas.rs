use super::curved::curved_areas;
use super::neighbours::Neighbourhoods;
use super::sites::Sites;
use super::voronoi::voronoi_areas;
use super::{EstimateConfig, EstimateError};
use crate::data::{Cancelled, Monitor, OrientedCloud, Parts, PointCloud};
use crate::math::Vec3;
use std::f64::consts::PI;

/// How the area that each point stands for is estimated. Points in the same place share one area.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AreaMethod {
    /// The Voronoi cell among the neighbours that look to the same side, in their best-fit plane (Barill et al. 2018,
    /// section 3.1): what [`complete`](super::complete) and [`orient`](super::orient) use.
    #[default]
    Voronoi,
    /// The Voronoi cell with the area of a quadratic surface fitted to the neighbours above it (Cazals & Pouget 2005).
    Curved,
    /// π d², with the distance d to the nearest other place (*Leaps and Bounds*, appendix F.1). It adds up to the surface's
    /// area on average for places drawn evenly at random, though the single area then varies as much as its mean; it adds
    /// up to π times that for a square grid, and 3.6 times for a hexagonal one, the most there can be.
    NearestNeighbour,
    /// The mean of the Voronoi areas for every place.
    Uniform,
}

/// The area of each point by `method`, in the square of the points' unit; areas the cloud came with are not looked at.
///
/// # Errors
/// If and only if the cloud is empty, all its points are in one place, it is without normals and the method is not
/// [`AreaMethod::NearestNeighbour`], or `monitor` cancels.
pub fn areas(
    cloud: &PointCloud,
    method: AreaMethod,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, EstimateError> {
    let of_sites = match method {
        AreaMethod::Voronoi => voronoi_areas,
        AreaMethod::Curved => curved_areas,
        AreaMethod::NearestNeighbour => circles,
        AreaMethod::Uniform => mean_areas,
    };
    let normals = match (cloud.normals(), method) {
        (None, AreaMethod::NearestNeighbour) => vec![Vec3::Z; cloud.len()],
        _ => normals_of(cloud)?,
    };
    areas_by(of_sites, cloud, &normals, config, monitor)
}

/// [`complete`](super::complete) with areas estimated by `method`, also where the cloud came with some.
///
/// # Errors
/// If and only if the cloud is empty or without normals, all its points are in one place, or `monitor` cancels.
pub fn complete_with(
    cloud: &PointCloud,
    method: AreaMethod,
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<OrientedCloud, EstimateError> {
    let normals = normals_of(cloud)?;
    let areas = areas(cloud, method, config, monitor)?;
    Ok(OrientedCloud::new(cloud.points().to_vec(), normals, areas)?)
}

/// The cloud's own normals.
pub(super) fn normals_of(cloud: &PointCloud) -> Result<Vec<Vec3>, EstimateError> {
    if cloud.is_empty() {
        return Err(EstimateError::Empty);
    }
    let missing = EstimateError::MissingNormals { points: cloud.len() };
    cloud.normals().map(<[Vec3]>::to_vec).ok_or(missing)
}

/// Areas of places from their points, normals and neighbours.
type OfSites = fn(&Sites, &[Vec3], &Neighbourhoods, &dyn Monitor) -> Result<Vec<f64>, Cancelled>;

/// Areas of points from those of their places; `normals` may be others than the cloud's.
pub(super) fn areas_by(
    of_sites: OfSites,
    cloud: &PointCloud,
    normals: &[Vec3],
    config: &EstimateConfig,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, EstimateError> {
    let points = cloud.points();
    let first = points.first().ok_or(EstimateError::Empty)?;
    if points.iter().all(|p| p == first) {
        return Err(EstimateError::OnePlace { points: points.len() });
    }
    let sites = Sites::find(points, normals);
    let monitor = &Parts::new(monitor);
    monitor.begin(0.0, 0.4);
    let neighbourhoods = Neighbourhoods::find(&sites.points, &sites.normals, config.neighbours, monitor)?;
    monitor.begin(0.4, 1.0);
    Ok(sites.share(of_sites(&sites, &sites.normals, &neighbourhoods, monitor)?))
}

fn circles(
    sites: &Sites,
    _: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    _: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    let place = |i: usize| sites.points[i];
    let circle = |i: usize| {
        // The other side of a sheet without thickness is in the same place.
        let mut distances =
            neighbourhoods.of(i).iter().map(|&j| place(i).distance_squared(place(j as usize)));
        PI * distances.find(|d| *d > 0.0).unwrap_or(0.0)
    };
    Ok((0..sites.points.len()).map(circle).collect())
}

fn mean_areas(
    sites: &Sites,
    normals: &[Vec3],
    neighbourhoods: &Neighbourhoods,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    let areas = voronoi_areas(sites, normals, neighbourhoods, monitor)?;
    let mean = areas.iter().sum::<f64>() / areas.len() as f64;
    Ok(vec![mean; areas.len()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::Silent;

    /// A square grid of 100 places at distance 2, each with `copies` points.
    fn grid(copies: usize) -> PointCloud {
        let points: Vec<Vec3> = (0..100 * copies)
            .map(|i| Vec3::new((i / copies % 10) as f64, (i / copies / 10) as f64, 0.5))
            .collect();
        let normals = vec![Vec3::Z; points.len()];
        PointCloud::cleaned(points.iter().map(|p| 2.0 * *p).collect(), Some(normals), None).unwrap().0
    }

    fn total(cloud: &PointCloud, method: AreaMethod) -> f64 {
        areas(cloud, method, &EstimateConfig::default(), &Silent).unwrap().iter().sum()
    }

    #[test]
    fn copies_change_no_sum() {
        for method in
            [AreaMethod::Voronoi, AreaMethod::Curved, AreaMethod::NearestNeighbour, AreaMethod::Uniform]
        {
            let (single, many) = (total(&grid(1), method), total(&grid(30), method));
            assert!((many / single - 1.0).abs() < 1e-12, "{method:?}: {many} instead of {single}");
        }
    }

    #[test]
    fn circles_of_a_square_grid_add_up_to_pi_times_its_area() {
        let circles = total(&grid(1), AreaMethod::NearestNeighbour);
        assert!((circles / (400.0 * PI) - 1.0).abs() < 1e-12, "{circles}");
        let (bare, _) = PointCloud::cleaned(grid(1).points().to_vec(), None, None).unwrap();
        assert_eq!(total(&bare, AreaMethod::NearestNeighbour), circles);
    }

    #[test]
    fn uniform_areas_add_up_to_those_of_the_cells() {
        let cloud = grid(1);
        let uniform = areas(&cloud, AreaMethod::Uniform, &EstimateConfig::default(), &Silent).unwrap();
        assert!(uniform.iter().all(|a| *a == uniform[0]));
        assert!((100.0 * uniform[0] / total(&cloud, AreaMethod::Voronoi) - 1.0).abs() < 1e-12);
    }
}
