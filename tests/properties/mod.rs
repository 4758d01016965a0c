//! What must hold in every world: those of the random gauntlet, new ones in each run, and every case that ever failed; and by
//! every table of elements.
//!
//! | room | does |
//! |---|---|
//! | `random` | judges new random worlds by all rules; what fails is kept as a case |
//! | `effects` | the same worlds, for what `auto` leaves out |
//! | `kept` | judges every case that was kept |
//! | `tables` | makes tables of elements, and keeps account of what changes by them |

mod effects;
mod kept;
mod random;
mod tables;
