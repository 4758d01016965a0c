//! Error against time, log–log: the curve with the presets as buttons on it, what is known of other details as marks,
//! the world as it runs now, and the bound that the autopilot holds. The error is that of density, or the true one
//! where that is known. What has a time and no error, for want of liquid, stands on the lower edge.

mod kind;
#[cfg(test)]
mod tests;

pub use kind::ErrorKind;

use crate::{
    game::hud::{
        panels::accuracy::{
            axis::{Axis, percent, percent_or_none},
            canvas::{Canvas, LEAST, Live, place_beside},
        },
        style, widgets,
    },
    kernel::params::{Preset, Quality},
    lab::{
        autopilot::Goal,
        dial::is_same_detail,
        live::accuracy::{Curve, CurvePoint},
    },
    sim::numbers::short,
};
use bevy_egui::egui::{self, Align2, Color32, FontId, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, vec2};
use tr::tr;

/// Errors of usual scenes, from calm to violent.
const USUAL: [f32; 2] = [1e-4, 1e-2];
/// Radius of a measured point, points.
const DOT: f32 = 4.0;
/// What of the plot a measured point takes for the pointer, points.
const TOUCHED: egui::Vec2 = vec2(9.0, 9.0);
/// Room for the numbers at the left and below, points.
const MARGIN: egui::Vec2 = vec2(46.0, 30.0);
/// Room around the text of a preset's button, points.
const PADDING: egui::Vec2 = vec2(6.0, 3.0);

/// What is shown.
pub struct Plot<'a> {
    /// The curve of the scene, if there is one.
    pub curve: Option<&'a Curve>,
    /// What its times are multiplied by.
    pub scale: f32,
    /// Which error.
    pub kind: ErrorKind,
    /// Whether there is another to show.
    pub has_both: bool,
    /// The world of late, oldest first; the last is now.
    pub trail: &'a [Live],
    /// What the autopilot holds.
    pub goal: Option<Goal>,
    /// The quality in force.
    pub now: (Preset, Quality),
    /// The detail that is asked for.
    pub detail: f64,
    /// Whether the error was looked for: then, where there is none, there is no liquid to have one.
    pub looked: bool,
    /// Whether a curve is being measured.
    pub is_measuring: bool,
}

/// What was pressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pressed {
    /// The button of a preset.
    Preset(Preset),
    /// The mark of a preset at another detail that is asked for.
    Detail(Preset, f64),
    /// The other error.
    Kind(ErrorKind),
}

