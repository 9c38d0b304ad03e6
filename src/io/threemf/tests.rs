use crate::data::{TriangleSoup, Warning, WarningKind};
use crate::io::{Format, Geometry, Imported, Location, ReadError, read};
use crate::math::{Aabb, Vec3};
use std::io::{Cursor, Write};
use zip::write::SimpleFileOptions;

const TETRAHEDRON: &str = r#"<mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
    <vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="3"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
    <triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="0" v2="3" v3="2"/></triangles></mesh>"#;

fn archive(files: &[(&str, &str)]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, content) in files {
        writer.start_file(*name, SimpleFileOptions::default()).unwrap();
        writer.write_all(content.as_bytes()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn model(attributes: &str, resources: &str, build: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model {attributes} \
         xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\
         <resources>{resources}</resources><build>{build}</build></model>"
    )
}

fn one_model(attributes: &str, resources: &str, build: &str) -> Vec<u8> {
    archive(&[("3D/3dmodel.model", &model(attributes, resources, build))])
}

fn soup(bytes: &[u8]) -> (TriangleSoup, Vec<Warning>) {
    match read(bytes).unwrap() {
        Imported { geometry: Geometry::Soup(soup), format: Format::ThreeMf, warnings } => (soup, warnings),
        other => panic!("{other:?}"),
    }
}

fn volume(soup: &TriangleSoup) -> f64 {
    let corners = (0..soup.len()).map(|triangle| soup.corners(triangle));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn bounds(min: [f64; 3], max: [f64; 3]) -> Aabb {
    Aabb { min: Vec3::from_array(min), max: Vec3::from_array(max) }
}

fn expected_of(bytes: &[u8]) -> String {
    match read(bytes).unwrap_err() {
        ReadError::Parse { format: Format::ThreeMf, expected, .. } => expected,
        other => panic!("{other:?}"),
    }
}

#[test]
fn objects_lie_where_items_and_components_put_them() {
    let resources = format!(
        r#"<object id="1" type="model">{TETRAHEDRON}</object><object id="2"><components>
        <component objectid="1"/><component objectid="1" transform="1 0 0 0 1 0 0 0 1 10 0 0"/></components></object>"#
    );
    let build = r#"<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 0 0 100"/><item objectid="1"/>"#;
    let (soup, warnings) = soup(&one_model(r#"unit="centimeter""#, &resources, build));
    assert_eq!((soup.len(), warnings), (12, vec![]));
    assert_eq!(soup.bounds(), bounds([-20.0, 0.0, 0.0], [10.0, 110.0, 1030.0]));
    assert!((volume(&soup) - 3000.0).abs() < 1e-6);
}

#[test]
fn mirrored_objects_stay_solid() {
    let resources = format!(r#"<object id="1">{TETRAHEDRON}</object>"#);
    let build = r#"<item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>"#;
    let (soup, _) = soup(&one_model("", &resources, build));
    assert_eq!(soup.bounds(), bounds([-1.0, 0.0, 0.0], [0.0, 2.0, 3.0]));
    assert!((volume(&soup) - 1.0).abs() < 1e-12);
}

#[test]
fn relationships_paths_and_prefixes_are_followed() {
    let relationships = r#"<Relationships><Relationship Id="a" Target="/Metadata/a.png" Type="x/thumbnail"/>
        <Relationship Id="b" Target="/3D/Main.model" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
        </Relationships>"#;
    let component = r#"<object id="5"><components><component p:path="/3D/Objects/part.model" objectid="1"/></components></object>"#;
    let main = model("", component, r#"<item objectid="5"/>"#);
    let part = model(
        "",
        &format!(r#"<object id="1">{TETRAHEDRON}</object><s:slice><s:vertex x="0" y="0"/></s:slice>"#),
        "",
    );
    let prefixed =
        part.replace('<', "<m:").replace("<m:/", "</m:").replace("m:s:", "s:").replace("<m:?", "<?");
    for part in [part, prefixed] {
        let files =
            [("_rels/.rels", relationships), ("3d/main.model", &main), ("3D/Objects/part.model", &part)];
        assert_eq!(soup(&archive(&files)).0.len(), 4);
    }
}

#[test]
fn without_a_build_the_outermost_objects_are_placed() {
    let resources = format!(
        r#"<object id="1">{TETRAHEDRON}</object><object id="2"><components><component objectid="1"/></components></object>"#
    );
    assert_eq!(soup(&one_model("", &resources, "")).0.len(), 4);
}

#[test]
fn indices_that_name_no_vertex_of_their_own_object_are_dropped() {
    let short = TETRAHEDRON.replacen(r#"v3="1""#, r#"v3="4""#, 1);
    let resources = format!(r#"<object id="1">{short}</object><object id="2">{TETRAHEDRON}</object>"#);
    let build = r#"<item objectid="1"/><item objectid="2"/><item objectid="3"/>"#;
    let (soup, warnings) = soup(&one_model("", &resources, build));
    assert_eq!(soup.len(), 7);
    let counts = [(WarningKind::SkippedElements, 1), (WarningKind::IndexOutOfRange, 1)];
    assert_eq!(warnings, counts.map(|(kind, count)| Warning::new(kind, count)));
}

#[test]
fn cycles_and_copies_of_copies_are_refused() {
    let cycle = r#"<object id="1"><components><component objectid="1"/></components></object>"#;
    assert!(expected_of(&one_model("", cycle, r#"<item objectid="1"/>"#)).contains("64 deep"));
    let mut resources = format!(r#"<object id="1">{TETRAHEDRON}</object>"#);
    for id in 2..60 {
        let half = format!(r#"<component objectid="{}"/>"#, id - 1);
        resources += &format!(r#"<object id="{id}"><components>{half}{half}</components></object>"#);
    }
    let doubled = one_model("", &resources, r#"<item objectid="59"/>"#);
    assert!(expected_of(&doubled).contains("for each byte of the archive"));
}

#[test]
fn bombs_are_refused() {
    let blanks = " ".repeat(30 << 20);
    let bytes = one_model("", &blanks, "");
    assert!(bytes.len() < 100_000);
    assert!(expected_of(&bytes).contains("unpacks to more than 64 times"));
}

#[test]
fn errors_name_the_file_and_what_was_expected() {
    let bad = TETRAHEDRON.replacen(r#"y="2""#, r#"y="two""#, 1);
    let text = model("", &format!(r#"<object id="1">{bad}</object>"#), "");
    let bytes = archive(&[("3D/3dmodel.model", &text)]);
    let after_vertex = text.find(r#""two" z="0"/>"#).unwrap() + r#""two" z="0"/>"#.len();
    let expected = "numbers x, y and z of a vertex, in the file '3D/3dmodel.model'".to_owned();
    let at = Location::Byte(after_vertex);
    assert_eq!(read(&bytes).unwrap_err(), ReadError::Parse { format: Format::ThreeMf, at, expected });
    assert!(expected_of(&archive(&[("a.txt", "no model")])).contains("'3D/3dmodel.model'"));
    assert!(expected_of(&one_model(r#"unit="ell""#, "", "")).contains("'ell'"));
    assert!(expected_of(&one_model("", r#"<object id="1"></mesh>"#, "")).contains("well-formed XML"));
    assert!(expected_of(&bytes[..bytes.len() - 30]).contains("a whole ZIP archive"));
    let empty = read(&one_model("", "", "")).unwrap_err();
    assert_eq!(empty, ReadError::EmptyInput { format: Some(Format::ThreeMf), dropped: vec![] });
}
