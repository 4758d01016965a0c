//! The dial from smooth to exact: one slider over the steps of `lab::dial`, for those who want no plot.

use crate::{
    game::{
        hud::{
            style::{self, weak},
            widgets::{detail_name, quality_name},
        },
        orders::{Order, Orders},
    },
    lab::dial::{Accuracy, STEPS, Step},
    sim::state::Setup,
};
use bevy_egui::egui::{
    self, Align2, Color32, EventFilter, FontId, Key, Painter, Pos2, Response, Sense, Stroke, Ui, pos2, vec2,
};
use tr::tr;

/// Height with and without the names below the steps, points.
const HEIGHTS: [f32; 2] = [37.0, 24.0];
/// Room for the words at the ends, points.
const ENDS: f32 = 56.0;
/// Room that the name of a step takes at least, points.
const NAME: f32 = 52.0;
/// Radius of the handle, points.
const HANDLE: f32 = 6.5;

/// Shows it, and pushes the order to go to the step that was chosen.
pub fn show(ui: &mut Ui, setup: &Setup, piloted: bool, orders: &mut Orders) {
    let accuracy = Accuracy::of(setup);
    let Shown { response, looked_at, chosen } = track(ui, accuracy);
    let now = match accuracy.step() {
        Some(step) => about(STEPS[step]),
        None => tr!(
            "{quality}, detail {detail}: chosen by hand",
            quality = quality_name(setup.preset, &setup.quality),
            detail = detail_name(setup.asked_detail())
        ),
    };
    response.widget_info(|| egui::WidgetInfo::slider(true, f64::from(accuracy.place()), tr!("smooth to exact")));
    let text = match looked_at {
        Some(step) => about(STEPS[step]),
        None if piloted => tr!("{now}; to choose a step ends the autopilot", now),
        None => now,
    };
    ui.label(weak(text).small());
    // Where an autopilot stands now, too, is a choice.
    let chosen = chosen.filter(|step| piloted || accuracy.step() != Some(*step));
    orders.extend(chosen.map(|step| Order::Accuracy(STEPS[step])));
}

/// What became of the track in a frame.
struct Shown {
    response: Response,
    /// The step under the pointer, or that a drag would choose.
    looked_at: Option<usize>,
    /// The step that was chosen.
    chosen: Option<usize>,
}

fn track(ui: &mut Ui, accuracy: Accuracy) -> Shown {
    let width = ui.available_width();
    let named = (width - 2.0 * ENDS) / (STEPS.len() - 1) as f32 >= NAME;
    let size = vec2(width, HEIGHTS[usize::from(!named)]);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let scale = Scale { left: rect.left() + ENDS, right: rect.right() - ENDS, y: rect.top() + 12.0 };
    let pointed = response.interact_pointer_pos().or(response.hover_pos()).map(|at| scale.step_at(at));
    let is_held = response.dragged() || response.is_pointer_button_down_on();
    if response.clicked() || response.drag_started() {
        response.request_focus();
    }
    // A finger that goes over details would have the world resampled at each.
    let let_go = response.clicked() || response.drag_stopped();
    let chosen = pointed.filter(|_| let_go).or_else(|| by_key(ui, &response, accuracy));
    let place = if is_held { pointed.map(|step| step as f32) } else { None };
    let exact = is_held || accuracy.step().is_some();
    scale.draw(ui.painter(), named, place.unwrap_or(accuracy.place()), exact);
    if response.has_focus() {
        ui.painter().rect_stroke(rect, 5.0, Stroke::new(1.0, style::ACCENT), egui::StrokeKind::Inside);
    }
    Shown { response, looked_at: pointed, chosen }
}

/// The step that the arrow keys go to.
fn by_key(ui: &Ui, response: &Response, accuracy: Accuracy) -> Option<usize> {
    if !response.has_focus() {
        return None;
    }
    // Else the arrows would move the focus.
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    let presses = |keys: [Key; 2]| ui.input(|input| keys.map(|key| input.num_presses(key)).iter().sum::<usize>());
    let (up, down) = (presses([Key::ArrowRight, Key::ArrowUp]), presses([Key::ArrowLeft, Key::ArrowDown]));
    next(accuracy.place(), up as i32 - down as i32)
}

