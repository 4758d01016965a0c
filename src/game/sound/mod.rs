//! Sound of the world that is played. Each tick's frame an ear ([`lab::sound`](crate::lab::sound)) listens from where the camera
//! is; what it hears goes to a desk, from which the thread of the output makes samples ([`powder_sound`](crate::sound)).
//!
//! ```text
//! world, camera ─► ears ─► desk ─► player, on the output's thread ─► PulseAudio or PipeWire; WASAPI; CoreAudio
//! volume, pause ─► direct ─► output: plays or rests
//! ```
//!
//! In a page `page` is the output: controls go to the browser's audio thread, where a module of its own plays them.
//!
//! While it is muted, or time stands, or the window can't be seen, nothing listens, and the output asks for no samples. Where there
//! is no output it never begins.

#[cfg(not(target_arch = "wasm32"))]
mod desk;
#[cfg(any(windows, target_os = "macos"))]
mod device;
mod ears;
#[cfg(not(target_arch = "wasm32"))]
mod output;
#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(not(any(windows, target_os = "macos", target_arch = "wasm32")))]
mod pulse;
pub mod volume;
#[cfg(not(target_arch = "wasm32"))]
mod wishes;

pub use ears::{Ears, SoundCost};
#[cfg(not(target_arch = "wasm32"))]
pub use output::Output;
#[cfg(target_arch = "wasm32")]
pub use page::Output;

use bevy::{
    prelude::{App, AppExit, IntoScheduleConfigs, Last, SystemCondition, on_message},
    time::common_conditions::on_timer,
};
use std::time::Duration;

/// How often a changed volume is kept.
const KEEP_EVERY: Duration = Duration::from_secs(1);

/// Lets the world be heard.
pub fn plugin(app: &mut App) {
    app.init_resource::<volume::Volume>()
        .init_resource::<Output>()
        .init_resource::<SoundCost>()
        .init_resource::<Ears>()
        .add_systems(
            Last,
            (
                (ears::direct, ears::listen.run_if(ears::hears)).chain(),
                volume::keep.run_if(on_timer(KEEP_EVERY).or_else(on_message::<AppExit>)),
            ),
        );
}
