//! The way to a page's audio thread (`web/sound.js`). It has a module of its own, so controls are all that goes there.

use crate::sound::Controls;
use bevy::prelude::Resource;
use std::time::Duration;
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(js_namespace = powderHost)]
extern "C" {
    /// Whether the browser has sound.
    #[wasm_bindgen(js_name = maySound)]
    fn may_sound() -> bool;

    /// Leaves what is to be heard.
    #[wasm_bindgen(js_name = leaveSound)]
    fn leave_sound(controls: &[f32]);

    /// Lets it play, or rest.
    #[wasm_bindgen(js_name = wishSound)]
    fn wish_sound(plays: bool);
}

/// The way to the browser's sound. By default there is none: only the page's game asks for it.
#[derive(Resource, Debug, Default)]
pub struct Output {
    may_play: bool,
}

impl Output {
    /// The browser's.
    pub fn of_system() -> Self {
        Self { may_play: may_sound() }
    }

    /// Leaves what is to be heard.
    pub(super) fn leave(&self, controls: &Controls) {
        leave_sound(&controls.to_array());
    }

    /// Whether there is one.
    pub fn may_play(&self) -> bool {
        self.may_play
    }

    /// Lets it play, or rest.
    pub(super) fn wish(&mut self, plays: bool) {
        wish_sound(plays);
    }

    /// Frames that were played, and the time that took: on another thread, which can't tell.
    pub(super) fn played(&self) -> (u64, Duration) {
        (0, Duration::ZERO)
    }
}
