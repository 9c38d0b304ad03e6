//! Voxels as files, read back by the published structure of their formats.
mod common;

use common::{sphere, torus};
use fast_winding::data::{Silent, VoxelBricks, Voxels};
use fast_winding::io::{NrrdEncoding, VoxContent, VoxError, write_nrrd, write_vox};
use fast_winding::math::Vec3;
use fast_winding::solid::{VoxelConfig, voxelize};
use fast_winding::winding::WindingField;
use fast_winding::{Lattice, TriangleSoup};
use std::collections::HashMap;
use std::io::Read;

fn voxels(soup: TriangleSoup, resolution: usize) -> Voxels {
    let field = WindingField::new(soup, Default::default());
    let lattice = Lattice::with_resolution(field.bounds(), resolution).unwrap();
    voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap()
}

/// The same by the crate dot_vox.
fn read_by_dot_vox(bytes: &[u8]) -> (Vec<[i32; 3]>, usize) {
    use dot_vox::SceneNode;
    let file = dot_vox::load_bytes(bytes).unwrap();
    let mut all = Vec::new();
    let mut open = vec![(0, [0; 3])];
    while let Some((node, at)) = open.pop() {
        match &file.scenes[node as usize] {
            SceneNode::Transform { frames, child, .. } => {
                let own = frames[0].position().map_or([0; 3], |p| [p.x, p.y, p.z]);
                open.push((*child, [0, 1, 2].map(|axis| at[axis] + own[axis])));
            }
            SceneNode::Group { children, .. } => open.extend(children.iter().map(|child| (*child, at))),
            SceneNode::Shape { models, .. } => {
                let model = &file.models[models[0].model_id as usize];
                let size = [model.size.x, model.size.y, model.size.z];
                let place = |v: &dot_vox::Voxel| {
                    let own = [v.x, v.y, v.z].map(i32::from);
                    [0, 1, 2].map(|axis| own[axis] + at[axis] - size[axis] as i32 / 2)
                };
                all.extend(model.voxels.iter().map(place));
            }
        }
    }
    (all, file.models.len())
}

/// A chunk of a VOX file: its name, its content, the chunks in it.
struct Chunk<'a> {
    name: &'a [u8],
    content: &'a [u8],
    children: Vec<Chunk<'a>>,
}

fn word(bytes: &mut &[u8]) -> i32 {
    let (word, rest) = bytes.split_at(4);
    *bytes = rest;
    i32::from_le_bytes(word.try_into().unwrap())
}

fn chunks(mut bytes: &[u8]) -> Vec<Chunk<'_>> {
    let mut all = Vec::new();
    while !bytes.is_empty() {
        let (name, mut rest) = bytes.split_at(4);
        let [content, children] = [0, 1].map(|_| word(&mut rest) as usize);
        let (content, rest) = rest.split_at(content);
        let (inner, rest) = rest.split_at(children);
        all.push(Chunk { name, content, children: chunks(inner) });
        bytes = rest;
    }
    all
}

fn text(bytes: &mut &[u8]) -> String {
    let length = word(bytes) as usize;
    let (text, rest) = bytes.split_at(length);
    *bytes = rest;
    String::from_utf8(text.to_vec()).unwrap()
}

fn dictionary(bytes: &mut &[u8]) -> HashMap<String, String> {
    (0..word(bytes)).map(|_| (text(bytes), text(bytes))).collect()
}

