//! A charged soup and its field.
use super::cells::Cells;
use super::clusters::Clusters;
use super::config::{ChargeConfig, ChargeError, ChargeReport, Solver};
use super::elements::Elements;
use super::influence::Influence;
use super::krylov;
use super::moments::{Moments, Series};
use super::panel::potential_and_field;
use super::panel_lanes::Panel;
use super::robin_hood;
use super::sum::{Charged, Value, series_of_elements};
use super::system::{Kept, Matrix, System};
use super::walk::{Block, Lists, Opening};
use crate::bvh::along_curve;
use crate::data::{BLOCK, Monitor, Parts, TriangleSoup, map_items, map_tasks};
use crate::math::Vec3;
use std::sync::Arc;

/// Up to so many elements all entries of the system are kept: 288 MB.
const MOST_IN_MATRIX: usize = 6000;

/// A charged triangle soup: charges that make the potential the same on all triangles, and their field.
///
/// ```
/// # use fast_winding::{TriangleSoup, charge::{ChargeConfig, ElectricField}, data::Silent, math::Vec3};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let soup = TriangleSoup::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])?;
/// let field = ElectricField::solve(soup.into(), &ChargeConfig::default(), &Silent)?;
/// let far = 1000.0 * Vec3::Z;
/// assert!((field.potential(&[far])[0] * 1000.0 - 1.0).abs() < 1e-3);
/// # Ok(())
/// # }
/// ```
pub struct ElectricField {
    soup: Arc<TriangleSoup>,
    elements: Elements,
    clusters: Clusters,
    opening: Opening,
    of_elements: Vec<Series>,
    of_clusters: Vec<Series>,
    panels: Vec<Panel>,
    /// Their sizes are 1 in all: 32-bit floats hold the series of any charge then.
    element_charges: Vec<f64>,
    /// What these are to be multiplied by.
    unit: f64,
    charges: Vec<f64>,
    report: ChargeReport,
}

impl ElectricField {
    /// Charges a soup so that the potential is the same at the barycentres of all its triangles, or of their parts.
    ///
    /// Up to 6,000 elements the system is kept as a matrix and solved as exactly as asked for. More take the tree: their
    /// deviation is that of potentials by the tree, some 10⁻⁵ of which are wrong; the report says whether it is as small as asked.
    ///
    /// # Errors
    /// If and only if no triangle has an area, a number of the configuration is out of its range, the system does not fit in
    /// memory, or `monitor` cancels.
    pub fn solve(
        soup: Arc<TriangleSoup>,
        config: &ChargeConfig,
        monitor: &dyn Monitor,
    ) -> Result<Self, ChargeError> {
        let wanted = vec![1.0; soup.len()];
        ElectricField::between(soup, &wanted, config, monitor)
    }

    /// The field between a soup with the potential 1 and a surface around it with −1, both charged: the dipole field of Degener &
    /// Klein 2007 (section 7.3), for comparison. Its lines lead from the soup to that surface.
    ///
    /// The soup of the result is both, the surface's triangles last. The soup's charge is `config.total`; the system is solved by
    /// GMRES.
    ///
    /// # Errors
    /// Those of [`ElectricField::solve`], for both together.
    pub fn dipole(
        soup: &TriangleSoup,
        around: &TriangleSoup,
        config: &ChargeConfig,
        monitor: &dyn Monitor,
    ) -> Result<Self, ChargeError> {
        let first = soup.positions().len() as u32;
        let positions = [soup.positions(), around.positions()].concat();
        let shifted = around.triangles().iter().map(|corners| corners.map(|i| first + i));
        let triangles = soup.triangles().iter().copied().chain(shifted).collect();
        let both = TriangleSoup::new(positions, triangles).expect("both are soups");
        let wanted: Vec<f64> = (0..both.len()).map(|t| if t < soup.len() { 1.0 } else { -1.0 }).collect();
        let config = ChargeConfig { solver: Solver::Krylov, ..*config };
        ElectricField::between(both.into(), &wanted, &config, monitor)
    }

