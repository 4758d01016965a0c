//! The mouse: where it is, and what its buttons begin and end.

use crate::{
    game::{
        camera::WorldCamera,
        input::{
            bindings::{self, Action, Gesture, Mods, Trigger},
            strokes::{Held, Pull},
        },
        orders::{Order, Orders},
        tools::Toolbox,
    },
    sim::intent::{Intent, IntentQueue},
};
use bevy::{
    input::mouse::{AccumulatedMouseScroll, MouseScrollUnit},
    prelude::{ButtonInput, KeyCode, MouseButton, Query, Real, Res, ResMut, Resource, Time, With},
    window::{PrimaryWindow, Window},
};
use bevy_egui::input::EguiWantsInput;
use glam::Vec2;

/// Buttons that can hold something.
const BUTTONS: [MouseButton; 3] = [MouseButton::Left, MouseButton::Right, MouseButton::Middle];
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
    /// Whether the HUD has it.
    pub over_hud: bool,
}

/// Finds the pointer in the window, and whether the HUD has it there.
pub fn locate(windows: Query<&Window, With<PrimaryWindow>>, hud: Res<EguiWantsInput>, mut pointer: ResMut<Pointer>) {
    let at = windows.single().ok().and_then(Window::cursor_position);
    let over_hud = hud.is_pointer_over_area() || hud.is_using_pointer() || hud.is_popup_open();
    *pointer = Pointer { at, over_hud };
}

/// Reads buttons into [`Held`] and commands.
pub fn read_buttons(
    buttons: Res<ButtonInput<MouseButton>>,
    keys: Res<ButtonInput<KeyCode>>,
    pointer: Res<Pointer>,
    time: Res<Time<Real>>,
    tools: Res<Toolbox>,
    mut camera: ResMut<WorldCamera>,
    mut held: ResMut<Held>,
    mut orders: ResMut<Orders>,
    mut intents: ResMut<IntentQueue>,
) {
    let Some(pixel) = pointer.at else {
        // The pointer left the window: what was begun ends where it was last seen.
        if !BUTTONS.iter().any(|&button| buttons.pressed(button)) {
            held.release();
        }
        return;
    };
    let at = camera.to_world(pixel);
    for button in BUTTONS {
        if buttons.just_pressed(button) && !pointer.over_hud {
            match bindings::find(Trigger::Button(button), Mods::held(&keys)) {
                Some(Action::Hold(gesture)) => {
                    begin(gesture, button, pixel, at, &tools, &mut held, &mut orders, &mut intents);
                }
                Some(action) => orders.push(Order::Act(action)),
                None => {}
            }
        }
    }
    let Some(pull) = held.pull_mut() else { return };
    if pull.gesture == Gesture::Drag {
        camera.pan(pixel - pull.pixel);
    }
    pull.moved |= (pixel - pull.pressed_at).length() > CLICK;
    pull.pixel = pixel;
    let straight = matches!(pull.gesture, Gesture::Line | Gesture::Rectangle);
    pull.follow(at, time.delta_secs(), !pointer.over_hud || straight);
    if !buttons.pressed(pull.button) {
        finish(pull, at, &tools, &mut orders, &mut intents);
        held.release();
    }
}

fn begin(
    gesture: Gesture,
    button: MouseButton,
    pixel: Vec2,
    at: Vec2,
    tools: &Toolbox,
    held: &mut Held,
    orders: &mut Orders,
    intents: &mut IntentQueue,
) {
    if gesture != Gesture::Drag {
        orders.push(Order::Checkpoint);
    }
    if gesture == Gesture::Fill {
        if let Some(element) = tools.element() {
            intents.push(Intent::Fill { element, at });
        }
        return;
    }
    // The air tools have neither lines nor rectangles: with any modifier they work freehand.
    let gesture = if tools.tool.is_air() && gesture != Gesture::Drag && gesture != Gesture::Erase {
        Gesture::Use
    } else {
        gesture
    };
    held.begin(Pull::new(gesture, button, pixel, at));
}

/// Does what waited for the release.
fn finish(pull: &Pull, at: Vec2, tools: &Toolbox, orders: &mut Orders, intents: &mut IntentQueue) {
    let stroke = match pull.gesture {
        Gesture::Line => tools.stroke(pull.start, at),
        Gesture::Rectangle => crate::kernel::brush::Stroke::rectangle(pull.start, at),
        Gesture::Drag => {
            if !pull.moved {
                orders.push(Order::Act(Action::Sample));
            }
            return;
        }
        Gesture::Use | Gesture::Erase | Gesture::Fill => return,
    };
    intents.push(match tools.element() {
        Some(element) => Intent::Stamp { element, stroke },
        None => Intent::Erase { stroke },
    });
}

/// Reads the wheel: brush size, or zoom with Ctrl.
pub fn read_wheel(
    scroll: Res<AccumulatedMouseScroll>,
    keys: Res<ButtonInput<KeyCode>>,
    pointer: Res<Pointer>,
    mut turned: bevy::prelude::Local<f32>,
    mut orders: ResMut<Orders>,
) {
    if pointer.over_hud || scroll.delta.y == 0.0 {
        return;
    }
    *turned += match scroll.unit {
        MouseScrollUnit::Line => scroll.delta.y,
        MouseScrollUnit::Pixel => scroll.delta.y / PIXELS_PER_NOTCH,
    };
    let notches = turned.trunc();
    *turned -= notches;
    let mods = Mods::held(&keys);
    for _ in 0..notches.abs() as u32 {
        if let Some(action) = bindings::find(Trigger::Wheel(notches.signum() as i32), mods) {
            orders.push(Order::Act(action));
        }
    }
}
