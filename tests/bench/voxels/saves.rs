//! Fields built beside the same fields loaded.
use crate::{median, milliseconds, read, with_commas};
use fast_winding::Lattice;
use fast_winding::data::Silent;
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::winding::WindingField;

pub fn print(models: &[String]) {
    println!("{} threads; milliseconds.\n", rayon::current_num_threads());
    println!(
        "| model | elements | build | save | load | loaded / built | MB saved | of it the shape | voxels at 64³ | points: prepared | once saved | MB more |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for model in models {
        let shape = read(model);
        let (build, field) = median(|| WindingField::new(shape.clone(), Default::default()));
        let (save, bytes) = median(|| {
            let mut bytes = Vec::new();
            field.save(&mut bytes).expect("a vector takes any bytes");
            bytes
        });
        let (load, loaded) = median(|| WindingField::load(&bytes).expect("it was saved just now"));
        let lattice = Lattice::with_resolution(field.bounds(), 64).expect("the model has a size");
        let of = |field: &WindingField| {
            voxelize(field, &lattice, &VoxelConfig::default(), &Silent).expect("the voxels fit")
        };
        let (query, voxels) = median(|| of(&field));
        assert!(of(&loaded) == voxels, "a loaded field answers otherwise");
        // What inside tests of scattered points need, built, and built from what was saved once it was.
        let prepared =
            |bytes: &[u8]| median(|| WindingField::load(bytes).expect("it was saved").prepare_points()).0;
        let ready = prepared(&bytes) - load;
        field.prepare_points();
        let mut with_points = Vec::new();
        field.save(&mut with_points).expect("a vector takes any bytes");
        let loaded_ready = prepared(&with_points) - load;
        let of_shape = match &shape {
            fast_winding::data::Shape::Soup(soup) => 24 * soup.positions().len() + 12 * soup.len(),
            fast_winding::data::Shape::Cloud(cloud) => 56 * cloud.len(),
        };
        let name = model.rsplit('/').next().unwrap_or(model);
        println!(
            "| {name} | {} | {} | {} | {} | {:.2} | {:.1} | {:.1} | {} | {} | {} | {:.1} |",
            with_commas(shape.len()),
            milliseconds(build),
            milliseconds(save),
            milliseconds(load),
            load / build,
            bytes.len() as f64 / 1e6,
            of_shape as f64 / 1e6,
            milliseconds(query),
            milliseconds(ready.max(0.0)),
            milliseconds(loaded_ready.max(0.0)),
            (with_points.len() - bytes.len()) as f64 / 1e6
        );
    }
}
