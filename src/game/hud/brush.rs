//! What the brush would touch, drawn at the pointer.

use crate::{
    game::{
        actions::Gesture,
        brush_mode::BrushMode,
        camera::WorldCamera,
        hud::gauges::Marks,
        icons,
        input::{
            pointer::{HudCover, Pointer},
            strokes::DragState,
        },
        panels::Panels,
        stamps::hand::Hand,
        toolbox::Toolbox,
    },
    kernel::brush::BrushShape,
    sim::state::Setup,
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2, pos2},
};

/// Half the width of the mark beside the ring, points.
const MARK: f32 = 9.0;

/// How much of its colour fills the ring: while it waits, and while a button is held.
const FILL: [f32; 2] = [0.1, 0.3];

/// Shows the brush.
pub fn show(
    mut contexts: EguiContexts,
    (panels, hand): (Res<Panels>, Res<Hand>),
    (pointer, cover): (Res<Pointer>, Res<HudCover>),
    marks: Marks,
    drag: Res<DragState>,
    tools: Res<Toolbox>,
    setup: Res<Setup>,
    camera: Res<WorldCamera>,
) -> Result {
    let (Some(pixel), true) = (pointer.at, panels.visible && hand.is_empty()) else { return Ok(()) };
    let straight = drag.current().filter(|drag| matches!(drag.gesture, Gesture::Line | Gesture::Rectangle));
    // Where a gauge is gripped the brush does nothing.
    if cover.covers(pixel) && straight.is_none() || marks.grip().is_some() {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let to_points = 1.0 / context.zoom_factor();
    let at = |pixel: glam::Vec2| pos2(pixel.x * to_points, pixel.y * to_points);
    let radius = tools.reach() * camera.pixels_per_d() * to_points;
    let rectangle = |rect: Rect, pen: Stroke| Shape::rect_stroke(rect, 0.0, pen, StrokeKind::Middle);
    let brush = |centre: Pos2, pen: Stroke| match tools.shape {
        BrushShape::Disc => Shape::circle_stroke(centre, radius, pen),
        BrushShape::Square | BrushShape::Rectangle => {
            rectangle(Rect::from_center_size(centre, Vec2::splat(2.0 * radius)), pen)
        }
    };
    let shapes = |pen: Stroke| {
        let Some(drag) = straight else { return vec![brush(at(pixel), pen)] };
        let (start, end) = (at(camera.to_pixel_beside(drag.start, pixel)), at(pixel));
        match drag.gesture {
            Gesture::Line => vec![Shape::line_segment([start, end], pen), brush(start, pen), brush(end, pen)],
            _ => vec![rectangle(Rect::from_two_pos(start, end), pen)],
        }
    };
    // An outline that can be seen on light and on dark.
    let pen = Stroke::new(1.25, tools.tool.pen(setup.elements()));
    let shadow = Stroke::new(pen.width + 1.6, Color32::from_black_alpha(120));
    let painter = context.layer_painter(egui::LayerId::background());
    if straight.is_none() {
        let fill = pen.color.gamma_multiply(FILL[usize::from(drag.current().is_some())]);
        painter.add(match tools.shape {
            BrushShape::Disc => Shape::circle_filled(at(pixel), radius, fill),
            BrushShape::Square | BrushShape::Rectangle => {
                Shape::rect_filled(Rect::from_center_size(at(pixel), Vec2::splat(2.0 * radius)), 0.0, fill)
            }
        });
    }
    [shadow, pen].into_iter().for_each(|pen| painter.extend(shapes(pen)));
    if tools.mode() != BrushMode::Draw {
        mark(&painter, at(pixel), radius, tools.mode(), pen.color);
    }
    Ok(())
}

/// Marks at the ring what the brush does to what is there.
fn mark(painter: &egui::Painter, centre: Pos2, radius: f32, mode: BrushMode, colour: Color32) {
    let aside = radius * std::f32::consts::FRAC_1_SQRT_2 + MARK;
    let at = centre + Vec2::new(aside, aside);
    painter.circle_filled(at, MARK, Color32::from_black_alpha(160));
    icons::draw(painter, icons::square(at, 1.3 * MARK), mode.icon(), colour);
}
