//! Reads the texts of cases, which are a part of the program.

use ron::{Options, extensions::Extensions};
use serde::{Deserialize, Deserializer};

/// A text that lives as long as the program. Under this name a field of it can be read from anything.
pub type Text = &'static str;

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

/// Reads a text that there may be. It lives as long as the program.
pub(in crate::lab) fn reason<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<&'static str>, D::Error> {
    Ok(Option::<String>::deserialize(deserializer)?.map(|text| &*text.leak()))
}

/// Reads a figure, which JSON has nothing for where it is no number.
pub(in crate::lab) fn figure_or_nan<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
