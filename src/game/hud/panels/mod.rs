//! The panels of the HUD. Each brings its row along ([`Panel`](crate::game::panels::Panel)): keys, help, bar and touch list
//! follow from it. A new one is a file here and its line below.

pub mod accuracy;
pub mod cases;
pub mod details;
pub mod elements;
pub mod help;
pub mod saves;
pub mod scenes;
pub mod settings;
pub mod stamps;

use crate::{
    game::panels::Panels,
    lab::{exam::ExamCase, gauntlet::GauntletCase},
};
use bevy::prelude::App;

/// Adds them all; the buttons of the bar stand in this order from the right.
pub fn plugin(app: &mut App) {
    Panels::add(app, help::PANEL, help::show);
    Panels::add(app, settings::PANEL, settings::show);
    app.add_plugins((cases::window::plugin::<ExamCase>, cases::window::plugin::<GauntletCase>));
    Panels::add(app, details::PANEL, details::show);
    app.add_plugins((accuracy::panel::plugin, stamps::plugin, saves::plugin, scenes::panel::plugin));
    Panels::add(app, elements::PANEL, elements::show);
}
