//! The statistics of the simulation: what each stage costs, what it works on and is spared, which effects run and why, what the
//! limiters did.

use crate::{
    game::{
        actions::PanelId,
        frame::Tempo,
        hud::{
            cost::HudCost,
            stats::Readings,
            style::{self, weak},
            widgets,
            window::{PanelWindow, scroll},
        },
        icons,
        input::bindings::{Group, NONE},
        language::{grouped, spoken},
        orders::{Order, Orders},
        panels::Panel,
        render::cost::{PicturePass, RenderCost},
        sound::SoundCost,
        views::table::STABILITY,
    },
    kernel::units::TICKS_PER_SECOND,
    scene::{
        effects::{Effect, Mode},
        passes::{Pass, Unit},
    },
    sim::{
        effects::{
            Effects,
            status::{self, EffectStatus, Sleepers},
        },
        ledger::{PassLedger, PassRecord},
        state::{Acted, AirGrid, Clock, ParticleStore, Setup, SleepState},
    },
};
use bevy::prelude::{KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{self, Align2, RichText, Ui, vec2};
use tr::tr;

/// Width of the window's contents, points.
const WIDTH: f32 = 480.0;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("details"),
    title: "Details",
    icon: icons::chart,
    keys: &[(KeyCode::F3, NONE)],
    group: Group::Look,
    help: "details: what runs and what it costs",
    in_bar: true,
    in_list: Some("Details and effects"),
    stays: true,
};

/// Shows them.
pub fn show(
    mut window: PanelWindow,
    ledger: Res<PassLedger>,
    effects: Res<Effects>,
    setup: Res<Setup>,
    clock: Res<Clock>,
    (readings, tempo): (Res<Readings>, Res<Tempo>),
    costs: (Res<RenderCost>, Res<HudCost>, Res<SoundCost>),
    sleepers: (Res<SleepState>, Res<ParticleStore>, Res<AirGrid>),
    mut orders: ResMut<Orders>,
) -> Result {
    window.show(&PANEL, (Align2::LEFT_TOP, vec2(14.0, 54.0)), |ui| {
        scroll(ui, 210.0, |ui| {
            ui.set_width(WIDTH);
            ui.spacing_mut().interact_size.y = 17.0;
            ui.spacing_mut().button_padding = vec2(6.0, 1.0);
            world(ui, &setup, &clock);
            ui.separator();
            pace(ui, &tempo, &ledger);
            frame(ui, &costs.0, &costs.1);
            sound(ui, &costs.2);
            ui.separator();
            stages(ui, &ledger);
            ui.separator();
            let sleepers = Sleepers::of(&sleepers.0, &sleepers.1, &sleepers.2);
            switches(ui, &effects, &ledger, sleepers, &mut orders);
            asleep(ui, sleepers);
            ui.separator();
            limiters(ui, &readings);
        });
    })
}

fn world(ui: &mut Ui, setup: &Setup, clock: &Clock) {
    let (blueprint, quality) = (&setup.blueprint, &setup.quality);
    let metres = blueprint.scale.vec_to_metres(blueprint.domain.size);
    let advection = spoken(quality.air_advection.words());
    ui.label(weak(tr!(
        "{width} × {height} m, d = {spacing} m (detail {detail}), tick {tick} ({seconds} s)",
        width = format_args!("{:.1}", metres.x),
        height = format_args!("{:.1}", metres.y),
        spacing = blueprint.scale.spacing,
        detail = blueprint.scale.detail,
        tick = grouped(clock.tick),
        seconds = format_args!("{:.1}", clock.tick as f32 * crate::kernel::units::TICK_SECONDS)
    )));
    ui.label(weak(tr!(
        "{quality}: substeps × iterations {substeps} × {iterations}, h = {radius} d, air cell {cell} d, {advection}",
        quality = setup.preset.name(),
        substeps = quality.substeps,
        iterations = quality.iterations,
        radius = quality.kernel_radius,
        cell = quality.air_cell,
        advection
    )));
}

