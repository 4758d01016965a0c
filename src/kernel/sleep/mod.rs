//! Water at rest sleeps: it keeps its place and costs nothing until something touches it.
//!
//! The unit is the **body**: all the particles in tiles that touch each other. A body falls asleep when every tile of it
//! has been calm for a second; it wakes as a whole before anything acts on it. A body is surrounded by a ring of empty
//! tiles, wider than any force between particles reaches: so the particles that are awake are simulated as if those that
//! sleep were not there, and lose nothing by it. As long as nothing comes, the only difference to a world without sleep is
//! that what little moved stands still. That difference is what [`JITTER`] and [`DRIFT`] bound.
//!
//! Why not parts of a body: pressure reaches through the whole of it at once. Were the still end of two communicating
//! vessels to sleep while the other is filled, their levels would part.
//!
//! Where the sleepers are: at the front of the particle store, in the order in which they fell asleep. For the substeps they
//! are taken aside ([`Sleep::set_aside`], [`Sleep::put_back`]), so that no pass sees them.
//!
//! What wakes: an awake particle in a tile of the body or beside it ([`Sleep::wake_touched`], looked at before the first
//! substep and in each after the prediction, before the solver looks for neighbours), wind ([`Sleep::wake_blown`]), any
//! change of the sleepers themselves, as by a brush or a drain ([`Sleep::check`]), and for all of them a change of the
//! rock, of gravity, of the quality or of the effects ([`Sleep::keep_under`]).

mod calm;
mod falling;
mod state;
#[cfg(test)]
mod tests;
mod tiles;
mod waking;

pub use calm::{DRIFT, JITTER, LOOK_TICKS};
pub use state::{Sleep, SleepRecord};
pub use waking::BREEZE;
