//! The fuzz targets on a stable compiler: every file of the corpus, and some mutations of each, always the same.
#[path = "../fuzz/src/lib.rs"]
mod targets;

use std::collections::BTreeSet;
use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Mutations of each file.
const MUTATIONS: u64 = 1;

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz").join(name)
}

/// The files of a folder, or the folders, by name.
fn sorted(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Whole numbers below `count`: the same sequence for the same seed.
fn random(seed: u64) -> impl FnMut(usize) -> usize {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(1);
    move |count| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count.max(1)
    }
}

/// The bytes with a few of them changed, left out, doubled or cut off.
fn mutated(bytes: &[u8], seed: u64) -> Vec<u8> {
    let (mut bytes, mut next) = (bytes.to_vec(), random(seed));
    for _ in 0..1 + next(3) {
        let at = next(bytes.len());
        let end = (at + 1 + next(8)).min(bytes.len());
        match next(6) {
            _ if bytes.is_empty() => bytes.push(next(256) as u8),
            0 => bytes[at] ^= 1 << next(8),
            1 => bytes[at] = next(256) as u8,
            2 => bytes[at..end].fill([0, 0xff][next(2)]),
            3 => drop(bytes.drain(at..end)),
            4 => bytes.extend_from_within(at..end),
            _ => bytes.truncate(at),
        }
    }
    bytes
}

fn hold_on_the_corpus(name: &str) {
    for (number, path) in (0..).zip(sorted(&folder("corpus").join(name))) {
        let file = fs::read(&path).unwrap();
        for mutation in 0..=MUTATIONS {
            let bytes = if mutation == 0 { file.clone() } else { mutated(&file, 4 * number + mutation + 1) };
            let is_sound = catch_unwind(|| targets::run(name, &bytes)).is_ok();
            assert!(is_sound, "{}, mutation {mutation}: b\"{}\"", path.display(), bytes.escape_ascii());
        }
    }
}

macro_rules! targets {
    ($($name:ident)*) => {
        const NAMES: &[&str] = &[$(stringify!($name)),*];
        mod facts_hold_on_the_corpus_and_around_it {
            $(#[test]
            fn $name() {
                super::hold_on_the_corpus(stringify!($name));
            })*
        }
    };
}
targets! {
    stl obj ply off xyz threemf saved
    soups clouds planar distances layers prints level_sets offsets voxels booleans
    arrangements checks repairs faces normals charges textures
}

#[test]
fn every_target_has_a_test_a_corpus_and_a_binary() {
    let listed: BTreeSet<String> = targets::TARGETS.iter().map(|(name, _)| (*name).to_owned()).collect();
    let stems = |name: &str| -> BTreeSet<String> {
        let stem = |path: &PathBuf| path.file_stem().unwrap().to_str().unwrap().to_owned();
        sorted(&folder(name)).iter().map(stem).collect()
    };
    assert_eq!(NAMES.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>(), listed);
    assert_eq!(stems("corpus"), listed);
    assert_eq!(stems("fuzz_targets"), listed);
}
