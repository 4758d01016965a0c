//! What must hold in every world: those of the random gauntlet, new ones in each run, and every case that ever failed.
//!
//! | room | does |
//! |---|---|
//! | `random` | judges new random worlds by all rules; what fails is kept as a case |
//! | `effects` | the same worlds, for what `auto` leaves out |
//! | `kept` | judges every case that was kept |

mod effects;
mod kept;
mod random;
