//! Level sets of fields and of distances: closed, manifold, finite.
use super::facts::{Watch, assert_closed_manifold, assert_manifold};
use super::shapes::Made;
use super::slices::{reaches_far, too_few_to_wait_for};
use super::source::Source;
use fast_winding::surface::{
    Drain, HollowConfig, OffsetConfig, SurfaceConfig, extract, hollow, offset, two_sided_offset,
};
use fast_winding::winding::{FieldConfig, WindingField};

/// A field of any shape.
fn field(source: &mut Source) -> WindingField {
    let Made { shape, .. } = source.shape();
    let config = FieldConfig { bounded: source.flag(), ..FieldConfig::default() };
    WindingField::new(shape, config)
}

fn resolution(source: &mut Source) -> Option<usize> {
    Some(source.below(16))
}

fn spacing(source: &mut Source, field: &WindingField) -> Option<f64> {
    let usual = field.bounds().size().max_element() / 7.0;
    source.option(&[usual, 2.0 * usual, 0.5 * usual]).filter(|spacing| too_few_to_wait_for(*spacing, field))
}

pub fn level_sets(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let field = field(&mut source);
    let config = SurfaceConfig {
        resolution: resolution(&mut source),
        spacing: spacing(&mut source, &field),
        level: source
            .option(&[0.5, 0.4, 0.3, 1.5])
            .filter(|level| level.is_nan() || level.abs() >= 0.1 || *level == 0.0),
        min_component: source.option(&[0.0, 0.1]),
        smoothing: source.option(&[0.5, 1.0]),
        trim: source.option(&[1.5, 3.0]),
        sharp: source.option(&[35.0, 10.0, 120.0]),
    };
    if reaches_far(&field, config.spacing, config.resolution.unwrap_or(1)) {
        return;
    }
    let Ok(mesh) = extract(&field, &config, &Watch::new(source.byte())) else { return };
    match config.trim {
        Some(_) => assert_manifold(&mesh.positions, &mesh.triangles, "a trimmed surface"),
        None => assert_closed_manifold(&mesh, "a surface"),
    }
}

pub fn offsets(bytes: &[u8]) {
    let mut source = Source::new(bytes);
    let field = field(&mut source);
    let size = field.bounds().size().max_element();
    let sharp = source.option(&[35.0]);
    let kind = source.below(3);
    let length = size * source.setting(&[0.1, -0.1, 0.5, 0.25, 1.0]);
    // Far away the cells of so fine a spacing would be many.
    let spacing = spacing(&mut source, &field).filter(|_| length.abs() <= size);
    let resolution = resolution(&mut source);
    let watch = Watch::new(source.byte());
    if reaches_far(&field, spacing, resolution.unwrap_or(1)) {
        return;
    }
    let made = match kind {
        0 => {
            let drain = |source: &mut Source| Drain {
                at: source.grid_point() * size,
                direction: source.any_point(),
                radius: 0.2 * size,
            };
            let drains = (0..source.below(2)).map(|_| drain(&mut source)).collect();
            hollow(&field, &HollowConfig { thickness: length, drains, resolution, spacing, sharp }, &watch)
        }
        kind => {
            let config = OffsetConfig { distance: length, resolution, spacing, sharp };
            if kind == 1 {
                offset(&field, &config, &watch)
            } else {
                two_sided_offset(&field, &config, &watch)
            }
        }
    };
    if let Ok(mesh) = made {
        assert_closed_manifold(&mesh, "an offset surface");
    }
}
