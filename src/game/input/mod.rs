//! Devices → intents. `bindings` says which key or button means what, `keys` and `pointer` read the devices once a
//! frame, `strokes` turns what the pointer holds into intents, one lot for each tick.

pub mod bindings;
pub mod keys;
pub mod pointer;
pub mod strokes;
