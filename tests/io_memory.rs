//! Files that claim more than they hold, and files that hold as much as can be in few bytes: reading takes memory
//! in proportion to the file. In a test binary of its own, as the allocator counts for the whole process.
use fast_winding::io::read;
use std::alloc::{GlobalAlloc, Layout, System};
use std::io::{Cursor, Write};
use std::sync::atomic::{AtomicUsize, Ordering::SeqCst};

struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), SeqCst) + layout.size();
        PEAK.fetch_max(held, SeqCst);
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), SeqCst);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes that `read` holds at most at one time.
fn peak_of_reading(bytes: &[u8]) -> usize {
    let before = HELD.load(SeqCst);
    PEAK.store(before, SeqCst);
    let result = read(bytes);
    let peak = PEAK.load(SeqCst) - before;
    drop(result);
    peak
}

fn ply(encoding: &str, elements: &str, body: &[u8]) -> Vec<u8> {
    [format!("ply\nformat {encoding} 1.0\n{elements}end_header\n").as_bytes(), body].concat()
}

fn binary_stl(declared: u32, body: &[u8]) -> Vec<u8> {
    [&[0; 80][..], &declared.to_le_bytes(), body].concat()
}

fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        writer.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
        writer.write_all(content).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

const XYZ: &str = "property uchar x\nproperty uchar y\nproperty uchar z\n";
const LIST: &str = "property list uchar uchar vertex_indices\n";
const LONG_LIST: &str = "property list int int vertex_indices\n";

