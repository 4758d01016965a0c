//! Opens the game on the page.

use crate::{
    game::{hud::motion::ReducedMotion, input::touch::Fingers, toasts::Toasts, window},
    lab::live::LivePlugin,
    web::{hook, host, link::Link},
};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Plays what a link asks for (a JSON list of pairs) on the page's canvas, with tools for fingers if `touch`, and with a HUD that
/// moves little if the system asks for `reduced_motion`. What can't be followed is told, and the default scene played.
///
/// # Errors
/// If there is no scene to play.
#[wasm_bindgen]
pub fn start(link: &str, touch: bool, reduced_motion: bool) -> Result<(), JsError> {
    host::tell_of_panics();
    let (begun, problem) = match Link::read(link).and_then(|link| link.open()) {
        Ok(begun) => (begun, None),
        Err(error) => (Link::read("[]")?.open()?, Some(error)),
    };
    let mut app = window::build(None, |app| {
        app.add_plugins(LivePlugin);
        begun.restore(app.world_mut());
    });
    app.add_plugins(hook::plugin);
    // Bevy has put its own teller in the place.
    host::tell_of_panics();
    app.world_mut().resource_mut::<Fingers>().in_use = touch;
    app.world_mut().resource_mut::<ReducedMotion>().by_system = reduced_motion;
    if let Some(error) = problem {
        app.world_mut().resource_mut::<Toasts>().warn(error.to_string());
    }
    app.run();
    Ok(())
}
