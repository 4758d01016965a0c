//! `bench`: tables of what things cost.

mod effects;
mod neighbours;
mod scaling;

pub(super) use effects::effects;
pub(super) use neighbours::neighbours;
pub(super) use scaling::scaling;
