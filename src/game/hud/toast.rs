//! Short messages that come and go by themselves.

use crate::{
    game::hud::style::{LINE, PANEL, TEXT, WARN},
    sim::state::Census,
};
use bevy::prelude::{Real, Res, ResMut, Resource, Time};
use bevy_egui::{EguiContexts, egui};

/// Time that a message stays, s.
const STAY: f32 = 3.2;
/// Widest message that stays on one line, points.
const WIDTH: f32 = 640.0;
/// Messages shown at once.
const MOST: usize = 4;

#[derive(Clone, Debug)]
struct Toast {
    text: String,
    warning: bool,
    left: f32,
}

/// The messages that are shown.
#[derive(Resource, Clone, Debug, Default)]
pub struct Toasts(Vec<Toast>);

impl Toasts {
    /// Tells something.
    pub fn say(&mut self, text: impl Into<String>) {
        self.push(text.into(), false);
    }

    /// Tells that something went wrong.
    pub fn warn(&mut self, text: impl Into<String>) {
        self.push(text.into(), true);
    }

    /// Takes back what was told about something.
    pub fn take_back(&mut self, about: &str) {
        self.0.retain(|toast| !toast.text.contains(about));
    }

    /// The messages, the newest last.
    pub fn texts(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|toast| toast.text.as_str())
    }

    /// The newest message.
    pub fn last(&self) -> Option<&str> {
        self.0.last().map(|toast| toast.text.as_str())
    }

    fn push(&mut self, text: String, warning: bool) {
        self.0.retain(|toast| toast.text != text);
        let stay = if warning { 2.0 * STAY } else { STAY };
        self.0.push(Toast { text, warning, left: stay });
        if self.0.len() > MOST {
            self.0.remove(0);
        }
    }
}

/// Shows them above the palette. That the world is full stays as long as it is so.
pub fn show(
    mut contexts: EguiContexts,
    mut toasts: ResMut<Toasts>,
    census: Option<Res<Census>>,
    camera: Res<crate::game::camera::WorldCamera>,
    time: Res<Time<Real>>,
) -> bevy::prelude::Result {
    for toast in &mut toasts.0 {
        toast.left -= time.delta_secs();
    }
    toasts.0.retain(|toast| toast.left > 0.0);
    let full = census.is_some_and(|census| census.full);
    if toasts.0.is_empty() && !full {
        return Ok(());
    }
    let context = contexts.ctx_mut()?;
    let lowest = camera.panes().map(|pane| pane.max.y).fold(0.0, f32::max);
    let bottom = (camera.window().y - lowest) / context.zoom_factor();
    egui::Area::new("toasts".into())
        .anchor(egui::Align2::CENTER_BOTTOM, [0.0, -bottom - 14.0])
        .order(egui::Order::Foreground)
        .interactable(false)
        .show(context, |ui| {
            ui.set_max_width(WIDTH);
            ui.vertical_centered(|ui| {
                if full {
                    card(ui, "The world is full: erase something before you draw more", true, 1.0);
                }
                for toast in &toasts.0 {
                    card(ui, &toast.text, toast.warning, (toast.left / 0.4).min(1.0));
                }
            });
        });
    Ok(())
}

fn card(ui: &mut egui::Ui, text: &str, warning: bool, opacity: f32) {
    let colour = if warning { WARN } else { TEXT };
    egui::Frame::new()
        .fill(PANEL.gamma_multiply(0.96 * opacity))
        .stroke(egui::Stroke::new(1.0, LINE.gamma_multiply(opacity)))
        .corner_radius(8)
        .inner_margin(egui::Margin::symmetric(14, 7))
        .show(ui, |ui| ui.label(egui::RichText::new(text).color(colour.gamma_multiply(opacity))));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_out_wrong_is_taken_back() {
        let mut toasts = Toasts::default();
        toasts.say("Saved: worlds/a.pms");
        toasts.say("Undone");
        toasts.take_back("worlds/a.pms");
        assert_eq!(toasts.texts().collect::<Vec<_>>(), ["Undone"]);
    }
}
