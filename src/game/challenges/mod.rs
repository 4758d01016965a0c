//! Challenges in the game: how one begins and ends (`attempt`), what a press may do in it (`referee`), and the stars that are
//! kept (`earned`). The judge itself is the simulation's ([`crate::sim::judge`]).

pub mod attempt;
pub mod earned;
pub mod referee;