/// The step that is `by` steps from a place; from between two, the first of them is the next.
fn next(place: f32, by: i32) -> Option<usize> {
    let from = if by > 0 { place.floor() } else { place.ceil() };
    let last = STEPS.len() as i32 - 1;
    (by != 0).then(|| (from as i32 + by).clamp(0, last) as usize)
}

/// Where the steps are on the screen.
struct Scale {
    left: f32,
    right: f32,
    y: f32,
}

impl Scale {
    fn at(&self, place: f32) -> Pos2 {
        let share = place / (STEPS.len() - 1) as f32;
        pos2(self.left + share * (self.right - self.left), self.y)
    }

    fn step_at(&self, at: Pos2) -> usize {
        let share = ((at.x - self.left) / (self.right - self.left)).clamp(0.0, 1.0);
        (share * (STEPS.len() - 1) as f32).round() as usize
    }

    fn draw(&self, painter: &Painter, named: bool, place: f32, exact: bool) {
        let (first, last) = (self.at(0.0), self.at((STEPS.len() - 1) as f32));
        let gap = vec2(HANDLE + 5.0, 0.0);
        let font = FontId::proportional(12.0);
        painter.text(first - gap, Align2::RIGHT_CENTER, tr!("smooth"), font.clone(), style::TEXT);
        painter.text(last + gap, Align2::LEFT_CENTER, tr!("exact"), font, style::TEXT);
        painter.line_segment([first, last], Stroke::new(3.0, style::BUTTON_HOVER));
        painter.line_segment([first, self.at(place)], Stroke::new(3.0, style::ACCENT));
        for (k, step) in STEPS.into_iter().enumerate() {
            let at = self.at(k as f32);
            let is_here = place == k as f32;
            let passed = k as f32 <= place;
            painter.circle_filled(at, 3.5, if passed { style::ACCENT } else { style::BUTTON_HOVER });
            if named {
                let colour = if is_here { Color32::WHITE } else { style::WEAK };
                let below = at + vec2(0.0, HANDLE + 4.0);
                painter.text(below, Align2::CENTER_TOP, short_name(step), FontId::proportional(style::SMALL), colour);
            }
        }
        let handle = self.at(place);
        let fill = if exact { Color32::WHITE } else { style::PANEL };
        painter.circle(handle, HANDLE, fill, Stroke::new(2.0, style::ACCENT));
    }
}

/// The name below a step.
fn short_name(step: Step) -> String {
    let name = step.preset.name();
    if step.detail == 1.0 { name.to_owned() } else { format!("{name} {}", detail_name(step.detail)) }
}

