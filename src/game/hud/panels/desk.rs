//! The buttons of long work in the background: the exam and the gauntlet.

use crate::{
    game::hud::style,
    kernel::params::Preset,
    sim::desk::{Desk, Progress},
};
use bevy_egui::egui::{self, RichText, Ui};

/// Begins, called `begin`, and stops; what is wanted from now on, if that was changed.
pub fn controls<R: Send + Sync>(
    ui: &mut Ui,
    desk: &Desk<R>,
    preset: Preset,
    begin: &str,
) -> Option<Option<Vec<Preset>>> {
    let mut wanted = None;
    ui.horizontal(|ui| {
        if desk.wanted.is_some() {
            if style::main_button(ui, "Stop").clicked() {
                wanted = Some(None);
            }
        } else {
            if style::main_button(ui, begin).on_hover_text("the quality that is played at").clicked() {
                wanted = Some(Some(vec![preset]));
            }
            if ui.button("all qualities").on_hover_text("takes some minutes").clicked() {
                wanted = Some(Some(Preset::ALL.to_vec()));
            }
        }
        match &desk.progress {
            Progress::Idle => {}
            Progress::Running { done, of, now } => {
                let share = *done as f32 / (*of).max(1) as f32;
                ui.add(egui::ProgressBar::new(share).desired_width(160.0).text(format!("{done} of {of}")));
                ui.label(RichText::new(now).small().color(style::WEAK));
            }
            Progress::Done => drop(ui.label(RichText::new("done").color(style::WEAK))),
            Progress::Stopped => drop(ui.label(RichText::new("stopped").color(style::WEAK))),
            Progress::Broken(why) => drop(ui.label(RichText::new(why).color(style::WARN))),
        }
    });
    wanted
}
