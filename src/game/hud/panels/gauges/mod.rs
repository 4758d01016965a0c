//! The panel of the gauges: `panel` their numbers, `plot` the last half minute of one quantity, `scale` the axis that it stands on.

pub mod panel;
pub mod plot;
mod scale;
