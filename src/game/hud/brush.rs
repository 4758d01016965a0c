//! What the brush would touch, drawn at the pointer.

use crate::{
    game::{
        actions::Gesture,
        camera::WorldCamera,
        input::{
            pointer::{HudCover, Pointer},
            strokes::DragState,
        },
        panels::Panels,
        tools::Toolbox,
    },
    kernel::brush::BrushShape,
    sim::state::Setup,
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, Pos2, Rect, Stroke, StrokeKind, Vec2, pos2},
};

/// Shows the brush.
pub fn show(
    mut contexts: EguiContexts,
    panels: Res<Panels>,
    pointer: Res<Pointer>,
    cover: Res<HudCover>,
    drag: Res<DragState>,
    tools: Res<Toolbox>,
    setup: Res<Setup>,
    camera: Res<WorldCamera>,
) -> Result {
    let (Some(pixel), true) = (pointer.at, panels.visible) else { return Ok(()) };
    let straight = drag.current().filter(|drag| matches!(drag.gesture, Gesture::Line | Gesture::Rectangle));
    if cover.covers(pixel) && straight.is_none() {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let painter = context.layer_painter(egui::LayerId::background());
    let to_points = 1.0 / context.zoom_factor();
    let at = |pixel: glam::Vec2| pos2(pixel.x * to_points, pixel.y * to_points);
    let radius = tools.radius() * camera.pixels_per_d() * to_points;
    let colour = tools.tool.pen(setup.elements());
    let pen = Pen { painter, stroke: Stroke::new(1.25, colour) };
    match straight {
        Some(drag) if drag.gesture == Gesture::Line => {
            let start = at(camera.to_pixel_beside(drag.start, pixel));
            pen.line(start, at(pixel));
            pen.brush(tools.shape, start, radius);
            pen.brush(tools.shape, at(pixel), radius);
        }
        Some(drag) => pen.rectangle(Rect::from_two_pos(at(camera.to_pixel_beside(drag.start, pixel)), at(pixel))),
        None => pen.brush(tools.shape, at(pixel), radius),
    }
    Ok(())
}

/// Draws outlines that can be seen on light and on dark.
struct Pen {
    painter: egui::Painter,
    stroke: Stroke,
}

impl Pen {
    fn shadow(&self) -> Stroke {
        Stroke::new(self.stroke.width + 1.6, Color32::from_black_alpha(120))
    }

    fn brush(&self, shape: BrushShape, centre: Pos2, radius: f32) {
        match shape {
            BrushShape::Disc => {
                self.painter.circle_stroke(centre, radius, self.shadow());
                self.painter.circle_stroke(centre, radius, self.stroke);
            }
            BrushShape::Square | BrushShape::Rectangle => {
                self.rectangle(Rect::from_center_size(centre, Vec2::splat(2.0 * radius)));
            }
        }
    }

    fn rectangle(&self, rect: Rect) {
        self.painter.rect_stroke(rect, 0.0, self.shadow(), StrokeKind::Middle);
        self.painter.rect_stroke(rect, 0.0, self.stroke, StrokeKind::Middle);
    }

    fn line(&self, from: Pos2, to: Pos2) {
        self.painter.line_segment([from, to], self.shadow());
        self.painter.line_segment([from, to], self.stroke);
    }
}
