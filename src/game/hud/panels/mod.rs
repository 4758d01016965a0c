//! The panels of the HUD. Each brings its row along ([`Panel`](crate::game::panels::Panel)): keys, help, bar and touch list
//! follow from it. A new one is a file here and its line below.

pub mod accuracy;
pub mod cases;
pub mod challenges;
pub mod details;
pub mod elements;
pub mod gauges;
pub mod help;
pub mod keys;
pub mod mixer;
pub mod museum;
pub mod saves;
pub mod scenes;
pub mod settings;
pub mod stamps;
pub mod throws;

use crate::{
    game::panels::Panels,
    lab::{exam::ExamCase, gauntlet::GauntletCase},
};
use bevy::prelude::App;

/// Adds them all; the buttons of the bar stand in this order from the right.
pub fn plugin(app: &mut App) {
    app.add_plugins(help::plugin);
    Panels::add(app, settings::PANEL, settings::show);
    app.add_plugins((cases::window::plugin::<ExamCase>, cases::window::plugin::<GauntletCase>));
    Panels::add(app, museum::PANEL, museum::show);
    Panels::add(app, throws::PANEL, throws::show);
    Panels::add(app, details::PANEL, details::show);
    app.add_plugins((accuracy::panel::plugin, gauges::panel::plugin, stamps::plugin, saves::plugin));
    Panels::add(app, challenges::PANEL, challenges::show);
    app.add_plugins(scenes::panel::plugin);
    app.add_plugins(mixer::plugin);
    Panels::add(app, elements::PANEL, elements::show);
}
