//! Fig. 11 and its inset: the time of a voxelization of 100³, and error and time against β.
use crate::measured::{affordable, lattice, median, points, print_table, short};
use crate::models::Model;
use crate::plot::{Chart, Mark, Series};
use fast_winding::data::{Shape, Silent};
use fast_winding::treecode::{Tree, TreeConfig};
use fast_winding::winding::{Accuracy, ExactHierarchy, FieldConfig, Order, Triangles, WindingField};
use std::path::Path;

const VOXELS: usize = 100;
/// Errors are taken over a coarser lattice, and those voxels only that the oracle can answer in time.
const SIDE: usize = 50;
const ORACLE_BUDGET: f64 = 2.0;
const HIERARCHY_BUDGET: f64 = 2.0;
const BETAS: [f64; 9] = [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0];
const ORDERS: [(Order, &str); 3] =
    [(Order::Zero, "order 0"), (Order::One, "order 1"), (Order::Two, "order 2")];

/// Largest and mean error, and seconds for one query.
struct Sample {
    max: f64,
    mean: f64,
    seconds: f64,
}

pub fn report(models: &[&Model], folder: &Path) {
    for model in models {
        voxels(model);
    }
    if let Some(model) = models.first() {
        against_beta(model, folder);
    }
}

fn against_beta(model: &Model, folder: &Path) {
    let table = inset(model);
    println!("### Error against β, {}, lattice of {SIDE}³ (fig. 11, inset)\n", model.name);
    let rows = BETAS.iter().enumerate().map(|(k, beta)| {
        let cells =
            table.iter().flat_map(|row| [short(row[k].max), short(row[k].mean), short(1e6 * row[k].seconds)]);
        std::iter::once(format!("{beta}")).chain(cells).collect()
    });
    let header: Vec<String> = std::iter::once("β".to_string())
        .chain(
            ORDERS.iter().flat_map(|(_, name)| ["max", "mean", "µs"].map(|what| format!("{name}: {what}"))),
        )
        .collect();
    print_table(&header.iter().map(String::as_str).collect::<Vec<_>>(), rows);

    let line = |value: fn(&Sample) -> f64, row: &[Sample]| {
        BETAS.iter().copied().zip(row.iter().map(value)).collect()
    };
    let maxima = table.iter().enumerate().map(|(k, row)| {
        Series::line(&format!("{}, largest", ORDERS[k].1), k, Mark::Circle, line(|s| s.max, row))
    });
    let means = table.iter().enumerate().map(|(k, row)| {
        Series::line(&format!("{}, mean", ORDERS[k].1), k, Mark::Square, line(|s| s.mean, row)).dashed()
    });
    Chart::linear_log(maxima.chain(means).collect())
        .titled(&format!("Error of the winding number, {}", model.name), "β", "absolute error")
        .write(&folder.join(format!("figure-11-error-{}.svg", model.name)));
    let times = table
        .iter()
        .enumerate()
        .map(|(k, row)| Series::line(ORDERS[k].1, k, Mark::Circle, line(|s| 1e6 * s.seconds, row)));
    Chart::linear_log(times.collect())
        .titled(&format!("Time of a query, {}, lattice of {SIDE}³", model.name), "β", "microseconds")
        .write(&folder.join(format!("figure-11-time-{}.svg", model.name)));
}

/// The time to build and to decide every voxel, by each evaluator.
fn voxels(model: &Model) {
    let shape = Shape::from(model.soup.clone());
    let done = "nothing cancels";
    let lattice = lattice(&model.soup, VOXELS);
    let points = points(&lattice);
    let (build, field) = median(|| WindingField::new(shape.clone(), FieldConfig::default()));
    let (hierarchy_build, hierarchy) = median(|| ExactHierarchy::new(&model.soup));
    let of_paper = Accuracy::of_paper(&shape);
    let tree_config = TreeConfig { leaf_size: FieldConfig::default().leaf_size };
    let (tree_build, _) = median(|| Tree::build(&Triangles::new(model.soup.clone()), &tree_config));
    field.evaluate(&points[..1], of_paper, &Silent).expect(done); // builds its tree when first asked
    let ours = median(|| field.evaluate_lattice(&lattice, Accuracy::default(), &Silent).expect(done)).0;
    let paper = median(|| field.evaluate_lattice(&lattice, of_paper, &Silent).expect(done)).0;
    let by_hierarchy = |points: &[_]| median(|| hierarchy.evaluate(points, &Silent).expect(done)).0;
    let sample = affordable(&points, HIERARCHY_BUDGET, by_hierarchy);
    let exact = by_hierarchy(&sample) * points.len() as f64 / sample.len() as f64;
    println!("### {VOXELS}³ voxels, {}, {} triangles (fig. 11)\n", model.name, model.soup.len());
    let row = |name: &str, build: f64, all: f64| {
        vec![name.to_string(), short(build), short(all), short(1e9 * all / points.len() as f64)]
    };
    print_table(
        &["evaluator", "build, s", "all voxels, s", "ns per voxel"],
        [
            row("fast-winding, by default", build, ours),
            row("paper's: order 2, β 2", tree_build, paper),
            row("hierarchy of 2013", hierarchy_build, exact),
            row("reported by the paper, its model and machine", 0.021, 0.184),
            row("the same, hierarchy of 2013", 0.129, 9.13),
        ],
    );
}

/// One row for each order, one sample for each β.
fn inset(model: &Model) -> Vec<Vec<Sample>> {
    let shape = Shape::from(model.soup.clone());
    let done = "nothing cancels";
    let field = WindingField::new(shape.clone(), FieldConfig::default());
    let hierarchy = ExactHierarchy::new(&model.soup);
    let lattice = lattice(&model.soup, SIDE);
    let all = points(&lattice);
    let queries = affordable(&all, ORACLE_BUDGET, |some| median(|| hierarchy.evaluate(some, &Silent)).0);
    let exact = hierarchy.evaluate(&queries, &Silent).expect(done);
    field.evaluate(&all[..1], Accuracy::of_paper(&shape), &Silent).expect(done); // builds its tree when first asked
    let sample = |order: Order, beta: f64| {
        let accuracy = Accuracy::Explicit { order, beta };
        let (seconds, grid) = median(|| field.evaluate_lattice(&lattice, accuracy, &Silent).expect(done));
        // The lattice's own values where the oracle took all of it.
        let values = if queries.len() == all.len() {
            grid.values
        } else {
            field.evaluate(&queries, accuracy, &Silent).expect(done)
        };
        let errors = values.iter().zip(&exact).map(|(w, e)| (w - e).abs());
        Sample {
            max: errors.clone().fold(0.0, f64::max),
            mean: errors.sum::<f64>() / exact.len() as f64,
            seconds: seconds / all.len() as f64,
        }
    };
    ORDERS.iter().map(|(order, _)| BETAS.iter().map(|beta| sample(*order, *beta)).collect()).collect()
}
