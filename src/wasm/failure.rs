//! Errors as JavaScript sees them: `{ code, message, details }`, of which the client makes a `WindingError`.
use crate::data::{Cancelled, CloudError, LatticeError, SoupError};
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
