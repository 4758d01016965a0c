//! What can be thrown at the world, and the verdict on how it took it. It stays beside the world that is watched.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            style::{self, weak},
            widgets::name,
            window::PanelWindow,
        },
        icons::{self, Icon},
        input::bindings::{Bindings, Group, SHIFT},
        language::{grouped, spoken},
        orders::{Order, Orders},
        panels::Panel,
        throws::Thrown,
    },
    lab::gauntlet::throws::{Progress, SECONDS, StressTest, THROWS, Throw},
    sim::state::{Clock, Setup},
};
use bevy::prelude::{KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{Align2, Button, Color32, ProgressBar, RichText, Sense, Ui, vec2};
use tr::tr;

/// Width of what can be thrown, points.
const WIDTH: f32 = 136.0;
/// In a row.
const COLUMNS: usize = 3;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("throws"),
    title: "Try to break it",
    icon: icons::pressure,
    keys: &[(KeyCode::F7, SHIFT)],
    group: Group::Look,
    help: "try to break it: hard cases at your own world",
    in_bar: false,
    in_list: Some("Try to break it"),
    stays: true,
};

/// Shows it.
pub fn show(
    mut window: PanelWindow,
    (setup, clock, bindings): (Res<Setup>, Res<Clock>, Res<Bindings>),
    (test, thrown): (Res<StressTest>, Option<Res<Thrown>>),
    mut orders: ResMut<Orders>,
) -> Result {
    let comes = thrown.is_some_and(|thrown| thrown.comes(&clock));
    let mut pressed = None;
    window.show(&PANEL, (Align2::RIGHT_TOP, vec2(-14.0, 60.0)), |ui| {
        ui.set_width(COLUMNS as f32 * (WIDTH + 6.0) - 6.0);
        ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
        ui.label(weak(tr!(
            "What breaks programs of this kind, thrown at your own world. A copy of it is judged by every rule of the stability \
             gauntlet; undo brings yours back."
        )));
        for row in THROWS.chunks(COLUMNS) {
            ui.horizontal(|ui| {
                for throw in row {
                    if button(ui, throw, &setup, comes) {
                        pressed = Some(Order::Throw(throw.name));
                    }
                }
            });
        }
        if let Some(throw) = test.throw() {
            ui.separator();
            verdict(ui, throw, test.progress(), &bindings);
        }
    })?;
    orders.extend(pressed);
    Ok(())
}

/// The button of a throw; whether it was pressed.
fn button(ui: &mut Ui, throw: &Throw, setup: &Setup, comes: bool) -> bool {
    let (lacks, title) = (throw.lacks(setup), spoken(throw.title));
    let response =
        ui.add_enabled_ui(!comes && lacks.is_none(), |ui| ui.add_sized(vec2(WIDTH, 30.0), Button::new(&title))).inner;
    name(&response, &title, false);
    let why = lacks.map(|element| {
        let element = spoken(element);
        tr!("This world knows no {}.", element)
    });
    response
        .on_hover_text(spoken(throw.what))
        .on_disabled_hover_text(why.unwrap_or_else(|| tr!("It still comes.")))
        .clicked()
}

/// What came of it.
fn verdict(ui: &mut Ui, throw: &Throw, progress: &Progress, bindings: &Bindings) {
    let title = spoken(throw.title);
    match progress {
        Progress::Idle => {}
        Progress::Running(share) => {
            let so_far = format!("{:.1}", share * SECONDS as f32);
            let text = tr!("{title}: judged for {so_far} of {all} s", title, so_far, all = SECONDS);
            ui.add(ProgressBar::new(*share).text(text));
        }
        Progress::Held { particles, nearest } => {
            told(ui, (icons::check, style::GOOD), &tr!("{}: held", title));
            let what = tr!(
                "{seconds} s by every rule, {particles} particles at the end. Nearest to a bound: {nearest}.",
                seconds = SECONDS,
                particles = grouped(*particles),
                nearest
            );
            ui.label(weak(what).small());
        }
        Progress::Broke { faults, known } => {
            let (text, colour) = match known {
                true => (tr!("{}: as known", title), style::WARN),
                false => (tr!("{}: broken", title), style::BAD),
            };
            told(ui, (icons::close, colour), &text);
            faults.iter().for_each(|fault| drop(ui.label(RichText::new(fault).small())));
            let what = match known {
                true => tr!("Without the pressure predictor the method is known for this."),
                false => {
                    let key = bindings.key(Action::KeepLastMinute);
                    tr!("{} keeps the last minute as a recording.", key)
                }
            };
            ui.label(weak(what).small());
        }
    }
}

/// A mark and a line beside it.
fn told(ui: &mut Ui, (icon, colour): (Icon, Color32), text: &str) {
    ui.horizontal(|ui| {
        let (rect, _) = ui.allocate_exact_size(vec2(14.0, 18.0), Sense::hover());
        icons::draw(ui.painter(), icons::square(rect.center(), 12.0), icon, colour);
        ui.label(RichText::new(text).color(Color32::WHITE));
    });
}
