//! Copy, cut and paste: what the player holds, and the stamps that are kept.
//!
//! A copy begins with an empty frame in hand; the rectangle that is dragged then is a stamp, which is kept on the shelf and
//! held. A click pastes it, as often as wanted. What it changes goes through intents, as all edits do.

pub mod act;
pub mod hand;
pub mod shelf;
