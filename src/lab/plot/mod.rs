//! Charts for reports: lines and points on linear or logarithmic axes, as SVG or PNG.
//!
//! Rooms: `chart` what a chart shows, `ticks` where its axes are marked, `text` how wide words are, `labels` where words
//! find room, `layout` where everything stands, `draw` the SVG, `png` the same as a picture.

mod chart;
mod draw;
mod labels;
mod layout;
mod png;
#[cfg(test)]
mod tests;
mod text;
mod ticks;

pub use chart::{Axis, Chart, Look, Naming, Point, Scale, Series};
pub use png::PngError;
