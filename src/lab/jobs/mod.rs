//! Long work: one piece in the background of a game ([`Handle`]), or many pieces at once for a command ([`pool`]).

mod handle;
pub mod pool;

pub use handle::{Handle, Share};
