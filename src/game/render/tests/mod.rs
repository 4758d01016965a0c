//! What the picture must be like: what is packed for the graphics, and what is seen.

#[cfg(not(target_arch = "wasm32"))]
mod flashes;
mod matter;
#[cfg(not(target_arch = "wasm32"))]
mod pixels;

/// Set where there must be graphics: elsewhere a machine without any passes.
#[cfg(not(target_arch = "wasm32"))]
const MUST: &str = "POWDER_MASTER_GRAPHICS";

/// A picture, if there are graphics to draw it.
#[cfg(not(target_arch = "wasm32"))]
fn graphics<P, E: std::fmt::Display>(open: impl FnOnce() -> Result<P, E>) -> Option<P> {
    match open() {
        Ok(picture) => Some(picture),
        Err(reason) => {
            assert!(std::env::var_os(MUST).is_none(), "{reason}");
            eprintln!("not tested: {reason}");
            None
        }
    }
}