fn files() -> Vec<(&'static str, Vec<u8>)> {
    let lying =
        |xyz: &str, list: &str| format!("element vertex 4000000000\n{xyz}element face 4000000000\n{list}");
    let three = |list: &str| format!("element vertex 3\n{XYZ}element face 1\n{list}");
    let huge_length = [&[0; 9][..], &i32::MAX.to_le_bytes(), &[0; 12]].concat();
    vec![
        ("stl that claims 4 G", binary_stl(u32::MAX, &[0; 500])),
        ("ply text that claims 4 G", ply("ascii", &lying(XYZ, LIST), b"0 0 0\n1 0 0\n")),
        ("ply that claims 4 G", ply("binary_little_endian", &lying(XYZ, LIST), &[1; 100])),
        ("ply of empty records", ply("ascii", "element nothing 18000000000000000000\n", b"")),
        ("ply of a list of 2 G", ply("binary_little_endian", &three(LONG_LIST), &huge_length)),
        ("ply text of a list of 2 G", ply("ascii", &three(LONG_LIST), b"0 0 0 1 0 0 0 1 0 2147483647 0 1 2")),
        ("off that claims 4 G", b"OFF\n4000000000 4000000000 0\n0 0 0\n".to_vec()),
        ("off of a face of 4 G", b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n".to_vec()),
        ("xyz that claims 4 G", b"4000000000\n0 0 0\n".to_vec()),
        ("archive that claims 4 G", lying_archive(4_000_000_000, 4)),
        ("archive that claims all", lying_archive(u64::MAX, u64::MAX)),
        ("dense xyz", b"0 0 0\n".repeat(50_000)),
        ("dense xyz with normals", b"0 0 0 1 0 0\n".repeat(50_000)),
        ("dense obj", [b"v 0 0 0\n".repeat(50_000), b"f 1 1 1\n".repeat(50_000)].concat()),
        ("obj of one face", [b"v 0 0 0\nf".to_vec(), b" 1".repeat(100_000)].concat()),
        (
            "dense ply of points",
            ply("binary_little_endian", &format!("element vertex 100000\n{XYZ}"), &[7; 300_000]),
        ),
        (
            "dense ply of faces",
            ply(
                "binary_little_endian",
                &format!("element vertex 1\n{XYZ}element face 100000\n{LIST}"),
                &[3; 400_003],
            ),
        ),
        ("dense stl", binary_stl(5000, &[0; 250_000])),
        (
            "dense text stl",
            [b"solid\n".to_vec(), b"vertex 0 0 0 vertex 0 0 0 vertex 0 0 0 endloop\n".repeat(5000)].concat(),
        ),
        ("ply of many elements", ply("ascii", &"element a 1\n".repeat(20_000), b"")),
        (
            "ply of many properties",
            ply("ascii", &format!("element a 1\n{}", "property char a\n".repeat(20_000)), b""),
        ),
    ]
}

/// An archive without files whose directory claims `count` of them in `size` bytes (ZIP64).
fn lying_archive(count: u64, size: u64) -> Vec<u8> {
    let mut bytes = b"PK\x03\x04".to_vec();
    let directory = bytes.len() as u64;
    bytes.extend(b"PK\x06\x06");
    bytes.extend(44_u64.to_le_bytes());
    bytes.extend([45, 0, 45, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    [count, count, size, 0].iter().for_each(|field| bytes.extend(field.to_le_bytes()));
    bytes.extend(b"PK\x06\x07\0\0\0\0");
    bytes.extend(directory.to_le_bytes());
    bytes.extend([1, 0, 0, 0]);
    bytes.extend(b"PK\x05\x06\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0");
    bytes
}

#[test]
fn reading_takes_memory_in_proportion_to_the_file() {
    for (name, bytes) in files() {
        let peak = peak_of_reading(&bytes);
        // A number of text takes two bytes at least and becomes eight, in arrays that grow by doubling.
        let bound = 16 * bytes.len() + 16 * 1024;
        assert!(
            peak <= bound,
            "{name}: {peak} bytes for {}, {:.1} for each",
            bytes.len(),
            peak as f64 / bytes.len() as f64
        );
    }
    let instances = "<component objectid=\"1\"/>".repeat(100_000);
    let texts = [
        ("bomb of blanks", " ".repeat(30 << 20)),
        ("bomb of one tag", format!("<model {}", "a".repeat(30 << 20))),
        (
            "bomb of vertices",
            format!("<model><object id=\"1\">{}", "<vertex x=\"0\" y=\"0\" z=\"0\"/>".repeat(1 << 20)),
        ),
        (
            "bomb of instances",
            format!(
                "<model><object id=\"1\">{instances}</object><build><item objectid=\"1\"/></build></model>"
            ),
        ),
        ("bomb of nesting", format!("<model>{}", "<a>".repeat(5 << 20))),
    ];
    let models = texts.map(|(name, text)| (name, archive(&[("3D/3dmodel.model", text.as_bytes())])));
    let nested = "<a>".repeat(5 << 20);
    let relationships = archive(&[("_rels/.rels", nested.as_bytes())]);
    for (name, bytes) in models.into_iter().chain([("bomb of relationships", relationships)]) {
        let peak = peak_of_reading(&bytes);
        // Unpacked at most 64 times and 1 MiB, of which a token may be as long as all, in a buffer that doubles.
        let bound = 4 * (64 * bytes.len() + (1 << 20));
        assert!(peak <= bound, "{name}: {peak} bytes for {}", bytes.len());
    }
    for (name, start) in beginnings_of_zeros() {
        let mut bytes = vec![0; if start.is_empty() { 1 << 30 } else { 32 << 20 }];
        bytes[..start.len()].copy_from_slice(&start);
        let peak = peak_of_reading(&bytes);
        assert!(peak <= 4 * (32 << 20), "{name}: {peak} bytes");
    }
}

/// What a file of zeros may begin with, so that it is taken for one of a format: as many triangles or a billion points claimed. Where it
/// begins with nothing, no format is found, however long it is.
fn beginnings_of_zeros() -> Vec<(&'static str, Vec<u8>)> {
    let double = "property double x\nproperty double y\nproperty double z\n";
    let billion = |list: &str| format!("element vertex 1000000000\n{double}element face 1000000000\n{list}");
    vec![
        ("zeros", vec![]),
        ("stl", binary_stl((32 << 20) / 50 - 2, &[])),
        ("ply", ply("binary_little_endian", &billion(LIST), &[])),
        ("ply of faces", ply("binary_big_endian", &format!("element face 1000000000\n{LONG_LIST}"), &[])),
        ("ply text", ply("ascii", &billion(LIST), &[])),
        ("obj", b"v 0 0 0\nf 1 1 1\n".to_vec()),
        ("off", b"OFF\n1000000000 1000000000 0\n".to_vec()),
        ("xyz", b"0 0 0\n1 1 1\n".to_vec()),
        ("text stl", b"solid\nfacet normal 0 0 0\n".to_vec()),
        ("archive", b"PK\x03\x04".to_vec()),
    ]
}
