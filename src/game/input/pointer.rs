//! The mouse: where it is, and what its buttons begin and end.

use crate::{
    game::{
        actions::{Action, Gesture},
        brush_mode::BrushMode,
        camera::{Area, WorldCamera},
        challenges::referee::Referee,
        gauges::grip::{self, Grip, Part},
        input::{
            bindings::{Bindings, Mods, Trigger},
            keys::HudKeys,
            rebind::KeyEditor,
            strokes::{Drag, DragState},
        },
        orders::{Order, Orders},
        panels::Panels,
        stamps::hand::Hand,
        toolbox::Toolbox,
    },
    kernel::brush::Stroke,
    lab::gauges::set::Gauges,
    sim::{intent::IntentQueue, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    input::mouse::{MouseScrollUnit, MouseWheel},
    prelude::{KeyCode, MouseButton, Res, ResMut, Resource},
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
    /// Name of the element whose tile the pointer is over, in the panel of all.
    pub element: Option<String>,
}

impl HudCover {
    /// Whether the HUD has what happens at `pixel`.
    pub fn covers(&self, pixel: Vec2) -> bool {
        self.menu || self.parts.iter().any(|part| part.contains(pixel))
    }
}

/// The pointer, what it drags, and what it acts on.
#[derive(SystemParam)]
pub struct PointerInput<'w> {
    orders: ResMut<'w, Orders>,
    pointer: ResMut<'w, Pointer>,
    drag: ResMut<'w, DragState>,
    camera: ResMut<'w, WorldCamera>,
    intents: ResMut<'w, IntentQueue>,
    tools: Res<'w, Toolbox>,
    cover: Res<'w, HudCover>,
    bindings: Res<'w, Bindings>,
    editor: ResMut<'w, KeyEditor>,
    hand: Res<'w, Hand>,
    gauges: Res<'w, Gauges>,
    setup: Option<Res<'w, Setup>>,
    panels: Res<'w, Panels>,
    referee: Referee<'w>,
}

