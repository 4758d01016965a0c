//! The marks of springs and drains, while the brush sets them: a frame with an arrow out of it, or into it.

use crate::{
    game::{brush_mode::BrushMode, camera::WorldCamera, hud::style, panels::Panels, springs::areas, toolbox::Toolbox},
    sim::state::{Setup, Sources},
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, CornerRadius, Painter, Pos2, Rect, Stroke, StrokeKind, pos2, vec2},
};
use glam::Vec2;

/// Least width of a mark, and half the height of its arrow's head, points.
const LEAST: f32 = 10.0;
const HEAD: f32 = 4.0;

/// Shows them.
pub fn show(
    mut contexts: EguiContexts,
    (panels, tools, sources): (Res<Panels>, Res<Toolbox>, Res<Sources>),
    (camera, setup): (Res<WorldCamera>, Res<Setup>),
) -> Result {
    if !panels.visible || tools.mode() != BrushMode::Spring {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let (zoom, free) = (context.zoom_factor(), camera.free());
    let points = |pixel: Vec2| pos2(pixel.x / zoom, pixel.y / zoom);
    let sight = Rect::from_min_max(points(free.min), points(free.max));
    let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(sight);
    for (area, element) in areas(&sources) {
        let corners = [area.min, area.max].map(|corner| points(camera.to_pixel(corner)));
        let frame = Rect::from_two_pos(corners[0], corners[1]);
        let frame = Rect::from_center_size(frame.center(), frame.size().max(egui::Vec2::splat(LEAST)));
        let colour = element.map_or(style::TEXT, |id| {
            let [r, g, b] = setup.elements().get(id).colour;
            Color32::from_rgb(r, g, b).lerp_to_gamma(Color32::WHITE, 0.35)
        });
        mark(&painter, frame, element.is_some(), colour);
    }
    Ok(())
}

fn mark(painter: &Painter, frame: Rect, is_spring: bool, colour: Color32) {
    // Both can be seen on light and on dark.
    for pen in [Stroke::new(3.4, Color32::from_black_alpha(130)), Stroke::new(1.5, colour)] {
        painter.rect_stroke(frame, CornerRadius::same(2), pen, StrokeKind::Middle);
        let (tail, tip) = arrow(frame, is_spring);
        painter.line_segment([tail, tip], pen);
        let back = if tip.y > tail.y { -HEAD } else { HEAD };
        for side in [-HEAD, HEAD] {
            painter.line_segment([tip, tip + vec2(side, back)], pen);
        }
    }
}

/// Tail and tip: from the middle down out of a spring, from above into a drain.
fn arrow(frame: Rect, is_spring: bool) -> (Pos2, Pos2) {
    let middle = frame.center();
    if is_spring {
        (middle, pos2(middle.x, frame.bottom() + 2.5 * HEAD))
    } else {
        (pos2(middle.x, frame.top() - 2.5 * HEAD), middle)
    }
}