/// What a step is, and what it takes.
fn about(step: Step) -> String {
    let Step { preset, detail } = step;
    let name = match preset.detail() {
        1.0 => preset.name().to_owned(),
        own => tr!("{}, which is fine at detail {}", preset.name(), detail_name(own * detail)),
    };
    match step.particles() {
        1.0 => tr!("{name}, at the scene's own detail", name),
        fewer if fewer < 1.0 => {
            tr!("{name} at detail {}: {} of the particles", detail_name(detail), detail_name(fewer), name)
        }
        more => tr!("{name}: {more} × the particles", name, more),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        scene::{self, effects::EffectModes},
        sim::{checkpoint::Checkpoint, simulation::Simulation, workers::Workers},
    };
    use std::sync::Arc;

    /// A world at a preset and a detail.
    fn world(preset: Preset, detail: f64) -> Simulation {
        let scene = scene::load("empty").unwrap().at_detail(detail);
        let blueprint = scene.build(&[], Some(preset), &EffectModes::new()).unwrap();
        Simulation::resume(&Checkpoint::of_scene(Arc::new(blueprint)), Workers::single())
    }

    /// A player in front of the dial: what it shows, and what is ordered by each frame of events.
    fn play(setup: &Setup, piloted: bool, frames: &[Vec<egui::Event>]) -> (Vec<String>, Vec<Order>) {
        let context = egui::Context::default();
        style::apply(&context);
        let (mut orders, mut words) = (Orders::default(), Vec::new());
        let blank = [Vec::new(), Vec::new()];
        for events in blank.iter().chain(frames) {
            let screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, vec2(412.0, 90.0)));
            let input = egui::RawInput { events: events.clone(), screen_rect, ..egui::RawInput::default() };
            let output = context.run_ui(input, |ui| show(ui, setup, piloted, &mut orders));
            words = output.shapes.iter().filter_map(|shape| text_of(&shape.shape)).collect();
        }
        (words, std::mem::take(&mut *orders))
    }

    fn text_of(shape: &egui::Shape) -> Option<String> {
        if let egui::Shape::Text(text) = shape { Some(text.galley.text().to_owned()) } else { None }
    }

    fn button(x: f32, pressed: bool) -> egui::Event {
        let (button, modifiers) = (egui::PointerButton::Primary, egui::Modifiers::NONE);
        egui::Event::PointerButton { pos: pos2(x, 16.0), button, pressed, modifiers }
    }

    fn key(key: Key) -> egui::Event {
        egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: egui::Modifiers::NONE }
    }

    fn moved(x: f32) -> egui::Event {
        egui::Event::PointerMoved(pos2(x, 16.0))
    }

    #[test]
    fn a_press_at_the_ends_orders_the_ends_and_where_it_stands_nothing() {
        let at_fine = world(Preset::Fine, 1.0);
        let press = |x, piloted| {
            let frames = [vec![moved(x)], vec![button(x, true)], vec![button(x, false)]];
            play(at_fine.get::<Setup>(), piloted, &frames).1
        };
        assert_eq!(press(40.0, false), [Order::Accuracy(STEPS[0])]);
        assert_eq!(press(380.0, false), [Order::Accuracy(STEPS[5])]);
        let (left, right) = (8.0 + ENDS, 404.0 - ENDS);
        let there = left + 0.8 * (right - left);
        assert_eq!(press(there, false), [], "it is there");
        assert_eq!(press(there, true), [Order::Accuracy(STEPS[4])], "to stay there, which the autopilot would not");
    }

    #[test]
    fn a_drag_over_all_steps_orders_only_the_last() {
        let at_draft = world(Preset::Draft, 0.5);
        let mut frames = vec![vec![moved(64.0)], vec![button(64.0, true)]];
        frames.extend((1..=30).map(|k| vec![moved(64.0 + 10.0 * k as f32)]));
        frames.push(vec![button(364.0, false)]);
        assert_eq!(play(at_draft.get::<Setup>(), false, &frames).1, [Order::Accuracy(STEPS[5])]);
    }

    #[test]
    fn arrows_go_step_by_step_once_it_has_been_pressed() {
        let at_fast = world(Preset::Fast, 1.0);
        let setup = at_fast.get::<Setup>();
        assert_eq!(play(setup, false, &[vec![key(Key::ArrowRight)]]).1, [], "not in focus");
        let x = 8.0 + ENDS + 0.4 * (396.0 - 2.0 * ENDS);
        let focus = [vec![moved(x)], vec![button(x, true)], vec![button(x, false)]];
        for (pressed, expected) in [(Key::ArrowRight, 3), (Key::ArrowLeft, 1), (Key::ArrowUp, 3), (Key::ArrowDown, 1)] {
            let frames: Vec<_> = focus.iter().cloned().chain([vec![key(pressed)]]).collect();
            assert_eq!(play(setup, false, &frames).1, [Order::Accuracy(STEPS[expected])], "{pressed:?}");
        }
    }

    #[test]
    fn from_between_two_steps_either_is_next_and_the_ends_hold() {
        assert_eq!((next(3.4, 1), next(3.4, -1)), (Some(4), Some(3)));
        assert_eq!((next(5.0, 1), next(0.0, -3), next(2.0, 0)), (Some(5), Some(0), None));
    }

    #[test]
    fn it_says_where_it_stands_and_what_that_takes() {
        let says = |preset, detail| play(world(preset, detail).get::<Setup>(), false, &[]).0.pop().unwrap();
        assert_eq!(says(Preset::Draft, 0.5), "draft at detail ½: ¼ of the particles");
        assert_eq!(says(Preset::Fast, 1.0), "fast, at the scene's own detail");
        assert_eq!(says(Preset::Reference, 1.0), "reference, which is fine at detail 2: 4 × the particles");
        assert_eq!(says(Preset::Draft, 2.0), "draft, detail 2: chosen by hand");
    }
}
