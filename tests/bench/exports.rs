//! Layers of a model as files: `exports MODEL FOLDER [--layers N]` writes them in every format there is, and `layers.f64` for
//! `peers/roundtrip.py` to compare with: raw little-endian numbers, a layer's bottom, top, sample and number of polygons, a polygon's number
//! of rings, a ring's number of points and its x y x y.
use fast_winding::data::{Layer, Silent};
use fast_winding::io::{
    self, Geometry, MeshResolution, write_layer_svg, write_layers_3mf, write_layers_dxf, write_layers_json,
    write_layers_svg,
};
use fast_winding::slice::{LayerPlan, SliceConfig, slice};
use fast_winding::winding::WindingField;
use std::error::Error;
use std::fs::{File, write};
use std::path::Path;
use std::sync::Arc;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let count: f64 = match words.get(2..4) {
        Some([name, count]) if name == "--layers" => count.parse()?,
        _ => 100.0,
    };
    let Geometry::Soup(soup) = io::read(&std::fs::read(&words[0])?)?.geometry else {
        return Err("a model with triangles is needed".into());
    };
    let soup = Arc::new(soup);
    let field = WindingField::new(soup.clone(), Default::default());
    let plan = LayerPlan { layer_height: field.bounds().size().z / count, ..LayerPlan::default() };
    let layers = slice(&field, &plan, &SliceConfig::default(), &Silent)?;
    let folder = Path::new(&words[1]);
    let file = |name: &str| File::create(folder.join(name));
    write_layers_svg(&layers, &mut file("layers.svg")?)?;
    write_layers_dxf(&layers, &mut file("layers.dxf")?)?;
    write_layers_json(&layers, &mut file("layers.json")?)?;
    write_layers_3mf(&layers, &soup, MeshResolution::Full, &mut file("layers.3mf")?)?;
    for (number, layer) in layers.iter().enumerate() {
        write_layer_svg(layer, &mut file(&format!("layer{number}.svg"))?)?;
    }
    write(
        folder.join("layers.f64"),
        numbers(&layers).iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>(),
    )?;
    Ok(())
}

fn numbers(layers: &[Layer]) -> Vec<f64> {
    let mut all = Vec::new();
    for layer in layers {
        all.extend([layer.z_bottom, layer.z_top, layer.z_sample, layer.polygons.len() as f64]);
        for polygon in &layer.polygons {
            all.push(1.0 + polygon.holes.len() as f64);
            for ring in std::iter::once(&polygon.outer).chain(&polygon.holes) {
                all.push(ring.len() as f64);
                all.extend(ring.iter().flat_map(|p| p.to_array()));
            }
        }
    }
    all
}