    /// Charges for potentials of 1 or −1 on each triangle; the sum of the positive triangles' is `config.total`.
    fn between(
        soup: Arc<TriangleSoup>,
        wanted: &[f64],
        config: &ChargeConfig,
        monitor: &dyn Monitor,
    ) -> Result<Self, ChargeError> {
        config.check()?;
        let monitor = &Parts::new(monitor);
        monitor.report(0.0, "charges")?;
        let elements = Elements::new(&soup, config.refinement.as_ref());
        if elements.is_empty() {
            return Err(ChargeError::NoArea { triangles: soup.len() });
        }
        let of_triangles = wanted;
        let wanted: Vec<f64> = elements.parents.iter().map(|t| of_triangles[*t as usize]).collect();
        let clusters = Clusters::of(&elements);
        let own = own_moments(&elements);
        let influence = Influence { elements: &elements, integration: config.integration };
        let system: Box<dyn System> = if elements.len() <= MOST_IN_MATRIX {
            Box::new(Matrix::new(&influence)?)
        } else {
            Box::new(Kept::new(&influence, &clusters, &own, monitor)?)
        };
        let solution = match config.solver {
            Solver::Krylov => krylov::solve(&*system, &influence, &wanted, config.tolerance, monitor)?,
            Solver::RobinHood => {
                let area: f64 = elements.areas.iter().sum();
                let even = elements.areas.iter().map(|own| own / area).collect();
                robin_hood::solve(&*system, even, config.tolerance, config.most_steps, monitor)?
            }
        };
        let sizes: f64 = solution.charges.iter().map(|charge| charge.abs()).sum();
        let element_charges: Vec<f64> = solution.charges.iter().map(|charge| charge / sizes).collect();
        // The sum is that of the triangles: parts of one may have far larger charges, of both signs.
        let mut charges = vec![0.0; soup.len()];
        elements.parents.iter().zip(&element_charges).for_each(|(t, charge)| charges[*t as usize] += charge);
        let is_of_soup = |pair: &(&f64, &f64)| *pair.1 > 0.0;
        let sum: f64 = charges.iter().zip(of_triangles).filter(is_of_soup).map(|(charge, _)| charge).sum();
        let unit = config.total / sum;
        charges.iter_mut().for_each(|charge| *charge *= unit);
        // With the signs of one conductor: all are to be the same.
        let potentials = system.potentials(&element_charges);
        let potentials: Vec<f64> = potentials.iter().zip(&wanted).map(|(p, wanted)| p * wanted).collect();
        drop(system);
        let mut is_flat = vec![true; soup.len()];
        elements.parents.iter().for_each(|parent| is_flat[*parent as usize] = false);
        let deviation = robin_hood::deviation(&potentials).0;
        let report = ChargeReport {
            elements: elements.len(),
            flat: is_flat.iter().filter(|flat| **flat).count(),
            steps: solution.steps,
            deviation,
            reached: deviation <= config.tolerance,
            potential: unit * elements.frame.scale * potentials.iter().sum::<f64>() / potentials.len() as f64,
        };
        Ok(ElectricField {
            of_elements: series_of_elements(&own, &element_charges),
            of_clusters: clusters.series(&elements, &own, &element_charges),
            panels: map_items(elements.len(), |i| {
                Panel::new(elements.corners[i], elements.centers[i], elements.sizes[i])
            }),
            soup,
            elements,
            clusters,
            opening: config.opening,
            element_charges,
            unit,
            charges,
            report,
        })
    }

    pub fn soup(&self) -> &Arc<TriangleSoup> {
        &self.soup
    }

    /// One for each triangle of the soup.
    pub fn charges(&self) -> &[f64] {
        &self.charges
    }

    pub fn report(&self) -> &ChargeReport {
        &self.report
    }

    /// The potential at points, positive around a positive charge; NaN where a point is not finite.
    pub fn potential(&self, points: &[Vec3]) -> Vec<f64> {
        self.at(points).into_iter().map(|value| value.0).collect()
    }

    /// The field at points, which points away from positive charges: −∇ of the potential. NaN where a point is not finite.
    pub fn field(&self, points: &[Vec3]) -> Vec<Vec3> {
        self.at(points).into_iter().map(|value| value.1).collect()
    }

    /// The field by the closed form of every element: the slow way, exact to rounding.
    pub fn direct(&self, q: Vec3) -> (f64, Vec3) {
        let q = self.elements.frame.local(q);
        let sum = (0..self.elements.len()).fold((0.0, Vec3::ZERO), |sum: Value, i| {
            let density = self.element_charges[i] / self.elements.areas[i];
            let (potential, field) = potential_and_field(q, self.elements.corners[i]);
            (sum.0 + density * potential, sum.1 + density * field)
        });
        self.world(sum)
    }

    fn at(&self, points: &[Vec3]) -> Vec<Value> {
        let finite: Vec<u32> = (0..points.len() as u32).filter(|i| points[*i as usize].is_finite()).collect();
        let places: Vec<Vec3> = finite.iter().map(|i| points[*i as usize]).collect();
        let order = along_curve(&places);
        let tasks = map_tasks(order.len().div_ceil(BLOCK), |task| {
            let own = &order[task * BLOCK..order.len().min((task + 1) * BLOCK)];
            let points: Vec<Vec3> = own.iter().map(|k| places[*k as usize]).collect();
            self.at_block(&points, &mut Lists::default())
        });
        let mut values = vec![(f64::NAN, Vec3::NAN); points.len()];
        let found = order.iter().zip(tasks.into_iter().flatten());
        found.for_each(|(k, value)| values[finite[*k as usize] as usize] = value);
        values
    }

    /// Potential and field at up to [`BLOCK`] finite points that lie close together.
    fn at_block(&self, points: &[Vec3], lists: &mut Lists) -> Vec<Value> {
        let values = self.charged().at(&self.local_block(points), lists);
        values.into_iter().map(|value| self.world(value)).collect()
    }

    /// The same at any finite points, with what is kept of former questions at points close to them.
    pub(super) fn at_moving(&self, points: &[Vec3], cells: &mut Cells) -> Vec<Value> {
        let local: Vec<Vec3> = points.iter().map(|p| self.elements.frame.local(*p)).collect();
        let values = cells.at(&self.charged(), &local);
        values.into_iter().map(|value| self.world(value)).collect()
    }

    /// For [`ElectricField::at_moving`]: the smallest cubes have edges of `edge`.
    pub(super) fn cells(&self, edge: f64) -> Cells {
        Cells::new(self.elements.frame.scale * edge)
    }

    fn local_block(&self, points: &[Vec3]) -> Block {
        let local: Vec<Vec3> = points.iter().map(|p| self.elements.frame.local(*p)).collect();
        Block::new(&local)
    }

    fn charged(&self) -> Charged<'_> {
        Charged {
            elements: &self.elements,
            clusters: &self.clusters,
            opening: self.opening,
            charges: &self.element_charges,
            of_clusters: &self.of_clusters,
            of_elements: &self.of_elements,
            panels: &self.panels,
        }
    }

    fn world(&self, (potential, field): Value) -> Value {
        let scale = self.elements.frame.scale;
        (self.unit * scale * potential, self.unit * scale * scale * field)
    }
}

fn own_moments(elements: &Elements) -> Vec<Moments> {
    map_items(elements.len(), |i| Moments::of_triangle(elements.corners[i], elements.centers[i]))
}
