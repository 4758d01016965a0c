//! What the pointer holds, and the intents that it makes: one lot for each tick, however many frames a tick takes, so
//! that pouring has a rate of its own on every screen.

use crate::{
    game::{
        input::bindings::Gesture,
        tools::{Tool, Toolbox},
    },
    kernel::brush::Stroke,
    lab::colours::Reference,
    sim::{
        intent::{Intent, IntentQueue},
        state::Setup,
    },
};
use bevy::prelude::{MouseButton, Res, ResMut, Resource};
use glam::Vec2;

/// Time over which the speed of a drag is smoothed, s.
const DRAG_MEMORY: f32 = 0.09;
/// Speed of the wind for each unit of drag speed.
const WIND_GAIN: f32 = 2.5;
/// Most wind that a drag makes, in units of [`Reference::wind`]: the speed of sound. Water takes off at some two units.
pub(in crate::game) const WIND_LIMIT: f32 = 5.0;
/// A drag slower than this makes no wind, in units of [`Reference::wind`].
const WIND_FLOOR: f32 = 0.02;
/// Pressure that one tick of the pressure tool adds; the surroundings' is 1.
const PRESS_STEP: f32 = 0.4;
/// Points of the way that are kept for a tick.
const WAY_LIMIT: usize = 64;

/// A held button.
#[derive(Clone, Debug)]
pub struct Pull {
    /// What it does.
    pub gesture: Gesture,
    /// With which tool: another choice before the release is for the next stroke.
    pub tool: Tool,
    /// Which button.
    pub button: MouseButton,
    /// Where it was pressed, pixels.
    pub pressed_at: Vec2,
    /// Where the pointer was in the last frame, pixels.
    pub pixel: Vec2,
    /// Whether it moved enough to be a drag.
    pub moved: bool,
    /// Where it was pressed, d.
    pub start: Vec2,
    /// Where the pointer is now, d.
    pub now: Vec2,
    at_frame_start: Vec2,
    /// Smoothed velocity of the drag, d/s.
    velocity: Vec2,
    /// The way since the last tick, d; empty while the pointer is over the HUD.
    way: Vec<Vec2>,
    over_world: bool,
    released: bool,
}

impl Pull {
    /// A button pressed at a place.
    pub fn new(gesture: Gesture, tool: Tool, button: MouseButton, pixel: Vec2, at: Vec2) -> Self {
        Self {
            gesture,
            tool,
            button,
            pressed_at: pixel,
            pixel,
            moved: false,
            start: at,
            now: at,
            at_frame_start: at,
            velocity: Vec2::ZERO,
            way: vec![at],
            over_world: true,
            released: false,
        }
    }

    /// A frame begins.
    pub fn begin_frame(&mut self) {
        self.at_frame_start = self.now;
    }

    /// The pointer comes by `at`; `over_world` is false while the HUD covers the place.
    pub fn visit(&mut self, at: Vec2, over_world: bool) {
        self.now = at;
        self.over_world = over_world;
        if !over_world {
            self.way.clear();
        } else if self.way.last() != Some(&at) {
            if self.way.len() >= WAY_LIMIT {
                self.way.pop();
            }
            self.way.push(at);
        }
    }

    /// A frame of `seconds` ends: this is how fast the drag was.
    pub fn end_frame(&mut self, seconds: f32) {
        if seconds > 0.0 {
            let share = seconds / (seconds + DRAG_MEMORY);
            self.velocity += ((self.now - self.at_frame_start) / seconds - self.velocity) * share;
        }
    }
}

/// The button that is held, if any. It outlives its release until a tick has seen it, so that no click is lost.
#[derive(Resource, Clone, Debug, Default)]
pub struct Held(Option<Pull>);

impl Held {
    /// A button goes down. A second button waits until the first is up.
    pub fn begin(&mut self, pull: Pull) {
        if self.0.as_ref().is_none_or(|pull| pull.released) {
            self.0 = Some(pull);
        }
    }

    /// What is held now.
    pub fn pull(&self) -> Option<&Pull> {
        self.0.as_ref().filter(|pull| !pull.released)
    }

    /// What is held now, to move it.
    pub fn pull_mut(&mut self) -> Option<&mut Pull> {
        self.0.as_mut().filter(|pull| !pull.released)
    }

    /// The button goes up.
    pub fn release(&mut self) {
        if let Some(pull) = &mut self.0 {
            pull.released = true;
        }
    }
}

/// Turns what is held into the intents of one tick.
pub fn make_intents(
    mut held: ResMut<Held>,
    tools: Res<Toolbox>,
    setup: Option<Res<Setup>>,
    mut intents: ResMut<IntentQueue>,
) {
    let (Some(pull), Some(setup)) = (&mut held.0, setup) else { return };
    let tools = tools.with(pull.tool);
    let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
    if tools.tool.is_air() {
        thicken(&mut pull.way, 0.5 * tools.radius());
    }
    let strokes = match pull.way.as_slice() {
        [] => 0,
        way => way.len().max(2) - 1,
    };
    for k in 0..strokes {
        let (from, to) = (pull.way[k], pull.way[(k + 1).min(pull.way.len() - 1)]);
        if let Some(intent) = intent_of(pull, tools.stroke(from, to), &tools, reference, strokes) {
            intents.push(intent);
        }
    }
    pull.way.clear();
    if pull.over_world {
        let now = pull.now;
        pull.way.push(now);
    }
    if pull.released {
        held.0 = None;
    }
}

/// Puts points between points further apart than `gap` d: the air takes a stroke as a row of dabs.
fn thicken(way: &mut Vec<Vec2>, gap: f32) {
    let Some((&first, rest)) = way.split_first() else { return };
    let mut thick = vec![first];
    let mut last = first;
    for &next in rest {
        let parts = ((next - last).length() / gap).ceil().clamp(1.0, WAY_LIMIT as f32);
        thick.extend((1..=parts as u32).map(|part| last.lerp(next, part as f32 / parts)));
        last = next;
    }
    *way = thick;
}

/// What the tool wants along one of the `strokes` strokes of a tick.
fn intent_of(pull: &Pull, stroke: Stroke, tools: &Toolbox, reference: Reference, strokes: usize) -> Option<Intent> {
    let amount = PRESS_STEP / strokes as f32;
    match (pull.gesture, tools.tool) {
        (Gesture::Use, Tool::Element(element)) => Some(Intent::Draw { element, stroke }),
        (Gesture::Use, Tool::Erase) => Some(Intent::Erase { stroke }),
        (Gesture::Use, Tool::Wind) => {
            let velocity = (pull.velocity * WIND_GAIN).clamp_length_max(WIND_LIMIT * reference.wind);
            (velocity.length() > WIND_FLOOR * reference.wind).then_some(Intent::Blow { stroke, velocity })
        }
        (Gesture::Use, Tool::Pressure) => Some(Intent::Press { stroke, amount }),
        (Gesture::Erase, Tool::Pressure) => Some(Intent::Press { stroke, amount: -amount }),
        (Gesture::Erase, _) => Some(Intent::Erase { stroke }),
        (Gesture::Line | Gesture::Rectangle | Gesture::Fill | Gesture::Drag, _) => None,
    }
}
