//! Error against time, log–log: the curve that was measured with the presets as buttons on it, the world as it runs now,
//! and the bound that the autopilot holds. What has a time and no error, for want of liquid, stands on the lower edge.

use crate::{
    game::hud::{
        panels::accuracy::axis::{Axis, percent},
        style, widgets,
    },
    kernel::params::{Preset, Quality},
    lab::{
        autopilot::Goal,
        live::accuracy::{Curve, CurvePoint},
    },
    sim::numbers::short,
};
use bevy_egui::egui::{self, Align2, Color32, FontId, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};

/// Errors below this are drawn at it: a logarithm has no 0.
const FLOOR: f32 = 1e-5;
/// Density errors of usual scenes, from calm to violent.
const USUAL: [f32; 2] = [1e-4, 1e-2];
/// Radius of a measured point, points.
const DOT: f32 = 4.0;
/// What of the plot a measured point takes for the pointer, points.
const TOUCHED: egui::Vec2 = vec2(9.0, 9.0);
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
    /// The world of late, oldest first; the last is now.
    pub trail: &'a [Live],
    /// What the autopilot holds.
    pub goal: Option<Goal>,
    /// The quality in force.
    pub now: (Preset, Quality),
    /// Whether the error was looked for: then, where there is none, there is no liquid to have one.
    pub looked: bool,
}

/// The world as it ran at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Live {
    /// Time of a tick, ms.
    pub milliseconds: f32,
    /// Density error; `None` without a liquid inside.
    pub error: Option<f32>,
}

/// Lines and places of the plot.
struct Canvas<'a> {
    painter: &'a egui::Painter,
    field: Rect,
    x: Axis,
    y: Axis,
}

