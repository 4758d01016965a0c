//! Error against time, log–log: the curve that was measured with the presets as buttons on it, the world as it runs now,
//! and the bound that the autopilot holds.

use super::{
    axis::{Axis, short},
    percent,
};
use crate::{
    game::hud::style,
    kernel::params::{Preset, Quality},
    sim::{
        accuracy::{Curve, CurvePoint},
        autopilot::Goal,
    },
};
use bevy_egui::egui::{self, Align2, Color32, FontId, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};

/// Errors below this are drawn at it: a logarithm has no 0.
const FLOOR: f32 = 1e-5;
/// Radius of a measured point, points.
const DOT: f32 = 4.0;
/// Room for the numbers at the left and below, points.
const MARGIN: egui::Vec2 = vec2(46.0, 30.0);
/// Room around the text of a preset's button, points.
const PADDING: egui::Vec2 = vec2(6.0, 3.0);
/// What is lately.
const LIVE: Color32 = Color32::from_rgb(255, 206, 92);

/// What is shown.
pub struct Plot<'a> {
    /// The curve of the scene, if it was measured.
    pub curve: Option<&'a Curve>,
    /// What its times are multiplied by.
    pub scale: f32,
    /// ms a tick and error of late, oldest first; the last is now.
    pub trail: &'a [(f32, f32)],
    /// What the autopilot holds.
    pub goal: Option<Goal>,
    /// The quality in force.
    pub now: (Preset, Quality),
}

/// Lines and places of the plot.
struct Canvas<'a> {
    painter: &'a egui::Painter,
    field: Rect,
    x: Axis,
    y: Axis,
}

impl Canvas<'_> {
    fn at(&self, milliseconds: f32, error: f32) -> Pos2 {
        pos2(
            self.field.left() + self.field.width() * self.x.share(milliseconds),
            self.field.bottom() - self.field.height() * self.y.share(error.max(FLOOR)),
        )
    }

    fn text(&self, at: Pos2, align: Align2, text: &str, colour: Color32) {
        self.painter.text(at, align, text, FontId::proportional(10.5), colour);
    }
}

impl Plot<'_> {
    /// Shows it in `size`; the preset whose button was pressed.
    pub fn show(&self, ui: &mut Ui, size: egui::Vec2) -> Option<Preset> {
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let field = Rect::from_min_max(rect.min + vec2(MARGIN.x, 8.0), rect.max - vec2(10.0, MARGIN.y));
        let painter = ui.painter_at(rect.expand(2.0));
        let points: Vec<&CurvePoint> = self.curve.iter().flat_map(|curve| &curve.points).collect();
        let times =
            points.iter().map(|point| self.scale * point.milliseconds).chain(self.trail.iter().map(|place| place.0));
        let bound = |wanted: fn(Goal) -> Option<f32>| self.goal.and_then(wanted);
        let time_bound = bound(|goal| if let Goal::Time(bound) = goal { Some(bound) } else { None });
        let error_bound = bound(|goal| if let Goal::Error(bound) = goal { Some(bound) } else { None });
        let errors = points.iter().filter_map(|point| point.error).chain(self.trail.iter().map(|place| place.1));
        let errors = errors.chain(error_bound);
        let canvas = Canvas {
            painter: &painter,
            field,
            x: Axis::around(times.chain(time_bound)),
            y: Axis::around(errors.map(|error| error.max(FLOOR))),
        };
        grid(&canvas);
        limits(&canvas, time_bound, error_bound);
        self.line(&canvas);
        trail(&canvas, self.trail);
        let chosen = self.presets(ui, &canvas);
        if points.is_empty() {
            let text = "no curve of this scene yet: measure here";
            canvas.text(field.center_top() + vec2(0.0, 16.0), Align2::CENTER_CENTER, text, style::WEAK);
        }
        chosen
    }

    /// The presets that have an error, by their time; the plain method stands apart.
    fn line(&self, canvas: &Canvas<'_>) {
        let curve = self.curve.iter().flat_map(|curve| &curve.points);
        let mut line: Vec<(f32, f32)> = curve
            .filter(|point| point.preset != Preset::Classic && point.quality == point.preset.quality())
            .filter_map(|point| Some((self.scale * point.milliseconds, point.error?)))
            .collect();
        line.sort_by(|a, b| a.0.total_cmp(&b.0));
        let places = line.iter().map(|&(time, error)| canvas.at(time, error)).collect();
        canvas.painter.add(Shape::line(places, Stroke::new(1.5, style::ACCENT.gamma_multiply(0.7))));
    }

    fn presets(&self, ui: &Ui, canvas: &Canvas<'_>) -> Option<Preset> {
        let mut chosen = None;
        let dots: Vec<(&CurvePoint, Pos2)> = self
            .curve
            .iter()
            .flat_map(|curve| &curve.points)
            .filter_map(|point| Some((point, canvas.at(self.scale * point.milliseconds, point.error?))))
            .collect();
        let mut taken: Vec<Rect> = dots.iter().map(|(_, dot)| Rect::from_center_size(*dot, vec2(9.0, 9.0))).collect();
        taken.extend(self.trail.last().map(|live| Rect::from_center_size(canvas.at(live.0, live.1), vec2(14.0, 14.0))));
        for (point, dot) in dots {
            let in_force = point.quality == self.now.1;
            if point.quality != point.preset.quality() {
                canvas.painter.circle_stroke(dot, DOT - 1.0, Stroke::new(1.5, style::ACCENT));
                continue;
            }
            let font = FontId::proportional(12.0);
            let text = ui.painter().layout_no_wrap(point.preset.name().to_owned(), font, Color32::PLACEHOLDER);
            let button = place_beside(dot, text.size() + 2.0 * PADDING, canvas.field, &taken);
            taken.push(button);
            let id = ui.id().with(("preset", point.preset.name()));
            let response = ui.interact(button.union(Rect::from_center_size(dot, vec2(12.0, 12.0))), id, Sense::click());
            let (fill, colour) = match (in_force, response.hovered()) {
                (true, _) => (style::ACCENT_FILL, Color32::WHITE),
                (false, true) => (style::BUTTON_HOVER, Color32::WHITE),
                (false, false) => (style::BUTTON, style::TEXT),
            };
            canvas.painter.line_segment([dot, button.center()], Stroke::new(1.0, style::WEAK.gamma_multiply(0.6)));
            let border = if in_force { style::ACCENT } else { style::LINE };
            canvas.painter.rect(button, 5.0, fill, Stroke::new(1.0, border), StrokeKind::Inside);
            canvas.painter.galley(button.min + PADDING, text, colour);
            canvas.painter.circle_filled(dot, DOT, if in_force { Color32::WHITE } else { style::ACCENT });
            let told = self.about(point);
            if response.on_hover_text(told).clicked() {
                chosen = Some(point.preset);
            }
        }
        chosen
    }

    fn about(&self, point: &CurvePoint) -> String {
        let time = short(self.scale * point.milliseconds);
        let (error, p99) = (point.error.map_or("none".into(), percent), point.p99.map_or("none".into(), percent));
        format!(
            "{}: {time} ms a tick, density error {error} (99th percentile {p99}); click to go on at it",
            point.preset.name()
        )
    }
}

