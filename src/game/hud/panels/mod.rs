//! The panels of the HUD. Each brings its row along ([`Panel`](crate::game::panels::Panel)): keys, help, bar and touch list
//! follow from it. A new one is a file here and its line below.

pub mod accuracy;
mod desk;
pub mod details;
pub mod exam;
pub mod gauntlet;
pub mod help;
pub mod saves;
pub mod scenes;
pub mod search;
pub mod settings;

use bevy::prelude::App;

/// Adds them all; the buttons of the bar stand in this order from the right.
pub fn plugin(app: &mut App) {
    app.add_plugins((
        help::plugin,
        settings::plugin,
        exam::plugin,
        gauntlet::plugin,
        details::plugin,
        accuracy::panel::plugin,
        saves::plugin,
        scenes::plugin,
        search::plugin,
    ));
}
