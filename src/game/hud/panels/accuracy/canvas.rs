//! What the plot is drawn on: the field with its grid, what lies beyond a bound or below the floor, the world as it
//! runs, and places for what stands beside a point.

use crate::{
    game::hud::{
        panels::accuracy::axis::{Axis, percent},
        style,
    },
    sim::numbers::short,
};
use bevy_egui::egui::{self, Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, pos2, vec2};
use tr::tr;

/// Errors below this are drawn at it: a logarithm has no 0.
pub const LEAST: f32 = 1e-5;
/// What is lately.
pub const LIVE: Color32 = Color32::from_rgb(255, 206, 92);

/// The world as it ran at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Live {
    /// Time of a tick, ms.
    pub milliseconds: f32,
    /// Density error; `None` without a liquid inside.
    pub error: Option<f32>,
}

/// Lines and places of the plot.
pub struct Canvas<'a> {
    /// What it is drawn with.
    pub painter: &'a egui::Painter,
    /// Where it is drawn.
    pub field: Rect,
    /// Times, ms.
    pub x: Axis,
    /// Errors, fractions.
    pub y: Axis,
}

impl Canvas<'_> {
    /// Where a time and an error stand; what has no error stands on the lower edge.
    pub fn place(&self, milliseconds: f32, error: Option<f32>) -> Pos2 {
        error.map_or_else(
            || pos2(self.at(milliseconds, LEAST).x, self.field.bottom()),
            |error| self.at(milliseconds, error),
        )
    }

    /// Where a time and an error stand.
    pub fn at(&self, milliseconds: f32, error: f32) -> Pos2 {
        pos2(
            self.field.left() + self.field.width() * self.x.share(milliseconds),
            self.field.bottom() - self.field.height() * self.y.share(error.max(LEAST)),
        )
    }

    /// Writes a small text.
    pub fn text(&self, at: Pos2, align: Align2, text: &str, colour: Color32) {
        self.painter.text(at, align, text, FontId::proportional(style::SMALL), colour);
    }

    /// Field, lines, and numbers beside them.
    pub fn grid(&self) {
        let field = self.field;
        self.painter.rect_filled(field, 4.0, Color32::from_rgb(12, 15, 21));
        let line = |power| Stroke::new(1.0, if power { style::LINE } else { style::LINE.gamma_multiply(0.45) });
        for mark in self.x.marks() {
            let x = self.at(mark.value, 1.0).x;
            self.painter.vline(x, field.y_range(), line(mark.power));
            if mark.labelled {
                self.text(pos2(x, field.bottom() + 3.0), Align2::CENTER_TOP, &short(mark.value), style::WEAK);
            }
        }
        for mark in self.y.marks().into_iter().filter(|mark| mark.value >= LEAST) {
            let y = self.at(1.0, mark.value).y;
            self.painter.hline(field.x_range(), y, line(mark.power));
            if mark.labelled {
                self.text(pos2(field.left() - 5.0, y), Align2::RIGHT_CENTER, &percent(mark.value), style::WEAK);
            }
        }
        let below = pos2(field.center().x, field.bottom() + 17.0);
        self.text(below, Align2::CENTER_TOP, &tr!("ms a tick"), style::WEAK);
    }

    /// What lies beyond the autopilot's bound.
    pub fn limits(&self, time: Option<f32>, error: Option<f32>) {
        let (field, shade) = (self.field, style::WARN.gamma_multiply(0.08));
        let pen = Stroke::new(1.5, style::WARN.gamma_multiply(0.8));
        if let Some(time) = time {
            let x = self.at(time, 1.0).x;
            self.painter.rect_filled(field.with_min_x(x), 0.0, shade);
            self.painter.extend(Shape::dashed_line(&[pos2(x, field.top()), pos2(x, field.bottom())], pen, 5.0, 4.0));
        }
        if let Some(error) = error {
            let y = self.at(1.0, error).y;
            self.painter.rect_filled(field.with_max_y(y), 0.0, shade);
            self.painter.extend(Shape::dashed_line(&[pos2(field.left(), y), pos2(field.right(), y)], pen, 5.0, 4.0));
        }
    }

    /// Errors that are not told apart.
    pub fn floor(&self, floor: f32) {
        let (field, y) = (self.field, self.at(1.0, floor).y);
        self.painter.rect_filled(field.with_min_y(y), 0.0, style::WEAK.gamma_multiply(0.12));
        let pen = Stroke::new(1.0, style::WEAK.gamma_multiply(0.8));
        self.painter.extend(Shape::dashed_line(&[pos2(field.left(), y), pos2(field.right(), y)], pen, 2.0, 3.0));
        let text = tr!("floor: less is not told apart");
        self.text(pos2(field.left() + 6.0, y + 2.0), Align2::LEFT_TOP, &text, style::WEAK);
    }

    /// The world as it runs, and where it was.
    pub fn trail(&self, trail: &[Live]) {
        for (k, live) in trail.iter().enumerate() {
            let age = (k + 1) as f32 / trail.len() as f32;
            let at = self.place(live.milliseconds, live.error);
            self.painter.circle_filled(at, 1.5, LIVE.gamma_multiply(0.45 * age * age));
        }
        if let Some(live) = trail.last() {
            let at = self.place(live.milliseconds, live.error);
            self.painter.circle_filled(at, 7.0, LIVE.gamma_multiply(0.25));
            self.painter.circle_filled(at, 3.5, LIVE);
        }
    }

    /// The world as it runs where only its time is known: a line, and the error that its setting has.
    pub fn now(&self, live: &Live, error: Option<f32>) {
        let x = self.at(live.milliseconds, LEAST).x;
        self.painter.vline(x, self.field.y_range(), Stroke::new(1.0, LIVE.gamma_multiply(0.5)));
        if let Some(error) = error {
            self.painter.circle_filled(self.at(live.milliseconds, error), 7.0, LIVE.gamma_multiply(0.25));
        }
    }
}

