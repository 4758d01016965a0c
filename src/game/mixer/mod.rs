//! The mixer: elements of the player's own. An element is begun like another one (what becomes of that by heat, in time and by
//! touch becomes of it, too), changed by dials, and put into the world that is played; saves, recordings and pictures carry it
//! along. All that were made are kept from session to session, to be put into other worlds.
//!
//! ```text
//! panel ─► dials ─► draft (desk) ─► order ─► act ─► checkpoint with an element more ─► world
//!                     └► picture                └► own: the file
//! ```

pub mod act;
pub mod desk;
pub mod dials;
pub mod likeness;
pub mod own;
