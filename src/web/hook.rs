//! What the page's script may ask and tell while the game runs: `window.powderMaster` (see `docs/web.md`). The desktop has
//! the same hook, [`script`]; here is what only a page tells.

use crate::{
    game::{
        actions::Action,
        disk,
        language::{self, Language},
        orders::{Order, Orders},
        script,
        toasts::Toasts,
    },
    web::{host, link::Link, reader},
};
use bevy::{
    ecs::world::World,
    prelude::{App, IntoScheduleConfigs, Last, Local, Res, Time, Virtual, resource_changed},
};
use std::path::Path;
use tr::tr;
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// Listens to the page.
pub(super) fn plugin(app: &mut App) {
    app.add_plugins((script::plugin, reader::plugin))
        .add_systems(Last, (tell_of_the_first_frame, tell_of_the_language.run_if(resource_changed::<Language>)));
}

fn tell_of_the_language(language: Res<Language>) {
    host::speak(language.tag());
}

fn tell_of_the_first_frame(mut painted: Local<bool>) {
    if !*painted {
        host::painted();
        *painted = true;
    }
}

/// The state of the game in the last frame, as JSON.
#[wasm_bindgen]
pub fn stats() -> String {
    script::stats().to_string()
}

/// What of the HUD has a name, as JSON.
#[wasm_bindgen]
pub fn widgets() -> String {
    script::widgets().to_string()
}

/// Plays what a link asks for (a JSON list of pairs).
///
/// # Errors
/// If the link can't be followed; then the game goes on as it is.
#[wasm_bindgen]
pub fn scene(link: &str) -> Result<(), JsError> {
    let link = Link::read(link)?;
    let asked = link.open()?;
    let Link { scene: name, settings, quality, detail, world } = link;
    let order = match world {
        Some(_) => Order::LoadBytes { name: tr!("the link"), bytes: asked.encode() },
        None => Order::Open { name, settings, quality, detail },
    };
    script::tell(move |world| world.resource_mut::<Orders>().push(order));
    Ok(())
}

/// Opens a file that was dropped, pasted or chosen: a save file, a picture with its world, a recording or a scene.
#[wasm_bindgen]
pub fn open(name: String, bytes: Vec<u8>) {
    script::tell(move |world| world.resource_mut::<Orders>().push(Order::LoadBytes { name, bytes }));
}

/// Stops the world's time, or lets it go on.
#[wasm_bindgen]
pub fn pause(paused: bool) {
    script::pause(paused);
}

/// The page is hidden, or seen again.
#[wasm_bindgen]
pub fn hidden(hidden: bool) {
    script::tell(move |world| {
        let mut time = world.resource_mut::<Time<Virtual>>();
        if hidden { time.pause() } else { time.unpause() }
    });
}

/// A text of the page in the language of the game.
#[wasm_bindgen]
pub fn spoken(english: &str) -> String {
    language::spoken(english)
}

/// Tells the player something.
#[wasm_bindgen]
pub fn tell(text: String) {
    script::tell(move |world| toasts(world).say(text));
}

/// Tells the player that something went wrong.
#[wasm_bindgen]
pub fn warn(text: String) {
    script::tell(move |world| toasts(world).warn(text));
}

/// Saves the world and stops its time: the player can no longer see it.
#[wasm_bindgen]
pub fn rescue() {
    script::tell(|world| world.resource_mut::<Orders>().push(Order::Act(Action::Save)));
    script::pause(true);
}

/// The browser keeps a file under another name: another page has taken the one that it had.
#[wasm_bindgen]
pub fn renamed(from: String, to: String) {
    disk::rename(Path::new(&from), Path::new(&to));
    script::tell(move |world| {
        let toasts = toasts(world);
        toasts.take_back(&from);
        toasts.say(tr!("Saved: {}", to));
    });
}

/// The browser does not keep a file, which is there until the page is left.
#[wasm_bindgen(js_name = notKept)]
pub fn not_kept(path: String, why: String) {
    script::tell(move |world| {
        let toasts = toasts(world);
        toasts.take_back(&path);
        toasts.warn(tr!("Not kept: the browser refuses it ({why}). {path} goes with this page.", why, path));
    });
}

fn toasts(world: &mut World) -> &mut Toasts {
    world.resource_mut::<Toasts>().into_inner()
}
