//! Charts for reports, as SVG or PNG.

mod draw;
#[cfg(test)]
mod tests;
mod types;

pub use types::{Axis, Chart, Look, Point, Scale, Series};
