//! The game without its window.

use crate::{
    game::{
        camera, challenges, drop, execute, favourites, follow, frame, gauges, hints, history, hud, input, lens, mixer,
        museum, orders, panels, playback, recording, rewind, saves, sound, split, stamps, throws, toasts, toolbox,
        views,
    },
    kernel::units::TICKS_PER_SECOND,
    lab::{
        autopilot,
        gauges::set::{self, any as any_gauge},
        gauntlet::throws::plugin as stress_test,
        live::{accuracy, measures},
    },
    sim::{generation::Generation, recorder, state::Setup},
};
use bevy::{
    input::mouse::MouseButtonInput,
    prelude::{
        App, AppExit, Fixed, FixedPreUpdate, IntoScheduleConfigs, Last, Plugin, PreStartup, RunFixedMainLoop,
        RunFixedMainLoopSystems, SystemSet, Time, not, on_message, resource_exists,
    },
    time::common_conditions::on_timer,
    window::{CursorMoved, WindowEvent},
};

use std::time::Duration;

/// Reads the devices and carries out orders, before the ticks of a frame.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct InputSystems;

/// Input, tools, orders and pace: all of the game that needs no window.
pub struct GamePlugin;

impl Plugin for GamePlugin {
    fn build(&self, app: &mut App) {
        app.add_message::<WindowEvent>()
            .add_message::<CursorMoved>()
            .add_message::<MouseButtonInput>()
            .insert_resource(Time::<Fixed>::from_hz(f64::from(TICKS_PER_SECOND)))
            .init_resource::<camera::WorldCamera>()
            .init_resource::<toolbox::Toolbox>()
            .init_resource::<input::bindings::Bindings>()
            .init_resource::<input::keymap::Keymap>()
            .init_resource::<input::rebind::KeyEditor>()
            .init_resource::<orders::Orders>()
            .init_resource::<drop::Hovering>()
            .init_resource::<views::table::Shown>()
            .init_resource::<follow::Followed>()
            .init_resource::<history::History>()
            .init_resource::<rewind::Rewind>()
            .init_resource::<lens::Lens>()
            .init_resource::<gauges::desk::GaugeDesk>()
            .init_resource::<saves::SaveFolders>()
            .init_resource::<favourites::Favourites>()
            .init_resource::<mixer::desk::MixerDesk>()
            .init_resource::<mixer::own::OwnElements>()
            .init_resource::<museum::Museum>()
            .init_resource::<challenges::attempt::Attempt>()
            .init_resource::<challenges::earned::Earned>()
            .init_resource::<stamps::hand::Hand>()
            .init_resource::<stamps::shelf::Shelf>()
            .init_resource::<frame::Tempo>()
            .init_resource::<panels::Panels>()
            .init_resource::<toasts::Toasts>()
            .init_resource::<input::pointer::Pointer>()
            .init_resource::<input::pointer::HudCover>()
            .init_resource::<input::keys::HudKeys>()
            .init_resource::<input::mouse_keys::MouseKeys>()
            .init_resource::<input::touch::Fingers>()
            .init_resource::<input::strokes::DragState>()
            .init_resource::<accuracy::Watched>()
            .init_resource::<accuracy::LiveError>()
            .init_resource::<accuracy::Survey>()
            .init_resource::<measures::Measures>()
            .add_plugins((
                sound::plugin,
                hints::plugin,
                hud::panels::plugin,
                autopilot::plugin,
                stress_test,
                crate::lab::split::plugin,
                set::plugin,
                recorder::plugin,
            ))
            .add_systems(PreStartup, input::keymap::read_file)
            .add_systems(
                RunFixedMainLoop,
                (
                    follow::follow_scene,
                    input::mouse_keys::run.run_if(not(input::rebind::asks)),
                    input::keys::pan.run_if(not(input::rebind::asks)).run_if(not(input::mouse_keys::are_on)),
                    input::devices::read_devices,
                    drop::read_drops,
                    execute::carry_out,
                    rewind::run,
                    challenges::attempt::leave_with_the_scene.run_if(resource_exists::<Setup>),
                    lens::run.run_if(lens::is_on),
                    gauges::act::follow.run_if(any_gauge),
                    museum::leave.run_if(resource_exists::<Generation>),
                    split::watch,
                    frame::set_pace,
                )
                    .chain()
                    .in_set(InputSystems)
                    .in_set(RunFixedMainLoopSystems::BeforeFixedMainLoop),
            )
            .add_systems(
                RunFixedMainLoop,
                challenges::attempt::see_the_end.in_set(RunFixedMainLoopSystems::AfterFixedMainLoop),
            )
            .add_systems(
                FixedPreUpdate,
                (playback::feed, throws::feed, follow::follow_elements, input::strokes::make_intents).chain(),
            )
            .add_systems(
                Last,
                (
                    frame::measure_tempo,
                    recording::end_when_full.run_if(resource_exists::<Setup>).run_if(on_timer(Duration::from_secs(1))),
                    (rewind::finish, recording::write_at_exit).chain().run_if(on_message::<AppExit>),
                ),
            );
        app.world().resource::<recorder::Recorder>().keep_keys();
    }
}