impl Plot<'_> {
    /// Shows it in `size`; what was pressed.
    pub fn show(&self, ui: &mut Ui, size: egui::Vec2) -> Option<Pressed> {
        let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
        let field = Rect::from_min_max(rect.min + vec2(MARGIN.x, 8.0), rect.max - vec2(10.0, MARGIN.y));
        let painter = ui.painter_at(rect.expand(2.0));
        let goal = |wanted: fn(Goal) -> Option<f32>| self.goal.and_then(wanted);
        let time_bound = goal(|goal| if let Goal::Time(bound) = goal { Some(bound) } else { None });
        let error_bound = goal(|goal| if let Goal::Error(bound) = goal { Some(bound) } else { None });
        let error_bound = error_bound.filter(|_| self.kind == ErrorKind::Density);
        let floor = self.curve.and_then(|curve| curve.floor).filter(|_| self.kind == ErrorKind::True);
        let (x, y) = self.axes(time_bound, error_bound.or(floor));
        let canvas = Canvas { painter: &painter, field, x, y };
        canvas.grid();
        if let Some(floor) = floor {
            canvas.floor(floor);
        }
        canvas.limits(time_bound, error_bound);
        let mut taken = self.dots(&canvas);
        let pressed = self.kind.choose(ui, field, self.has_both, &mut taken).map(Pressed::Kind);
        self.lines(&canvas, &mut taken);
        match (self.kind, self.trail.last()) {
            (ErrorKind::Density, _) => canvas.trail(self.trail),
            (ErrorKind::True, Some(live)) => {
                let own = self.detail * self.now.0.detail();
                let point = self.curve.and_then(|curve| curve.point_of(&self.now.1, own));
                canvas.now(live, point.and_then(|point| point.truth));
            }
            (ErrorKind::True, None) => {}
        }
        let pressed = pressed.or(self.marks(ui, &canvas));
        let pressed = self.presets(ui, &canvas, taken).map(Pressed::Preset).or(pressed);
        for (k, text) in self.hints().into_iter().enumerate() {
            let at = field.center_top() + vec2(0.0, 32.0 + 15.0 * k as f32);
            canvas.text(at, Align2::CENTER_CENTER, &text, style::WEAK);
        }
        pressed
    }

    /// The axes that hold everything, with a bound of time and an error that are to be seen, too.
    fn axes(&self, time: Option<f32>, error: Option<f32>) -> (Axis, Axis) {
        let trail = || self.trail.iter();
        let times = self.points().map(|point| self.scale * point.milliseconds);
        let times = times.chain(trail().map(|live| live.milliseconds)).chain(time);
        let lived = trail().filter_map(|live| live.error).filter(|_| self.kind == ErrorKind::Density);
        let errors: Vec<f32> =
            self.points().filter_map(|point| self.kind.of(point)).chain(lived).chain(error).collect();
        // Without any error the axis shows where errors usually are.
        let errors = if errors.is_empty() { USUAL.to_vec() } else { errors };
        (Axis::around(times), Axis::around(errors.iter().map(|error| error.max(LEAST))))
    }

    fn points(&self) -> impl Iterator<Item = &CurvePoint> {
        self.curve.iter().flat_map(|curve| &curve.points)
    }

    /// What there is to say where something is missing.
    fn hints(&self) -> Vec<String> {
        let any = self.points().next().is_some();
        let errs = self.points().any(|point| point.error.is_some());
        let mut hints = Vec::new();
        if !errs && self.looked && self.trail.last().is_none_or(|live| live.error.is_none()) {
            hints.push(tr!("no density error to measure: no particle has liquid all around"));
        }
        match (any, self.is_measuring) {
            (false, false) => hints.push(tr!("no curve of this scene yet: measure here")),
            (false, true) => hints.push(tr!("no curve of this scene yet: it is being measured")),
            (true, _) if !errs => hints.push(tr!("the curve has times only")),
            (true, _) => {}
        }
        hints
    }

    /// The presets as buttons below, as long as one of them has none on the curve; the one that was pressed.
    pub fn chips(&self, ui: &mut Ui) -> Option<Preset> {
        let point = |preset| self.curve.and_then(|curve| curve.point(preset, self.detail));
        if Preset::ALL.into_iter().all(|preset| point(preset).is_some_and(|point| self.kind.of(point).is_some())) {
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
                let told = measured.map_or_else(|| tr!("click to go on at it"), |point| self.about(point));
                if chip.on_hover_text(told).clicked() {
                    chosen = Some(preset);
                }
            }
        });
        chosen
    }

    /// What points and the world as it runs cover.
    fn dots(&self, canvas: &Canvas<'_>) -> Vec<Rect> {
        let dots = self.points().map(|point| Rect::from_center_size(self.place(canvas, point), TOUCHED));
        let live = self.trail.last().filter(|_| self.kind == ErrorKind::Density);
        let live = live.map(|live| canvas.place(live.milliseconds, live.error));
        dots.chain(live.map(|live| Rect::from_center_size(live, vec2(14.0, 14.0)))).collect()
    }

    /// A line for each detail at which presets have an error, by their time; the plain method stands apart. Those of
    /// other details are called by them, over nothing that is `taken`.
    fn lines(&self, canvas: &Canvas<'_>, taken: &mut Vec<Rect>) {
        let on_line = |point: &&CurvePoint| {
            point.preset != Preset::Classic && point.quality == point.preset.quality() && point.is_sound
        };
        let mut left: Vec<&CurvePoint> = self.points().filter(on_line).collect();
        left.retain(|point| self.kind.of(point).is_some());
        left.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
        while let Some(detail) = left.first().map(|point| point.detail) {
            let (line, others): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|point| is_same_detail(point.detail, detail));
            left = others;
            let place = |point: &&CurvePoint| canvas.place(self.scale * point.milliseconds, self.kind.of(point));
            let places: Vec<Pos2> = line.iter().map(place).collect();
            let is_own = is_same_detail(detail, self.detail);
            let colour = if is_own { style::ACCENT.gamma_multiply(0.7) } else { style::WEAK.gamma_multiply(0.55) };
            // The end that is furthest from the line of the detail in force.
            let end = if detail < self.detail { places.first() } else { places.last() };
            if let Some(end) = end.filter(|_| !is_own) {
                let (text, font) = (tr!("detail {}", short(detail as f32)), FontId::proportional(style::SMALL));
                let text = canvas.painter.layout_no_wrap(text, font, style::TEXT);
                let room = place_beside(*end, text.size(), canvas.field, taken);
                canvas.painter.galley(room.min, text, style::TEXT);
                taken.push(room);
            }
            canvas.painter.add(Shape::line(places, Stroke::new(1.5, colour)));
        }
    }

    /// Whether a point has its button on the plot: it is a preset at the detail that is asked for.
    fn has_button(&self, point: &CurvePoint) -> bool {
        point.quality == point.preset.quality() && is_same_detail(point.asked_detail(), self.detail)
    }

    /// Where a point stands.
    fn place(&self, canvas: &Canvas<'_>, point: &CurvePoint) -> Pos2 {
        canvas.place(self.scale * point.milliseconds, self.kind.of(point))
    }

    /// The presets at other details, which can be pressed, and what is no preset.
    fn marks(&self, ui: &Ui, canvas: &Canvas<'_>) -> Option<Pressed> {
        let mut pressed = None;
        for point in self.points().filter(|point| !self.has_button(point)) {
            let dot = self.place(canvas, point);
            if point.quality != point.preset.quality() {
                canvas.painter.circle_stroke(dot, DOT - 1.0, Stroke::new(1.5, style::ACCENT));
                continue;
            }
            let (name, asked) = (point.preset.name(), point.asked_detail());
            let detail = short(asked as f32);
            let id = ui.id().with((name, &detail));
            let response = ui.interact(Rect::from_center_size(dot, TOUCHED), id, Sense::click());
            widgets::name(&response, &tr!("{name} at detail {detail}", name, detail), false);
            let colour = if response.hovered() { Color32::WHITE } else { style::WEAK };
            let corners = [vec2(0.0, -DOT), vec2(DOT, 0.0), vec2(0.0, DOT), vec2(-DOT, 0.0)].map(|way| dot + way);
            canvas.painter.add(Shape::convex_polygon(corners.into(), colour, Stroke::NONE));
            if response.on_hover_text(self.about(point)).clicked() {
                pressed = Some(Pressed::Detail(point.preset, asked));
            }
        }
        pressed
    }

    /// The presets at the detail that is asked for, as buttons over nothing that is `taken`; the one that was pressed.
    fn presets(&self, ui: &Ui, canvas: &Canvas<'_>, mut taken: Vec<Rect>) -> Option<Preset> {
        let mut chosen = None;
        for point in self.points().filter(|point| self.has_button(point)) {
            let dot = self.place(canvas, point);
            let in_force = self.is_now(point.preset, point.quality);
            // What has no error has its button below.
            if self.kind.of(point).is_none() {
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
            widgets::name(&response, &tr!("{} on the curve", point.preset.name()), in_force);
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
        let (name, detail) = (point.preset.name(), point.asked_detail());
        let time = short(self.scale * point.milliseconds);
        let (error, p99) = (percent_or_none(point.error), percent_or_none(point.p99));
        let cost = if is_same_detail(detail, self.detail) {
            tr!("{name}: {time} ms a tick", name, time)
        } else {
            tr!("{name} at detail {detail}: {time} ms a tick", name, detail, time)
        };
        let truth = point.truth.map(|truth| tr!("true error {}", percent(truth)));
        let density = tr!("density error {error} (99th percentile {p99})", error, p99);
        let figures: Vec<String> = [Some(cost), truth, Some(density)].into_iter().flatten().collect();
        let sound = (!point.is_sound).then(|| tr!("its world came out unsound, so errors mean little"));
        let told = [Some(figures.join(", ")), sound, Some(tr!("click to go on at it"))];
        told.into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}
