//! The window of a suite of cases: what it is, the buttons of its job queue, and what the suite shows of its rows.

use crate::{
    game::{
        hud::{
            style::{self, weak},
            widgets::main_button,
            window::{MIDDLE, PanelWindow},
        },
        icons::{self, Icon},
        language::spoken,
        orders::{Order, Orders},
        panels::{Panel, Panels},
    },
    kernel::params::Preset,
    lab::cases::{self, Case, JobQueue, Progress, Row, Verdict},
    sim::state::Setup,
};
use bevy::prelude::{App, Res, ResMut, Result};
use bevy_egui::egui::{self, Color32, RichText, Ui};
use tr::tr;

/// What is particular to the window of a suite.
pub trait Suite: Case {
    /// Its row.
    const PANEL: Panel;
    /// What it is for.
    const PURPOSE: &'static str;
    /// The button that begins.
    const BEGIN: &'static str;
    /// Width of its contents, points.
    const WIDTH: f32;

    /// Shows the rows, on a screen `height` points high. Gives what was clicked.
    fn show(ui: &mut Ui, rows: &[Row<Self::Figures>], setup: &Setup, height: f32) -> Option<Order>;
}

/// Adds the panel of a suite, and what runs its jobs.
pub fn plugin<C: Suite>(app: &mut App) {
    app.add_plugins(cases::plugin::<C>);
    Panels::add(app, C::PANEL, show::<C>);
}

/// Shows the window of a suite.
fn show<C: Suite>(
    mut window: PanelWindow,
    setup: Res<Setup>,
    mut queue: ResMut<JobQueue<C>>,
    mut orders: ResMut<Orders>,
) -> Result {
    window.show(&C::PANEL, MIDDLE, |ui| {
        ui.set_width(C::WIDTH);
        ui.label(weak(spoken(C::PURPOSE)));
        ui.horizontal(|ui| {
            buttons(ui, &mut queue, setup.preset);
            progress(ui, queue.progress());
        });
        let height = ui.ctx().content_rect().height();
        orders.extend(C::show(ui, queue.rows(), &setup, height));
    })
}

/// Begins and stops.
fn buttons<C: Suite>(ui: &mut Ui, queue: &mut JobQueue<C>, preset: Preset) {
    if queue.is_running() {
        if main_button(ui, &tr!("Stop")).clicked() {
            queue.stop();
        }
        return;
    }
    if main_button(ui, &spoken(C::BEGIN)).on_hover_text(tr!("the quality that is played at")).clicked() {
        queue.begin(&[preset]);
    }
    if ui.button(tr!("all qualities")).on_hover_text(tr!("takes some minutes")).clicked() {
        queue.begin(&Preset::ALL);
    }
}

fn progress(ui: &mut Ui, progress: &Progress) {
    match progress {
        Progress::Idle => {}
        Progress::Running { done, of, now } => {
            let share = *done as f32 / (*of).max(1) as f32;
            ui.add(egui::ProgressBar::new(share).desired_width(160.0).text(tr!("{done} of {of}", done, of)));
            ui.label(weak(now).small());
        }
        Progress::Done => drop(ui.label(weak(tr!("done")))),
        Progress::Stopped => drop(ui.label(weak(tr!("stopped")))),
        Progress::Broken(why) => drop(ui.label(RichText::new(why).color(style::WARN))),
    }
}

/// How a verdict looks.
pub(super) fn mark(verdict: Verdict) -> (Icon, Color32) {
    match verdict {
        Verdict::Pass => (icons::check, style::GOOD),
        Verdict::Shown => (icons::check, style::WEAK),
        Verdict::Miss | Verdict::Known => (icons::close, style::WARN),
        Verdict::Fail => (icons::close, style::BAD),
    }
}
