use crate::data::{Warning, WarningKind};
use crate::io::{Format, Geometry, Imported, Location, ReadError, read};
use crate::math::Vec3;

const MESH: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty uchar red\nproperty double y\n\
    property float z\nelement edge 1\nproperty int a\nproperty list uchar int others\nelement face 2\n\
    property list uchar int vertex_indices\nproperty uchar red\nend_header\n";
const MESH_BODY: &str = "0 9 0 0\n2 9 0 0\n2 9 2 0\n0 9 2 0\n7 2 8 8\n4 0 1 2 3 9\n3 0 1 -7 9\n";

fn expected_mesh() -> (Vec<[u32; 3]>, Vec<Warning>) {
    (vec![[0, 1, 2], [0, 2, 3]], vec![Warning::new(WarningKind::IndexOutOfRange, 1)])
}

fn soup(bytes: &[u8]) -> (Vec<[u32; 3]>, Vec<Warning>) {
    match read(bytes).unwrap() {
        Imported { geometry: Geometry::Soup(soup), warnings, format: Format::Ply } => {
            (soup.triangles().to_vec(), warnings)
        }
        other => panic!("{other:?}"),
    }
}

/// The body of [`MESH`] in binary, as `order` writes each number given in little endian.
fn binary_mesh(encoding: &str, order: fn(Vec<u8>) -> Vec<u8>) -> Vec<u8> {
    let mut bytes = MESH.replace("ascii", encoding).into_bytes();
    for [x, y] in [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]] {
        bytes.extend(order((x as f32).to_le_bytes().to_vec()));
        bytes.push(9);
        bytes.extend(order(f64::to_le_bytes(y).to_vec()));
        bytes.extend([0; 4]);
    }
    let mut integers = |list: &[i32]| bytes.extend(list.iter().flat_map(|i| order(i.to_le_bytes().to_vec())));
    integers(&[7]);
    bytes.push(2);
    bytes.extend([0; 8]);
    for (face, length) in [(&[0, 1, 2, 3][..], 4), (&[0, 1, -7], 3)] {
        bytes.push(length);
        bytes.extend(face.iter().flat_map(|i: &i32| order(i.to_le_bytes().to_vec())));
        bytes.push(9);
    }
    bytes
}

#[test]
fn encodings_give_the_same_faces() {
    assert_eq!(soup(format!("{MESH}{MESH_BODY}").as_bytes()), expected_mesh());
    assert_eq!(soup(format!("{MESH}{MESH_BODY}").replace('\n', "\r\n").as_bytes()), expected_mesh());
    assert_eq!(soup(&binary_mesh("binary_little_endian", |number| number)), expected_mesh());
    let reversed = |number: Vec<u8>| number.into_iter().rev().collect();
    assert_eq!(soup(&binary_mesh("binary_big_endian", reversed)), expected_mesh());
}

#[test]
fn vertices_without_faces_are_a_cloud_with_its_normals() {
    let file = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n\
        property float nx\nproperty float ny\nproperty float nz\nelement face 0\n\
        property list uchar int vertex_indices\nend_header\n0 0 9 0 0 2\n1 0 9 3 0 0";
    let Geometry::Cloud(cloud) = read(file.as_bytes()).unwrap().geometry else { panic!() };
    assert_eq!(cloud.points(), [Vec3::Z * 9.0, Vec3::new(1.0, 0.0, 9.0)]);
    assert_eq!(cloud.normals(), Some(&[Vec3::Z, Vec3::X][..]));
}

#[test]
fn strips_alternate_their_orientation() {
    let file = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n2 0 0\n0 2 0\n2 2 0\n8 0 1 2 3 -1 2 1 0\n";
    assert_eq!(soup(file.as_bytes()), (vec![[0, 1, 2], [2, 1, 3], [2, 1, 0]], vec![]));
}

#[test]
fn cut_faces_are_counted_and_cut_vertices_leave_nothing() {
    let bytes = binary_mesh("binary_little_endian", |number| number);
    let (faces, warnings) = soup(&bytes[..bytes.len() - 1]);
    assert_eq!(faces, expected_mesh().0);
    let counts = [(WarningKind::CountMismatch, 1), (WarningKind::TruncatedRecord, 1)];
    assert_eq!(warnings, counts.map(|(kind, count)| Warning::new(kind, count)));
    let error = read(&bytes[..MESH.len() + 40]).unwrap_err();
    assert!(matches!(error, ReadError::EmptyInput { format: Some(Format::Ply), .. }));
}

#[test]
fn trailing_bytes_are_counted() {
    let trailing = soup(format!("{MESH}{MESH_BODY}more").as_bytes()).1;
    assert!(trailing.contains(&Warning::new(WarningKind::TrailingBytes, 4)));
}

#[test]
fn bad_numbers_name_their_line() {
    let body = MESH_BODY.replacen("2 9 2 0", "2 9 z 0", 1);
    match read(format!("{MESH}{body}").as_bytes()) {
        Err(ReadError::Parse { at: Location::Line(17), expected, .. }) => {
            assert_eq!(expected, "a number, found 'z'");
        }
        other => panic!("{other:?}"),
    }
    let negative = MESH_BODY.replacen("4 0 1 2 3", "-4 0 1 2 3", 1);
    assert!(matches!(read(format!("{MESH}{negative}").as_bytes()), Err(ReadError::Parse { .. })));
}
