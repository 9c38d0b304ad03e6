//! Fig. 10: time to build, and average time of a query over a lattice of 50³, against the number of triangles.
use crate::measured::{affordable, lattice, median, points, print_table, short};
use crate::models::Model;
use crate::plot::{Chart, Mark, Series};
use fast_winding::data::{Shape, Silent};
use fast_winding::treecode::{Tree, TreeConfig};
use fast_winding::winding::{Accuracy, ExactHierarchy, FieldConfig, Triangles, WindingField};
use std::path::Path;

const SIDE: usize = 50;
/// Seconds for the queries of the exact hierarchy, which is slow on loose triangles.
const HIERARCHY_BUDGET: f64 = 1.0;

struct Row {
    name: String,
    triangles: usize,
    /// Seconds: the field, the tree of the paper's evaluator, the hierarchy.
    builds: [f64; 3],
    /// Seconds for one query: the field by default, the paper's evaluator, the same query by query, the hierarchy.
    queries: [f64; 4],
}

const BUILDS: [&str; 3] = ["fast-winding", "paper: tree and moments", "hierarchy of 2013"];
const QUERIES: [&str; 4] =
    ["fast-winding", "paper: order 2, β 2", "the same, query by query", "hierarchy of 2013"];
const MARKS: [Mark; 4] = [Mark::Circle, Mark::Triangle, Mark::Diamond, Mark::Square];

fn measure(model: &Model) -> Row {
    let shape = Shape::from(model.soup.clone());
    let (build, field) = median(|| WindingField::new(shape.clone(), FieldConfig::default()));
    let tree_config = TreeConfig { leaf_size: FieldConfig::default().leaf_size };
    let (tree_build, _) = median(|| Tree::build(&Triangles::new(model.soup.clone()), &tree_config));
    let (hierarchy_build, hierarchy) = median(|| ExactHierarchy::new(&model.soup));
    let lattice = lattice(&model.soup, SIDE);
    let points = points(&lattice);
    let done = "nothing cancels";
    let of_paper = Accuracy::of_paper(&shape);
    field.evaluate(&points[..1], of_paper, &Silent).expect(done); // builds its tree when first asked
    let on_lattice = |accuracy| median(|| field.evaluate_lattice(&lattice, accuracy, &Silent).expect(done)).0;
    let one_by_one = median(|| field.evaluate(&points, of_paper, &Silent).expect(done)).0;
    let by_hierarchy = |points: &[_]| median(|| hierarchy.evaluate(points, &Silent).expect(done)).0;
    let sample = affordable(&points, HIERARCHY_BUDGET, by_hierarchy);
    let count = points.len() as f64;
    Row {
        name: model.name.clone(),
        triangles: model.soup.len(),
        builds: [build, tree_build, hierarchy_build],
        queries: [
            on_lattice(Accuracy::default()) / count,
            on_lattice(of_paper) / count,
            one_by_one / count,
            by_hierarchy(&sample) / sample.len() as f64,
        ],
    }
}

pub fn report(models: impl Iterator<Item = Model>, folder: &Path) {
    let mut rows: Vec<Row> = models.map(|model| measure(&model)).collect();
    rows.sort_by_key(|row| row.triangles);
    println!("### Build and query time against size (fig. 10), lattice of {SIDE}³\n");
    let header: Vec<String> = ["model", "triangles"]
        .map(String::from)
        .into_iter()
        .chain(BUILDS.map(|b| format!("build, ms: {b}")))
        .chain(QUERIES.map(|q| format!("query, µs: {q}")))
        .chain(["2013 / ours: build".into(), "query".into()])
        .collect();
    print_table(&header.iter().map(String::as_str).collect::<Vec<_>>(), rows.iter().map(Row::cells));
    let [slower_build, slower_query] =
        [|r: &Row| r.builds[2] / r.builds[0], |r: &Row| r.queries[3] / r.queries[0]]
            .map(|ratio| rows.iter().map(ratio).fold(0.0, f64::max));
    println!(
        "The hierarchy of 2013 took up to {}× as long to build and up to {}× as long for a query. The paper saw up to \
         100× and up to 1000× on Thingi10K with its implementations (Barill et al. 2018, fig. 10).\n",
        short(slower_build),
        short(slower_query)
    );
    plot(&rows, &BUILDS, &[0, 1, 3], |row| row.builds.to_vec())
        .titled("Time to build", "triangles", "seconds")
        .write(&folder.join("figure-10-build.svg"));
    plot(&rows, &QUERIES, &[0, 1, 2, 3], |row| row.queries.map(|s| 1e6 * s).to_vec())
        .titled("Average time of a query, lattice of 50³", "triangles", "microseconds")
        .write(&folder.join("figure-10-query.svg"));
}

impl Row {
    fn cells(&self) -> Vec<String> {
        let ratios = [self.builds[2] / self.builds[0], self.queries[3] / self.queries[0]];
        [self.name.clone(), self.triangles.to_string()]
            .into_iter()
            .chain(self.builds.map(|s| short(1e3 * s)))
            .chain(self.queries.map(|s| short(1e6 * s)))
            .chain(ratios.map(|r| format!("{}×", short(r))))
            .collect()
    }
}

/// `looks` are a colour and a mark for each of the series, the same for one evaluator in all plots.
fn plot(rows: &[Row], names: &[&str], looks: &[usize], values: impl Fn(&Row) -> Vec<f64>) -> Chart {
    let of = |k: usize| rows.iter().map(|row| (row.triangles as f64, values(row)[k])).collect();
    let series = names.iter().zip(looks).enumerate();
    Chart::log_log(series.map(|(k, (name, look))| Series::marks(name, *look, MARKS[*look], of(k))).collect())
}
