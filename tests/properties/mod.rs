//! What must hold in every world: random scenes under random hands, and every case that ever failed.
//!
//! | room | does |
//! |---|---|
//! | `scenes` | random scene files from the whole space of valid ones |
//! | `hands` | random tools at random times |
//! | `case` | a scene file and what was done to it, as files under `tests/cases` |
//! | `rules` | what a world is judged by |
//! | `random` | puts them together: what fails is shrunk and kept as a case |
//! | `effects` | the same, for what `auto` leaves out |
//! | `kept` | runs every case that was kept |

mod case;
mod effects;
mod hands;
mod kept;
mod random;
mod rules;
mod scenes;
