//! The bar on top: the numbers at the left, the menus at the right.

use crate::{
    game::{
        actions::Action,
        hud::{
            layout::Bars,
            panels::scenes::panel as scenes,
            stats::{Reading, Readings, as_text, show_reading},
            style,
            widgets::{action_button, hold_button, icon_button, menu, quality_menu, quality_name, row},
        },
        icons,
        input::bindings::Bindings,
        language::spoken,
        orders::{Order, Orders},
        panels::Panels,
        sound::{Output, volume::Volume},
        views::table::{ELEMENTS, Shown, VIEWS},
    },
    kernel::units::TICKS_PER_SECOND,
    sim::{pace::Pace, recorder::Recorder, state::Setup},
};
use bevy::{
    ecs::system::SystemParam,
    prelude::{Res, ResMut, Result},
};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align, Color32, Layout, RichText, Ui, vec2},
};
use tr::tr;

/// Below this width the menus lose their names, points.
const NARROW: f32 = 1080.0;

/// What the bar shows.
#[derive(SystemParam)]
pub struct Shows<'w> {
    panels: Res<'w, Panels>,
    readings: Res<'w, Readings>,
    setup: Res<'w, Setup>,
    view: Res<'w, Shown>,
    recorder: Res<'w, Recorder>,
    volume: Res<'w, Volume>,
    output: Res<'w, Output>,
    bindings: Res<'w, Bindings>,
    pace: Res<'w, Pace>,
}

/// Shows the bar.
pub fn show(mut contexts: EguiContexts, shows: Shows, mut bars: ResMut<Bars>, mut orders: ResMut<Orders>) -> Result {
    bars.top = 0.0;
    if !shows.panels.visible {
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
                        menus(ui, width < NARROW, &shows, &mut orders);
                        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                            if let Some(ticks) = shows.recorder.ticks() {
                                recording(ui, ticks, &shows.bindings);
                            }
                            numbers(ui, &shows.readings);
                        });
                    });
                });
            });
        });
    bars.top = shown_bar.response.rect.bottom();
    Ok(())
}

/// That there is a recording, and how long it is.
fn recording(ui: &mut Ui, ticks: u64, bindings: &Bindings) {
    let key = bindings.key(Action::Record);
    let tip = tr!("recording ({} ends it)", key);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 5.0;
        dot(ui, style::BAD);
        let seconds = ticks / u64::from(TICKS_PER_SECOND);
        ui.label(RichText::new(format!("{}:{:02}", seconds / 60, seconds % 60)).color(style::BAD)).on_hover_text(tip);
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
    20.0 + 7.2 * (reading.value.chars().count() + reading.unit.chars().count()) as f32
}

fn dot(ui: &mut Ui, colour: Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(8.0, 8.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, colour);
}

/// The menus, from right to left.
fn menus(ui: &mut Ui, narrow: bool, shows: &Shows, orders: &mut Orders) {
    let Shows { panels, setup, view: shown, bindings, .. } = shows;
    ui.spacing_mut().item_spacing.x = 6.0;
    let text = |text: String| if narrow { String::new() } else { text };
    for (panel, open) in panels.iter().filter(|(panel, _)| panel.in_bar) {
        action_button(ui, panel.icon, "", Action::Panel(panel.id), open, (bindings, orders));
    }
    action_button(ui, icons::save, "", Action::Save, false, (bindings, orders));
    hold_button(ui, icons::rewind, Action::Rewind, shows.pace.rewinds, (bindings, orders));
    volume(ui, shows, orders);
    let quality = quality_name(setup.preset, &setup.quality);
    let quality = icon_button(ui, (icons::gauge, &tr!("quality")), &text(quality), false);
    if let Some(preset) = quality_menu(&quality, setup.preset) {
        orders.push(Order::Quality(preset));
    }
    let view = icon_button(ui, (icons::eye, &tr!("view")), &text(spoken(shown.0.name)), *shown.0 != ELEMENTS);
    menu(&view, &tr!("View"), |ui| {
        for view in VIEWS {
            if row(ui, &spoken(view.name), &bindings.key(Action::View(view)), view == shown.0) {
                orders.push(Order::Act(Action::View(view)));
            }
        }
    });
    let (title, open) = (text(spoken(&setup.blueprint.title)), panels.shows(scenes::PANEL.id));
    action_button(ui, icons::scenes, &title, Action::Panel(scenes::PANEL.id), open, (bindings, orders));
}

/// The loudspeaker, and under it how loud it is.
fn volume(ui: &mut Ui, Shows { volume, output, bindings, .. }: &Shows, orders: &mut Orders) {
    let (plays, silent) = (output.may_play(), volume.gain() == 0.0);
    let icon = if silent || !plays { icons::muted } else { icons::sound };
    let button = icon_button(ui, (icon, &tr!("sound")), "", false);
    if !plays {
        button.on_hover_text(tr!("There is no sound: this machine has no output for it"));
        return;
    }
    menu(&button, &tr!("Volume"), |ui| {
        let mut level = volume.level();
        let slider = egui::Slider::new(&mut level, 0.0..=1.0).show_value(false);
        let moved = ui.add(slider);
        moved.widget_info(|| egui::WidgetInfo::slider(true, f64::from(level), tr!("volume")));
        if moved.changed() {
            orders.push(Order::Volume(level));
        }
        if row(ui, &tr!("mute"), &bindings.key(Action::Mute), volume.is_muted()) {
            orders.push(Order::Act(Action::Mute));
        }
    });
    button.on_hover_text(bindings.tip(Action::Mute));
}
