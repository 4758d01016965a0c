//! The mouse: where it is, and what its buttons begin and end.

use crate::{
    game::{
        camera::{Area, WorldCamera},
        input::{
            bindings::{self, Action, Gesture, Mods, Trigger},
            strokes::{Held, Pull},
        },
        orders::{Order, Orders},
        tools::Toolbox,
    },
    kernel::brush::Stroke,
    sim::intent::{Intent, IntentQueue},
};
use bevy::{
    ecs::system::SystemParam,
    input::mouse::{MouseScrollUnit, MouseWheel},
    prelude::{MouseButton, Res, ResMut, Resource},
};
use glam::Vec2;

/// Pixels of a trackpad's scroll that count as one notch of a wheel.
const PIXELS_PER_NOTCH: f32 = 40.0;
/// A press that moved less than this many pixels was a click.
const CLICK: f32 = 4.0;
/// Factor of one step of zoom.
pub const ZOOM_STEP: f32 = 1.3;

/// Where the pointer is.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct Pointer {
    /// Logical pixels from the window's upper left corner, if it is in the window.
    pub at: Option<Vec2>,
    /// Share of a notch that the wheel has turned.
    turned: f32,
}

/// What the HUD covers: written by the HUD, empty without one.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct HudCover {
    /// Its parts, logical pixels.
    pub parts: Vec<Area>,
    /// Whether a menu is open: then the next click anywhere only closes it.
    pub menu: bool,
}

impl HudCover {
    /// Whether the HUD has what happens at `pixel`.
    pub fn covers(&self, pixel: Vec2) -> bool {
        self.menu || self.parts.iter().any(|part| part.contains(pixel))
    }
}

/// The player's hand: the pointer, what it holds, and what it acts on.
#[derive(SystemParam)]
pub struct Hand<'w> {
    /// Orders that it gives.
    pub orders: ResMut<'w, Orders>,
    pointer: ResMut<'w, Pointer>,
    held: ResMut<'w, Held>,
    camera: ResMut<'w, WorldCamera>,
    intents: ResMut<'w, IntentQueue>,
    tools: Res<'w, Toolbox>,
    cover: Res<'w, HudCover>,
}

impl Hand<'_> {
    /// A frame begins.
    pub fn begin_frame(&mut self) {
        if let Some(pull) = self.held.pull_mut() {
            pull.begin_frame();
        }
    }

    /// A frame of `seconds` ends.
    pub fn end_frame(&mut self, seconds: f32) {
        if let Some(pull) = self.held.pull_mut() {
            pull.end_frame(seconds);
        }
    }

    /// The pointer moves.
    pub fn move_to(&mut self, pixel: Vec2) {
        self.pointer.at = Some(pixel);
        let Some(pull) = self.held.pull_mut() else { return };
        if pull.gesture == Gesture::Drag {
            self.camera.pan(pixel - pull.pixel);
        }
        pull.moved |= (pixel - pull.pressed_at).length() > CLICK;
        pull.pixel = pixel;
        pull.visit(self.camera.to_world(pixel), !self.cover.covers(pixel));
    }

    /// The pointer leaves the window. What it holds goes on: the system reports a drag beyond the window, too.
    pub fn leave(&mut self) {
        self.pointer.at = None;
    }

    /// Whether the HUD has what happens at `pixel`.
    pub fn is_over_hud(&self, pixel: Vec2) -> bool {
        self.cover.covers(pixel)
    }

    /// The picture grows by `factor` around `pixel`, then moves by `pixels`: the other way round there would be no room to
    /// move in while all of the box is seen.
    pub fn move_picture(&mut self, pixel: Vec2, pixels: Vec2, factor: f32) {
        self.camera.zoom_at(pixel, factor);
        self.camera.pan(pixels);
    }

    /// The window loses the devices.
    pub fn let_go(&mut self) {
        self.held.release();
        self.camera.let_pane_go();
    }

    /// A button goes down.
    pub fn press(&mut self, button: MouseButton, mods: Mods) {
        let Some(pixel) = self.pointer.at.filter(|pixel| !self.cover.covers(*pixel)) else { return };
        match bindings::find(Trigger::Button(button), mods) {
            Some(Action::Hold(gesture)) => self.begin(gesture, button, pixel),
            Some(action) => self.orders.push(Order::Act(action)),
            None => {}
        }
    }

    fn begin(&mut self, gesture: Gesture, button: MouseButton, pixel: Vec2) {
        let (at, tool) = (self.camera.to_world(pixel), self.tools.tool);
        if gesture != Gesture::Drag {
            self.orders.push(Order::Checkpoint);
        }
        if gesture != Gesture::Fill && self.held.pull().is_none() {
            self.camera.hold_pane(pixel);
        }
        let freehand = tool.is_air() && matches!(gesture, Gesture::Line | Gesture::Rectangle | Gesture::Fill);
        match (gesture, self.tools.element()) {
            // The air tools know no shapes: they blow wherever they are dragged.
            _ if freehand => self.held.begin(Pull::new(Gesture::Use, tool, button, pixel, at)),
            (Gesture::Fill, Some(element)) => self.intents.push(Intent::Fill { element, at }),
            (Gesture::Fill, None) => {}
            _ => self.held.begin(Pull::new(gesture, tool, button, pixel, at)),
        }
    }

    /// A button goes up.
    pub fn release(&mut self, button: MouseButton) {
        let Some(pull) = self.held.pull().filter(|pull| pull.button == button) else { return };
        let tools = self.tools.with(pull.tool);
        let stroke = match pull.gesture {
            Gesture::Line => Some(tools.stroke(pull.start, pull.now)),
            Gesture::Rectangle => Some(Stroke::rectangle(pull.start, pull.now)),
            Gesture::Use | Gesture::Erase | Gesture::Fill | Gesture::Drag => None,
        };
        if let Some(stroke) = stroke {
            self.intents.push(match tools.element() {
                Some(element) => Intent::Stamp { element, stroke },
                None => Intent::Erase { stroke },
            });
        }
        if pull.gesture == Gesture::Drag && !pull.moved {
            self.orders.push(Order::Act(Action::Sample));
        }
        self.held.release();
        self.camera.let_pane_go();
    }

    /// The wheel turns: brush size, or zoom with Ctrl.
    pub fn scroll(&mut self, wheel: &MouseWheel, mods: Mods) {
        if self.pointer.at.is_none_or(|pixel| self.cover.covers(pixel)) {
            return;
        }
        self.pointer.turned += match wheel.unit {
            MouseScrollUnit::Line => wheel.y,
            MouseScrollUnit::Pixel => wheel.y / PIXELS_PER_NOTCH,
        };
        let notches = self.pointer.turned.trunc();
        self.pointer.turned -= notches;
        if let Some(action) = bindings::find(Trigger::Wheel(notches.signum() as i32), mods) {
            for _ in 0..notches.abs().min(20.0) as u32 {
                self.orders.push(Order::Act(action));
            }
        }
    }
}
