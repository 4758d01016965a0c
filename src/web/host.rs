//! What the page's script does for the program: the object `powderHost`, which `web/page.js` and `web/worker.js` set up.

use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(js_namespace = powderHost)]
extern "C" {
    /// Tells the player that the program ended, and why.
    pub(super) fn failed(message: &str);

    /// Takes the progress bar away: the first frame is drawn.
    pub(super) fn painted();

    /// Has a screen reader say something.
    pub(super) fn say(text: &str);

    /// Says the page's own texts in the language of a tag, by [`spoken`](super::hook::spoken).
    pub(super) fn speak(tag: &str);
}

/// Tells of a panic in whatever thread.
pub(super) fn tell_of_panics() {
    std::panic::set_hook(Box::new(|panic| failed(&panic.to_string())));
}
