//! Typed arrays to vectors and back, always as copies: the memory of wasm moves when it grows.
use super::failure::Failure;
use crate::math::{Aabb, Vec3};
use js_sys::{Float32Array, Float64Array, Function, Reflect, Uint8Array, Uint32Array};
use wasm_bindgen::{JsCast, JsValue};

/// Numbers copied at a time: enough to amortise a call into JavaScript, little on the stack.
const BLOCK: u32 = 3 * 1024;

/// A vector that can take `count` items, or `OutOfMemory`.
pub fn reserved<T>(count: usize) -> Result<Vec<T>, Failure> {
    let mut items = Vec::new();
    let bytes = count.saturating_mul(size_of::<T>());
    items.try_reserve_exact(count).map_err(|_| Failure::out_of_memory(bytes))?;
    Ok(items)
}

/// The bytes of a `Uint8Array`.
pub fn bytes_from(array: &Uint8Array) -> Result<Vec<u8>, Failure> {
    let mut bytes = reserved(array.length() as usize)?;
    bytes.resize(array.length() as usize, 0);
    array.copy_to(&mut bytes);
    Ok(bytes)
}

/// The numbers of a `Float64Array` or `Float32Array`.
pub fn numbers_from(what: &str, array: &JsValue) -> Result<Vec<f64>, Failure> {
    if let Some(array) = array.dyn_ref::<Float64Array>() {
        let mut numbers = reserved(array.length() as usize)?;
        numbers.resize(array.length() as usize, 0.0);
        array.copy_to(&mut numbers);
        return Ok(numbers);
    }
    let Some(array) = array.dyn_ref::<Float32Array>() else {
        return Err(Failure::invalid(format!("{what} must be a Float32Array or a Float64Array")));
    };
    let mut numbers = reserved(array.length() as usize)?;
    let mut block = [0.0f32; BLOCK as usize];
    for start in (0..array.length()).step_by(BLOCK as usize) {
        let end = array.length().min(start + BLOCK);
        let part = &mut block[..(end - start) as usize];
        array.subarray(start, end).copy_to(part);
        numbers.extend(part.iter().map(|&x| f64::from(x)));
    }
    Ok(numbers)
}

/// The points of an array xyzxyz…
pub fn points_from(what: &str, array: &JsValue) -> Result<Vec<Vec3>, Failure> {
    let numbers = numbers_from(what, array)?;
    let (triples, []) = numbers.as_chunks() else {
        let length = numbers.len();
        return Err(Failure::invalid(format!("{what} has {length} numbers: a multiple of 3 is needed")));
    };
    let mut points = reserved(triples.len())?;
    points.extend(triples.iter().map(|&p| Vec3::from_array(p)));
    Ok(points)
}

/// The triangles of an array of indices, three each; without one, of every three of `vertices`.
pub fn triangles_from(indices: Option<&Uint32Array>, vertices: usize) -> Result<Vec<[u32; 3]>, Failure> {
    let Some(indices) = indices else {
        if !vertices.is_multiple_of(3) {
            let message = format!("{vertices} vertices without indices: a multiple of 3 is needed");
            return Err(Failure::invalid(message));
        }
        let mut triangles = reserved(vertices / 3)?;
        triangles.extend((0..vertices as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]));
        return Ok(triangles);
    };
    let mut numbers = reserved(indices.length() as usize)?;
    numbers.resize(indices.length() as usize, 0);
    indices.copy_to(&mut numbers);
    let (triples, []) = numbers.as_chunks() else {
        let length = numbers.len();
        return Err(Failure::invalid(format!("there are {length} indices: a multiple of 3 is needed")));
    };
    let mut triangles = reserved(triples.len())?;
    triangles.extend_from_slice(triples);
    Ok(triangles)
}

/// A new array that lies in JavaScript's memory, or `OutOfMemory`.
fn new_array(constructor: &str, length: usize, bytes: usize) -> Result<JsValue, Failure> {
    let failed = |_| Failure::out_of_memory(length.saturating_mul(bytes));
    let class: Function =
        Reflect::get(&js_sys::global(), &constructor.into()).map_err(failed)?.unchecked_into();
    Reflect::construct(&class, &js_sys::Array::of1(&(length as f64).into())).map_err(failed)
}

pub fn bytes_to(bytes: &[u8]) -> Result<Uint8Array, Failure> {
    let array: Uint8Array = new_array("Uint8Array", bytes.len(), 1)?.unchecked_into();
    array.copy_from(bytes);
    Ok(array)
}

pub fn numbers_to(numbers: &[f64]) -> Result<Float64Array, Failure> {
    let array: Float64Array = new_array("Float64Array", numbers.len(), 8)?.unchecked_into();
    array.copy_from(numbers);
    Ok(array)
}

pub fn singles_to(numbers: &[f32]) -> Result<Float32Array, Failure> {
    let array: Float32Array = new_array("Float32Array", numbers.len(), 4)?.unchecked_into();
    array.copy_from(numbers);
    Ok(array)
}

pub fn indices_to(indices: &[u32]) -> Result<Uint32Array, Failure> {
    let array: Uint32Array = new_array("Uint32Array", indices.len(), 4)?.unchecked_into();
    array.copy_from(indices);
    Ok(array)
}

/// Indices of triangles, three each.
pub fn triangles_to(triangles: &[[u32; 3]]) -> Result<Uint32Array, Failure> {
    indices_to(triangles.as_flattened())
}

/// Vectors as 32-bit floats xyzxyz…, relative to `origin`.
pub fn vectors_to(vectors: &[Vec3], origin: Vec3) -> Result<Float32Array, Failure> {
    let array: Float32Array = new_array("Float32Array", 3 * vectors.len(), 4)?.unchecked_into();
    let mut block = [[0.0f32; 3]; BLOCK as usize / 3];
    for (index, part) in vectors.chunks(block.len()).enumerate() {
        for (narrow, wide) in block.iter_mut().zip(part) {
            *narrow = (*wide - origin).as_vec3().to_array();
        }
        let start = (index * block.len() * 3) as u32;
        let numbers = block[..part.len()].as_flattened();
        array.subarray(start, start + numbers.len() as u32).copy_from(numbers);
    }
    Ok(array)
}

/// Three numbers as a plain array.
pub fn triple_to(v: impl Into<[f64; 3]>) -> JsValue {
    v.into().into_iter().map(JsValue::from).collect::<js_sys::Array>().into()
}

/// `{ min, max }`.
pub fn bounds_to(bounds: Aabb) -> JsValue {
    let entries = [("min", triple_to(bounds.min)), ("max", triple_to(bounds.max))];
    super::failure::object(entries).into()
}
