//! The same world at another particle spacing: what moves is split or merged, rock and air are carried over.
//!
//! `factor` is the number of new d in one old d: 2 makes four particles of one, ½ one of four. Mass and momentum are
//! those of before to rounding, the area to half a particle; what stands for a place stays within a new d of it. Nobody
//! sleeps afterwards, and the first guess of the pressure is forgotten: both follow from the matter.

mod curve;
mod pieces;
mod rock;
mod settle;

pub use pieces::resample_particles;
pub use rock::{make_room, resample_rock};
pub use settle::settle;

#[cfg(test)]
mod tests;
