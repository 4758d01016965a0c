//! What is allowed: the tolerances of the physics exam and its misses, and the bounds of the gauntlet.

mod bounds;
mod history;
mod misses;
