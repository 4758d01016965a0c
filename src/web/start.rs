//! Opens the game on the page.

use crate::{
    game::{input::touch::Fingers, toasts::Toasts, window},
    lab::live::LivePlugin,
    sim::checkpoint::Checkpoint,
    web::{hook, host, link::Link},
};
use std::sync::Arc;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Plays what a link asks for (a JSON list of pairs) on the page's canvas, with tools for fingers if `touch`. What can't
/// be followed is told, and the default scene played.
///
/// # Errors
/// If there is no scene to play.
#[wasm_bindgen]
pub fn start(link: &str, touch: bool) -> Result<(), JsError> {
    host::tell_of_panics();
    let (blueprint, problem) = match Link::read(link).and_then(|link| link.build()) {
        Ok(blueprint) => (blueprint, None),
        Err(error) => (Link::read("[]")?.build()?, Some(error)),
    };
    let mut app = window::build(None, |app| {
        app.add_plugins(LivePlugin);
        Checkpoint::of_scene(Arc::new(blueprint)).restore(app.world_mut());
    });
    app.add_plugins(hook::plugin);
    // Bevy has put its own teller in the place.
    host::tell_of_panics();
    app.world_mut().resource_mut::<Fingers>().in_use = touch;
    if let Some(error) = problem {
        app.world_mut().resource_mut::<Toasts>().warn(error.to_string());
    }
    app.run();
    Ok(())
}
