//! What theory says of an exhibit, drawn over the world.

use crate::{
    game::{camera::WorldCamera, museum::Museum, panels::Panels},
    kernel::units::TICK_SECONDS,
    lab::exam::exhibits::Mark,
    sim::{
        generation::Generation,
        state::{Clock, Setup},
    },
};
use bevy::prelude::{Res, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Color32, Painter, Pos2, Shape, Stroke, pos2},
};
use glam::{DVec2, Vec2};

/// Colour of theory: no matter has it.
pub const THEORY: Color32 = Color32::from_rgb(255, 132, 216);
/// Below the line, so that it is seen on light and on dark.
const SHADE: Stroke = Stroke { width: 4.0, color: Color32::from_black_alpha(120) };
const PEN: Stroke = Stroke { width: 2.0, color: THEORY };
/// Length of a dash, and of the gap behind it, points.
const DASH: [f32; 2] = [9.0, 5.0];

/// Shows it.
pub fn show(
    mut contexts: EguiContexts,
    (panels, museum): (Res<Panels>, Res<Museum>),
    (camera, setup, clock, generation): (Res<WorldCamera>, Res<Setup>, Res<Clock>, Res<Generation>),
) -> Result {
    let Some(exhibit) = museum.shown(*generation).filter(|_| panels.visible) else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    let (zoom, scale, free) = (context.zoom_factor(), setup.blueprint.scale, camera.free());
    let points = |pixel: Vec2| pos2(pixel.x / zoom, pixel.y / zoom);
    let area = egui::Rect::from_min_max(points(free.min), points(free.max));
    let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(area);
    let place = |at: &DVec2| points(camera.to_pixel(scale.vec_to_kernel(at.as_vec2())));
    for mark in exhibit.theory(clock.tick as f64 * f64::from(TICK_SECONDS)) {
        match mark {
            Mark::Line(line) => draw(&painter, line.iter().map(place).collect()),
            Mark::Circle(middle, radius) => {
                let radius = scale.to_kernel(radius as f32) * camera.pixels_per_d() / zoom;
                for pen in [SHADE, PEN] {
                    painter.circle_stroke(place(&middle), radius, pen);
                }
            }
        }
    }
    Ok(())
}

fn draw(painter: &Painter, line: Vec<Pos2>) {
    painter.add(Shape::line(line.clone(), SHADE));
    painter.extend(Shape::dashed_line(&line, PEN, DASH[0], DASH[1]));
}