fn grid(canvas: &Canvas<'_>) {
    let field = canvas.field;
    canvas.painter.rect_filled(field, 4.0, Color32::from_rgb(12, 15, 21));
    let line = |power| Stroke::new(1.0, if power { style::LINE } else { style::LINE.gamma_multiply(0.45) });
    for mark in canvas.x.marks() {
        let x = canvas.at(mark.value, 1.0).x;
        canvas.painter.vline(x, field.y_range(), line(mark.power));
        if mark.labelled {
            canvas.text(pos2(x, field.bottom() + 3.0), Align2::CENTER_TOP, &short(mark.value), style::WEAK);
        }
    }
    for mark in canvas.y.marks().into_iter().filter(|mark| mark.value >= FLOOR) {
        let y = canvas.at(1.0, mark.value).y;
        canvas.painter.hline(field.x_range(), y, line(mark.power));
        if mark.labelled {
            canvas.text(pos2(field.left() - 5.0, y), Align2::RIGHT_CENTER, &percent(mark.value), style::WEAK);
        }
    }
    let below = pos2(field.center().x, field.bottom() + 17.0);
    canvas.text(below, Align2::CENTER_TOP, "ms a tick", style::WEAK);
    canvas.text(field.right_top() + vec2(-6.0, 5.0), Align2::RIGHT_TOP, "density error", style::WEAK);
}

/// What lies beyond the autopilot's bound.
fn limits(canvas: &Canvas<'_>, time: Option<f32>, error: Option<f32>) {
    let (field, shade) = (canvas.field, style::WARN.gamma_multiply(0.08));
    let pen = Stroke::new(1.5, style::WARN.gamma_multiply(0.8));
    if let Some(time) = time {
        let x = canvas.at(time, 1.0).x;
        canvas.painter.rect_filled(field.with_min_x(x), 0.0, shade);
        canvas.painter.extend(Shape::dashed_line(&[pos2(x, field.top()), pos2(x, field.bottom())], pen, 5.0, 4.0));
    }
    if let Some(error) = error {
        let y = canvas.at(1.0, error).y;
        canvas.painter.rect_filled(field.with_max_y(y), 0.0, shade);
        canvas.painter.extend(Shape::dashed_line(&[pos2(field.left(), y), pos2(field.right(), y)], pen, 5.0, 4.0));
    }
}

/// The world as it runs, and where it was.
fn trail(canvas: &Canvas<'_>, trail: &[(f32, f32)]) {
    for (k, &(time, error)) in trail.iter().enumerate() {
        let age = (k + 1) as f32 / trail.len() as f32;
        canvas.painter.circle_filled(canvas.at(time, error), 1.5, LIVE.gamma_multiply(0.45 * age * age));
    }
    if let Some(&(time, error)) = trail.last() {
        let at = canvas.at(time, error);
        canvas.painter.circle_filled(at, 7.0, LIVE.gamma_multiply(0.25));
        canvas.painter.circle_filled(at, 3.5, LIVE);
    }
}

/// A place for something of `size` beside a dot: inside the field, and over nothing that is `taken` if that can be.
fn place_beside(dot: Pos2, size: egui::Vec2, field: Rect, taken: &[Rect]) -> Rect {
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
        for dot in [pos2(60.0, 40.0), pos2(75.0, 60.0), pos2(82.0, 66.0), pos2(150.0, 100.0), pos2(335.0, 195.0)] {
            let rect = place_beside(dot, vec2(62.0, 20.0), field, &taken);
            assert!(field.contains_rect(rect), "{rect:?} sticks out");
            assert!(taken.iter().all(|other| !other.intersects(rect)), "{rect:?} covers another");
            taken.push(rect);
        }
    }
}
