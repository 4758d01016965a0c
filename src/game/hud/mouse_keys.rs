//! The pointer that keys move: it goes along with egui's focus, and is drawn by the game, for that of the system stays where the mouse
//! left it.

use crate::game::input::{mouse_keys::Mouse, pointer::Pointer};
use bevy::prelude::{Local, Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{Color32, Id, LayerId, Order, Shape, Stroke, pos2, vec2},
};
use glam::Vec2;

/// Corners of the arrow from its tip, points; the two halves are convex.
const HALVES: [[(f32, f32); 3]; 2] = [[(0.0, 0.0), (0.0, 19.0), (5.0, 14.0)], [(0.0, 0.0), (5.0, 14.0), (13.5, 13.5)]];
const OUTLINE: [(f32, f32); 4] = [(0.0, 0.0), (0.0, 19.0), (5.0, 14.0), (13.5, 13.5)];

/// Takes the pointer to the control that has come into focus.
pub fn follow_focus(mut contexts: EguiContexts, mut mouse: Mouse, mut focused: Local<Option<Id>>) -> Result {
    let context = contexts.ctx_mut()?;
    let now = context.memory(|memory| memory.focused());
    if now != *focused
        && let Some(control) = now.and_then(|id| context.read_response(id))
        && !control.contains_pointer()
    {
        let middle = control.rect.center() * context.zoom_factor();
        mouse.move_to(Vec2::new(middle.x, middle.y));
    }
    *focused = now;
    Ok(())
}

/// Leaves the arrows to the picture again.
pub fn leave_focus(mut contexts: EguiContexts) -> Result {
    contexts.ctx_mut()?.memory_mut(|memory| memory.focused().inspect(|id| memory.surrender_focus(*id)));
    Ok(())
}

/// Shows it, above all else.
pub fn show(mut contexts: EguiContexts, pointer: Res<Pointer>) -> Result {
    let Some(at) = pointer.at else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    let zoom = context.zoom_factor();
    let tip = pos2(at.x / zoom, at.y / zoom);
    let corner = |(x, y): (f32, f32)| tip + vec2(x, y);
    let painter = context.layer_painter(LayerId::new(Order::Debug, Id::new("mouse keys")));
    for half in HALVES {
        painter.add(Shape::convex_polygon(half.map(corner).to_vec(), Color32::WHITE, Stroke::NONE));
    }
    painter.add(Shape::closed_line(OUTLINE.map(corner).to_vec(), Stroke::new(1.5, Color32::BLACK)));
    Ok(())
}
