//! A link that carries the world, which a page can be opened with.

use crate::{
    game::{language::grouped, toasts::Toasts},
    sim::{checkpoint::Checkpoint, world_text},
};
use bevy::prelude::World;
use tr::tr;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(js_namespace = powderHost)]
extern "C" {
    /// Puts the page's address with the text of a world into the clipboard, and tells the player (`web::hook`).
    #[wasm_bindgen(js_name = copyLink)]
    fn copy_link(world: &str);
}

/// Copies a link to the world as it is now, if that is small enough.
pub fn copy(world: &mut World) {
    match world_text::write(&Checkpoint::of(world)) {
        Ok(text) if text.len() <= world_text::MOST => copy_link(&text),
        Ok(text) => world.resource_mut::<Toasts>().warn(tr!(
            "Too large for a link: {} characters, {} are allowed; a screenshot (F2) carries any world",
            grouped(text.len() as u64),
            grouped(world_text::MOST as u64)
        )),
        Err(error) => world.resource_mut::<Toasts>().warn(tr!("No link: {}", error)),
    }
}
