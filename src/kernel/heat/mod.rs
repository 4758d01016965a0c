//! Heat: what matter holds of it, how it goes from warm to cold, and what that makes of matter.
//!
//! A lump, a movable particle or a cell of rock, holds enthalpy in whole quanta of 8 J/m² ([`units`]); its temperature follows
//! ([`curve`], [`table`]). Once a tick
//!
//! 1. lumps whose change is done become another element ([`change`](change())),
//! 2. lumps near one another are gathered, where temperatures differ ([`grid`]): rock on its lattice ([`sites`]), and what moves
//!    with the rock that it may reach ([`sorted`]),
//! 3. pairs exchange heat ([`lattice`], [`passes`]), and what stands in the air exchanges it with the air ([`conduction`]).
//!
//! What one of a pair gets the other gives, in whole numbers: the sum is exact, in any order and for any number of threads.
//! Where all is at the room's temperature, nothing of this exists, and where no exchange would come to half a quantum, nothing
//! is done.

mod allowances;
mod brush;
mod change;
mod conduction;
pub mod curve;
mod exchanged;
mod exposure;
mod grid;
mod lattice;
mod lumps;
mod matter;
mod passes;
mod rates;
mod record;
mod settle;
mod sites;
mod slopes;
mod sorted;
mod states;
mod steps;
mod surface;
pub mod table;
#[cfg(test)]
mod tests;
pub mod units;
mod walls;
mod weights;

pub use brush::{reheat_under, set_under, warm_under};
pub use change::change;
pub use exposure::Exposure;
pub use matter::{Warm, chemical, held};
pub use record::{DECAY, GAS_PARTS, HeatRecord};
pub use steps::{Heat, HeatReport};
