//! The stability gauntlet: its cases, each to be watched, and how they came out.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            panels::{
                cases::window::{Suite, mark},
                throws,
            },
            style,
            widgets::{self, field},
        },
        icons,
        input::bindings::{Group, NONE},
        orders::Order,
        panels::Panel,
    },
    kernel::params::Preset,
    lab::{
        cases::Row,
        gauntlet::{CASES, GauntletCase, Stability},
    },
    sim::state::Setup,
};
use bevy::prelude::KeyCode;
use bevy_egui::egui::{self, Align2, Ui, pos2, vec2};
use tr::tr;

/// Height of a line, points.
const LINE: f32 = 24.0;
/// Where a line's title begins, points.
const TITLE: f32 = 24.0;
/// Where the first of the marks stands, one for each quality, points.
const MARKS: f32 = 430.0;
/// From one mark to the next, points.
const MARK: f32 = 56.0;

impl Suite for GauntletCase {
    const PANEL: Panel = Panel {
        id: PanelId("gauntlet"),
        title: "Stability gauntlet",
        icon: icons::shield,
        keys: &[(KeyCode::F7, NONE)],
        group: Group::Look,
        help: "stability gauntlet: hard cases, to watch and to run",
        in_bar: true,
        in_list: Some("Hard cases"),
        stays: false,
    };
    const PURPOSE: &'static str = "What breaks programs of this kind. Click a case to watch it; run them all in the background \
                                   to see how they come out.";
    const BEGIN: &'static str = "Run all";
    const WIDTH: f32 = 740.0;

    fn show(ui: &mut Ui, rows: &[Row<Stability>], setup: &Setup, height: f32) -> Option<Order> {
        let throw =
            ui.button(tr!("Try to break it")).on_hover_text(tr!("throw hard cases at your own world")).clicked();
        ui.separator();
        headings(ui);
        let watched = list(ui, rows, setup, (height - 360.0).max(4.0 * LINE)).map(Order::Watch);
        watched.or(throw.then_some(Order::Act(Action::Panel(throws::PANEL.id))))
    }
}

/// The qualities above their marks.
fn headings(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(GauntletCase::WIDTH, 14.0), egui::Sense::hover());
    let font = egui::FontId::proportional(style::SMALL);
    for (column, preset) in Preset::ALL.into_iter().enumerate() {
        let at = pos2(rect.left() + MARKS + MARK * column as f32, rect.center().y);
        ui.painter().text(at, Align2::CENTER_CENTER, preset.name(), font.clone(), style::WEAK);
    }
}

/// The cases; the one that was clicked. Of a long list only what is seen is laid out.
fn list(ui: &mut Ui, rows: &[Row<Stability>], setup: &Setup, height: f32) -> Option<&'static str> {
    let cases: Vec<&GauntletCase> = CASES.iter().filter(|case| case.is_watchable()).collect();
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut clicked = None;
    egui::ScrollArea::vertical().max_height(height).show_rows(ui, LINE, cases.len(), |ui, seen| {
        for &case in &cases[seen] {
            let (rect, response) = field(ui, vec2(GauntletCase::WIDTH, LINE), case.title, false, widgets::LINE);
            let colour = if case.is_played(setup) { style::ACCENT } else { style::TEXT };
            let triangle = icons::square(rect.left_center() + vec2(11.0, 0.0), 9.0);
            icons::draw(ui.painter(), triangle, icons::play, style::WEAK);
            let font = egui::TextStyle::Body.resolve(ui.style());
            let at = pos2(rect.left() + TITLE, rect.center().y);
            ui.painter().text(at, Align2::LEFT_CENTER, case.title, font, colour);
            for (column, preset) in Preset::ALL.into_iter().enumerate() {
                if let Some((icon, colour)) = outcome(rows, case, preset).map(|row| mark(row.verdict)) {
                    let at = pos2(rect.left() + MARKS + MARK * column as f32, rect.center().y);
                    icons::draw(ui.painter(), icons::square(at, 11.0), icon, colour);
                }
            }
            let response = response.on_hover_ui(|ui| drop(ui.label(about(case, rows))));
            if response.clicked() {
                clicked = Some(case.name);
            }
        }
    });
    clicked
}

/// The row of a case at a quality, if it or one that gives the same was run.
fn outcome<'a>(rows: &'a [Row<Stability>], case: &GauntletCase, preset: Preset) -> Option<&'a Row<Stability>> {
    rows.iter().rev().find(|row| row.case == case.name && case.over.same(row.preset, preset))
}

/// What happens in a case, and what broke where.
fn about(case: &GauntletCase, rows: &[Row<Stability>]) -> String {
    let broken = rows.iter().filter(|row| row.case == case.name && !row.figures.broken.is_empty());
    broken.fold(case.what.to_owned(), |text, row| {
        let known = row.figures.known.map_or_else(String::new, |known| format!(" (known: {known})"));
        format!("{text}\n\nAt {}: {}{known}", row.setting, row.figures.broken.join("; "))
    })
}
