//! Effects: the parts of the simulation that a scene may do without.
//!
//! | room | has |
//! |---|---|
//! | `table` | what there is: name, passes, what calls for it, parameters, what `off` means |
//! | `facts` | what is known of the world when a tick is planned |
//! | `states` | what is wanted of each effect, what was decided, how often it ran |
//! | `account` | what is said of it: whether it runs, why, how much it leaves alone, what that saves |

pub mod account;
pub mod facts;
mod states;
pub mod table;

pub use states::{EffectState, Effects, runs};
