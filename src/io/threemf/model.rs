//! One model file: its meshes, the components that join them, and what of them is built.
use super::error;
use super::transform::Transform;
use super::xml::Events;
use crate::io::parsed::vertex_index;
use crate::io::text::number;
use crate::io::{ReadError, Unit};
use crate::math::Vec3;
use quick_xml::events::{BytesStart, Event};
use rustc_hash::FxHashMap;
use std::io::BufRead;
use std::ops::Range;

/// An object of the model: a mesh or components, as ranges of the model's arrays.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Object {
    pub vertices: Range<usize>,
    /// Their indices count from the first of `vertices`.
    pub triangles: Range<usize>,
    pub components: Range<usize>,
}

/// A use of an object. Small, with what is rare kept in the model's arrays: a hostile file can hold many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Instance {
    pub object: u32,
    /// Place in [`Model::paths`] of the file that holds the object; `None` is this file.
    pub path: Option<u32>,
    /// Place in [`Model::transforms`].
    pub transform: Option<u32>,
}

#[derive(Debug, Default)]
pub(super) struct Model {
    pub unit: Unit,
    pub vertices: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
    pub components: Vec<Instance>,
    pub objects: FxHashMap<u32, Object>,
    /// The build.
    pub items: Vec<Instance>,
    pub transforms: Vec<Transform>,
    /// Other model files that instances name.
    pub paths: Vec<String>,
}

/// A model that is being read.
struct ModelReader<'n, R> {
    xml: Events<R>,
    /// Name of the file, for messages.
    name: &'n str,
    /// What stands before the names of 3MF's own elements; extensions have other prefixes.
    prefix: String,
    /// The object that has begun.
    open: Option<(u32, Object)>,
    path_numbers: FxHashMap<String, u32>,
    model: Model,
}

impl Model {
    /// Reads the model in `content`, the file called `name`.
    pub fn read(content: impl BufRead, name: &str) -> Result<Model, ReadError> {
        let (prefix, path_numbers) = (String::new(), FxHashMap::default());
        let xml = Events::new(content);
        let mut reader = ModelReader { xml, name, prefix, open: None, path_numbers, model: Model::default() };
        let mut buffer = Vec::new();
        loop {
            match reader.xml.next(&mut buffer).map_err(|expected| reader.error(&expected))? {
                Event::Start(element) => reader.start(&element)?,
                Event::Empty(element) => {
                    reader.start(&element)?;
                    reader.end(element.name().0);
                }
                Event::End(element) => reader.end(element.name().0),
                Event::Eof => break,
                _ => {}
            }
        }
        Ok(reader.model)
    }
}

/// The values of the attributes with these names, whatever their prefixes.
fn attributes<'e, const N: usize>(element: &'e BytesStart, names: [&str; N]) -> [Option<&'e str>; N] {
    let mut values = [None; N];
    // Without checks: they take time that grows with the square of the number of attributes.
    for attribute in element.attributes().with_checks(false).flatten() {
        let place = names.iter().position(|name| attribute.key.local_name().as_ref() == *name);
        if let (Some(place), std::borrow::Cow::Borrowed(value)) = (place, attribute.value) {
            values[place] = Some(value.trim_ascii());
        }
    }
    values
}

impl<R: BufRead> ModelReader<'_, R> {
    #[cold]
    fn error(&self, expected: &str) -> ReadError {
        error(self.xml.position(), format!("{expected}, in the file '{}'", self.name))
    }

    fn is_core(&self, qualified: &str, name: &str) -> bool {
        qualified.strip_prefix(self.prefix.as_str()) == Some(name)
    }

    fn start(&mut self, element: &BytesStart) -> Result<(), ReadError> {
        let qualified = element.name().0;
        if element.local_name().as_ref() == "model" {
            self.prefix = qualified.trim_end_matches("model").to_owned();
            return self.start_model(element);
        }
        match qualified.strip_prefix(self.prefix.as_str()) {
            Some("vertex") => self.vertex(element),
            Some("triangle") => self.triangle(element),
            Some("object") => self.start_object(element),
            Some("component") => {
                let component = self.instance(element)?;
                self.model.components.push(component);
                Ok(())
            }
            Some("item") => {
                let item = self.instance(element)?;
                self.model.items.push(item);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn start_model(&mut self, element: &BytesStart) -> Result<(), ReadError> {
        if let [Some(unit)] = attributes(element, ["unit"]) {
            self.model.unit = unit.parse().map_err(|cause| self.error(&format!("a unit, found: {cause}")))?;
        }
        Ok(())
    }

    fn vertex(&mut self, element: &BytesStart) -> Result<(), ReadError> {
        let values = attributes(element, ["x", "y", "z"]).map(|value| number(value?.as_bytes()));
        let [Some(x), Some(y), Some(z)] = values else {
            return Err(self.error("numbers x, y and z of a vertex"));
        };
        self.model.vertices.push(Vec3::new(x, y, z));
        Ok(())
    }

    fn triangle(&mut self, element: &BytesStart) -> Result<(), ReadError> {
        let values = attributes(element, ["v1", "v2", "v3"]).map(|value| value?.parse().ok());
        let [Some(a), Some(b), Some(c)] = values else {
            return Err(self.error("whole numbers v1, v2 and v3 of a triangle"));
        };
        self.model.triangles.push([a, b, c].map(vertex_index));
        Ok(())
    }

    fn start_object(&mut self, element: &BytesStart) -> Result<(), ReadError> {
        let [id] = attributes(element, ["id"]);
        let id = id
            .and_then(|id| id.parse().ok())
            .ok_or_else(|| self.error("a whole number as id of an object"))?;
        let Model { vertices, triangles, components, .. } = &self.model;
        let empty = |length: usize| length..length;
        let object = Object {
            vertices: empty(vertices.len()),
            triangles: empty(triangles.len()),
            components: empty(components.len()),
        };
        self.open = Some((id, object));
        Ok(())
    }

    fn end(&mut self, qualified: &str) {
        if !self.is_core(qualified, "object") {
            return;
        }
        if let Some((id, mut object)) = self.open.take() {
            object.vertices.end = self.model.vertices.len();
            object.triangles.end = self.model.triangles.len();
            object.components.end = self.model.components.len();
            self.model.objects.insert(id, object);
        }
    }

    /// An item of the build or a component of an object.
    fn instance(&mut self, element: &BytesStart) -> Result<Instance, ReadError> {
        let [object, transform, path] = attributes(element, ["objectid", "transform", "path"]);
        let object = object.and_then(|id| id.parse().ok());
        let object = object.ok_or_else(|| self.error("a whole number as objectid"))?;
        let transform = match transform.map(Transform::parse) {
            None => None,
            Some(Some(transform)) => {
                self.model.transforms.push(transform);
                Some(self.model.transforms.len() as u32 - 1)
            }
            Some(None) => return Err(self.error("twelve numbers as transform")),
        };
        let path = path.map(|path| self.path_number(path));
        Ok(Instance { object, path, transform })
    }

    fn path_number(&mut self, path: &str) -> u32 {
        if let Some(number) = self.path_numbers.get(path) {
            return *number;
        }
        let number = self.model.paths.len() as u32;
        self.model.paths.push(path.to_owned());
        self.path_numbers.insert(path.to_owned(), number);
        number
    }
}
