//! What follows the header: the same elements, as text or as binary numbers.
use super::header::{Element, Encoding, Header, Kind, Property, Scalar, error};
use super::values::{AsciiValues, BinaryValues, Values};
use crate::data::WarningKind;
use crate::io::ReadError;
use crate::io::parsed::{Parsed, Tally, push_polygon, vertex_index};
use crate::math::Vec3;

/// Ends one strip of triangles in a list of vertices, and begins the next.
const STRIP_END: u32 = u32::MAX;

pub(super) fn read(bytes: &[u8], header: &Header) -> Result<Parsed, ReadError> {
    match header.encoding {
        Encoding::Ascii => Body::new(AsciiValues::new(bytes, header.body, header.body_line)).read(header),
        Encoding::LittleEndian | Encoding::BigEndian => {
            Body::new(BinaryValues::new(bytes, header.body, header.encoding)).read(header)
        }
    }
}

struct Body<V> {
    values: V,
    positions: Vec<Vec3>,
    normals: Option<Vec<Vec3>>,
    triangles: Option<Vec<[u32; 3]>>,
    tally: Tally,
    /// The list of the record being read.
    list: Vec<u32>,
}

/// Whether a record was whole, or the end of the file cut it.
#[derive(Clone, Copy, PartialEq)]
enum Record {
    Whole,
    Cut,
}

impl<V: Values> Body<V> {
    fn new(values: V) -> Body<V> {
        Body {
            values,
            positions: Vec::new(),
            normals: None,
            triangles: None,
            tally: Tally::default(),
            list: Vec::new(),
        }
    }

    fn read(mut self, header: &Header) -> Result<Parsed, ReadError> {
        for element in &header.elements {
            match element.name {
                // Some clouds declare that they have no faces.
                b"face" | b"tristrips" if element.count == 0 => {}
                b"vertex" => self.read_vertices(element)?,
                b"face" => self.read_lists(element, Body::push_face)?,
                b"tristrips" => self.read_lists(element, Body::push_strips)?,
                _ => self.skip(element)?,
            }
        }
        self.tally.add(WarningKind::TrailingBytes, self.values.trailing());
        let Body { positions, normals, triangles, tally, .. } = self;
        Ok(Parsed { positions, normals, triangles, tally })
    }

    fn read_vertices(&mut self, element: &Element) -> Result<(), ReadError> {
        let slot = |property: &Property| {
            let names: [&[u8]; 6] = [b"x", b"y", b"z", b"nx", b"ny", b"nz"];
            names.iter().position(|name| *name == property.name)
        };
        let slots: Vec<Option<usize>> = element.properties.iter().map(slot).collect();
        let has = |wanted: std::ops::Range<usize>| wanted.into_iter().all(|slot| slots.contains(&Some(slot)));
        if !has(0..3) {
            return Err(error(
                element.line,
                "the properties x, y and z of 'vertex', found others only".to_owned(),
            ));
        }
        let records = element.count.min(self.values.most_records(element));
        let (mut positions, mut normals) = (Vec::with_capacity(records), Vec::new());
        let has_normals = has(3..6);
        if has_normals {
            normals.reserve_exact(records);
        }
        self.each_record(element, |body| {
            let mut vertex = [0.0; 6];
            for (property, slot) in element.properties.iter().zip(&slots) {
                match (property.kind, slot) {
                    (Kind::One(kind), Some(slot)) => match body.values.number(kind)? {
                        Some(number) => vertex[*slot] = number,
                        None => return Ok(Record::Cut),
                    },
                    (kind, _) => {
                        if body.skip_value(kind)? == Record::Cut {
                            return Ok(Record::Cut);
                        }
                    }
                }
            }
            let [x, y, z, nx, ny, nz] = vertex;
            positions.push(Vec3::new(x, y, z));
            if has_normals {
                normals.push(Vec3::new(nx, ny, nz));
            }
            Ok(Record::Whole)
        })?;
        self.positions = positions;
        self.normals = has_normals.then_some(normals);
        Ok(())
    }

    /// Reads an element with a list of vertices, which `push` turns into triangles.
    fn read_lists(&mut self, element: &Element, push: impl Fn(&mut Body<V>)) -> Result<(), ReadError> {
        let is_vertices = |property: &&Property| property.name.starts_with(b"vertex_ind");
        let Some(vertices) = element.properties.iter().find(is_vertices) else {
            let expected = "the property vertex_indices, found others only".to_owned();
            return Err(error(element.line, expected));
        };
        let records = element.count.min(self.values.most_records(element));
        self.triangles.get_or_insert_default().reserve(records);
        self.each_record(element, |body| {
            for property in &element.properties {
                let state = match property.kind {
                    Kind::List { count, item } if std::ptr::eq(property, vertices) => {
                        body.read_list(count, item)?
                    }
                    kind => body.skip_value(kind)?,
                };
                if state == Record::Cut {
                    return Ok(Record::Cut);
                }
            }
            push(body);
            Ok(Record::Whole)
        })
    }

    fn push_face(&mut self) {
        push_polygon(self.triangles.get_or_insert_default(), &self.list, &mut self.tally);
    }

    /// Every three neighbours in a strip are a triangle; every second one runs the other way round.
    fn push_strips(&mut self) {
        let triangles = self.triangles.get_or_insert_default();
        for strip in self.list.split(|&index| index == STRIP_END) {
            for (i, corners) in strip.windows(3).enumerate() {
                let [a, b, c] = [corners[0], corners[1], corners[2]];
                triangles.push(if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
            }
        }
    }

    fn skip(&mut self, element: &Element) -> Result<(), ReadError> {
        // Records of no bytes would be passed as often as the header claims.
        if element.properties.is_empty() {
            return Ok(());
        }
        self.each_record(element, |body| {
            for property in &element.properties {
                if body.skip_value(property.kind)? == Record::Cut {
                    return Ok(Record::Cut);
                }
            }
            Ok(Record::Whole)
        })
    }

    /// Calls `read` for each record that the file holds of `element`; counts what is missing.
    fn each_record(
        &mut self,
        element: &Element,
        mut read: impl FnMut(&mut Body<V>) -> Result<Record, ReadError>,
    ) -> Result<(), ReadError> {
        for index in 0..element.count {
            let has_begun = self.values.remaining() > 0;
            if read(self)? == Record::Cut {
                self.tally.add(WarningKind::CountMismatch, element.count - index);
                self.tally.add(WarningKind::TruncatedRecord, usize::from(has_begun));
                break;
            }
        }
        Ok(())
    }

    fn read_list(&mut self, count: Scalar, item: Scalar) -> Result<Record, ReadError> {
        self.list.clear();
        let Some(length) = self.values.list_length(count, item)? else { return Ok(Record::Cut) };
        for _ in 0..length {
            let Some(index) = self.values.number(item)? else { return Ok(Record::Cut) };
            let is_whole = index.fract() == 0.0;
            self.list.push(if is_whole { vertex_index(index as i64) } else { u32::MAX });
        }
        Ok(Record::Whole)
    }

    fn skip_value(&mut self, kind: Kind) -> Result<Record, ReadError> {
        let (length, item) = match kind {
            Kind::One(kind) => (Some(1), kind),
            Kind::List { count, item } => (self.values.list_length(count, item)?, item),
        };
        let Some(length) = length else { return Ok(Record::Cut) };
        for _ in 0..length {
            if self.values.number(item)?.is_none() {
                return Ok(Record::Cut);
            }
        }
        Ok(Record::Whole)
    }
}
