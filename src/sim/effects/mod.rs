//! The effects of a world: what is wanted of each and what was decided (`states`), and what is shown of it (`status`). What
//! effects there are stands in `scene::effects`.

mod states;
pub mod status;

pub use states::{EffectState, Effects, runs};
