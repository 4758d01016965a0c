//! The challenges: a tile each, with the stars that were earned.

use crate::{
    game::{
        actions::PanelId,
        challenges::earned::Earned,
        edit_icons,
        hud::{
            challenges::stars,
            style::{self, weak},
            widgets::{BUTTON, field},
            window::{MIDDLE, PanelWindow, scroll},
        },
        input::bindings::{Group, NONE},
        language::spoken,
        orders::{Order, Orders},
        panels::Panel,
    },
    scene::challenges::{Challenge, challenges},
    sim::judge::Judge,
};
use bevy::prelude::{KeyCode, Res, ResMut, Result};
use bevy_egui::egui::{self, Align, Color32, FontId, Stroke, StrokeKind, Ui, Vec2, text::LayoutJob, vec2};
use tr::tr;

/// Size of a tile, points.
const TILE: Vec2 = vec2(206.0, 112.0);
/// Between tiles, points.
const GAP: f32 = 8.0;
/// Between the edge of a tile and what is in it, points.
const EDGE: f32 = 11.0;
/// Most tiles in a row.
const COLUMNS: f32 = 4.0;
/// Of the screen's width and height this is never tiles, points.
const MARGIN: Vec2 = vec2(72.0, 170.0);
/// Side of a star, points.
const STAR: f32 = 15.0;

/// Its row.
pub const PANEL: Panel = Panel {
    id: PanelId("challenges"),
    title: "Challenges",
    icon: edit_icons::cup,
    keys: &[(KeyCode::KeyJ, NONE)],
    group: Group::World,
    help: "challenges: something to do, for up to three stars",
    in_bar: true,
    in_list: Some("Challenges"),
    stays: false,
};

/// Shows them.
pub fn show(mut window: PanelWindow, (earned, judge): (Res<Earned>, Res<Judge>), mut orders: ResMut<Orders>) -> Result {
    let all = challenges()?;
    let tried = judge.running().map(|trial| trial.challenge.name.as_str());
    let mut chosen = None;
    window.show(&PANEL, MIDDLE, |ui| {
        let columns = ((ui.ctx().content_rect().width() - MARGIN.x) / (TILE.x + GAP)).floor().clamp(1.0, COLUMNS);
        ui.set_width(columns * (TILE.x + GAP) - GAP + 14.0);
        let (have, most) = earned.count();
        ui.label(weak(tr!(
            "{have} of {most} stars: one if it is done, one for few particles, one for few strokes.",
            have,
            most
        )));
        scroll(ui, MARGIN.y, |ui| {
            ui.spacing_mut().item_spacing = Vec2::splat(GAP);
            for row in all.chunks(columns as usize) {
                ui.horizontal(|ui| {
                    for challenge in row {
                        if tile(ui, challenge, &earned, tried == Some(&challenge.name)) {
                            chosen = Some(challenge.name.clone());
                        }
                    }
                });
            }
        });
    })?;
    if let Some(name) = chosen {
        orders.push(Order::Challenge(name));
        window.close(PANEL.id);
    }
    Ok(())
}

/// The tile of a challenge; whether it was pressed.
fn tile(ui: &mut Ui, challenge: &Challenge, earned: &Earned, tried: bool) -> bool {
    let (rect, response) = field(ui, TILE, &spoken(challenge.title()), false, BUTTON);
    let stars_earned = earned.of(&challenge.name);
    let inner = rect.shrink(EDGE);
    let colour = if tried { style::ACCENT } else { Color32::WHITE };
    let title = format!("{}  {}", challenge.number, spoken(challenge.title()));
    let height = write(ui, inner, &title, FontId::proportional(14.5), colour);
    let below = inner.with_min_y(inner.top() + height + 5.0);
    write(ui, below, &spoken(&challenge.task), FontId::proportional(12.0), style::WEAK);
    stars::paint(ui.painter(), inner.left_bottom() - vec2(0.0, STAR), stars_earned, STAR);
    if tried || response.hovered() {
        let stroke = Stroke::new(1.5, style::ACCENT);
        ui.painter().rect_stroke(rect, style::BUTTON_CORNER, stroke, StrokeKind::Inside);
    }
    response.clicked()
}

/// Writes a text of up to three lines at the top of a rectangle; how high it is.
fn write(ui: &Ui, rect: egui::Rect, text: &str, font: FontId, colour: Color32) -> f32 {
    let mut job = LayoutJob::simple(text.to_owned(), font, colour, rect.width());
    job.wrap.max_rows = 3;
    job.halign = Align::LEFT;
    let galley = ui.painter().layout_job(job);
    let height = galley.size().y;
    ui.painter().galley(rect.left_top(), galley, colour);
    height
}
