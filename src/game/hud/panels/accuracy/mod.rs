//! The accuracy panel: the running world on the curve of error against time, the presets to choose on it, the survey
//! that measures the curve here and now, the autopilot, the A/B split, what each stage takes of a tick, and on demand all
//! else that is measured.

pub mod axis;
mod canvas;
mod curves;
pub mod dial;
mod measures;
pub mod panel;
mod pilot;
mod plot;
