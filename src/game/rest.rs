//! Rest: while nothing changes, no frame is drawn and the event loop sleeps. A paused game takes next to no processor, and
//! one whose window can't be seen stands still.

use crate::{
    game::{
        frame::{Tempo, measure_tempo},
        hud::panels::{saves::SaveMenu, scenes::pictures::Pictures},
        input::strokes::DragState,
        orders::Orders,
        render::cost::RenderCost,
        toasts::Toasts,
    },
    lab::{
        cases::JobQueue,
        exam::ExamCase,
        gauntlet::{GauntletCase, throws::StressTest},
        live::accuracy::Survey,
    },
    sim::{intent::IntentQueue, pace::Pace},
};
use bevy::{
    a11y::AccessibilityRequested,
    ecs::system::SystemParam,
    prelude::{App, DetectChanges, IntoScheduleConfigs, Last, Local, MessageReader, Real, Res, ResMut, Time, Virtual},
    window::WindowEvent,
    winit::{UpdateMode, WinitSettings},
};
use std::time::Duration;

/// How long frames go on after the last change: the renderer draws one frame behind, and what is lit by the pointer fades.
const LINGER: Duration = Duration::from_millis(400);

/// Time from one look to the next while nothing changes; input wakes at once, and so does a page's script.
const NAP: Duration = Duration::from_secs(10);

/// The same while another thread works something out.
const WATCH: Duration = Duration::from_millis(200);

/// Lets the event loop sleep whenever it may.
pub fn plugin(app: &mut App) {
    app.init_resource::<WinitSettings>().add_systems(Last, rest.after(measure_tempo));
    // A page's script tells this in its own way.
    #[cfg(not(target_arch = "wasm32"))]
    app.add_systems(Last, stand_while_unseen);
}

/// What may be worked out in the background, or asked for from outside.
#[derive(SystemParam)]
struct Background<'w> {
    exam: Res<'w, JobQueue<ExamCase>>,
    gauntlet: Res<'w, JobQueue<GauntletCase>>,
    stress: Res<'w, StressTest>,
    survey: Res<'w, Survey>,
    readers: Option<Res<'w, AccessibilityRequested>>,
    #[cfg(not(target_arch = "wasm32"))]
    recovery: Option<Res<'w, crate::game::crash::recovery::Recovery>>,
}

impl Background<'_> {
    fn works(&self) -> bool {
        #[cfg(not(target_arch = "wasm32"))]
        let restores = self.recovery.as_ref().is_some_and(|recovery| recovery.is_busy());
        #[cfg(target_arch = "wasm32")]
        let restores = false;
        let judges = self.exam.is_running() || self.gauntlet.is_running() || self.stress.is_running();
        // What a screen reader asks for wakes nobody.
        let is_read = self.readers.as_ref().is_some_and(|readers| readers.get());
        restores || judges || is_read || self.survey.is_running()
    }
}

/// How the event loop goes on while the world `moves` or not and something `works` in the background or not, after `calm`
/// without a sign of change.
fn mode(moves: bool, works: bool, calm: Duration) -> UpdateMode {
    // In a page the frames do the work, a slice each.
    let works_by_frames = works && cfg!(target_arch = "wasm32");
    if moves || works_by_frames || calm < LINGER {
        UpdateMode::Continuous
    } else {
        UpdateMode::reactive_low_power(if works { WATCH } else { NAP })
    }
}

fn rest(
    pace: Res<Pace>,
    time: Res<Time<Virtual>>,
    real: Res<Time<Real>>,
    mut events: MessageReader<WindowEvent>,
    (orders, intents, drag): (Res<Orders>, Res<IntentQueue>, Res<DragState>),
    (toasts, saves, pictures, background): (Res<Toasts>, Res<SaveMenu>, Res<Pictures>, Background),
    picture: Option<Res<RenderCost>>,
    mut calm: Local<Duration>,
    mut tempo: ResMut<Tempo>,
    mut settings: ResMut<WinitSettings>,
) {
    let touched = events.read().count() > 0 || !orders.is_empty() || !intents.is_empty() || drag.current().is_some();
    // A message that is shown is about to go; of the list of saves each frame reads one, and of
    // the gallery's pictures it shows what is new.
    let is_awaited = picture.is_some_and(|picture| picture.waits());
    let shows_more = toasts.last().is_some() || saves.is_reading() || pictures.is_busy() || is_awaited;
    let stirs = touched || pace.is_changed() || shows_more;
    *calm = if stirs { Duration::ZERO } else { (*calm + real.delta()).min(LINGER) };
    let moves = pace.rewinds || pace.ticks() && !time.is_paused();
    let focused = mode(moves, background.works(), *calm);
    tempo.rests = focused != UpdateMode::Continuous;
    // Out of focus a game that runs keeps to the rate of a screen, as Bevy has it.
    let unfocused = if tempo.rests { focused } else { WinitSettings::game().unfocused_mode };
    if (settings.focused_mode, settings.unfocused_mode) != (focused, unfocused) {
        (settings.focused_mode, settings.unfocused_mode) = (focused, unfocused);
    }
}

/// Time stands while no part of the window can be seen.
#[cfg(not(target_arch = "wasm32"))]
fn stand_while_unseen(mut events: MessageReader<WindowEvent>, mut time: ResMut<Time<Virtual>>) {
    for event in events.read() {
        if let WindowEvent::WindowOccluded(window) = event {
            if window.occluded { time.pause() } else { time.unpause() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::params::Preset;
    use bevy::{ecs::system::RunSystemOnce, prelude::World};

    #[test]
    fn a_world_that_moves_never_rests() {
        assert_eq!(mode(true, false, Duration::from_secs(100)), UpdateMode::Continuous);
    }

    #[test]
    fn a_world_that_stands_rests_after_a_moment() {
        assert_eq!(mode(false, false, Duration::ZERO), UpdateMode::Continuous, "the last change must reach the screen");
        assert_eq!(mode(false, false, LINGER), UpdateMode::reactive_low_power(NAP));
    }

    #[test]
    fn what_works_in_the_background_is_watched_or_in_a_page_done() {
        let expected =
            if cfg!(target_arch = "wasm32") { UpdateMode::Continuous } else { UpdateMode::reactive_low_power(WATCH) };
        assert_eq!(mode(false, true, LINGER), expected);
    }

    /// A world in which nothing works.
    fn idle() -> World {
        let mut world = World::new();
        world.init_resource::<JobQueue<ExamCase>>();
        world.init_resource::<JobQueue<GauntletCase>>();
        world.init_resource::<StressTest>();
        world.init_resource::<Survey>();
        world.init_resource::<AccessibilityRequested>();
        world
    }

    fn works(world: &mut World) -> bool {
        world.run_system_once(|background: Background| background.works()).expect("all of it is there")
    }

    #[test]
    fn exam_and_gauntlet_are_work() {
        let mut world = idle();
        assert!(!works(&mut world));
        world.resource_mut::<JobQueue<ExamCase>>().begin(&[Preset::Fast]);
        assert!(works(&mut world));
        world.resource_mut::<JobQueue<ExamCase>>().stop();
        assert!(!works(&mut world));
        world.resource_mut::<JobQueue<GauntletCase>>().begin(&[Preset::Fast]);
        assert!(works(&mut world));
    }

    #[test]
    fn what_a_screen_reader_asks_for_is_watched() {
        let mut world = idle();
        assert!(!works(&mut world));
        world.resource::<AccessibilityRequested>().set(true);
        assert!(works(&mut world));
    }
}
