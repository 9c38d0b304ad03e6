//! Voxels as files, and as they are for comparison: `voxels.u8`, a byte for each, x fastest; `lattice.json`.
use fast_winding::Lattice;
use fast_winding::data::{Shape, Silent};
use fast_winding::io::{NrrdEncoding, VoxContent, write_nrrd, write_vox};
use fast_winding::solid::{VoxelConfig, VoxelMethod, voxelize_bricks};
use fast_winding::winding::WindingField;
use std::fs::{File, write as write_file};
use std::path::Path;

pub fn write(shape: &Shape, folder: &str, resolution: usize) {
    let folder = Path::new(folder);
    let file = |name: &str| File::create(folder.join(name)).expect("the folder can be written to");
    let field = WindingField::new(shape.clone(), Default::default());
    for (name, resolution) in [("small", 60), ("large", resolution)] {
        let lattice = Lattice::with_resolution(field.bounds(), resolution).expect("the model has a size");
        let config = VoxelConfig { method: VoxelMethod::Lattice, threshold: 0.5 };
        let bricks = voxelize_bricks(&field, &lattice, &config, &Silent).expect("the bricks fit");
        let in_file = "the file can be written";
        write_nrrd(&bricks, NrrdEncoding::Gzip, &mut file(&format!("{name}.nrrd"))).expect(in_file);
        write_nrrd(&bricks, NrrdEncoding::Raw, &mut file(&format!("{name}-raw.nrrd"))).expect(in_file);
        write_vox(&bricks, VoxContent::Solid, &mut file(&format!("{name}.vox"))).expect(in_file);
        write_vox(&bricks, VoxContent::Shell, &mut file(&format!("{name}-shell.vox"))).expect(in_file);
        let bytes = bricks.to_voxels().and_then(|v| v.to_bytes()).expect("the voxels fit");
        write_file(folder.join(format!("{name}.u8")), bytes).expect(in_file);
        let [origin, spacing] = [lattice.origin, lattice.spacing].map(|v| v.to_array());
        let text =
            format!("{{\"counts\": {:?}, \"origin\": {origin:?}, \"spacing\": {spacing:?}}}", lattice.counts);
        write_file(folder.join(format!("{name}.json")), text).expect(in_file);
    }
}
