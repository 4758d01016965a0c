//! Crash recovery: what is kept for when the game ends as it should not: by a panic, or killed, or with the machine.
//!
//! ```text
//! recorder ─► journal: a thread that keeps the newest state and the input since then in a file, locked while we live
//!     │           │ killed: the file stays, and its lock is free
//!     │           ▼
//!     │       recovery: at the next start, the world just before the end is offered, or forgotten
//!     ▼
//! panic ─► the last minute as a recording of its own; the journal gets the rest of the input and its end
//! ```
//!
//! A crash does not lead to the next: what is offered is only loaded when the player asks for it, its input runs again in a
//! thread of its own where a panic loses nothing but the input, and the world that comes of it is paused. A page has none
//! of this: a panic there ends the program at once, without a chance to write.

mod guard;
pub mod journal;
pub mod recovery;

pub use guard::{Crash, folder, run};