/// A place for something of `size` beside a dot: inside the field, and over nothing that is `taken` if that can be.
pub fn place_beside(dot: Pos2, size: egui::Vec2, field: Rect, taken: &[Rect]) -> Rect {
    let (near, far) = (8.0 + size.x / 2.0, 9.0 + size.y / 2.0);
    let places = [
        vec2(0.0, -far),
        vec2(0.0, far),
        vec2(near, 0.0),
        vec2(-near, 0.0),
        vec2(near, -far * 0.8),
        vec2(-near, far * 0.8),
        vec2(near, far * 0.8),
        vec2(-near, -far * 0.8),
        vec2(near, -far * 1.9),
        vec2(-near, far * 1.9),
        vec2(near, far * 1.9),
        vec2(-near, -far * 1.9),
        vec2(0.0, -far * 2.2),
        vec2(0.0, far * 2.2),
        vec2(near, -far * 3.0),
        vec2(-near, -far * 3.0),
        vec2(near, far * 3.0),
        vec2(-near, far * 3.0),
    ];
    let rects = places.map(|place| Rect::from_center_size(dot + place, size));
    let free = |rect: &&Rect| field.contains_rect(**rect) && taken.iter().all(|other| !other.intersects(**rect));
    rects
        .iter()
        .find(free)
        .or_else(|| rects.iter().find(|rect| field.contains_rect(**rect)))
        .map_or(rects[0], |rect| *rect)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_avoid_each_other_and_stay_inside() {
        let field = Rect::from_min_size(pos2(0.0, 0.0), vec2(340.0, 200.0));
        let mut taken: Vec<Rect> = Vec::new();
        for dot in [
            pos2(60.0, 40.0),
            pos2(75.0, 60.0),
            pos2(82.0, 66.0),
            pos2(83.0, 66.0),
            pos2(150.0, 100.0),
            pos2(335.0, 195.0),
        ] {
            let rect = place_beside(dot, vec2(62.0, 20.0), field, &taken);
            assert!(field.contains_rect(rect), "{rect:?} sticks out");
            assert!(taken.iter().all(|other| !other.intersects(rect)), "{rect:?} covers another");
            taken.push(rect);
        }
    }
}
