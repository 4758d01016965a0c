//! The physics exam: its rows as they come, while the game goes on.

use crate::{
    game::{
        actions::{Action, PanelId},
        hud::{
            panels::{
                cases::window::{Suite, mark},
                museum,
            },
            style,
        },
        icons,
        input::bindings::{Group, NONE},
        language::{grouped, spoken},
        orders::Order,
        panels::Panel,
    },
    lab::{
        cases::{Row, Verdict},
        exam::{Answer, ExamCase},
    },
    sim::state::Setup,
};
use bevy::prelude::KeyCode;
use bevy_egui::egui::{self, Align2, Color32, RichText, Ui, pos2, vec2};
use tr::tr;

/// Height of a line, points.
const LINE: f32 = 19.0;
/// Where the columns are, points: the first two from their left edge, the figures from their right.
const COLUMNS: [f32; 7] = [24.0, 268.0, 486.0, 566.0, 640.0, 704.0, 750.0];
/// Their headings.
const HEADINGS: [&str; 7] = ["", "at", "expected", "got", "error", "allowed", "ms"];

impl Suite for ExamCase {
    const PANEL: Panel = Panel {
        id: PanelId("exam"),
        title: "Physics exam",
        icon: icons::check,
        keys: &[(KeyCode::F6, NONE)],
        group: Group::Look,
        help: "physics exam: known answers, computed and compared",
        in_bar: true,
        in_list: Some("Physics exam"),
        stays: false,
    };
    const PURPOSE: &'static str = "Known answers of theory and experiment, computed in the background and compared.";
    const BEGIN: &'static str = "Examine";
    const WIDTH: f32 = 760.0;

    fn show(ui: &mut Ui, rows: &[Row<Answer>], _setup: &Setup, height: f32) -> Option<Order> {
        let see = ui.button(tr!("Museum")).on_hover_text(tr!("see them, with theory drawn over the world")).clicked();
        if !rows.is_empty() {
            ui.separator();
            headings(ui);
            table(ui, rows, (height - 350.0).max(4.0 * LINE));
            ui.separator();
            summary(ui, rows);
        }
        see.then_some(Order::Act(Action::Panel(museum::PANEL.id)))
    }
}

fn headings(ui: &mut Ui) {
    let (rect, _) = ui.allocate_exact_size(vec2(ExamCase::WIDTH, LINE), egui::Sense::hover());
    let font = egui::TextStyle::Small.resolve(ui.style());
    for (column, heading) in HEADINGS.into_iter().enumerate() {
        put(ui, rect, column, &spoken(heading), &font, style::WEAK);
    }
}

/// A line of the table.
enum Line<'a> {
    /// The case that the rows below belong to.
    Case(&'static str),
    /// A row.
    Row(&'a Row<Answer>),
}

/// The rows under the names of their cases.
fn lines(rows: &[Row<Answer>]) -> Vec<Line<'_>> {
    let mut lines = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        if k == 0 || rows[k - 1].case != row.case {
            lines.push(Line::Case(row.title));
        }
        lines.push(Line::Row(row));
    }
    lines
}

/// The rows; of a long table only what is seen is laid out.
fn table(ui: &mut Ui, rows: &[Row<Answer>], height: f32) {
    let lines = lines(rows);
    ui.spacing_mut().item_spacing.y = 0.0;
    let area = egui::ScrollArea::vertical().max_height(height).stick_to_bottom(true);
    area.show_rows(ui, LINE, lines.len(), |ui, seen| {
        for line in &lines[seen] {
            let (rect, _) = ui.allocate_exact_size(vec2(ExamCase::WIDTH, LINE), egui::Sense::hover());
            match line {
                Line::Case(title) => {
                    let font = egui::TextStyle::Button.resolve(ui.style());
                    ui.painter().text(rect.left_center(), Align2::LEFT_CENTER, title, font, Color32::WHITE);
                }
                Line::Row(row) => show_row(ui, rect, row),
            }
        }
    });
}

fn show_row(ui: &Ui, rect: egui::Rect, row: &Row<Answer>) {
    let (icon, colour) = mark(row.verdict);
    icons::draw(ui.painter(), icons::square(rect.left_center() + vec2(11.0, 0.0), 11.0), icon, colour);
    let (text, figures) = (egui::TextStyle::Body.resolve(ui.style()), egui::TextStyle::Small.resolve(ui.style()));
    let [expected, got, error, allowed] = row.figures.words();
    put(ui, rect, 0, row.figures.quantity, &text, style::TEXT);
    put(ui, rect, 1, &row.setting, &figures, style::WEAK);
    put(ui, rect, 2, &expected, &figures, style::WEAK);
    put(ui, rect, 3, &got, &figures, style::TEXT);
    put(ui, rect, 4, &error, &figures, colour);
    put(ui, rect, 5, &allowed, &figures, style::WEAK);
    put(ui, rect, 6, &milliseconds(row), &figures, style::WEAK);
}

/// Time that simulating the case took in this setting.
fn milliseconds(row: &Row<Answer>) -> String {
    match row.figures.milliseconds {
        time if time < 10.0 => format!("{time:.1}"),
        time => grouped(time.round() as u64),
    }
}

fn put(ui: &Ui, rect: egui::Rect, column: usize, text: &str, font: &egui::FontId, colour: Color32) {
    let align = if column < 2 { Align2::LEFT_CENTER } else { Align2::RIGHT_CENTER };
    ui.painter().text(pos2(rect.left() + COLUMNS[column], rect.center().y), align, text, font.clone(), colour);
}

/// How many rows came out how.
fn summary(ui: &mut Ui, rows: &[Row<Answer>]) {
    ui.horizontal(|ui| {
        for (verdict, name) in [
            (Verdict::Pass, tr!("within")),
            (Verdict::Miss, tr!("beyond, below balanced")),
            (Verdict::Known, tr!("beyond, as is known")),
            (Verdict::Fail, tr!("beyond")),
        ] {
            let count = rows.iter().filter(|row| row.verdict == verdict).count();
            let (icon, colour) = mark(verdict);
            let (rect, _) = ui.allocate_exact_size(vec2(12.0, LINE), egui::Sense::hover());
            icons::draw(ui.painter(), icons::square(rect.center(), 11.0), icon, colour);
            ui.label(RichText::new(format!("{count} {name}")).color(if count > 0 { colour } else { style::WEAK }));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::params::Preset;

    #[test]
    fn each_case_has_one_heading_above_its_rows() {
        let answer = Answer {
            quantity: "q",
            unit: "m",
            expected: 1.0,
            got: 1.0,
            relative: true,
            error: 0.0,
            tolerance: 0.1,
            note: String::new(),
            known: None,
            milliseconds: 1.0,
        };
        let row = |case: &'static str| Row {
            case,
            title: case,
            setting: "fast".into(),
            preset: Preset::Fast,
            verdict: Verdict::Pass,
            figures: answer.clone(),
        };
        let rows = [row("fall"), row("fall"), row("wave")];
        let headings: Vec<usize> = (lines(&rows).iter().enumerate())
            .filter_map(|(k, line)| matches!(line, Line::Case(_)).then_some(k))
            .collect();
        assert_eq!(headings, [0, 3]);
    }
}
