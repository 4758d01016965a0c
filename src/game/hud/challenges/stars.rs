//! Stars: golden if they are earned, an outline if not.

use crate::{game::hud::style, sim::judge::Stars};
use bevy::math::ops;
use bevy_egui::egui::{Color32, Mesh, Painter, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, vec2};
use std::f32::consts::PI;

/// What is earned.
pub const GOLD: Color32 = Color32::from_rgb(255, 205, 84);
/// The inner corners' distance from the middle, of the outer ones'.
const WAIST: f32 = 0.45;

/// Draws one star in the middle of a square.
pub fn star(painter: &Painter, rect: Rect, earned: bool) {
    let reach = 0.5 * rect.width().min(rect.height());
    let corner = |k: usize| -> Pos2 {
        let (turn, far) = (k as f32 * PI / 5.0, if k.is_multiple_of(2) { reach } else { WAIST * reach });
        let (sin, cos) = ops::sin_cos(turn);
        rect.center() + far * vec2(sin, -cos)
    };
    let corners: Vec<Pos2> = (0..10).map(corner).collect();
    if earned {
        // A fan around the middle: the outline is not convex.
        let mut mesh = Mesh::default();
        mesh.colored_vertex(rect.center(), GOLD);
        corners.iter().for_each(|corner| mesh.colored_vertex(*corner, GOLD));
        (0..10).for_each(|k| mesh.add_triangle(0, 1 + k, 1 + (k + 1) % 10));
        painter.add(mesh);
    }
    painter.add(Shape::closed_line(corners, Stroke::new(1.2, if earned { GOLD } else { style::WEAK })));
}

/// A row of the three, each of `side` points.
pub fn row(ui: &mut Ui, stars: Stars, side: f32) {
    let gap = 0.25 * side;
    let (rect, _) = ui.allocate_exact_size(vec2(3.0 * side + 2.0 * gap, side), Sense::hover());
    paint(ui.painter(), rect.left_top(), stars, side);
}

/// The three from an upper left corner on.
pub fn paint(painter: &Painter, corner: Pos2, stars: Stars, side: f32) {
    for (k, earned) in [stars.done, stars.particles, stars.strokes].into_iter().enumerate() {
        let corner = corner + vec2(k as f32 * 1.25 * side, 0.0);
        star(painter, Rect::from_min_size(corner, Vec2::splat(side)), earned);
    }
}
