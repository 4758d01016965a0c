//! Devices → intents. `bindings` says which key or button means what; `keymap` changes that to the keys that the player has
//! chosen, by a layout (`layouts`) or one by one (`rebind`, `chord`). `devices` reads what happened since the last frame, in its
//! order, and `pointer`, `touch` and `keys` say what it means; `mouse_keys` makes a mouse of the keyboard; `strokes` turns what the pointer holds into intents, one lot for
//! each tick.

pub mod bindings;
pub mod chord;
pub mod devices;
pub mod keymap;
pub mod keys;
pub mod layouts;
pub mod mouse_keys;
pub mod pointer;
pub mod rebind;
pub mod strokes;
pub mod touch;
