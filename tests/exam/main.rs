//! The physics exam as a whole: its tolerances, and every case at `balanced`.

mod history;
mod misses;
