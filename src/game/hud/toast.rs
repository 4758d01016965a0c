//! Shows the messages.

use crate::{
    game::{
        actions::Action,
        camera::WorldCamera,
        hud::{
            motion::ReducedMotion,
            panels::help,
            style::{LINE, PANEL, TEXT, WARN},
        },
        input::{bindings::Bindings, touch::Fingers},
        toasts::Toasts,
    },
    sim::state::Census,
};
use bevy::prelude::{Real, Res, ResMut, Result, Time};
use bevy_egui::{
    EguiContexts,
    egui::{self, accesskit::Live},
};
use tr::tr;

/// Widest message that stays on one line, points.
const WIDTH: f32 = 640.0;

/// What a newcomer needs to know.
pub fn greet(mut toasts: ResMut<Toasts>, fingers: Res<Fingers>, bindings: Res<Bindings>) {
    let key = bindings.key(Action::Panel(help::PANEL.id));
    toasts.say(match fingers.in_use {
        true => tr!("One finger draws, two move and zoom"),
        false => tr!("Left button pours, right button erases, {} shows all keys", key),
    });
}

/// Shows them above the palette. That the world is full stays as long as it is so.
pub fn show(
    mut contexts: EguiContexts,
    mut toasts: ResMut<Toasts>,
    census: Option<Res<Census>>,
    camera: Res<WorldCamera>,
    time: Res<Time<Real>>,
    motion: Res<ReducedMotion>,
) -> Result {
    toasts.age(time.delta_secs());
    let full = census.is_some_and(|census| census.full);
    if toasts.last().is_none() && !full {
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
                    card(ui, &tr!("The world is full: erase something before you draw more"), true, 1.0);
                }
                for toast in toasts.iter() {
                    let opacity = if motion.is_on() { 1.0 } else { (toast.left / 0.4).min(1.0) };
                    card(ui, &toast.text, toast.warning, opacity);
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
        .show(ui, |ui| {
            let label = ui.label(egui::RichText::new(text).color(colour.gamma_multiply(opacity)));
            // A screen reader reads it out as it appears.
            ui.ctx().accesskit_node_builder(label.id, |node| node.set_live(Live::Polite));
        });
}
