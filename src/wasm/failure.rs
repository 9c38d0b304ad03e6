//! Errors as JavaScript sees them: `{ code, message, details }`, of which the client makes a `WindingError`.
use crate::data::{Cancelled, CloudError, LatticeError, OutOfMemory, SavedError, SoupError, VoxelDataError};
use crate::estimate::EstimateError;
use crate::io::{Location, ReadError};
use crate::levelset::TraceError;
use crate::slice::SliceError;
use crate::solid::VoxelError;
use crate::surface::SurfaceError;
use crate::winding::{FieldError, LoadError};
use js_sys::{Object, Reflect};
use wasm_bindgen::JsValue;

/// An error with a code that callers may rely on.
pub struct Failure {
    code: &'static str,
    message: String,
    details: Object,
}

/// A JavaScript object of the given entries.
pub fn object<const N: usize>(entries: [(&str, JsValue); N]) -> Object {
    let object = Object::new();
    for (key, value) in entries {
        Reflect::set(&object, &key.into(), &value).expect("a new object takes any property");
    }
    object
}

impl Failure {
    pub fn new(code: &'static str, message: impl ToString) -> Failure {
        Failure { code, message: message.to_string(), details: Object::new() }
    }

    pub fn with<const N: usize>(mut self, details: [(&str, JsValue); N]) -> Failure {
        self.details = object(details);
        self
    }

    /// An argument that has the wrong type or a value out of range.
    pub fn invalid(message: impl ToString) -> Failure {
        Failure::new("InvalidArgument", message)
    }

    /// `bytes` could not be had in one piece.
    pub fn out_of_memory(bytes: usize) -> Failure {
        let message = format!("out of memory: {bytes} bytes are needed at once");
        Failure::new("OutOfMemory", message).with([("bytes", (bytes as f64).into())])
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> JsValue {
        let entries = [
            ("code", failure.code.into()),
            ("message", failure.message.into()),
            ("details", failure.details.into()),
        ];
        object(entries).into()
    }
}

impl From<Cancelled> for Failure {
    fn from(cancelled: Cancelled) -> Failure {
        Failure::new("Aborted", cancelled)
    }
}

impl From<OutOfMemory> for Failure {
    fn from(error: OutOfMemory) -> Failure {
        Failure::new("OutOfMemory", &error).with([("bytes", (error.bytes as f64).into())])
    }
}

impl From<FieldError> for Failure {
    fn from(error: FieldError) -> Failure {
        match error {
            FieldError::Lattice(lattice) => lattice.into(),
            FieldError::Cancelled(cancelled) => cancelled.into(),
            FieldError::OutOfMemory(out_of_memory) => out_of_memory.into(),
        }
    }
}

impl From<VoxelError> for Failure {
    fn from(error: VoxelError) -> Failure {
        match error {
            VoxelError::Lattice(lattice) => lattice.into(),
            VoxelError::Cancelled(cancelled) => cancelled.into(),
            VoxelError::OutOfMemory(out_of_memory) => out_of_memory.into(),
            VoxelError::BadThreshold(_) | VoxelError::BadBeta(_) | VoxelError::NoTriangles { .. } => {
                Failure::invalid(&error)
            }
        }
    }
}

impl From<VoxelDataError> for Failure {
    fn from(error: VoxelDataError) -> Failure {
        match error {
            VoxelDataError::OutOfMemory(out_of_memory) => out_of_memory.into(),
            _ => Failure::invalid(&error),
        }
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Failure {
        match error {
            LoadError::Foreign { .. } => Failure::new("UnknownFormat", &error),
            LoadError::OtherVersion { version, known } => Failure::new("Unsupported", &error)
                .with([("version", version.into()), ("known", known.into())]),
            LoadError::Invalid(SavedError::OutOfMemory(out_of_memory)) => out_of_memory.into(),
            _ => Failure::new("ParseError", &error).with([("format", "field".into())]),
        }
    }
}

impl From<SliceError> for Failure {
    fn from(error: SliceError) -> Failure {
        match error {
            SliceError::Plan(plan) => Failure::invalid(plan),
            SliceError::Lattice(lattice) => lattice.into(),
            SliceError::Cancelled(cancelled) => cancelled.into(),
            SliceError::BadSimplification(_) => Failure::invalid(&error),
        }
    }
}

impl From<SurfaceError> for Failure {
    fn from(error: SurfaceError) -> Failure {
        match error {
            SurfaceError::Lattice(lattice) => lattice.into(),
            SurfaceError::Trace(TraceError::Cancelled(cancelled)) => cancelled.into(),
            SurfaceError::Trace(TraceError::OutOfMemory(out_of_memory)) => out_of_memory.into(),
            SurfaceError::Trace(TraceError::TooFine)
            | SurfaceError::BadLevel(_)
            | SurfaceError::BadShare(_)
            | SurfaceError::BadTrim(_)
            | SurfaceError::BadSmoothing(_)
            | SurfaceError::BadSharp(_)
            | SurfaceError::SmallCells { .. }
            | SurfaceError::OnlyOfClouds(_) => Failure::invalid(&error),
        }
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Failure {
        let message = error.to_string();
        match error {
            ReadError::Parse { format, at, expected } => {
                let at = match at {
                    Location::Byte(offset) => ("byte", offset.into()),
                    Location::Line(line) => ("line", line.into()),
                };
                Failure::new("ParseError", message).with([
                    ("format", format.name().into()),
                    at,
                    ("expected", expected.into()),
                ])
            }
            ReadError::EmptyInput { .. } => Failure::new("EmptyInput", message),
            ReadError::UnknownFormat { .. } => Failure::new("UnknownFormat", message),
        }
    }
}

impl From<EstimateError> for Failure {
    fn from(error: EstimateError) -> Failure {
        match error {
            EstimateError::Cancelled(cancelled) => cancelled.into(),
            EstimateError::Invalid(invalid) => invalid.into(),
            EstimateError::Empty | EstimateError::OnePlace { .. } => Failure::new("EmptyInput", &error),
            EstimateError::MissingNormals { points } => {
                Failure::new("MissingNormals", &error).with([("points", points.into())])
            }
        }
    }
}

impl From<SoupError> for Failure {
    fn from(error: SoupError) -> Failure {
        match error {
            SoupError::IndexOutOfRange { triangle, index, vertices } => {
                Failure::new("IndexOutOfRange", &error).with([
                    ("triangle", triangle.into()),
                    ("index", index.into()),
                    ("vertices", vertices.into()),
                ])
            }
            SoupError::NonFiniteVertex { vertex } => {
                Failure::new("NonFiniteVertex", &error).with([("vertex", vertex.into())])
            }
            SoupError::TooManyVertices(_) => Failure::invalid(&error),
        }
    }
}

impl From<CloudError> for Failure {
    fn from(error: CloudError) -> Failure {
        match error {
            CloudError::NonFinitePoint { point } => {
                Failure::new("NonFiniteVertex", &error).with([("vertex", point.into())])
            }
            _ => Failure::invalid(&error),
        }
    }
}

impl From<LatticeError> for Failure {
    fn from(error: LatticeError) -> Failure {
        match error {
            LatticeError::TooMany(samples) => {
                Failure::new("OutOfMemory", &error).with([("bytes", samples.into())])
            }
            _ => Failure::invalid(&error),
        }
    }
}
