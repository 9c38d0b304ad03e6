//! Layers: time for a hundred and a thousand of them against the number of triangles, of models that are closed or nearly so.
use crate::measured::{median, print_table, short};
use crate::models::Model;
use crate::plot::{Chart, Mark, Series};
use fast_winding::data::{Shape, Silent};
use fast_winding::slice::{LayerPlan, SliceConfig, slice_each};
use fast_winding::winding::{FieldConfig, WindingField};
use std::path::Path;

const COUNTS: [usize; 2] = [100, 1000];
const NAMES: [&str; 3] = ["field", "100 layers", "1,000 layers"];
const MARKS: [Mark; 3] = [Mark::Circle, Mark::Triangle, Mark::Square];

struct Row {
    name: String,
    triangles: usize,
    /// Seconds: of the field, and of each number of layers.
    times: [f64; 3],
}

fn measure(model: &Model) -> Row {
    let shape = Shape::from(model.soup.clone());
    let (build, field) = median(|| WindingField::new(shape.clone(), FieldConfig::default()));
    let height = field.bounds().size().z;
    let layers = COUNTS.map(|count| {
        let plan = LayerPlan { layer_height: height / count as f64, ..LayerPlan::default() };
        let cut = || slice_each(&field, &plan, &SliceConfig::default(), &Silent, &mut |_, _| {});
        median(|| cut().expect("the model has layers")).0
    });
    Row { name: model.name.clone(), triangles: model.soup.len(), times: [build, layers[0], layers[1]] }
}

pub fn report(models: impl Iterator<Item = Model>, folder: &Path) {
    let mut rows: Vec<Row> = models.map(|model| measure(&model)).collect();
    rows.sort_by_key(|row| row.triangles);
    println!("### Layers against size\n");
    let header: Vec<String> = ["model".into(), "triangles".into()]
        .into_iter()
        .chain(NAMES.map(|name| format!("{name}, ms")))
        .collect();
    let cells = rows.iter().map(|row| {
        let names = [row.name.clone(), row.triangles.to_string()];
        names.into_iter().chain(row.times.map(|s| short(1e3 * s))).collect()
    });
    print_table(&header.iter().map(String::as_str).collect::<Vec<_>>(), cells);
    let of = |k: usize| rows.iter().map(|row| (row.triangles as f64, row.times[k])).collect();
    let series = NAMES.iter().enumerate().map(|(k, name)| Series::marks(name, k, MARKS[k], of(k))).collect();
    Chart::log_log(series)
        .titled("Time to cut into layers", "triangles", "seconds")
        .write(&folder.join("layers.svg"));
}
