//! The strip at the top of the world while a challenge runs: what to do, with what, and how it stands.

use super::stars::star;
use crate::{
    game::{
        hud::{
            layout::Bars,
            style::{self, weak},
            tiles::Tiles,
            widgets::{BUTTON, field},
        },
        icons,
        language::spoken,
        orders::{Order, Orders},
        panels::Panels,
        toolbox::Toolbox,
        tools::{TOOLS, Tool, spaced},
    },
    kernel::{element::ElementTable, units::TICKS_PER_SECOND},
    sim::judge::{Judge, Trial},
};
use bevy::prelude::{Res, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, Align2, Color32, CornerRadius, FontId, Rect, RichText, Sense, Ui, Vec2, vec2},
};
use tr::tr;

/// Widest that it gets, points, and what is left of the screen beside it.
const WIDTH: f32 = 560.0;
const BESIDE: f32 = 24.0;
/// Height of its bar of time, points.
const BAR: f32 = 4.0;
/// Height of its buttons, points; at least so many pixels for fingers.
const BUTTON_HEIGHT: f32 = 26.0;
/// From the bar above, points.
const GAP: f32 = 10.0;
/// So many seconds before the end the time is a warning.
const LATE: u64 = 5 * TICKS_PER_SECOND as u64;

/// Shows it.
pub fn show(
    mut contexts: EguiContexts,
    (judge, panels, bars): (Res<Judge>, Res<Panels>, Res<Bars>),
    tiles: Tiles,
    mut tools: ResMut<Toolbox>,
    mut orders: ResMut<Orders>,
) -> Result {
    let Some(trial) = judge.running().filter(|_| panels.visible) else { return Ok(()) };
    let context = contexts.ctx_mut()?;
    let width = WIDTH.min(context.content_rect().width() - BESIDE);
    egui::Area::new("challenge".into())
        // The lamps of the effects are at the left.
        .anchor(Align2::RIGHT_TOP, vec2(-BESIDE / 2.0, bars.top + GAP))
        .order(egui::Order::Middle)
        .show(context, |ui| {
            let card = egui::Frame::new().fill(style::PANEL).stroke(egui::Stroke::new(1.0, style::LINE));
            card.corner_radius(style::WINDOW_CORNER).inner_margin(egui::Margin::symmetric(14, 10)).show(ui, |ui| {
                ui.set_width(width - 28.0);
                ui.spacing_mut().item_spacing = vec2(8.0, 7.0);
                ui.label(RichText::new(spoken(&trial.challenge.task)).color(Color32::WHITE).size(14.0));
                time(ui, trial);
                ui.horizontal_wrapped(|ui| {
                    counts(ui, trial);
                    means(ui, trial, tiles.elements(), &mut tools);
                    for (text, order) in
                        [(tr!("Again"), Order::ChallengeAgain), (tr!("Give up"), Order::LeaveChallenge)]
                    {
                        if button(ui, &text, &text, false) {
                            orders.push(order);
                        }
                    }
                });
            });
        });
    Ok(())
}

/// The time that is left, as a bar and in words.
fn time(ui: &mut Ui, trial: &Trial) {
    let colour = if trial.left() < LATE { style::WARN } else { style::ACCENT };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), BAR), Sense::hover());
    ui.painter().rect_filled(rect, CornerRadius::same(2), style::BUTTON);
    let share = trial.left() as f32 / trial.challenge.ticks as f32;
    let left = Rect::from_min_size(rect.min, vec2(share * rect.width(), rect.height()));
    ui.painter().rect_filled(left, CornerRadius::same(2), colour);
    response.on_hover_text(tr!("the time that is left"));
}

/// Time, particles and strokes, against what earns the stars.
fn counts(ui: &mut Ui, trial: &Trial) {
    let challenge = &trial.challenge;
    let seconds = trial.left().div_ceil(u64::from(TICKS_PER_SECOND));
    let colour = if trial.left() < LATE { style::WARN } else { style::TEXT };
    ui.label(RichText::new(format!("{seconds} s")).color(colour)).on_hover_text(tr!("the time that is left"));
    let stars = trial.stars();
    let most = challenge.particles;
    let particles = tr!("a star for at most {} particles; taking a stroke back does not give it back", most);
    let most = challenge.strokes;
    let strokes = tr!("a star for at most {} strokes; taking a stroke back does not give it back", most);
    for (what, used, most, holds, about) in [
        (tr!("particles"), trial.poured(), challenge.particles, stars.particles, particles),
        (tr!("strokes"), trial.strokes, challenge.strokes, stars.strokes, strokes),
    ] {
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let (rect, _) = ui.allocate_exact_size(Vec2::splat(13.0), Sense::hover());
            star(ui.painter(), rect, holds);
            let colour = if holds { style::TEXT } else { style::WEAK };
            ui.label(RichText::new(format!("{used} / {most}")).color(colour));
            ui.label(weak(what)).on_hover_text(about);
        });
    }
}

/// What the player has; a press chooses it.
fn means(ui: &mut Ui, trial: &Trial, elements: &ElementTable, tools: &mut Toolbox) {
    for name in trial.challenge.means.iter() {
        let Some(tool) = tool(name, elements) else { continue };
        let text = spoken(&spaced(name));
        let called = tr!("take up {}", text);
        if button(ui, &text, &called, tools.tool == tool) {
            tools.tool = tool;
        }
    }
}

/// The tool or element of a name.
pub fn tool(name: &str, elements: &ElementTable) -> Option<Tool> {
    let other = TOOLS.into_iter().find(|row| row.name == name).map(Tool::Other);
    other.or_else(|| elements.find(name).map(Tool::Element))
}

/// A button with a text; whether it was pressed.
pub fn button(ui: &mut Ui, text: &str, called: &str, chosen: bool) -> bool {
    let font = FontId::proportional(13.5);
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, style::TEXT);
    let size = vec2(galley.size().x + 20.0, BUTTON_HEIGHT);
    let (rect, response) = field(ui, size, called, chosen, BUTTON);
    ui.painter().galley(icons::square(rect.center(), 0.0).min - galley.size() / 2.0, galley, style::TEXT);
    response.clicked()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{
        self,
        challenges::{HANDS, challenges},
    };

    #[test]
    fn what_a_challenge_gives_is_a_tool_or_an_element() {
        let elements = scene::elements().expect("the table that comes with the game is valid");
        assert_eq!(HANDS.to_vec(), TOOLS.map(|row| row.name).to_vec(), "the names of the tools");
        for challenge in challenges().expect("they come with the game") {
            assert!(challenge.means.iter().all(|name| tool(name, &elements).is_some()), "{}", challenge.name);
        }
    }
}
