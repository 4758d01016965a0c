//! The books of the simulation: what each stage costs, which effects run and why, what the limiters did.

use crate::{
    game::{
        hud::{
            HudCost, HudState,
            stats::{Readings, grouped},
            style,
        },
        orders::{Order, Orders},
        render::RenderCost,
    },
    scene::blueprint::{Effect, Mode},
    sim::{
        effects::Effects,
        ledger::{Pass, PassLedger},
        state::{AirGrid, Clock, ParticleStore, Setup, SleepState},
        view::View,
    },
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, RichText, Ui, vec2},
};

/// Name of the view that shows where limiters act.
const STABILITY: &str = View::Stability.name();

/// Width of the window's contents, points.
const WIDTH: f32 = 390.0;

/// Shows the books.
pub fn show(
    mut contexts: EguiContexts,
    mut state: ResMut<HudState>,
    ledger: Res<PassLedger>,
    effects: Res<Effects>,
    setup: Res<Setup>,
    clock: Res<Clock>,
    readings: Res<Readings>,
    costs: (Res<RenderCost>, Res<HudCost>),
    sleepers: (Res<SleepState>, Res<ParticleStore>, Res<AirGrid>),
    mut orders: ResMut<Orders>,
) -> Result {
    if !state.details || !state.visible {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let screen = context.content_rect();
    let mut open = true;
    let height = screen.height() - 210.0;
    let place = (egui::Align2::LEFT_TOP, screen.left_top() + vec2(14.0, 54.0));
    style::window(context, "Details", &mut open, place, |ui| {
        egui::ScrollArea::vertical().min_scrolled_height(height).max_height(height).show(ui, |ui| {
            ui.set_width(WIDTH);
            ui.spacing_mut().interact_size.y = 17.0;
            ui.spacing_mut().button_padding = vec2(6.0, 1.0);
            world(ui, &setup, &clock);
            ui.separator();
            frame(ui, &costs.0, &costs.1);
            ui.separator();
            stages(ui, &ledger);
            ui.separator();
            switches(ui, &effects, &mut orders);
            asleep(ui, &sleepers.0, &sleepers.1, &sleepers.2);
            ui.separator();
            limiters(ui, &readings);
        });
    });
    if !open {
        state.details = false;
    }
    Ok(())
}

fn weak(text: impl Into<String>) -> RichText {
    RichText::new(text).color(style::WEAK)
}

fn world(ui: &mut Ui, setup: &Setup, clock: &Clock) {
    let (blueprint, quality) = (&setup.blueprint, &setup.quality);
    let metres = blueprint.scale.vec_to_metres(blueprint.domain.size);
    ui.label(weak(format!(
        "{:.1} × {:.1} m, d = {} m, tick {} ({:.1} s)",
        metres.x,
        metres.y,
        blueprint.scale.spacing,
        grouped(clock.tick),
        clock.tick as f32 * crate::kernel::units::TICK_SECONDS,
    )));
    ui.label(weak(format!(
        "{}: substeps × iterations {} × {}, h = {} d, air cell {} d",
        setup.preset.name(),
        quality.substeps,
        quality.iterations,
        quality.kernel_radius,
        quality.air_cell,
    )));
}

fn frame(ui: &mut Ui, render: &RenderCost, hud: &HudCost) {
    let (extract, upload) = render.milliseconds();
    ui.label(weak(format!(
        "a frame: picture {extract:.2} + {upload:.2} ms, HUD {:.2} ms of processor time",
        hud.milliseconds()
    )));
}

fn stages(ui: &mut Ui, ledger: &PassLedger) {
    egui::Grid::new("stages").num_columns(3).spacing([18.0, 3.0]).show(ui, |ui| {
        for heading in ["stage", "ms a tick", "calls"] {
            ui.label(weak(heading).small());
        }
        ui.end_row();
        for pass in Pass::ALL {
            let record = ledger.record(pass);
            line(ui, pass.name(), record.median().as_secs_f32() * 1000.0, Some(record.calls));
        }
        line(ui, "tick", ledger.tick().median().as_secs_f32() * 1000.0, Some(ledger.tick().calls));
    });
}

fn line(ui: &mut Ui, name: &str, milliseconds: f32, calls: Option<u64>) {
    ui.label(name);
    ui.monospace(format!("{milliseconds:7.3}"));
    ui.monospace(calls.map(grouped).unwrap_or_default());
    ui.end_row();
}

fn switches(ui: &mut Ui, effects: &Effects, orders: &mut Orders) {
    egui::Grid::new("effects").num_columns(3).spacing([12.0, 4.0]).show(ui, |ui| {
        for effect in Effect::ALL {
            let state = effects.get(effect);
            let colour = if state.running { style::ACCENT } else { style::WEAK };
            ui.label(RichText::new(effect.name()).color(colour)).on_hover_text(effect.meaning());
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                for (mode, name) in [(Mode::Auto, "auto"), (Mode::On, "on"), (Mode::Off, "off")] {
                    if ui.selectable_label(state.mode == mode, name).clicked() {
                        orders.push(Order::Effect(effect, mode));
                    }
                }
            });
            let verb = if state.running { "runs" } else { "rests" };
            ui.label(weak(format!("{verb}: {}", state.why)));
            ui.end_row();
        }
    });
}

/// How much of the world the stages leave alone.
fn asleep(ui: &mut Ui, sleep: &SleepState, particles: &ParticleStore, air: &AirGrid) {
    let (awake, tiles) = air.awake_tiles();
    let [asleep, count] = [sleep.asleep(), particles.len()].map(|count| grouped(count as u64));
    ui.label(weak(format!("asleep: {asleep} of {count} particles, {} of {tiles} tiles of air", tiles - awake)));
}

fn limiters(ui: &mut Ui, readings: &Readings) {
    if readings.limiters.is_empty() {
        ui.label(weak("No limiter acted."));
        return;
    }
    ui.label(weak(format!("limiters, since the scene began (the view {STABILITY} shows where)")).small());
    egui::Grid::new("limiters").num_columns(4).spacing([8.0, 3.0]).show(ui, |ui| {
        for pair in readings.limiters.chunks(2) {
            for (reading, meaning) in pair {
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    ui.label(RichText::new(&reading.value).monospace().color(style::WARN));
                });
                ui.label(&reading.unit).on_hover_text(*meaning);
            }
            ui.end_row();
        }
    });
}
