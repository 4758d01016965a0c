//! The marks of gauges in the world, with number and colour, and the line that is being set.

use crate::{
    game::{
        actions::Gesture,
        camera::WorldCamera,
        gauges::{
            desk::{GaugeDesk, MARK, mark},
            grip::{self, Grip, Part},
        },
        input::{
            pointer::{HudCover, Pointer},
            strokes::DragState,
        },
        panels::Panels,
        stamps::hand::Hand,
    },
    kernel::units::Scale,
    lab::gauges::{
        place::Place,
        set::{Gauge, Gauges},
    },
    sim::{generation::Generation, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, CursorIcon, FontId, Painter, Pos2, Stroke, pos2, vec2},
};
use glam::Vec2;

/// Colours of the gauges by their numbers.
const COLOURS: [Color32; 8] = [
    Color32::from_rgb(96, 178, 255),
    Color32::from_rgb(255, 196, 84),
    Color32::from_rgb(122, 222, 140),
    Color32::from_rgb(255, 122, 122),
    Color32::from_rgb(202, 150, 255),
    Color32::from_rgb(96, 226, 222),
    Color32::from_rgb(255, 158, 84),
    Color32::from_rgb(240, 140, 200),
];
/// Half the width of the cross at a place, and length of the arrow of a line, points.
const CROSS: f32 = 5.0;
const ARROW: f32 = 13.0;
/// Radius of the ring around an end of a line that is under the pointer, points.
const END: f32 = 7.0;

/// The colour of the gauge of a number.
pub fn colour(number: u32) -> Color32 {
    COLOURS[(number.max(1) as usize - 1) % COLOURS.len()]
}

/// Draws a number on its colour.
pub fn badge(painter: &Painter, at: Pos2, number: u32, stands_out: bool) {
    if stands_out {
        painter.circle_filled(at, MARK + 2.5, Color32::WHITE);
    }
    painter.circle_filled(at, MARK + 1.0, Color32::from_black_alpha(170));
    painter.circle_filled(at, MARK, colour(number));
    painter.text(
        at,
        Align2::CENTER_CENTER,
        number.to_string(),
        FontId::proportional(13.0),
        Color32::from_rgb(12, 15, 21),
    );
}

/// Where the gauges are, and the pointer among them.
#[derive(SystemParam)]
pub struct Marks<'w> {
    panels: Res<'w, Panels>,
    gauges: Res<'w, Gauges>,
    camera: Res<'w, WorldCamera>,
    setup: Res<'w, Setup>,
    pointer: Res<'w, Pointer>,
    cover: Res<'w, HudCover>,
    drag: Res<'w, DragState>,
    hand: Res<'w, Hand>,
}

impl Marks<'_> {
    /// What is gripped, or would be by a press.
    pub fn grip(&self) -> Option<Grip> {
        if let Some(drag) = self.drag.current() {
            return if let Gesture::Gauge(grip) = drag.gesture { Some(grip) } else { None };
        }
        let pixel = self.pointer.at.filter(|pixel| !self.cover.covers(*pixel))?;
        let works = self.panels.visible && self.hand.is_empty();
        grip::at(pixel, &self.gauges, &self.camera, self.setup.blueprint.scale).filter(|_| works)
    }
}

/// Shows them.
pub fn show(mut contexts: EguiContexts, marks: Marks, (desk, generation): (Res<GaugeDesk>, Res<Generation>)) -> Result {
    let Marks { panels, gauges, camera, setup, pointer, .. } = &marks;
    let begun = desk.begun(generation.scene);
    if !panels.visible || gauges.is_empty() && begun.is_none() {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let (zoom, scale, free) = (context.zoom_factor(), setup.blueprint.scale, camera.free());
    let points = |pixel: Vec2| pos2(pixel.x / zoom, pixel.y / zoom);
    let area = egui::Rect::from_min_max(points(free.min), points(free.max));
    let painter = context.layer_painter(egui::LayerId::background()).with_clip_rect(area);
    let place = |at: Vec2| points(camera.to_pixel(scale.vec_to_kernel(at)));
    for gauge in gauges.iter() {
        let (hue, stands_out) = (colour(gauge.number), desk.selected == Some(gauge.number));
        match gauge.place {
            Place::Spot { at, radius } => {
                spot(&painter, place(at), scale.to_kernel(radius) * camera.pixels_per_d() / zoom, hue);
            }
            Place::Line { from, to } => line(&painter, place(from), place(to), hue),
        }
        badge(&painter, points(mark(gauge, camera, scale)), gauge.number, stands_out);
    }
    if let Some(grip) = marks.grip() {
        let gauge = gauges.iter().find(|gauge| gauge.number == grip.number);
        if let Some((at, radius)) = gauge.map(|gauge| gripped(gauge, grip.part, camera, scale)) {
            for pen in pens(Color32::WHITE) {
                painter.circle_stroke(points(at), radius, pen);
            }
        }
        let is_held = marks.drag.current().is_some();
        context.set_cursor_icon(if is_held { CursorIcon::Grabbing } else { CursorIcon::Grab });
    }
    if let (Some(from), Some(pixel)) = (begun, pointer.at) {
        line(&painter, place(from), points(pixel), Color32::WHITE);
    }
    Ok(())
}

/// Where a ring shows what of a gauge is gripped, logical pixels, and its radius, points.
fn gripped(gauge: &Gauge, part: Part, camera: &WorldCamera, scale: Scale) -> (Vec2, f32) {
    let end = |at: Vec2| (camera.to_pixel(scale.vec_to_kernel(at)), END);
    match (gauge.place, part) {
        (Place::Line { from, .. }, Part::From) => end(from),
        (Place::Line { to, .. }, Part::To) => end(to),
        _ => (mark(gauge, camera, scale), MARK + 3.0),
    }
}

/// Pens that can be seen on light and on dark.
fn pens(colour: Color32) -> [Stroke; 2] {
    [Stroke::new(3.4, Color32::from_black_alpha(130)), Stroke::new(1.5, colour)]
}

fn spot(painter: &Painter, at: Pos2, radius: f32, colour: Color32) {
    for pen in pens(colour) {
        painter.circle_stroke(at, radius, Stroke::new(0.7 * pen.width, pen.color.gamma_multiply(0.8)));
        for arm in [vec2(CROSS, 0.0), vec2(0.0, CROSS)] {
            painter.line_segment([at - arm, at + arm], pen);
        }
    }
}

/// A line, and an arrow to its right: the way that counts as positive.
fn line(painter: &Painter, from: Pos2, to: Pos2, colour: Color32) {
    let along = (to - from).normalized();
    let (right, middle) = (vec2(-along.y, along.x), from + (to - from) / 2.0);
    let tip = middle + ARROW * right;
    for pen in pens(colour) {
        painter.line_segment([from, to], pen);
        for end in [from, to] {
            painter.circle_filled(end, 1.0 + pen.width, pen.color);
        }
        painter.line_segment([middle, tip], pen);
        for side in [-1.0, 1.0] {
            painter.line_segment([tip, tip - 5.0 * right + 4.0 * side * along], pen);
        }
    }
}
