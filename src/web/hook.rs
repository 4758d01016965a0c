//! What the page's script may ask and tell while the game runs: `window.powderMaster` (see `docs/web.md`).
//!
//! The game belongs to the browser's frame loop, so what is told waits for the next frame, and what is asked for was
//! noted in the last.

use crate::{
    game::{
        frame::Tempo,
        orders::{Order, Orders},
    },
    sim::{
        ledger::PassLedger,
        pace::Pace,
        state::{Census, Clock, Setup},
        workers::Workers,
    },
    web::{host, link::Link},
};
use bevy::prelude::{App, First, Last, Local, Res, ResMut, Time, Virtual};
use serde::Serialize;
use std::{cell::RefCell, collections::BTreeMap};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

thread_local! {
    /// What is told, in order.
    static TOLD: RefCell<Vec<Told>> = const { RefCell::new(Vec::new()) };
    /// What may be asked.
    static STATS: RefCell<Stats> = RefCell::default();
}

enum Told {
    Scene(Link),
    Pause(bool),
    Hidden(bool),
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
}

/// Listens to the page.
pub(super) fn plugin(app: &mut App) {
    app.add_systems(First, listen).add_systems(Last, note);
}

fn listen(mut orders: ResMut<Orders>, mut pace: ResMut<Pace>, mut time: ResMut<Time<Virtual>>) {
    for told in TOLD.take() {
        match told {
            Told::Scene(link) => {
                orders.push(Order::Scene { name: link.scene, settings: link.settings });
                if let Some(quality) = link.quality {
                    orders.push(Order::Quality(quality));
                }
            }
            Told::Pause(paused) => *pace = Pace { paused, steps_due: 0, ..*pace },
            Told::Hidden(true) => time.pause(),
            Told::Hidden(false) => time.unpause(),
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
    TOLD.with_borrow_mut(|told| told.push(Told::Scene(link)));
    Ok(())
}

/// Stops the world's time, or lets it go on.
#[wasm_bindgen]
pub fn pause(paused: bool) {
    TOLD.with_borrow_mut(|told| told.push(Told::Pause(paused)));
}

/// The page is hidden, or seen again.
#[wasm_bindgen]
pub fn hidden(hidden: bool) {
    TOLD.with_borrow_mut(|told| told.push(Told::Hidden(hidden)));
}