/// The voxels of a VOX file, at their places in the scene, and the number of its models.
fn read_vox(bytes: &[u8]) -> (Vec<[i32; 3]>, usize) {
    assert_eq!((&bytes[..4], &bytes[4..8]), (&b"VOX "[..], &150i32.to_le_bytes()[..]));
    let main = chunks(&bytes[8..]);
    assert!(main.len() == 1 && main[0].name == b"MAIN" && main[0].content.is_empty());
    let (mut models, mut children, mut places, mut shapes) =
        (vec![], HashMap::new(), HashMap::new(), HashMap::new());
    let mut size = [0; 3];
    for chunk in &main[0].children {
        let mut content = chunk.content;
        match chunk.name {
            b"SIZE" => size = [0, 1, 2].map(|_| word(&mut content)),
            b"XYZI" => {
                let count = word(&mut content) as usize;
                let found: Vec<[u8; 4]> = content.as_chunks().0.to_vec();
                content = &[];
                assert!(found.len() == count && found.iter().all(|v| v[3] == 1));
                assert!(found.iter().all(|v| (0..3).all(|axis| i32::from(v[axis]) < size[axis])));
                models.push((size, found));
            }
            b"RGBA" => {
                assert_eq!(content.len(), 1024);
                content = &[];
            }
            b"nTRN" => {
                let node = word(&mut content);
                assert!(dictionary(&mut content).is_empty());
                let child = word(&mut content);
                let [reserved, _layer, frames] = [0, 1, 2].map(|_| word(&mut content));
                assert_eq!((reserved, frames), (-1, 1));
                let frame = dictionary(&mut content);
                let place = frame
                    .get("_t")
                    .map_or(vec![0; 3], |t| t.split(' ').map(|n| n.parse::<i32>().unwrap()).collect());
                children.insert(node, vec![child]);
                places.insert(node, place);
            }
            b"nGRP" => {
                let node = word(&mut content);
                assert!(dictionary(&mut content).is_empty());
                let below = (0..word(&mut content)).map(|_| word(&mut content)).collect();
                children.insert(node, below);
            }
            b"nSHP" => {
                let node = word(&mut content);
                assert!(dictionary(&mut content).is_empty());
                assert_eq!(word(&mut content), 1);
                shapes.insert(node, word(&mut content) as usize);
                assert!(dictionary(&mut content).is_empty());
            }
            name => panic!("{} is no chunk of the format", name.escape_ascii()),
        }
        assert!(content.is_empty(), "{}", chunk.name.escape_ascii());
    }
    let mut all = Vec::new();
    let mut put = |model: &([i32; 3], Vec<[u8; 4]>), at: [i32; 3]| {
        let (size, voxels) = model;
        let place = |v: &[u8; 4]| [0, 1, 2].map(|axis| i32::from(v[axis]) + at[axis] - size[axis] / 2);
        all.extend(voxels.iter().map(place));
    };
    if children.is_empty() {
        models.iter().for_each(|model| put(model, model.0.map(|n| n / 2)));
        return (all, models.len());
    }
    let mut open = vec![(0, [0; 3])];
    while let Some((node, at)) = open.pop() {
        let own = places.get(&node).map_or(at, |place| [0, 1, 2].map(|axis| at[axis] + place[axis]));
        match shapes.get(&node) {
            Some(model) => put(&models[*model], own),
            None => open.extend(children[&node].iter().map(|child| (*child, own))),
        }
    }
    (all, models.len())
}

fn inside(voxels: &Voxels) -> Vec<[usize; 3]> {
    let lattice = voxels.lattice();
    (0..lattice.len()).map(|index| lattice.sample(index)).filter(|s| voxels.get(*s)).collect()
}

fn vox(voxels: &Voxels, content: VoxContent) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_vox(voxels, content, &mut bytes).unwrap();
    let mut of_bricks = Vec::new();
    write_vox(&VoxelBricks::from_voxels(voxels).unwrap(), content, &mut of_bricks).unwrap();
    assert_eq!(of_bricks, bytes);
    bytes
}

#[test]
fn a_small_lattice_is_one_model() {
    let voxels = voxels(torus(2.0, 0.7, 40, 20), 40);
    let (found, models) = read_vox(&vox(&voxels, VoxContent::Solid));
    let expected: Vec<[i32; 3]> = inside(&voxels).into_iter().map(|s| s.map(|c| c as i32)).collect();
    assert_eq!((found, models), (expected, 1));
}

