//! Voxels in bricks beside voxels of a bit each.
use crate::{memory, read, timed, with_commas};
use fast_winding::Lattice;
use fast_winding::data::Silent;
use fast_winding::solid::{VoxelConfig, VoxelMethod, voxelize, voxelize_bricks};
use fast_winding::winding::WindingField;

pub fn print(model: &str, resolution: usize) {
    let shape = read(model);
    let (build, field) = timed(|| WindingField::new(shape.clone(), Default::default()));
    let lattice = Lattice::with_resolution(field.bounds(), resolution).expect("the model has a size");
    println!(
        "{model}: {} elements, {:?} voxels, built in {build:.2} s\n",
        with_commas(shape.len()),
        lattice.counts
    );
    println!("| way | seconds | MB held | MB more at the peak | mixed bricks | inside |");
    println!("|---|--:|--:|--:|--:|--:|");
    let megabytes = |bytes: usize| format!("{:.1}", bytes as f64 / 1e6);
    let peak = |before: usize| megabytes(memory(false)[1].saturating_sub(before));
    let mut counts = Vec::new();
    for (name, method) in [
        ("bricks along the level set", VoxelMethod::Continuation),
        ("bricks of all samples", VoxelMethod::Lattice),
    ] {
        if method == VoxelMethod::Lattice && field.report().method.contains("fast") && resolution > 256 {
            continue; // points take microseconds each
        }
        let config = VoxelConfig { method, threshold: 0.5 };
        let [before, _] = memory(true);
        let (time, bricks) =
            timed(|| voxelize_bricks(&field, &lattice, &config, &Silent).expect("the bricks fit"));
        counts.push(bricks.count());
        println!(
            "| {name} | {time:.2} | {} | {} | {} | {} |",
            megabytes(bricks.bytes()),
            peak(before),
            with_commas(bricks.mixed()),
            with_commas(bricks.count())
        );
        if method == VoxelMethod::Continuation {
            let [before, _] = memory(true);
            let (time, surface) = timed(|| bricks.surface().expect("the planes fit"));
            let held = surface.positions.len() * 48 + surface.triangles.len() * 12;
            println!(
                "| its surface, {} triangles | {time:.2} | {} | {} | | |",
                with_commas(surface.triangles.len()),
                megabytes(held),
                peak(before)
            );
        }
    }
    if counts.len() == 2 {
        let [before, _] = memory(true);
        let (time, voxels) =
            timed(|| voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).expect("the voxels fit"));
        let held = megabytes(voxels.bits().len());
        println!(
            "| a bit for each | {time:.2} | {held} | {} | | {} |",
            peak(before),
            with_commas(voxels.count())
        );
    }
    println!();
}
