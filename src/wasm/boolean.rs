//! Booleans for JavaScript: one shape, and another, perhaps moved.
use super::convert::{bytes_to, numbers_to, triangles_to};
use super::failure::{Failure, object};
use super::handle::Handle;
use super::job::Job;
use super::options::{from_js, warning_to};
use crate::data::TransformError;
use crate::math::{Affine, Mat3, Vec3};
use crate::solid::{BooleanConfig, BooleanError, BooleanOp, boolean};
use crate::winding::WindingField;
use js_sys::{Array, Object, Uint32Array};
use serde::Deserialize;
use wasm_bindgen::prelude::*;

/// How fine a boolean is where it is not exact.
#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase")]
struct BooleanOptions {
    tolerance: Option<f64>,
    resolution: Option<usize>,
}

/// The second operand of a boolean, used once.
#[wasm_bindgen]
pub struct Operand(WindingField);

#[wasm_bindgen]
impl Handle {
    /// The shape as the second operand, moved by a matrix of 16 numbers, column by column, if there is one.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, the matrix moves no shape, or the call is aborted.
    pub fn operand(&mut self, transform: JsValue, job: &Job) -> Result<Operand, JsValue> {
        let shape = self.shape(job)?;
        let shape = match from_js::<Option<Vec<f64>>>(transform)? {
            None => shape,
            Some(numbers) => shape.moved(&affine(&numbers)?).map_err(Failure::from)?,
        };
        Ok(Operand(WindingField::new(shape, Default::default())))
    }

    /// Combines the shape with another: `{ positions, indices, faces, operands, warnings }`, positions as doubles, for each triangle its
    /// operand and that one's triangle.
    ///
    /// # Errors
    /// If and only if a cloud has no normals, an argument is wrong, memory does not suffice or the call is aborted.
    pub fn boolean(
        &mut self,
        op: &str,
        other: Operand,
        options: JsValue,
        job: &Job,
    ) -> Result<Object, JsValue> {
        let options: BooleanOptions = from_js(options)?;
        let config = BooleanConfig { tolerance: options.tolerance, resolution: options.resolution };
        let field = self.field(None, job)?;
        let mesh = boolean(field, &other.0, op_from(op)?, &config, job).map_err(Failure::from)?;
        let positions: Vec<f64> = mesh.positions.iter().flat_map(|p| p.to_array()).collect();
        let warnings: Array = mesh.warnings.iter().map(warning_to).collect();
        Ok(object([
            ("positions", numbers_to(&positions)?.into()),
            ("indices", triangles_to(&mesh.triangles)?.into()),
            ("faces", Uint32Array::from(&mesh.faces[..]).into()),
            ("operands", bytes_to(&mesh.operands)?.into()),
            ("warnings", warnings.into()),
        ]))
    }
}

fn op_from(name: &str) -> Result<BooleanOp, Failure> {
    match name {
        "union" => Ok(BooleanOp::Union),
        "intersection" => Ok(BooleanOp::Intersection),
        "difference" => Ok(BooleanOp::Difference),
        _ => Err(Failure::invalid(format!(
            "unknown operation '{name}': 'union', 'intersection' and 'difference' are known"
        ))),
    }
}

fn affine(numbers: &[f64]) -> Result<Affine, Failure> {
    let [a, b, c, d, e, f, g, h, i, j, k, l, x, y, z, w] = *numbers else {
        let message = format!("a transform has 16 numbers, column by column: these are {}", numbers.len());
        return Err(Failure::invalid(message));
    };
    if [d, h, l, w] != [0.0, 0.0, 0.0, 1.0] {
        return Err(Failure::invalid(
            "a transform's last row must be 0, 0, 0, 1: it moves without perspective",
        ));
    }
    let matrix3 = Mat3::from_cols(Vec3::new(a, b, c), Vec3::new(e, f, g), Vec3::new(i, j, k));
    Ok(Affine { matrix3, translation: Vec3::new(x, y, z) })
}

impl From<TransformError> for Failure {
    fn from(error: TransformError) -> Failure {
        Failure::invalid(error)
    }
}

impl From<BooleanError> for Failure {
    fn from(error: BooleanError) -> Failure {
        match error {
            BooleanError::Lattice(lattice) => lattice.into(),
            BooleanError::Cancelled(cancelled) => cancelled.into(),
            BooleanError::OutOfMemory(out_of_memory) => out_of_memory.into(),
            BooleanError::Soup(soup) => soup.into(),
            BooleanError::BadTolerance(_) | BooleanError::TooFine(_) => Failure::invalid(&error),
        }
    }
}
