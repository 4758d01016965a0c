//! The bar on top: the numbers at the left, the menus at the right.

use crate::{
    game::{
        hud::{
            HudState,
            icons::{self, Icon},
            settings::Room,
            stats::{Reading, Readings, as_text, show_reading},
            style,
        },
        input::bindings::{self, Action},
        orders::{Order, Orders, Shown},
    },
    kernel::{
        params::{Preset, Quality},
        units::TICKS_PER_SECOND,
    },
    sim::{recorder::Recorder, state::Setup, view::View},
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Color32, Layout, RichText, Ui, vec2},
};

/// Below this width the menus lose their names, points.
const NARROW: f32 = 1080.0;

/// Shows the bar.
pub fn show(
    mut contexts: EguiContexts,
    state: Res<HudState>,
    readings: Res<Readings>,
    setup: Res<Setup>,
    shown: Res<Shown>,
    recorder: Res<Recorder>,
    mut room: ResMut<Room>,
    mut orders: ResMut<Orders>,
) -> Result {
    room.top = 0.0;
    if !state.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let width = context.content_rect().width();
    let shown_bar = egui::Area::new("bar".into())
        .fixed_pos(egui::Pos2::ZERO)
        .order(egui::Order::Middle)
        .constrain(false)
        .show(context, |ui| {
            style::bar_frame().show(ui, |ui| {
                ui.set_width(width - 24.0);
                ui.horizontal(|ui| {
                    ui.set_height(26.0);
                    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                        menus(ui, width < NARROW, &state, &setup, shown.0, &mut orders);
                        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                            if let Some(ticks) = recorder.ticks() {
                                recording(ui, ticks);
                            }
                            numbers(ui, &readings);
                        });
                    });
                });
            });
        });
    room.top = shown_bar.response.rect.bottom();
    Ok(())
}

/// That there is a recording, and how long it is.
fn recording(ui: &mut Ui, ticks: u64) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        dot(ui, style::BAD);
        let seconds = ticks / u64::from(TICKS_PER_SECOND);
        ui.label(RichText::new(format!("{}:{:02}", seconds / 60, seconds % 60)).color(style::BAD)).on_hover_text(
            format!(
                "recording ({} ends it)",
                bindings::of(Action::Record).map(ToString::to_string).unwrap_or_default()
            ),
        );
    });
}

fn numbers(ui: &mut Ui, readings: &Readings) {
    ui.spacing_mut().item_spacing.x = 14.0;
    for reading in readings.pace.iter().chain([&readings.total]) {
        if ui.available_width() > width_of(reading) {
            show_reading(ui, reading);
        }
    }
    let mut hidden = false;
    for (colour, reading) in &readings.elements {
        if ui.available_width() < width_of(reading) + 40.0 {
            hidden = true;
            break;
        }
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.x = 5.0;
            let [r, g, b] = *colour;
            dot(ui, Color32::from_rgb(r, g, b));
            show_reading(ui, reading);
        });
    }
    if hidden {
        ui.label(RichText::new("…").color(style::WEAK)).on_hover_text(as_text(readings));
    }
}

/// About as wide as a reading gets, points.
fn width_of(reading: &Reading) -> f32 {
    20.0 + 7.2 * (reading.value.len() + reading.unit.len()) as f32
}

fn dot(ui: &mut Ui, colour: Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(8.0, 8.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, colour);
}

/// The menus, from right to left.
fn menus(ui: &mut Ui, narrow: bool, state: &HudState, setup: &Setup, shown: View, orders: &mut Orders) {
    ui.spacing_mut().item_spacing.x = 6.0;
    for (icon, action, open) in [
        (Icon::Question, Action::Help, state.help),
        (Icon::Gear, Action::Settings, state.settings),
        (Icon::Check, Action::Exam, state.exam),
        (Icon::Shield, Action::Gauntlet, state.gauntlet),
        (Icon::Chart, Action::Details, state.details),
        (Icon::Curve, Action::Accuracy, state.accuracy),
        (Icon::Load, Action::Saves, state.saves),
        (Icon::Save, Action::Save, false),
    ] {
        if icon_button(ui, icon, None, open).on_hover_text(tip(action)).clicked() {
            orders.push(Order::Act(action));
        }
    }
    let name = |text: &'static str| (!narrow).then_some(text);
    let quality = (!narrow).then(|| quality_name(setup.preset, &setup.quality));
    let quality = icon_button(ui, Icon::Gauge, quality.as_deref(), false);
    if let Some(preset) = quality_menu(&quality, setup.preset) {
        orders.push(Order::Quality(preset));
    }
    let view = icon_button(ui, Icon::Eye, name(shown.name()), shown != View::Elements);
    menu(&view, "View", |ui| {
        for view in View::ALL {
            let key = bindings::of(Action::View(view)).map(ToString::to_string).unwrap_or_default();
            if row(ui, view.name(), &key, view == shown) {
                orders.push(Order::Act(Action::View(view)));
            }
        }
    });
    let title = if narrow { None } else { Some(setup.blueprint.title.as_str()) };
    let scenes = icon_button(ui, Icon::Scenes, title, state.scenes);
    if scenes.on_hover_text(tip(Action::Scenes)).clicked() {
        orders.push(Order::Act(Action::Scenes));
    }
}