/// How fast frames and ticks come, and what a tick takes.
fn pace(ui: &mut Ui, tempo: &Tempo, ledger: &PassLedger) {
    let tick = ledger.tick().median().as_secs_f32() * 1000.0;
    let (frames, ticks) = (tempo.frames_per_second, tempo.ticks_per_second);
    let text = tr!(
        "{frames} frames and {ticks} of {wanted} ticks a second; a tick takes {tick} ms",
        frames = format_args!("{frames:.0}"),
        ticks = format_args!("{ticks:.0}"),
        wanted = TICKS_PER_SECOND,
        tick = format_args!("{tick:.2}")
    );
    let late = tempo.lag.is_some() || tick > 1000.0 / TICKS_PER_SECOND as f32;
    ui.label(if late { RichText::new(text).color(style::WARN) } else { weak(text) });
}

fn frame(ui: &mut Ui, render: &RenderCost, hud: &HudCost) {
    let [extract, pack, upload] = render.milliseconds();
    ui.label(weak(tr!(
        "a frame: picture {extract} + {pack} + {upload} ms, HUD {hud} ms of processor time",
        extract = format_args!("{extract:.2}"),
        pack = format_args!("{pack:.2}"),
        upload = format_args!("{upload:.2}"),
        hud = format_args!("{:.2}", hud.milliseconds())
    )));
    // Passes that draw nothing are not called.
    let drawn = PicturePass::ALL.into_iter().zip(render.drawn()).filter(|(_, count)| *count > 0);
    let drawn: Vec<String> =
        drawn.map(|(pass, count)| format!("{} {}", pass.name(), grouped(u64::from(count)))).collect();
    ui.label(weak(tr!("the picture draws: {}", drawn.join(", "))).small());
}

fn sound(ui: &mut Ui, cost: &SoundCost) {
    let each = format!("{:.2}", cost.milliseconds());
    let listening = tr!("sound: {calls} calls, {each} ms each", calls = grouped(cost.calls()), each);
    let playing = cost.playing().map(|playing| tr!("; {} ms to play a second", format_args!("{playing:.1}")));
    ui.label(weak(listening + &playing.unwrap_or_default()));
}

/// Columns of the stages, and what they mean.
const COLUMNS: [(&str, &str); 6] = [
    ("stage", "a pass over particles or cells"),
    ("ms a tick", "median of the last second"),
    ("calls", "in the last tick"),
    ("worked on", "particles, or cells of the air, in the last tick; each as often as it was worked on"),
    ("spared", "those that sleep, and all where the stage is not called"),
    ("saves ms", "what was spared, times what the stage takes for one; ? if it never ran"),
];

fn stages(ui: &mut Ui, ledger: &PassLedger) {
    egui::Grid::new("stages").num_columns(COLUMNS.len()).spacing([12.0, 3.0]).show(ui, |ui| {
        let [(stage, meaning), figures @ ..] = COLUMNS;
        ui.label(weak(spoken(stage)).small()).on_hover_text(spoken(meaning));
        for (heading, meaning) in figures {
            widgets::to_the_right(ui, weak(spoken(heading)).small()).on_hover_text(spoken(meaning));
        }
        ui.end_row();
        for pass in Pass::ALL {
            row(ui, pass, ledger.record(pass));
        }
        ui.label(tr!("tick"));
        widgets::to_the_right(ui, milliseconds(ledger.tick()));
        for _ in 0..3 {
            ui.label("");
        }
        let saved = Pass::ALL.map(|pass| ledger.record(pass).saved_last());
        let known: f64 = saved.iter().flatten().sum();
        let all = saved.iter().all(Option::is_some);
        widgets::to_the_right(ui, format!("{known:.3}{}", if all { "" } else { " + ?" }));
        ui.end_row();
    });
}

fn row(ui: &mut Ui, pass: Pass, record: &PassRecord) {
    let colour = if record.last.calls > 0 { style::TEXT } else { style::WEAK };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let calls = tr!("{} calls since the scene began", grouped(record.calls));
        ui.label(RichText::new(pass.name()).color(colour)).on_hover_text(calls);
        if pass.unit() != Unit::Particles {
            ui.label(weak(pass.unit().name()).small());
        }
    });
    let last = &record.last;
    let counts = [grouped(last.calls), grouped(last.touched), grouped(last.spared)];
    for text in [milliseconds(record)].into_iter().chain(counts).chain([saved(record.saved_last())]) {
        widgets::to_the_right(ui, RichText::new(text).color(colour));
    }
    ui.end_row();
}

