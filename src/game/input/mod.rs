//! Devices → intents. `bindings` says which key or button means what; `devices` reads what happened since the last
//! frame, in its order, and `pointer`, `touch` and `keys` say what it means; `strokes` turns what the pointer holds into intents,
//! one lot for each tick.

pub mod bindings;
pub mod devices;
pub mod keys;
pub mod pointer;
pub mod strokes;
pub mod touch;
