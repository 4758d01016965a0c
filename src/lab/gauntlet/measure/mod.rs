//! What the rules are about, measured in a world between two ticks. One form of each: the judge of the cases, that of the
//! random worlds and the tests measure by it.

pub(super) mod air;
pub(super) mod cost;
pub(super) mod energy;
pub(super) mod place;
pub(super) mod roll;
pub(super) mod sound;
pub(super) mod still;
pub(super) mod work;
