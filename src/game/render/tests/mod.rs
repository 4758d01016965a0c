//! What the picture must be like: what is packed for the graphics, and what is seen.

mod matter;
#[cfg(not(target_arch = "wasm32"))]
mod pixels;