impl Canvas<'_> {
    fn place(&self, milliseconds: f32, error: Option<f32>) -> Pos2 {
        error.map_or_else(
            || pos2(self.at(milliseconds, FLOOR).x, self.field.bottom()),
            |error| self.at(milliseconds, error),
        )
    }

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
        let times = points
            .iter()
            .map(|point| self.scale * point.milliseconds)
            .chain(self.trail.iter().map(|live| live.milliseconds));
        let bound = |wanted: fn(Goal) -> Option<f32>| self.goal.and_then(wanted);
        let time_bound = bound(|goal| if let Goal::Time(bound) = goal { Some(bound) } else { None });
        let error_bound = bound(|goal| if let Goal::Error(bound) = goal { Some(bound) } else { None });
        let errors =
            points.iter().filter_map(|point| point.error).chain(self.trail.iter().filter_map(|live| live.error));
        // Without any error the axis shows where errors usually are.
        let errors: Vec<f32> = errors.chain(error_bound).collect();
        let errors = if errors.is_empty() { USUAL.to_vec() } else { errors };
        let canvas = Canvas {
            painter: &painter,
            field,
            x: Axis::around(times.chain(time_bound)),
            y: Axis::around(errors.iter().map(|error| error.max(FLOOR))),
        };
        grid(&canvas);
        limits(&canvas, time_bound, error_bound);
        self.line(&canvas);
        trail(&canvas, self.trail);
        let chosen = self.presets(ui, &canvas);
        for (k, text) in self.hints().into_iter().enumerate() {
            let at = field.center_top() + vec2(0.0, 26.0 + 15.0 * k as f32);
            canvas.text(at, Align2::CENTER_CENTER, text, style::WEAK);
        }
        chosen
    }

    /// What there is to say where something is missing.
    fn hints(&self) -> Vec<&'static str> {
        let points = self.curve.map_or(&[][..], |curve| &curve.points);
        let errs = points.iter().any(|point| point.error.is_some());
        let mut hints = Vec::new();
        if !errs && self.looked && self.trail.last().is_none_or(|live| live.error.is_none()) {
            hints.push("no density error to measure: no particle has liquid all around");
        }
        match points {
            [] => hints.push("no curve of this scene yet: measure here"),
            _ if !errs => hints.push("the curve has times only"),
            _ => {}
        }
        hints
    }

    /// The presets as buttons below, as long as one of them has none on the curve; the one that was pressed.
    pub fn chips(&self, ui: &mut Ui) -> Option<Preset> {
        let point = |preset| self.curve.and_then(|curve| curve.point(preset));
        if Preset::ALL.into_iter().all(|preset| point(preset).is_some_and(|point| point.error.is_some())) {
            return None;
        }
        let mut chosen = None;
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = vec2(4.0, 4.0);
            for preset in Preset::ALL {
                let measured = point(preset);
                let time = measured.map(|point| format!("  {} ms", short(self.scale * point.milliseconds)));
                let text = format!("{}{}", preset.name(), time.unwrap_or_default());
                let chip = ui.add(egui::Button::new(text).selected(self.is_now(preset, preset.quality())));
                let told = measured.map_or_else(|| "click to go on at it".to_owned(), |point| self.about(point));
                if chip.on_hover_text(told).clicked() {
                    chosen = Some(preset);
                }
            }
        });
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
        let points = self.curve.iter().flat_map(|curve| &curve.points);
        let dots: Vec<(&CurvePoint, Pos2)> =
            points.map(|point| (point, canvas.place(self.scale * point.milliseconds, point.error))).collect();
        let mut taken: Vec<Rect> = dots.iter().map(|(_, dot)| Rect::from_center_size(*dot, TOUCHED)).collect();
        let live = self.trail.last().map(|live| canvas.place(live.milliseconds, live.error));
        taken.extend(live.map(|live| Rect::from_center_size(live, vec2(14.0, 14.0))));
        for (point, dot) in dots {
            let in_force = self.is_now(point.preset, point.quality);
            // What has no error has its button below.
            if point.quality != point.preset.quality() || point.error.is_none() {
                canvas.painter.circle_stroke(dot, DOT - 1.0, Stroke::new(1.5, style::ACCENT));
                continue;
            }
            let font = FontId::proportional(12.0);
            let text = ui.painter().layout_no_wrap(point.preset.name().to_owned(), font, Color32::PLACEHOLDER);
            let button = place_beside(dot, text.size() + 2.0 * PADDING, canvas.field, &taken);
            taken.push(button);
            let id = ui.id().with(("preset", point.preset.name()));
            // Button and dot, and not what lies between them: another's button may.
            let response = ui.interact(button, id, Sense::click());
            widgets::name(&response, &format!("{} on the curve", point.preset.name()), in_force);
            let response = response | ui.interact(Rect::from_center_size(dot, TOUCHED), id.with("dot"), Sense::click());
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

    /// Whether a quality is in force; two presets that differ in nothing but their detail are two.
    fn is_now(&self, preset: Preset, quality: Quality) -> bool {
        (preset.detail(), quality) == (self.now.0.detail(), self.now.1)
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
fn trail(canvas: &Canvas<'_>, trail: &[Live]) {
    for (k, live) in trail.iter().enumerate() {
        let age = (k + 1) as f32 / trail.len() as f32;
        let at = canvas.place(live.milliseconds, live.error);
        canvas.painter.circle_filled(at, 1.5, LIVE.gamma_multiply(0.45 * age * age));
    }
    if let Some(live) = trail.last() {
        let at = canvas.place(live.milliseconds, live.error);
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

    fn plot<'a>(curve: Option<&'a Curve>, trail: &'a [Live]) -> Plot<'a> {
        Plot { curve, scale: 1.0, trail, goal: None, now: (Preset::Fast, Preset::Fast.quality()), looked: true }
    }

    /// A curve of all presets, each with twice the cost and half the error of the one before it; `error` is the first one's.
    fn curve(error: Option<f32>) -> Curve {
        let point = |preset: Preset| {
            let factor = f32::from(1_u8 << preset as u8);
            let error = error.map(|error| error / factor);
            CurvePoint { preset, quality: preset.quality(), milliseconds: factor, error, p99: error }
        };
        Curve { points: Preset::ALL.map(point).into(), ..Curve::default() }
    }

    /// What the plot and its chips write in a window, and which preset a click on the words `on` chooses.
    fn press(plot: &Plot<'_>, on: &str) -> (Vec<String>, Option<Preset>) {
        let context = egui::Context::default();
        style::apply(&context);
        let (mut words, mut chosen, mut target) = (Vec::new(), None, None);
        for step in 0..6 {
            let button = |pressed, pos| egui::Event::PointerButton {
                pos,
                button: egui::PointerButton::Primary,
                pressed,
                modifiers: egui::Modifiers::NONE,
            };
            let events = match (step, target) {
                (3, Some(at)) => vec![egui::Event::PointerMoved(at)],
                (4, Some(at)) => vec![button(true, at)],
                (5, Some(at)) => vec![button(false, at)],
                _ => Vec::new(),
            };
            let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(440.0, 400.0)));
            let input = egui::RawInput { events, screen_rect, ..egui::RawInput::default() };
            let output = context.run_ui(input, |ui| {
                let pressed = plot.show(ui, vec2(396.0, 200.0)).or(plot.chips(ui));
                chosen = chosen.or(pressed);
            });
            words.clear();
            for shape in output.shapes {
                if let Shape::Text(text) = shape.shape {
                    let written = text.galley.text().to_owned();
                    if written.starts_with(on) {
                        target = Some(text.visual_bounding_rect().center());
                    }
                    words.push(written);
                }
            }
        }
        (words, chosen)
    }

    #[test]
    fn every_preset_can_be_pressed_with_a_curve_without_and_without_liquid() {
        let (full, times) = (curve(Some(0.1)), curve(None));
        let live = [Live { milliseconds: 2.0, error: None }];
        for curve in [None, Some(&full), Some(&times)] {
            for preset in Preset::ALL {
                let (words, chosen) = press(&plot(curve, &live), preset.name());
                assert_eq!(chosen, Some(preset), "{words:?}");
            }
        }
    }

    #[test]
    fn what_is_missing_is_said() {
        let (full, times) = (curve(Some(0.01)), curve(None));
        let (wet, dry) = (Live { milliseconds: 2.0, error: Some(0.1) }, Live { milliseconds: 2.0, error: None });
        let hints = |curve, live: &[Live]| plot(curve, live).hints().join("; ");
        assert_eq!(hints(Some(&full), &[wet]), "");
        assert!(hints(None, &[wet]).starts_with("no curve of this scene yet"));
        let empty = hints(None, &[dry]);
        assert!(empty.starts_with("no density error to measure") && empty.ends_with("measure here"), "{empty}");
        assert!(hints(Some(&times), &[dry]).ends_with("times only"));
    }

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
