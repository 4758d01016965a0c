//! What the HUD shows of stamps: pictures of them, the ghost at the pointer, and the buttons while one is held.

pub mod ghost;
pub mod picture;
pub mod strip;