impl PointerInput<'_> {
    /// A frame begins.
    pub fn begin_frame(&mut self) {
        if let Some(drag) = self.drag.current_mut() {
            drag.begin_frame();
        }
    }

    /// A frame of `seconds` ends.
    pub fn end_frame(&mut self, seconds: f32) {
        if let Some(drag) = self.drag.current_mut() {
            drag.end_frame(seconds);
        }
    }

    /// A key goes down, unless the HUD has it, or it is to be chosen for an action.
    pub fn key(&mut self, key: KeyCode, mods: Mods, hud: HudKeys) {
        if self.editor.asked().is_some() {
            return self.orders.extend(self.editor.hear(key, mods).map(Order::Keys));
        }
        let action = self.bindings.find(Trigger::Key(key), mods);
        if let Some(action) = action.filter(|action| hud.leave(key, *action)) {
            self.orders.push(Order::Act(action));
        }
    }

    /// The pointer moves.
    pub fn move_to(&mut self, pixel: Vec2) {
        self.pointer.at = Some(pixel);
        let Some(drag) = self.drag.current_mut() else { return };
        if drag.gesture == Gesture::Pan {
            self.camera.pan(pixel - drag.pixel);
        }
        drag.moved |= (pixel - drag.pressed_at).length() > CLICK;
        drag.pixel = pixel;
        drag.visit(self.camera.to_world(pixel), !self.cover.covers(pixel));
        if let (Gesture::Gauge(grip), true) = (drag.gesture, drag.moved) {
            self.orders.push(Order::MoveGauge(grip, drag.now - drag.start));
        }
    }

    /// The pointer leaves the window. A drag goes on: the system reports a drag beyond the window, too.
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
        self.drag.release();
        self.camera.end_drag();
    }

    /// A button goes down.
    pub fn press(&mut self, button: MouseButton, mods: Mods) {
        let Some(pixel) = self.pointer.at.filter(|pixel| !self.cover.covers(*pixel)) else { return };
        match (self.hand.gesture(), button) {
            (Some(gesture), MouseButton::Left) => return self.begin(gesture, button, pixel),
            (Some(_), MouseButton::Right) => return self.orders.push(Order::Act(Action::Close)),
            _ => {}
        }
        match (self.grip_at(pixel), button) {
            (Some(grip), MouseButton::Left) => return self.begin(Gesture::Gauge(grip), button, pixel),
            (Some(Grip { number, part: Part::Whole, .. }), MouseButton::Right) => {
                return self.orders.push(Order::RemoveGauge(number));
            }
            _ => {}
        }
        match self.bindings.find(Trigger::Button(button), mods) {
            Some(Action::Hold(gesture)) => self.begin(gesture, button, pixel),
            Some(action) => self.orders.push(Order::Act(action)),
            None => {}
        }
    }

    /// What is gripped of the gauges at a pixel.
    fn grip_at(&self, pixel: Vec2) -> Option<Grip> {
        let setup = self.setup.as_ref().filter(|_| self.panels.visible)?;
        grip::at(pixel, &self.gauges, &self.camera, setup.blueprint.scale)
    }

    fn begin(&mut self, gesture: Gesture, button: MouseButton, pixel: Vec2) {
        let (at, tool) = (self.camera.to_world(pixel), self.tools.tool);
        let is_brush = matches!(gesture, Gesture::Use | Gesture::Erase | Gesture::Line);
        if is_brush && self.tools.mode() == BrushMode::Spring {
            return self.orders.push(Order::SetSource(button, self.tools.stroke(at, at)));
        }
        // What is done with stamps sees to that itself.
        if !matches!(gesture, Gesture::Pan | Gesture::Take(_) | Gesture::Paste | Gesture::Gauge(_)) {
            self.orders.push(Order::Checkpoint);
        }
        if gesture != Gesture::Fill && self.drag.current().is_none() {
            self.camera.begin_drag(pixel);
        }
        let freehand = tool.is_freehand() && matches!(gesture, Gesture::Line | Gesture::Rectangle | Gesture::Fill);
        match (gesture, tool) {
            _ if freehand => self.drag.begin(Drag::new(Gesture::Use, tool, button, pixel, at)),
            (Gesture::Fill, _) => {
                let fill = tool.fill(self.tools.mode(), at);
                self.intents.extend(self.referee.admit(fill.into_iter().collect(), &mut None));
            }
            _ => self.drag.begin(Drag::new(gesture, tool, button, pixel, at)),
        }
    }

    /// A button goes up.
    pub fn release(&mut self, button: MouseButton) {
        let Some(drag) = self.drag.current().filter(|drag| drag.button == button) else { return };
        let tools = self.tools.with(drag.tool);
        let stroke = match drag.gesture {
            Gesture::Line => Some(tools.stroke(drag.start, drag.now)),
            Gesture::Rectangle if tools.mode() == BrushMode::Spring => {
                self.orders.push(Order::SetSource(button, Stroke::rectangle(drag.start, drag.now)));
                None
            }
            Gesture::Rectangle => Some(Stroke::rectangle(drag.start, drag.now)),
            _ => None,
        };
        if let Some(intent) = stroke.and_then(|stroke| tools.tool.shape(&tools.whole(stroke))) {
            self.intents.extend(self.referee.admit(vec![intent], &mut None));
        }
        match drag.gesture {
            Gesture::Pan if !drag.moved => self.orders.push(Order::Act(Action::Sample)),
            Gesture::Gauge(grip) if !drag.moved => self.orders.push(Order::SelectGauge(grip.number)),
            Gesture::Take(take) => self.orders.push(Order::TakePiece(drag.start, drag.now, take)),
            // Over the HUD it is not meant.
            Gesture::Paste if !self.cover.covers(drag.pixel) => self.orders.push(Order::Paste(drag.now)),
            _ => {}
        }
        self.drag.release();
        self.camera.end_drag();
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
        if let Some(action) = self.bindings.find(Trigger::Wheel(notches.signum() as i32), mods) {
            for _ in 0..notches.abs().min(20.0) as u32 {
                self.orders.push(Order::Act(action));
            }
        }
    }
}