#[test]
fn a_large_lattice_is_models_with_places() {
    // Longer than a model along x and y; hollow at the seams too.
    let soup = sphere(24);
    let field = WindingField::new(soup, Default::default());
    let lattice = Lattice::with_counts(field.bounds(), [530, 300, 31]).unwrap();
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    let is_in = |s: [usize; 3]| (0..3).all(|axis| s[axis] < lattice.counts[axis]) && voxels.get(s);
    let is_seen = |s: &[usize; 3]| {
        (0..6).any(|k| {
            let mut other = *s;
            other[k / 2] = if k % 2 == 1 { s[k / 2] + 1 } else { s[k / 2].wrapping_sub(1) };
            !is_in(other)
        })
    };
    for content in [VoxContent::Solid, VoxContent::Shell] {
        let bytes = vox(&voxels, content);
        let (mut found, models) = read_vox(&bytes);
        let (mut by_another, _) = read_by_dot_vox(&bytes);
        by_another.sort();
        let mut expected: Vec<[i32; 3]> = inside(&voxels)
            .into_iter()
            .filter(|s| content == VoxContent::Solid || is_seen(s))
            .map(|[x, y, z]| [x as i32 - 265, y as i32 - 150, z as i32])
            .collect();
        found.sort();
        expected.sort();
        assert!(found == expected, "{} and {}", found.len(), expected.len());
        assert!(by_another == expected, "{} and {}", by_another.len(), expected.len());
        // Of the 3 × 2 parts those at x from 512 and y from 256 hold nothing.
        assert_eq!(models, 5);
    }
}

#[test]
fn a_file_that_its_lengths_cannot_say_is_refused() {
    let lattice = Lattice { origin: Vec3::ZERO, spacing: Vec3::ONE, counts: [1024, 1024, 513] };
    let [nx, ny, nz] = lattice.counts.map(|n| n.div_ceil(8));
    let full: Vec<u32> = (0..(nx * ny * nz) as u32).collect();
    let bricks = VoxelBricks::from_parts(lattice, &[], &[], &full).unwrap();
    let refused = write_vox(&bricks, VoxContent::Solid, &mut std::io::sink());
    assert!(matches!(refused, Err(VoxError::TooLarge { .. })), "{refused:?}");
}

#[test]
fn nrrd_says_where_the_voxels_are() {
    let soup = torus(2.0, 0.7, 20, 12);
    let field = WindingField::new(soup, Default::default());
    let lattice = Lattice::with_counts(field.bounds(), [13, 17, 5]).unwrap();
    let voxels = voxelize(&field, &lattice, &VoxelConfig::default(), &Silent).unwrap();
    for encoding in [NrrdEncoding::Raw, NrrdEncoding::Gzip] {
        let mut bytes = Vec::new();
        write_nrrd(&voxels, encoding, &mut bytes).unwrap();
        let end = bytes.windows(2).position(|pair| pair == b"\n\n").unwrap();
        let header = std::str::from_utf8(&bytes[..end]).unwrap();
        let mut lines = header.lines();
        assert_eq!(lines.next(), Some("NRRD0005"));
        let fields: HashMap<&str, &str> =
            lines.filter(|line| !line.starts_with('#')).map(|line| line.split_once(": ").unwrap()).collect();
        assert_eq!((fields["type"], fields["dimension"], fields["sizes"]), ("uint8", "3", "13 17 5"));
        assert_eq!(fields["space"], "3D-right-handed");
        let vector = |text: &str| -> Vec<f64> {
            let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).unwrap();
            inner.split(',').map(|n| n.parse().unwrap()).collect()
        };
        assert_eq!(vector(fields["space origin"]), lattice.origin.to_array());
        let directions: Vec<Vec<f64>> = fields["space directions"].split(' ').map(vector).collect();
        for (axis, direction) in directions.iter().enumerate() {
            let mut expected = [0.0; 3];
            expected[axis] = lattice.spacing[axis];
            assert_eq!(direction[..], expected);
        }
        let data = &bytes[end + 2..];
        let unpacked = match encoding {
            NrrdEncoding::Raw => data.to_vec(),
            NrrdEncoding::Gzip => {
                let mut all = Vec::new();
                flate2::read::GzDecoder::new(data).read_to_end(&mut all).unwrap();
                all
            }
        };
        assert_eq!(fields["encoding"], if encoding == NrrdEncoding::Raw { "raw" } else { "gzip" });
        assert_eq!(unpacked, voxels.to_bytes().unwrap());
    }
}
