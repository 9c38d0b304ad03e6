//! The figures of Barill et al. 2018 with this crate's evaluators: `node pkg-config/bench.mjs figures`.
//!
//! `figures FOLDER MODEL… [--only scaling|layers|accuracy|quality]` reads models, generates more, prints Markdown tables and writes plots as SVG files to FOLDER:
//! build and query time against size (fig. 10), that of layers, voxelization and error against β (fig. 11 and its inset), and the share
//! of misclassified voxels (the statistics of section 4). Everything runs on all threads; times are medians of one run.
mod accuracy;
mod layers;
mod measured;
mod models;
mod plot;
mod quality;
mod scaling;

#[path = "../../common/mod.rs"]
mod common;

use models::Model;
use std::path::Path;
use std::time::Instant;

/// Models of the voxel figure, where they are among those given: the scan that everybody knows, which serves for its inset
/// too, and a soup of open parts that cross, as the paper's is.
const VOXEL_MODELS: [&str; 2] = ["bunny", "teapot"];

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let only = arguments.iter().position(|word| word == "--only").map(|at| {
        let named: Vec<String> = arguments.drain(at..).skip(1).collect();
        named.into_iter().next().expect("--only takes a name")
    });
    let is_wanted = |name: &str| only.as_deref().is_none_or(|only| only == name);
    let [folder, files @ ..] = &arguments[..] else { panic!("usage: figures FOLDER MODEL… [--only NAME]") };
    let folder = Path::new(folder);
    std::fs::create_dir_all(folder).expect("the folder can be made");
    let start = Instant::now();
    let read: Vec<Model> = files.iter().map(|path| Model::read(path)).collect();
    println!("{} threads; times are medians.\n", rayon::current_num_threads());

    if is_wanted("scaling") {
        scaling::report(read.iter().cloned().chain(models::growing()), folder);
    }
    if is_wanted("layers") {
        // Loose and damaged soups are traced on grids: minutes.
        let is_cut = |model: &Model| {
            !["loose-bunny", "damaged torus", "snowden", "teapot"].contains(&model.name.as_str())
        };
        layers::report(read.iter().cloned().chain(models::growing()).filter(is_cut), folder);
    }
    if is_wanted("accuracy") {
        let chosen: Vec<&Model> =
            VOXEL_MODELS.iter().filter_map(|name| read.iter().find(|model| model.name == *name)).collect();
        let fallback = models::damaged_torus(10_000);
        accuracy::report(&if chosen.is_empty() { vec![&fallback] } else { chosen }, folder);
    }
    if is_wanted("quality") {
        let made = [1_000, 10_000].map(models::damaged_torus).into_iter().chain([models::overlapping()]);
        quality::report(read.iter().cloned().chain(made));
    }
    println!("All of it took {:.0} s.", start.elapsed().as_secs_f64());
}
