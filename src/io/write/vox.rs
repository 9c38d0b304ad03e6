//! VOX of MagicaVoxel, version 150, as github.com/ephtracy/voxel-model describes it: models of up to 256 voxels along each side, and for
//! more of them a scene graph that says where they are.
use crate::data::VoxelRows;
use std::io::{self, BufWriter, Write};

/// Most voxels along a side of a model.
const SIDE: usize = 256;
const VERSION: i32 = 150;
/// The first colour of the palette, which all voxels have; red, green, blue and opacity.
const COLOUR: [u8; 4] = [224, 224, 224, 255];
/// Bytes before the content of a chunk: its name, the length of its content and that of the chunks in it.
const HEAD: usize = 12;

/// Which voxels a VOX file holds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VoxContent {
    /// Those inside that have one of the six neighbours outside: all that can be seen.
    #[default]
    Shell,
    /// All that are inside.
    Solid,
}

/// Why voxels cannot be written as VOX.
#[derive(Debug, thiserror::Error)]
pub enum VoxError {
    #[error("the file would take {bytes} bytes, and VOX can have {max}: write the shell, or fewer voxels", max = i32::MAX)]
    TooLarge { bytes: usize },
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Part of a lattice that makes a model.
struct Model {
    first: [usize; 3],
    size: [usize; 3],
    voxels: usize,
}

/// Writes voxels as VOX, z up. The format knows no lengths: a voxel is one unit, however large it is. Of lattices larger than a model
/// has room for, each part of 256 × 256 × 256 that holds voxels is a model with its place, and the scene's origin is at the
/// middle of the lattice's bottom.
///
/// # Errors
/// If and only if the file would be larger than its lengths can say, or `out` refuses to be written to.
pub fn write_vox(voxels: &dyn VoxelRows, content: VoxContent, out: &mut impl Write) -> Result<(), VoxError> {
    let counts = voxels.lattice().counts;
    let parts = counts.map(|n| n.div_ceil(SIDE));
    let mut models: Vec<Model> = (0..parts.iter().product::<usize>())
        .map(|p| {
            let first = [p % parts[0], p / parts[0] % parts[1], p / (parts[0] * parts[1])].map(|c| c * SIDE);
            let size = [0, 1, 2].map(|axis| (counts[axis] - first[axis]).min(SIDE));
            Model { first, size, voxels: 0 }
        })
        .collect();
    for model in &mut models {
        let mut count = 0;
        for_each_voxel(voxels, model, content, |_| count += 1);
        model.voxels = count;
    }
    let filled: Vec<Model> = models.extract_if(.., |m| m.voxels > 0).collect();
    // A file without a model is none.
    let models = if filled.is_empty() { models.into_iter().take(1).collect() } else { filled };
    let scene = if parts == [1; 3] { Vec::new() } else { scene(&models, counts) };
    let of_model = |m: &Model| 2 * HEAD + 12 + 4 + 4 * m.voxels;
    let bytes = models.iter().map(of_model).sum::<usize>() + scene.len() + HEAD + 4 * 256;
    if bytes > i32::MAX as usize {
        return Err(VoxError::TooLarge { bytes });
    }
    let mut out = BufWriter::new(out);
    out.write_all(b"VOX ")?;
    out.write_all(&VERSION.to_le_bytes())?;
    out.write_all(&head(b"MAIN", 0, bytes))?;
    for model in &models {
        out.write_all(&chunk(b"SIZE", &words(&model.size.map(|n| n as i32))))?;
        out.write_all(&head(b"XYZI", 4 + 4 * model.voxels, 0))?;
        out.write_all(&(model.voxels as i32).to_le_bytes())?;
        let mut written = Ok(());
        for_each_voxel(voxels, model, content, |[x, y, z]| {
            if written.is_ok() {
                written = out.write_all(&[x, y, z, 1]);
            }
        });
        written?;
    }
    out.write_all(&scene)?;
    out.write_all(&chunk(b"RGBA", &[COLOUR; 256].concat()))?;
    out.flush()?;
    Ok(())
}

fn head(name: &[u8; 4], content: usize, children: usize) -> Vec<u8> {
    [&name[..], &words(&[content as i32, children as i32])].concat()
}

fn chunk(name: &[u8; 4], content: &[u8]) -> Vec<u8> {
    [&head(name, content.len(), 0), content].concat()
}

fn words(values: &[i32]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// Pairs of strings.
fn dictionary(pairs: &[(&str, &str)]) -> Vec<u8> {
    let text = |s: &str| [&words(&[s.len() as i32]), s.as_bytes()].concat();
    let pairs = pairs.iter().map(|(key, value)| [text(key), text(value)].concat());
    std::iter::once(words(&[pairs.len() as i32])).chain(pairs).collect::<Vec<_>>().concat()
}

/// The scene graph: a root, a group below it, in it for each model its place and its shape.
fn scene(models: &[Model], counts: [usize; 3]) -> Vec<u8> {
    let transform = |node: usize, child: usize, layer: i32, frame: &[(&str, &str)]| {
        let attributes = [node as i32].map(|n| words(&[n])).concat();
        let links = words(&[child as i32, -1, layer, 1]);
        chunk(b"nTRN", &[attributes, dictionary(&[]), links, dictionary(frame)].concat())
    };
    let place_of = |k: usize| 2 + 2 * k;
    let children: Vec<i32> = (0..models.len()).map(|k| place_of(k) as i32).collect();
    let group = [words(&[1]), dictionary(&[]), words(&[children.len() as i32]), words(&children)].concat();
    let mut scene = [transform(0, 1, -1, &[]), chunk(b"nGRP", &group)].concat();
    for (k, model) in models.iter().enumerate() {
        // The middle of a model, rounded down, is put there.
        let at = |axis: usize| {
            let middle = model.first[axis] + model.size[axis] / 2;
            middle as i64 - if axis < 2 { counts[axis] as i64 / 2 } else { 0 }
        };
        let place = format!("{} {} {}", at(0), at(1), at(2));
        scene.extend(transform(place_of(k), place_of(k) + 1, 0, &[("_t", &place)]));
        let shape =
            [words(&[place_of(k) as i32 + 1]), dictionary(&[]), words(&[1, k as i32]), dictionary(&[])];
        scene.extend(chunk(b"nSHP", &shape.concat()));
    }
    scene
}

/// Calls `found` with the voxels of a model that the file holds, by their places in it.
fn for_each_voxel(
    voxels: &dyn VoxelRows,
    model: &Model,
    content: VoxContent,
    mut found: impl FnMut([u8; 3]),
) {
    let counts = voxels.lattice().counts;
    // With what lies around the model: planes of two more voxels each way, outside beyond the lattice.
    let [width, height] = [model.size[0] + 2, model.size[1] + 2];
    let mut planes = [0, 1, 2].map(|_| vec![0u8; width * height]);
    let [from, to] = [model.first[0].saturating_sub(1), counts[0].min(model.first[0] + model.size[0] + 1)];
    let read = |z: usize, plane: &mut [u8]| {
        plane.fill(0);
        // Counted from the plane, and the row, before the model.
        let Some(k) = (model.first[2] + z).checked_sub(1).filter(|k| *k < counts[2]) else { return };
        for (y, row) in plane.chunks_mut(width).enumerate() {
            if let Some(j) = (model.first[1] + y).checked_sub(1).filter(|j| *j < counts[1]) {
                let start = from + 1 - model.first[0];
                voxels.row([from, j, k], &mut row[start..start + to - from]);
            }
        }
    };
    read(0, &mut planes[1]);
    read(1, &mut planes[2]);
    for z in 0..model.size[2] {
        planes.rotate_left(1);
        read(z + 2, &mut planes[2]);
        let [below, plane, above] = &planes;
        for y in 0..model.size[1] {
            let row = (y + 1) * width + 1;
            for (x, at) in (row..row + model.size[0]).enumerate().filter(|(_, at)| plane[*at] == 1) {
                let is_hidden = || {
                    let around = [plane[at - 1], plane[at + 1], plane[at - width], plane[at + width]];
                    below[at] == 1 && above[at] == 1 && around == [1; 4]
                };
                if content == VoxContent::Solid || !is_hidden() {
                    found([x as u8, y as u8, z as u8]);
                }
            }
        }
    }
}
