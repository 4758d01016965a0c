//! The drag of the pointer, and the intents that it makes: those of one tick at a time, however many frames a tick takes, so
//! that pouring has a rate of its own on every screen.

use crate::{
    game::{actions::Gesture, challenges::referee::Referee, toolbox::Toolbox, tools::Tool},
    lab::colours::Reference,
    sim::{generation::Generation, intent::IntentQueue, state::Setup},
};
use bevy::prelude::{MouseButton, Res, ResMut, Resource};
use glam::Vec2;

/// Time over which the speed of a drag is smoothed, s.
const DRAG_MEMORY: f32 = 0.09;
/// Points of the way that are kept for a tick.
const WAY_LIMIT: usize = 64;

/// A pressed button and the way of the pointer since.
#[derive(Clone, Debug)]
pub struct Drag {
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
    /// The world in which it was counted as a stroke of a challenge, if it was.
    counted: Option<Generation>,
}

impl Drag {
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
            counted: None,
        }
    }

    /// The same drag where there are `factor` new d in one old.
    fn rescale(&mut self, factor: f32) {
        let Self { start, now, at_frame_start, velocity, way, .. } = self;
        [start, now, at_frame_start, velocity].into_iter().chain(way).for_each(|place| *place *= factor);
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

/// The drag that goes on, if any. It outlives its release until a tick has seen it, so that no click is lost.
#[derive(Resource, Clone, Debug, Default)]
pub struct DragState(Option<Drag>);

impl DragState {
    /// A button goes down. A second button waits until the first is up.
    pub fn begin(&mut self, drag: Drag) {
        if self.0.as_ref().is_none_or(|drag| drag.released) {
            self.0 = Some(drag);
        }
    }

    /// The drag goes on where there are `factor` new d in one old.
    pub fn rescale(&mut self, factor: f32) {
        if let Some(drag) = &mut self.0 {
            drag.rescale(factor);
        }
    }

    /// The drag that goes on now.
    pub fn current(&self) -> Option<&Drag> {
        self.0.as_ref().filter(|drag| !drag.released)
    }

    /// The drag that goes on now, to move it.
    pub fn current_mut(&mut self) -> Option<&mut Drag> {
        self.0.as_mut().filter(|drag| !drag.released)
    }

    /// The button goes up.
    pub fn release(&mut self) {
        if let Some(drag) = &mut self.0 {
            drag.released = true;
        }
    }
}

/// Turns the drag into the intents of one tick.
pub fn make_intents(
    mut state: ResMut<DragState>,
    tools: Res<Toolbox>,
    setup: Option<Res<Setup>>,
    mut intents: ResMut<IntentQueue>,
    mut referee: Referee,
) {
    let (Some(drag), Some(setup)) = (&mut state.0, setup) else { return };
    let tools = tools.with(drag.tool);
    let reference = Reference::of(&setup.blueprint.domain, &setup.blueprint.air);
    if tools.tool.is_freehand() {
        thicken(&mut drag.way, 0.5 * tools.reach());
    }
    let strokes = match drag.way.as_slice() {
        [] => 0,
        way => way.len().max(2) - 1,
    };
    let mut wanted = Vec::new();
    for k in 0..strokes {
        let (from, to) = (drag.way[k], drag.way[(k + 1).min(drag.way.len() - 1)]);
        let dab = tools.dab(tools.stroke(from, to), drag.velocity, reference, 1.0 / strokes as f32);
        let intent = match drag.gesture {
            Gesture::Use => drag.tool.left(&dab),
            Gesture::Erase => drag.tool.right(&dab),
            Gesture::Line
            | Gesture::Rectangle
            | Gesture::Fill
            | Gesture::Pan
            | Gesture::Take(_)
            | Gesture::Paste
            | Gesture::Gauge(_) => None,
        };
        wanted.extend(intent);
    }
    intents.extend(referee.admit(wanted, &mut drag.counted));
    drag.way.clear();
    if drag.over_world {
        let now = drag.now;
        drag.way.push(now);
    }
    if drag.released {
        state.0 = None;
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
