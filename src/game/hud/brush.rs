//! What the brush would touch, drawn at the pointer.

use crate::{
    game::{
        camera::WorldCamera,
        hud::{HudState, palette::colour_of, style},
        input::{
            bindings::Gesture,
            pointer::{HudCover, Pointer},
            strokes::Held,
        },
        tools::{Tool, Toolbox},
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
    state: Res<HudState>,
    pointer: Res<Pointer>,
    cover: Res<HudCover>,
    held: Res<Held>,
    tools: Res<Toolbox>,
    setup: Res<Setup>,
    camera: Res<WorldCamera>,
) -> Result {
    let (Some(pixel), true) = (pointer.at, state.visible) else { return Ok(()) };
    let straight = held.pull().filter(|pull| matches!(pull.gesture, Gesture::Line | Gesture::Rectangle));
    if cover.covers(pixel) && straight.is_none() {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let painter = context.layer_painter(egui::LayerId::background());
    let to_points = 1.0 / context.zoom_factor();
    let at = |pixel: glam::Vec2| pos2(pixel.x * to_points, pixel.y * to_points);
    let radius = tools.radius() * camera.pixels_per_d() * to_points;
    let colour = match tools.tool {
        Tool::Element(id) => colour_of(setup.elements().get(id)).lerp_to_gamma(Color32::WHITE, 0.35),
        Tool::Erase => style::WARN,
        Tool::Wind | Tool::Pressure => Color32::from_rgb(150, 230, 216),
    };
    let pen = Pen { painter, stroke: Stroke::new(1.25, colour) };
    match straight {
        Some(pull) if pull.gesture == Gesture::Line => {
            let start = at(camera.to_pixel_beside(pull.start, pixel));
            pen.line(start, at(pixel));
            pen.brush(tools.shape, start, radius);
            pen.brush(tools.shape, at(pixel), radius);
        }
        Some(pull) => pen.rectangle(Rect::from_two_pos(at(camera.to_pixel_beside(pull.start, pixel)), at(pixel))),
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
