//! The head-up display, in egui: a bar with the numbers and menus on top, the palette at the bottom, panels on call.
//! It reads the world and gives orders; it never changes the world itself.

pub mod bar;
pub mod brush;
pub mod challenges;
pub mod clicks;
pub mod cost;
#[cfg(not(target_arch = "wasm32"))]
pub mod crash;
pub mod drop;
mod fates;
pub mod focus;
pub mod gauges;
mod labels;
pub mod lamps;
pub mod layout;
pub mod lens;
pub mod live_picture;
pub mod motion;
pub mod mouse_keys;
pub mod museum;
pub mod paint;
pub mod palette;
pub mod panels;
pub mod probe;
pub mod rewind;
pub mod split;
pub mod springs;
pub mod stamps;
pub mod stats;
pub mod style;
mod temperature;
pub mod tiles;
pub mod toast;
pub mod touch;
pub mod widgets;
pub mod window;

use crate::game::{input, panels::HudSystems};
use bevy::prelude::{
    App, IntoScheduleConfigs, Plugin, PreUpdate, Startup, condition_changed_to, not, resource_changed,
};
use bevy_egui::{EguiPreUpdateSet, EguiPrimaryContextPass};

/// Shows the HUD.
pub struct HudPlugin;

impl Plugin for HudPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<stats::Readings>()
            .init_resource::<layout::UiScale>()
            .init_resource::<layout::Bars>()
            .init_resource::<motion::ReducedMotion>()
            .init_resource::<cost::HudCost>()
            .init_resource::<lamps::Lamps>()
            .configure_sets(
                EguiPrimaryContextPass,
                (HudSystems::Begin, HudSystems::Bars, HudSystems::Panels, HudSystems::End).chain(),
            )
            .add_systems(Startup, toast::greet)
            .add_systems(
                PreUpdate,
                (style::apply_to_new, motion::follow.run_if(resource_changed::<motion::ReducedMotion>))
                    .chain()
                    .after(EguiPreUpdateSet::InitContexts)
                    .before(EguiPreUpdateSet::BeginPass),
            )
            .add_systems(
                PreUpdate,
                (clicks::take_turns, focus::keep_keys).chain().after(EguiPreUpdateSet::ProcessInput),
            )
            .add_systems(
                EguiPrimaryContextPass,
                (
                    (cost::begin, layout::scale_to_window, stats::read, lamps::read, focus::forget_element)
                        .chain()
                        .in_set(HudSystems::Begin),
                    (
                        (bar::show, palette::show).chain().run_if(not(touch::in_use)),
                        touch::show.run_if(touch::in_use),
                        layout::place_world,
                        lamps::show.run_if(not(touch::in_use)),
                        brush::show,
                        stamps::ghost::show,
                        stamps::strip::show,
                        probe::show,
                        museum::show,
                        springs::show,
                        gauges::show,
                        split::show,
                        lens::show,
                        rewind::show,
                        challenges::strip::show,
                        challenges::verdict::show,
                    )
                        .chain()
                        .in_set(HudSystems::Bars),
                    (
                        toast::show,
                        drop::show,
                        (mouse_keys::follow_focus, mouse_keys::show).chain().run_if(input::mouse_keys::are_on),
                        mouse_keys::leave_focus.run_if(condition_changed_to(false, input::mouse_keys::are_on)),
                        focus::note_cover,
                        cost::end,
                    )
                        .chain()
                        .in_set(HudSystems::End),
                ),
            );
        #[cfg(not(target_arch = "wasm32"))]
        app.add_systems(EguiPrimaryContextPass, crash::show.after(HudSystems::Panels).before(HudSystems::End));
    }
}
