//! What the page's script may ask and tell while the game runs: `window.powderMaster` (see `docs/web.md`).
//!
//! The game belongs to the browser's frame loop, so what is told waits for the next frame, and what is asked for was
//! noted in the last.

use crate::{
    game::{
        actions::Action,
        disk,
        frame::Tempo,
        orders::{Order, Orders},
        toasts::Toasts,
    },
    sim::{
        ledger::PassLedger,
        pace::Pace,
        state::{Census, Clock, Setup},
        workers::Workers,
    },
    web::{host, link::Link},
};
use bevy::{
    prelude::{App, First, Last, Local, Res, ResMut, Time, Virtual},
    winit::{EventLoopProxy, EventLoopProxyWrapper, WinitUserEvent},
};
use serde::Serialize;
use std::{cell::RefCell, collections::BTreeMap, path::Path};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

thread_local! {
    /// What is told, in order.
    static TOLD: RefCell<Vec<Told>> = const { RefCell::new(Vec::new()) };
    /// What may be asked.
    static STATS: RefCell<Stats> = RefCell::default();
    /// The event loop, which sleeps while nothing changes.
    static LOOP: RefCell<Option<EventLoopProxy<WinitUserEvent>>> = const { RefCell::new(None) };
}

enum Told {
    Scene(Link),
    Pause(bool),
    Hidden(bool),
    Rescue,
    Warning(String),
    Renamed { from: String, to: String },
    NotKept { path: String, why: String },
}

fn tell(told: Told) {
    TOLD.with_borrow_mut(|all| all.push(told));
    LOOP.with_borrow(|sleeper| {
        // Before the game runs there is none to wake, and after its end none that could be.
        let _ = sleeper.as_ref().map(|sleeper| sleeper.send_event(WinitUserEvent::WakeUp));
    });
}

/// The state of the game in the last frame.
#[derive(Clone, Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
struct Stats {
    scene: String,
    title: String,
    quality: &'static str,
    tick: u64,
    particles: u32,
    elements: BTreeMap<String, u32>,
    paused: bool,
    frames_per_second: f32,
    ticks_per_second: f32,
    ms_per_tick: f64,
    threads: usize,
    messages: Vec<String>,
}

/// Listens to the page.
pub(super) fn plugin(app: &mut App) {
    app.add_systems(First, listen).add_systems(Last, note);
    let sleeper = app.world().get_resource::<EventLoopProxyWrapper>().map(|sleeper| (**sleeper).clone());
    LOOP.set(sleeper);
}

fn listen(
    mut orders: ResMut<Orders>,
    mut pace: ResMut<Pace>,
    mut time: ResMut<Time<Virtual>>,
    mut toasts: ResMut<Toasts>,
) {
    for told in TOLD.take() {
        match told {
            Told::Scene(Link { scene: name, settings, quality }) => {
                orders.push(Order::Open { name, settings, quality });
            }
            Told::Pause(paused) => *pace = Pace { paused, steps_due: 0, ..*pace },
            Told::Hidden(true) => time.pause(),
            Told::Hidden(false) => time.unpause(),
            Told::Rescue => {
                orders.push(Order::Act(Action::Save));
                *pace = Pace { paused: true, steps_due: 0, ..*pace };
            }
            Told::Warning(text) => toasts.warn(text),
            Told::Renamed { from, to } => {
                toasts.take_back(&from);
                toasts.say(format!("Saved: {to}"));
            }
            Told::NotKept { path, why } => {
                toasts.take_back(&path);
                toasts.warn(format!("Not kept: the browser refuses it ({why}). {path} goes with this page."));
            }
        }
    }
}

fn note(
    setup: Res<Setup>,
    census: Res<Census>,
    clock: Res<Clock>,
    pace: Res<Pace>,
    tempo: Res<Tempo>,
    ledger: Res<PassLedger>,
    workers: Res<Workers>,
    toasts: Res<Toasts>,
    mut painted: Local<bool>,
) {
    STATS.with_borrow_mut(|stats| {
        stats.scene.clone_from(&setup.blueprint.name);
        stats.title.clone_from(&setup.blueprint.title);
        stats.quality = setup.preset.name();
        stats.tick = clock.tick;
        stats.particles = census.total;
        let named = setup.elements().iter().map(|(_, element)| element.name.clone());
        stats.elements = named.zip(census.by_element.iter().copied()).collect();
        stats.paused = pace.paused;
        stats.frames_per_second = tempo.frames_per_second;
        stats.ticks_per_second = tempo.ticks_per_second;
        stats.ms_per_tick = ledger.tick().median().as_secs_f64() * 1000.0;
        stats.threads = workers.threads();
        stats.messages = toasts.texts().map(str::to_owned).collect();
    });
    if !*painted {
        host::painted();
        *painted = true;
    }
}

/// The state of the game in the last frame, as JSON.
///
/// # Errors
/// Never: it is made of numbers and names.
#[wasm_bindgen]
pub fn stats() -> Result<String, JsError> {
    Ok(STATS.with_borrow(serde_json::to_string)?)
}

/// Plays what a link asks for (a JSON list of pairs).
///
/// # Errors
/// If the link can't be followed; then the game goes on as it is.
#[wasm_bindgen]
pub fn scene(link: &str) -> Result<(), JsError> {
    let link = Link::read(link)?;
    link.build()?;
    tell(Told::Scene(link));
    Ok(())
}

/// Stops the world's time, or lets it go on.
#[wasm_bindgen]
pub fn pause(paused: bool) {
    tell(Told::Pause(paused));
}

/// The page is hidden, or seen again.
#[wasm_bindgen]
pub fn hidden(hidden: bool) {
    tell(Told::Hidden(hidden));
}

/// Tells the player that something went wrong.
#[wasm_bindgen]
pub fn warn(text: String) {
    tell(Told::Warning(text));
}

/// Saves the world and stops its time: the player can no longer see it.
#[wasm_bindgen]
pub fn rescue() {
    tell(Told::Rescue);
}

/// The browser keeps a file under another name: another page has taken the one that it had.
#[wasm_bindgen]
pub fn renamed(from: String, to: String) {
    disk::rename(Path::new(&from), Path::new(&to));
    tell(Told::Renamed { from, to });
}

/// The browser does not keep a file, which is there until the page is left.
#[wasm_bindgen(js_name = notKept)]
pub fn not_kept(path: String, why: String) {
    tell(Told::NotKept { path, why });
}
