//! Decay: what matter becomes in time.
//!
//! A row of an element's `decays` says what becomes of it, after how long, above which temperature, and whether it needs air
//! ([`table`]). What burns is no more than that: wood above its point of ignition becomes ember, ember fire and ash, and what
//! the products have less of chemical energy makes them hot; conduction lights what is beside them. Smoke fades.
//!
//! Once a tick each lump that is hot enough throws a die, made of its id and of the tick; what needs air decays only where it
//! has an open surface ([`exposure`](crate::heat::Exposure)). Of several products each lump gets the next in turn.

mod burn;
mod ignite;
pub mod table;
#[cfg(test)]
mod tests;

pub use burn::Decays;
pub use ignite::ignite_under;