fn milliseconds(record: &PassRecord) -> String {
    format!("{:.3}", record.median().as_secs_f32() * 1000.0)
}

/// Milliseconds that were saved: nothing where nothing was.
fn saved(milliseconds: Option<f64>) -> String {
    match milliseconds {
        Some(0.0) => "–".to_owned(),
        Some(milliseconds) => format!("{milliseconds:.3}"),
        None => "?".to_owned(),
    }
}

fn switches(ui: &mut Ui, effects: &Effects, ledger: &PassLedger, sleepers: Sleepers, orders: &mut Orders) {
    egui::Grid::new("effects").num_columns(4).spacing([12.0, 4.0]).show(ui, |ui| {
        ui.label(weak(tr!("effect")).small());
        ui.label("");
        let meaning = tr!("what it takes when it runs; of sleep, what those take that sleep; ? if it never ran");
        widgets::to_the_right(ui, weak(tr!("saves ms")).small()).on_hover_text(meaning);
        ui.end_row();
        for effect in Effect::ALL {
            let status = EffectStatus::of(effect, effects, sleepers);
            let colour = if status.works { style::ACCENT } else { style::WEAK };
            ui.label(RichText::new(effect.name()).color(colour)).on_hover_text(explanation(effect));
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                for (mode, name) in [(Mode::Auto, "auto"), (Mode::On, "on"), (Mode::Off, "off")] {
                    if ui.selectable_label(status.mode == mode, name).clicked() {
                        orders.push(Order::Effect(effect, mode));
                    }
                }
            });
            let saving = status::saving(effect, effects, ledger, PassRecord::saved_last);
            widgets::to_the_right(ui, weak(saved(saving)));
            ui.add(egui::Label::new(weak(said(&status))).truncate());
            ui.end_row();
        }
    });
}

/// Why an effect works or does not, or how much of what it works on sleeps.
fn said(status: &EffectStatus) -> String {
    let Some((asleep, all, unit)) = status.asleep else {
        return format!("{}: {}", spoken(status.activity.name()), spoken(&status.why));
    };
    let (some, all, unit) = (grouped(asleep as u64), grouped(all as u64), spoken(unit));
    if some == all { tr!("asleep: all {} {}", all, unit) } else { tr!("asleep: {} of {} {}", some, all, unit) }
}

/// What the table says of an effect, as the documents have it.
fn explanation(effect: Effect) -> String {
    let row = effect.row();
    let plain = |text: &str| text.replace('`', "");
    let mut text =
        format!("{}.\nstage: {}\nauto: runs while {}", row.meaning, effect.place("a part of"), plain(row.when));
    text += &format!("\noff: {}", plain(row.off));
    if !row.parameters.is_empty() {
        text += &format!("\nparameters: {}", row.parameters.join(", "));
    }
    text
}

/// How much of the world the stages leave alone.
fn asleep(ui: &mut Ui, sleepers: Sleepers) {
    let [(asleep, particles), (still, tiles)] =
        [sleepers.particles, sleepers.tiles].map(|(asleep, all)| (grouped(asleep as u64), grouped(all as u64)));
    ui.label(weak(tr!(
        "asleep: {asleep} of {particles} particles, {still} of {tiles} tiles of air",
        asleep,
        particles,
        still,
        tiles
    )));
}

fn limiters(ui: &mut Ui, readings: &Readings) {
    if readings.limiters.is_empty() {
        ui.label(weak(tr!("No limiter acted.")));
        return;
    }
    let view = spoken(STABILITY.name);
    ui.label(weak(tr!("limiters, since the scene began (the view {} shows where)", view)).small());
    egui::Grid::new("limiters").num_columns(4).spacing([8.0, 3.0]).show(ui, |ui| {
        for pair in readings.limiters.chunks(2) {
            for Acted { what, meaning, count } in pair {
                widgets::to_the_right(ui, RichText::new(grouped(*count)).color(style::WARN));
                ui.label(spoken(what)).on_hover_text(spoken(meaning));
            }
            ui.end_row();
        }
    });
}
