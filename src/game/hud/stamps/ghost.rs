//! What is in hand, drawn at the pointer: the frame around what is taken, or the ghost of the stamp where it would come to lie.

use crate::{
    game::{
        actions::Gesture,
        camera::WorldCamera,
        hud::stamps::picture::{Pictures, mesh},
        input::{
            pointer::{HudCover, Pointer},
            strokes::DragState,
            touch::Fingers,
        },
        panels::Panels,
        stamps::{act::cells_between, hand::Hand},
    },
    kernel::piece::lowest_cell,
    sim::{stamp::size_in, state::Setup},
};
use bevy::prelude::{Local, Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, pos2, vec2},
};
use glam::Vec2;

/// The ghost is as bright as this, of 255.
const GHOST: u8 = 190;
/// Half the width of the cross of an empty frame, points.
const CROSS: f32 = 9.0;

/// Shows it. `last` is where it was shown last: fingers do not hover.
pub fn show(
    mut contexts: EguiContexts,
    (panels, hand, setup): (Res<Panels>, Res<Hand>, Res<Setup>),
    (pointer, cover, drag, fingers): (Res<Pointer>, Res<HudCover>, Res<DragState>, Res<Fingers>),
    camera: Res<WorldCamera>,
    mut pictures: ResMut<Pictures>,
    mut last: Local<Option<Vec2>>,
) -> Result {
    if hand.is_empty() || !panels.visible {
        *last = None;
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let to_points = 1.0 / context.zoom_factor();
    let painter = context.layer_painter(egui::LayerId::background());
    let over_world = pointer.at.filter(|pixel| !cover.covers(*pixel));
    let pixel = over_world.or_else(|| fingers.in_use.then_some(camera.to_pixel(last.unwrap_or(camera.world() / 2.0))));
    let dragged = drag.current().filter(|drag| matches!(drag.gesture, Gesture::Take(_)));
    let Some(pixel) = pixel.or(dragged.map(|drag| drag.pixel)) else { return Ok(()) };
    let at = |place: Vec2| {
        let pixel = camera.to_pixel_beside(place, pixel) * to_points;
        pos2(pixel.x, pixel.y)
    };
    let middle = camera.to_world(pixel);
    match &*hand {
        Hand::Empty => {}
        Hand::Frame(_) => {
            if let Some(drag) = dragged {
                let (low, high) = cells_between(drag.start, drag.now, camera.world().ceil().as_ivec2());
                frame(&painter, at(low.as_vec2()), at(high.as_vec2()));
            } else if over_world.is_some() {
                cross(&painter, at(middle));
            }
        }
        Hand::Stamp(kept, turn) => {
            *last = Some(middle);
            let piece = &kept.stamp.piece;
            let size = size_in(piece, &setup.blueprint);
            let low = lowest_cell(middle, turn.size(size)).as_vec2();
            let corner = |corner: Vec2| at(low + turn.place(corner * size.as_vec2(), size));
            let picture = pictures.of(context, kept, setup.elements());
            painter.add(mesh(picture, Color32::from_white_alpha(GHOST), corner));
            frame(&painter, at(low), at(low + turn.size(size).as_vec2()));
        }
    }
    Ok(())
}

/// Lines that can be seen on light and on dark.
fn pens() -> [Stroke; 2] {
    [Stroke::new(2.6, Color32::from_black_alpha(120)), Stroke::new(1.25, Color32::from_white_alpha(220))]
}

fn frame(painter: &Painter, a: Pos2, b: Pos2) {
    for pen in pens() {
        painter.rect_stroke(Rect::from_two_pos(a, b), 0.0, pen, StrokeKind::Middle);
    }
}

fn cross(painter: &Painter, at: Pos2) {
    for pen in pens() {
        for arm in [vec2(CROSS, 0.0), vec2(0.0, CROSS)] {
            painter.add(Shape::line_segment([at - arm, at + arm], pen));
        }
    }
}
