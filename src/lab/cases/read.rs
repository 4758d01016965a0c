//! Reads the texts of cases, which are a part of the program.

use ron::{Options, extensions::Extensions};
use serde::{Deserialize, Deserializer};

/// Reads a RON text of the program.
///
/// # Panics
/// If it can't be read; a test reads each.
pub(in crate::lab) fn read<T: Deserialize<'static>>(file: &str, text: &'static str) -> T {
    let options = Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    options.from_str(text).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Reads a text that stands in several lines as one line. It lives as long as the program.
pub(in crate::lab) fn line<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static str, D::Error> {
    let text = String::deserialize(deserializer)?;
    Ok(text.split_whitespace().collect::<Vec<_>>().join(" ").leak())
}
