//! Reactions: what touches becomes something else.
//!
//! A row of an element's `touches` says what it and another become, how often a second where they touch, and between which
//! temperatures ([`table`]). Once a tick each lump, a movable particle or a cell of rock, looks at what touches it, and each
//! contact throws a die. Of those that fell it takes the lowest, and the two react if both took each other ([`contacts`]). The
//! dice are made of both ids, of the tick and of the row, so no order and no thread shows in what reacts.
//!
//! A lump becomes one lump or goes into the air, and keeps its heat: nothing multiplies, and no way round through reactions
//! gives heat.

mod contacts;
mod react;
pub mod table;
#[cfg(test)]
mod tests;

pub use react::Reactions;
