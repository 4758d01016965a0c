//! A person's side: input, tools, the picture, the HUD. Reads the simulation's resources and gives it intents.
//!
//! ```text
//! devices ─► input ─┬─► intents ─► (simulation)        simulation ─► render ─► window
//!                   └─► orders  ─► history, control               └► hud ──┘    │
//!                          ▲                                           orders ◄─┘
//! ```

pub mod camera;
#[cfg(not(target_arch = "wasm32"))]
pub mod crash;
pub mod disk;
pub mod files;
pub mod follow;
pub mod frame;
pub mod history;
pub mod hud;
pub mod input;
pub mod orders;
pub mod playback;
pub mod recording;
pub mod render;
pub mod rest;
pub mod saves;
pub mod screen;
pub mod split;
#[cfg(test)]
mod tests;
pub mod tools;
pub mod window;

use crate::{
    kernel::units::TICKS_PER_SECOND,
    sim::{accuracy, autopilot, measures, recorder, state::Setup},
};
use bevy::{
    prelude::{
        App, AppExit, Fixed, FixedPreUpdate, IntoScheduleConfigs, Last, Plugin, RunFixedMainLoop,
        RunFixedMainLoopSystems, SystemSet, Time, on_message, resource_exists,
    },
    time::common_conditions::on_timer,
    window::WindowEvent,
};

use std::time::Duration;
pub use window::{GameError, run};

/// Reads the devices and carries out orders, before the ticks of a frame.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InputSystems;

/// Input, tools, orders and pace: all of the game that needs no window.
pub struct GamePlugin;

impl Plugin for GamePlugin {
    fn build(&self, app: &mut App) {
        app.add_message::<WindowEvent>()
            .insert_resource(Time::<Fixed>::from_hz(f64::from(TICKS_PER_SECOND)))
            .init_resource::<camera::WorldCamera>()
            .init_resource::<tools::Toolbox>()
            .init_resource::<orders::Orders>()
            .init_resource::<orders::Shown>()
            .init_resource::<history::History>()
            .init_resource::<saves::SaveFolders>()
            .init_resource::<frame::Tempo>()
            .init_resource::<hud::HudState>()
            .init_resource::<hud::toast::Toasts>()
            .init_resource::<input::pointer::Pointer>()
            .init_resource::<input::pointer::HudCover>()
            .init_resource::<input::keys::Typing>()
            .init_resource::<input::touch::Fingers>()
            .init_resource::<input::strokes::Held>()
            .init_resource::<accuracy::Watched>()
            .init_resource::<accuracy::LiveError>()
            .init_resource::<accuracy::Survey>()
            .init_resource::<measures::Measures>()
            .add_plugins((autopilot::plugin, crate::sim::split::plugin, recorder::plugin))
            .add_systems(
                RunFixedMainLoop,
                (
                    follow::follow_scene,
                    input::keys::pan,
                    input::devices::read_devices,
                    orders::obey,
                    split::watch,
                    frame::set_pace,
                )
                    .chain()
                    .in_set(InputSystems)
                    .in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop),
            )
            .add_systems(FixedPreUpdate, (playback::feed, input::strokes::make_intents).chain())
            .add_systems(
                Last,
                (
                    frame::measure_tempo,
                    recording::end_when_full.run_if(resource_exists::<Setup>).run_if(on_timer(Duration::from_secs(1))),
                    recording::write_at_exit.run_if(on_message::<AppExit>),
                ),
            );
    }
}
