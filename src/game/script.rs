//! The hook for scripts: what a page's script (`web::hook`) or a test of the desktop (`play --hook`) may ask and tell while
//! the game runs. docs/scripts.md lists all of it.
//!
//! The event loop owns the game. So what a script tells waits for the next frame, and what it asks was noted in the last.
//!
//! ```text
//! script ─► tell ─► First: what was told ─► orders, pace, messages
//!        ◄─ stats, widgets ◄─ Last: note ◄─ the world, egui's tree of widgets
//! ```

use crate::{
    game::{
        frame::Tempo,
        input::pointer::Pointer,
        render::level::PictureLevel,
        sound::{Ears, SoundCost},
        toasts::Toasts,
        toolbox::Toolbox,
    },
    kernel::units::TICKS_PER_SECOND,
    sim::{
        judge::{Judge, Stars, Verdict},
        ledger::PassLedger,
        pace::Pace,
        recorder::Recorder,
        state::{Census, Clock, Setup},
        workers::Workers,
    },
};
use bevy::{
    prelude::{App, First, Last, World},
    winit::{EventLoopProxy, EventLoopProxyWrapper, WinitUserEvent},
};
use bevy_egui::{
    EguiContext, EguiOutput,
    egui::accesskit::{Node, Role, Toggled},
};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    mem,
    sync::{Mutex, MutexGuard, PoisonError},
};

/// What is done to the world in the next frame.
type Told = Box<dyn FnOnce(&mut World) + Send>;

static HOOK: Mutex<Hook> = Mutex::new(Hook::new());

/// What script and game leave for each other.
struct Hook {
    told: Vec<Told>,
    /// The event loop, which sleeps while nothing changes.
    event_loop: Option<EventLoopProxy<WinitUserEvent>>,
    /// Frames since the start, and the state of the game in the last of them; `null` before the first.
    frame: u64,
    stats: Value,
    /// The widgets are only noted from the first time on that a script asks for them.
    widgets: Option<Value>,
}

impl Hook {
    const fn new() -> Self {
        Self { told: Vec::new(), event_loop: None, frame: 0, stats: Value::Null, widgets: None }
    }
}

/// The lock is never held while a frame is drawn, so a page's thread, which may not sleep, never waits for it.
fn hook() -> MutexGuard<'static, Hook> {
    HOOK.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps the hook of this game up to date.
pub fn plugin(app: &mut App) {
    app.add_systems(First, listen).add_systems(Last, note);
    let event_loop = app.world().get_resource::<EventLoopProxyWrapper>().map(|event_loop| (**event_loop).clone());
    *hook() = Hook { event_loop, ..Hook::new() };
}

/// Has something done to the world in the next frame, and sees to it that there is one.
pub fn tell(told: impl FnOnce(&mut World) + Send + 'static) {
    let mut hook = hook();
    hook.told.push(Box::new(told));
    // Before the game runs there is no event loop, and after its end none that could be woken.
    let _ = hook.event_loop.as_ref().map(|event_loop| event_loop.send_event(WinitUserEvent::WakeUp));
}

/// Stops the world's time, or lets it go on.
pub fn pause(paused: bool) {
    tell(move |world| {
        let mut pace = world.resource_mut::<Pace>();
        *pace = Pace { paused, steps_due: 0, ..*pace };
    });
}

/// The state of the game in the last frame; `null` before the first.
pub fn stats() -> Value {
    hook().stats.clone()
}

/// The HUD's widgets in the last frame. The first to ask gets none.
pub fn widgets() -> Value {
    if let Some(widgets) = &hook().widgets {
        return widgets.clone();
    }
    tell(|world| {
        hook().widgets = Some(json!([]));
        for mut context in world.query::<&mut EguiContext>().iter_mut(world) {
            context.get_mut().enable_accesskit();
        }
    });
    json!([])
}

fn listen(world: &mut World) {
    let told = mem::take(&mut hook().told);
    told.into_iter().for_each(|told| told(world));
}

fn note(world: &mut World) {
    let stats = look(world);
    let noted = hook().widgets.is_some();
    let widgets = noted.then(|| {
        let mut outputs = world.query::<(&mut EguiContext, &EguiOutput)>();
        outputs
            .iter_mut(world)
            .flat_map(|(mut context, output)| named(output, context.get_mut().zoom_factor()))
            .collect()
    });
    let mut hook = hook();
    hook.frame += 1;
    hook.stats = stats;
    hook.stats["frame"] = hook.frame.into();
    hook.widgets = widgets;
}

