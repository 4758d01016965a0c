//! Long work: one piece in the background of a game ([`Handle`]), or many pieces at once for a command ([`pool`]).

mod drive;
mod handle;
pub mod pool;

pub(crate) use drive::{finish, pause};
pub use handle::{Handle, Share};
