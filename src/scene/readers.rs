//! Every reader of bytes that come from outside, by one door: what the fuzzer and the corpus tests throw at them.
//! Whatever they are given, they answer with a value or with one line, in time and memory that their limits bound.

use crate::{
    kernel::element::ElementTable,
    scene::{build::SceneFile, elements, error::SceneError, expression::Expression, image::Mask},
};

/// Reads a scene file. It can't name pictures of its own.
///
/// # Errors
/// If it is not what the format asks for.
pub fn scene(bytes: &[u8]) -> Result<SceneFile, SceneError> {
    SceneFile::from_bytes("scene", bytes.to_vec().into())
}

/// Reads an element table.
///
/// # Errors
/// If it is not what the format asks for.
pub fn element_table(bytes: &[u8]) -> Result<ElementTable, SceneError> {
    elements::table(bytes)
}

/// The value of an expression in which every name stands for `value`.
///
/// # Errors
/// If it is no expression, or has no finite value.
pub fn expression(text: &str, value: f64) -> Result<f64, String> {
    Expression::parse(text)?.evaluate(|_| Some(value)).map_err(|fault| fault.to_string())
}

/// Reads a picture; whether the middle of it is dark.
///
/// # Errors
/// If it is no PNG picture, or too large.
pub fn picture(bytes: &[u8]) -> Result<bool, String> {
    Ok(Mask::decode(bytes)?.is_dark(0.5, 0.5))
}
