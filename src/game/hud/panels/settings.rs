//! The settings.

use crate::game::{
    actions::PanelId,
    hud::{layout::UiScale, style},
    icons,
    input::bindings::{Group, NONE},
    panels::{Panel, Panels},
};
use bevy::prelude::{App, KeyCode, ResMut, Result};
use bevy_egui::{
    EguiContexts,
    egui::{self, RichText},
};

/// Its name.
pub const ID: PanelId = PanelId("settings");

/// Scales that the player may choose on top of the automatic one.
const CHOICES: [f32; 6] = [0.75, 0.9, 1.0, 1.15, 1.3, 1.6];

/// Adds the panel.
pub fn plugin(app: &mut App) {
    let panel = Panel {
        id: ID,
        title: "Settings",
        icon: icons::gear,
        keys: &[(KeyCode::F4, NONE)],
        group: Group::Look,
        help: "settings",
        in_bar: true,
        in_list: Some("Settings"),
        stays: false,
    };
    Panels::add(app, panel, show);
}

/// Shows the settings.
fn show(mut contexts: EguiContexts, mut panels: ResMut<Panels>, mut scale: ResMut<UiScale>) -> Result {
    let context = contexts.ctx_mut()?;
    let place = (egui::Align2::CENTER_CENTER, context.content_rect().center());
    style::panel(context, &mut panels, ID, place, |ui| {
        ui.label(RichText::new("Size of the HUD").color(style::WEAK));
        ui.horizontal(|ui| {
            for choice in CHOICES {
                let text = format!("{:.0} %", choice * 100.0);
                if ui.selectable_label(scale.factor == choice, text).clicked() {
                    scale.factor = choice;
                }
            }
        });
        ui.label(RichText::new("100 % follows the size of the window.").small().color(style::WEAK));
    });
    Ok(())
}
