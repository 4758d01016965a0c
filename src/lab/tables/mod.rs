//! What a run leaves as a table, comma separated, in SI units. A field is empty where there is nothing to measure.

pub mod distances;
pub mod particles;
pub mod trace;