/// The menu of qualities under a button; says which one is chosen.
pub fn quality_menu(button: &egui::Response, now: Preset) -> Option<Preset> {
    let mut chosen = None;
    menu(button, "Quality", |ui| {
        for preset in Preset::ALL {
            if row(ui, preset.name(), about(preset), preset == now) {
                chosen = Some(preset);
            }
        }
    });
    chosen
}

/// A quality on the screen: its name, or substeps × iterations where it lies between two names.
pub fn quality_name(preset: Preset, quality: &Quality) -> String {
    if *quality == preset.quality() {
        return preset.name().to_owned();
    }
    format!("{} × {}", quality.substeps, quality.iterations)
}

fn about(preset: Preset) -> &'static str {
    match preset {
        Preset::Classic => "the plain method",
        Preset::Draft => "for weak machines",
        Preset::Fast => "cheap and calm",
        Preset::Balanced => "the default",
        Preset::Fine => "for deep water",
        Preset::Reference => "not in real time",
    }
}

fn menu(button: &egui::Response, title: &str, add: impl FnOnce(&mut Ui)) {
    egui::Popup::menu(button).gap(8.0).width(220.0).show(|ui| {
        ui.label(RichText::new(title).small().color(style::WEAK));
        ui.spacing_mut().item_spacing.y = 2.0;
        add(ui);
    });
}

/// A line of a menu: a name and something about it.
fn row(ui: &mut Ui, name: &str, about: &str, chosen: bool) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 26.0), egui::Sense::click());
    if chosen || response.hovered() {
        let fill = if chosen { style::ACCENT_FILL } else { style::BUTTON_HOVER };
        ui.painter().rect_filled(rect, style::BUTTON_CORNER, fill);
    }
    let colour = if chosen { Color32::WHITE } else { style::TEXT };
    let font = |style: egui::TextStyle| style.resolve(ui.style());
    let (left, right) = (rect.left_center() + vec2(9.0, 0.0), rect.right_center() - vec2(9.0, 0.0));
    ui.painter().text(left, egui::Align2::LEFT_CENTER, name, font(egui::TextStyle::Button), colour);
    ui.painter().text(right, egui::Align2::RIGHT_CENTER, about, font(egui::TextStyle::Small), style::WEAK);
    style::name(&response, name, chosen);
    response.clicked()
}

/// What an action does, and its key.
pub fn tip(action: Action) -> String {
    match bindings::of(action) {
        Some(binding) => format!("{} ({binding})", binding.help),
        None => String::new(),
    }
}

/// A button with an icon, and a text if there is room.
pub fn icon_button(ui: &mut Ui, icon: Icon, text: Option<&str>, active: bool) -> egui::Response {
    let galley = text.map(|text| {
        let font = egui::TextStyle::Button.resolve(ui.style());
        ui.painter().layout_no_wrap(text.to_owned(), font, Color32::PLACEHOLDER)
    });
    let width = galley.as_ref().map_or(32.0, |galley| 40.0 + galley.size().x);
    let (rect, response) = ui.allocate_exact_size(vec2(width, 26.0), egui::Sense::click());
    let widget = ui.style().interact(&response);
    let (fill, colour) = match active {
        true => (style::ACCENT_FILL, style::ACCENT),
        false => (widget.bg_fill, widget.fg_stroke.color),
    };
    ui.painter().rect_filled(rect, style::BUTTON_CORNER, fill);
    let square = icons::square(rect.left_center() + vec2(16.0, 0.0), 15.0);
    icons::draw(ui.painter(), square, icon, colour);
    if let Some(galley) = galley {
        let at = egui::pos2(rect.left() + 29.0, rect.center().y - galley.size().y / 2.0);
        ui.painter().galley(at, galley, colour);
    }
    style::name(&response, &format!("{icon:?}"), active);
    response
}
