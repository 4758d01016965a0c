//! The stability gauntlet: its cases, each to be watched, and how they came out.

use crate::{
    game::{
        actions::PanelId,
        hud::{panels::desk, style},
        icons::{self, Icon},
        input::bindings::{Group, NONE},
        orders::{Order, Orders},
        panels::{Panel, Panels},
    },
    kernel::params::Preset,
    sim::{
        gauntlet::{Cases, Entry, GauntletDesk, Row, Verdict},
        state::Setup,
    },
};
use bevy::prelude::{App, KeyCode, Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, RichText, Ui, pos2, vec2},
};

/// Its name.
pub const ID: PanelId = PanelId("gauntlet");

/// Width of the window's contents, points.
const WIDTH: f32 = 620.0;
/// Height of a line, points.
const LINE: f32 = 24.0;
/// Where a line's title begins, points.
const TITLE: f32 = 24.0;
/// Where the first of the marks stands, one for each quality, points.
const MARKS: f32 = 400.0;
/// From one mark to the next, points.
const MARK: f32 = 34.0;

/// Adds the panel.
pub fn plugin(app: &mut App) {
    app.init_resource::<GauntletDesk>().init_resource::<Cases>();
    let panel = Panel {
        id: ID,
        title: "Stability gauntlet",
        icon: icons::shield,
        keys: &[(KeyCode::F7, NONE)],
        group: Group::Look,
        help: "stability gauntlet: hard cases, to watch and to run",
        in_bar: true,
        in_list: Some("Hard cases"),
        stays: false,
    };
    Panels::add(app, panel, show);
}

/// Shows the gauntlet.
fn show(
    mut contexts: EguiContexts,
    mut panels: ResMut<Panels>,
    setup: Res<Setup>,
    cases: Res<Cases>,
    mut desk: ResMut<GauntletDesk>,
    mut orders: ResMut<Orders>,
) -> Result {
    let context = contexts.ctx_mut()?;
    let screen = context.content_rect();
    let place = (Align2::CENTER_CENTER, screen.center());
    style::panel(context, &mut panels, ID, place, |ui| {
        ui.set_width(WIDTH);
        let about = "What breaks programs of this kind. Click a case to watch it; run them all in the background to see \
                     how they come out.";
        ui.label(RichText::new(about).color(style::WEAK));
        if let Some(wanted) = desk::controls(ui, &desk, setup.preset, "Run all") {
            desk.wanted = wanted;
        }
        ui.separator();
        headings(ui);
        if let Some(name) = list(ui, &cases.0, &desk.rows, &setup, (screen.height() - 330.0).max(4.0 * LINE)) {
            orders.push(Order::Watch(name));
        }
    });
    Ok(())
}

/// The qualities above their marks.
fn headings(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(WIDTH, 14.0), egui::Sense::hover());
    let font = egui::FontId::proportional(9.5);
    for (column, preset) in Preset::ALL.into_iter().enumerate() {
        let at = pos2(rect.left() + MARKS + MARK * column as f32, rect.center().y);
        ui.painter().text(at, Align2::CENTER_CENTER, preset.name(), font.clone(), style::WEAK);
    }
}

/// The cases; the one that was clicked. Of a long list only what is seen is laid out.
fn list(ui: &mut Ui, cases: &[Entry], rows: &[Row], setup: &Setup, height: f32) -> Option<&'static str> {
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut clicked = None;
    egui::ScrollArea::vertical().max_height(height).show_rows(ui, LINE, cases.len(), |ui, seen| {
        for case in &cases[seen] {
            let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, LINE), egui::Sense::click());
            if response.hovered() {
                ui.painter().rect_filled(rect, style::BUTTON_CORNER, style::BUTTON_HOVER);
            }
            let is_watched = setup.blueprint.name.strip_prefix("gauntlet_") == Some(case.name);
            let colour = if is_watched { style::ACCENT } else { style::TEXT };
            icons::draw(
                ui.painter(),
                icons::square(rect.left_center() + vec2(11.0, 0.0), 9.0),
                icons::play,
                style::WEAK,
            );
            let font = egui::TextStyle::Body.resolve(ui.style());
            let at = pos2(rect.left() + TITLE, rect.center().y);
            ui.painter().text(at, Align2::LEFT_CENTER, case.title, font, colour);
            for (column, preset) in Preset::ALL.into_iter().enumerate() {
                if let Some((icon, colour)) = outcome(rows, case.name, preset).map(|row| mark(row.verdict)) {
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

/// The row of a case at a quality, if it was run.
fn outcome<'a>(rows: &'a [Row], case: &str, preset: Preset) -> Option<&'a Row> {
    rows.iter().rev().find(|row| row.case == case && row.quality == preset.name())
}

/// What happens in a case, and what broke where.
fn about(case: &Entry, rows: &[Row]) -> String {
    let broken = rows.iter().filter(|row| row.case == case.name && !row.broken.is_empty());
    broken.fold(case.what.to_owned(), |text, row| {
        let known = row.known.map_or_else(String::new, |known| format!(" (known: {known})"));
        format!("{text}\n\nAt {}: {}{known}", row.quality, row.broken.join("; "))
    })
}

/// How a verdict looks.
fn mark(verdict: Verdict) -> (Icon, Color32) {
    match verdict {
        Verdict::Pass => (icons::check, style::GOOD),
        Verdict::Known => (icons::close, style::WARN),
        Verdict::Fail => (icons::close, style::BAD),
    }
}