/// The state of the game: docs/scripts.md says what each number means.
fn look(world: &World) -> Value {
    let setup = world.resource::<Setup>();
    let census = world.resource::<Census>();
    let tempo = world.resource::<Tempo>();
    let names = setup.elements().iter().map(|(_, element)| &element.name);
    json!({
        "scene": setup.blueprint.name,
        "title": setup.blueprint.title,
        "quality": setup.preset.name(),
        "tick": world.resource::<Clock>().tick,
        "particles": census.total,
        "elements": names.zip(&census.by_element).collect::<BTreeMap<_, _>>(),
        "tool": world.resource::<Toolbox>().tool.name(setup.elements()),
        "pointer": world.resource::<Pointer>().at.map(<[f32; 2]>::from),
        "brush": 2.0 * world.resource::<Toolbox>().radius(),
        "mode": world.resource::<Toolbox>().mode().name(),
        "paused": world.resource::<Pace>().paused,
        "rewinds": world.resource::<Pace>().rewinds,
        "speed": world.resource::<Pace>().speed,
        "rests": tempo.rests,
        "recording": world.resource::<Recorder>().ticks(),
        "framesPerSecond": tempo.frames_per_second,
        "ticksPerSecond": tempo.ticks_per_second,
        "msPerTick": world.resource::<PassLedger>().tick().median().as_secs_f64() * 1000.0,
        "threads": world.resource::<Workers>().threads(),
        "picture": world.resource::<PictureLevel>().now().name(),
        "sound": {
            "calls": world.resource::<SoundCost>().calls(),
            "stream": world.resource::<Ears>().controls().stream_level,
        },
        "challenge": challenge(world.resource()),
        "messages": world.resource::<Toasts>().texts().collect::<Vec<_>>(),
    })
}

/// How the challenge stands that is tried; `null` if none is.
fn challenge(judge: &Judge) -> Value {
    let Some(trial) = judge.trial() else { return Value::Null };
    let stars = if let Verdict::Won(stars) = trial.verdict { stars } else { Stars::default() };
    json!({
        "name": trial.challenge.name,
        "won": stars.done,
        "lost": matches!(trial.verdict, Verdict::Lost(_)),
        "stars": stars.count(),
        "seconds": trial.left() as f64 / f64::from(TICKS_PER_SECOND),
        "particles": trial.poured(),
        "strokes": trial.strokes,
    })
}

/// The widgets that have a name, as egui tells them to screen readers.
fn named(output: &EguiOutput, zoom: f32) -> Vec<Value> {
    let update = output.platform_output.accesskit_update.iter();
    update.flat_map(|update| &update.nodes).filter_map(|(_, node)| widget(node, f64::from(zoom))).collect()
}

fn widget(node: &Node, zoom: f64) -> Option<Value> {
    let name = if node.role() == Role::Label { node.value() } else { node.label() }?;
    let bounds = node.bounds()?;
    let place = [bounds.x0, bounds.y0, bounds.width(), bounds.height()];
    Some(json!({
        "name": name,
        "kind": format!("{:?}", node.role()),
        "place": place.map(|points| points * zoom),
        "enabled": !node.is_disabled(),
        "chosen": node.toggled().map(|toggled| toggled == Toggled::True),
    }))
}

/// Answers each line of stdin with one on stdout.
#[cfg(not(target_arch = "wasm32"))]
pub fn answer_stdin() {
    use std::io::Write;

    std::thread::spawn(|| {
        for line in std::io::stdin().lines().map_while(Result::ok) {
            // A script that has gone needs no answers.
            if writeln!(std::io::stdout(), "{}", answer(&line)).is_err() {
                return;
            }
        }
    });
}

/// What a script asks or tells in a line.
#[cfg(not(target_arch = "wasm32"))]
fn answer(line: &str) -> Value {
    match line.trim() {
        "stats" => stats(),
        "widgets" => widgets(),
        "pause" => json!(pause(true)),
        "go on" => json!(pause(false)),
        other => json!({ "error": format!("`{other}`: allowed are stats, widgets, pause, go on") }),
    }
}
