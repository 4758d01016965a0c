//! Listens to the world that is played, from where the camera is.

use super::{Output, volume::Volume};
use crate::{
    game::camera::WorldCamera,
    lab::sound::{Audible, Ear, Listener},
    sim::{
        generation::Generation,
        pace::Pace,
        state::{AirGrid, Census, Clock, ParticleStore, Rock, Setup},
    },
    sound::{Controls, DEFAULT_RATE},
};
use bevy::{
    platform::time::Instant,
    prelude::{Res, ResMut, Resource, Time, Virtual},
};
use std::{collections::VecDeque, time::Duration};

/// Times that are kept for the median.
const HISTORY: usize = 64;

/// Who listens, and whether anyone does.
#[derive(Resource, Debug, Default)]
pub struct Ears {
    ear: Ear,
    open: bool,
    controls: Controls,
}

impl Ears {
    /// What was heard last.
    pub fn controls(&self) -> &Controls {
        &self.controls
    }
}

/// What sound costs.
#[derive(Resource, Debug, Default)]
pub struct SoundCost {
    /// How often the world was listened to.
    calls: u64,
    recent: VecDeque<Duration>,
    /// Frames that were played, and the time that took.
    played: (u64, Duration),
}

impl SoundCost {
    /// How often the world was listened to since the program began.
    pub fn calls(&self) -> u64 {
        self.calls
    }

    /// Median time of the last calls, ms.
    pub fn milliseconds(&self) -> f32 {
        let mut sorted: Vec<_> = self.recent.iter().copied().collect();
        sorted.sort_unstable();
        sorted.get(sorted.len() / 2).copied().unwrap_or_default().as_secs_f32() * 1000.0
    }

    /// Processor time to play a second of sound, ms, if any was played that tells.
    pub fn playing(&self) -> Option<f32> {
        let (frames, time) = self.played;
        (frames > 0).then(|| time.as_secs_f32() * 1000.0 * DEFAULT_RATE as f32 / frames as f32)
    }

    fn note(&mut self, time: Duration) {
        self.calls += 1;
        self.recent.truncate(HISTORY - 1);
        self.recent.push_front(time);
    }
}

/// Opens and shuts the ears: shut while nothing is to be heard, or nothing could be.
pub fn direct(
    pace: Res<Pace>,
    time: Res<Time<Virtual>>,
    volume: Res<Volume>,
    mut ears: ResMut<Ears>,
    mut output: ResMut<Output>,
) {
    let open = volume.gain() > 0.0 && pace.ticks() && !time.is_paused() && output.may_play();
    if ears.open == open {
        return;
    }
    ears.open = open;
    output.wish(open);
    if !open {
        output.leave(&Controls { gain: 0.0, ..ears.controls });
    }
}

/// Run condition: the ears are open, and there is a world.
pub fn hears(ears: Res<Ears>, setup: Option<Res<Setup>>) -> bool {
    ears.open && setup.is_some()
}

/// Listens to what the ticks of the frame did, and leaves it on the desk.
pub fn listen(
    (setup, particles, rock): (Res<Setup>, Res<ParticleStore>, Res<Rock>),
    (air, census, clock): (Res<AirGrid>, Res<Census>, Res<Clock>),
    generation: Res<Generation>,
    (camera, volume): (Res<WorldCamera>, Res<Volume>),
    output: Res<Output>,
    mut ears: ResMut<Ears>,
    mut cost: ResMut<SoundCost>,
) {
    let begun = Instant::now();
    let audible = Audible::of_parts(&setup, &particles, &rock, &air, &census, clock.tick, *generation);
    let heard = ears.ear.listen(&audible, listener(&camera, &setup));
    ears.controls = Controls { gain: volume.gain(), ..heard };
    output.leave(&ears.controls);
    cost.note(begun.elapsed());
    cost.played = output.played();
}

/// Before the middle of what the window shows.
fn listener(camera: &WorldCamera, setup: &Setup) -> Listener {
    let (scale, free) = (setup.blueprint.scale, camera.free());
    let centre = scale.vec_to_metres(camera.to_world((free.min + free.max) / 2.0));
    Listener { centre, width: scale.to_metres((free.max.x - free.min.x) / camera.pixels_per_d()) }
}

#[cfg(test)]
#[cfg(not(target_arch = "wasm32"))]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        scene::{self, effects::EffectModes},
        sim::{SimulationPlugin, checkpoint::Checkpoint},
    };
    use bevy::{MinimalPlugins, app::App, time::TimeUpdateStrategy};
    use glam::Vec2;
    use std::sync::Arc;

    /// A game that is heard by nobody: its output is a desk.
    fn game() -> App {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, SimulationPlugin, crate::game::sound::plugin))
            .init_resource::<WorldCamera>()
            .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
            .insert_resource(Output::of_desk());
        let scene = scene::load("dam_break").unwrap();
        let blueprint = scene.build(&[], Some(Preset::Fast), &EffectModes::new()).unwrap();
        Checkpoint::of_scene(Arc::new(blueprint)).restore(app.world_mut());
        app
    }

    fn calls(app: &App) -> u64 {
        app.world().resource::<SoundCost>().calls()
    }

    fn run(app: &mut App, frames: u32) -> u64 {
        let before = calls(app);
        (0..frames).for_each(|_| app.update());
        calls(app) - before
    }

    #[test]
    fn nothing_listens_while_muted_paused_unseen_or_without_an_output() {
        let mut app = game();
        assert!((8..=10).contains(&run(&mut app, 10)));
        assert!(app.world().resource::<Ears>().controls.stream_level > 0.0);
        app.world_mut().resource_mut::<Volume>().toggle();
        assert_eq!(run(&mut app, 10), 0, "muted");
        app.world_mut().resource_mut::<Volume>().toggle();
        assert_eq!(run(&mut app, 10), 10);
        app.world_mut().resource_mut::<Pace>().paused = true;
        assert_eq!(run(&mut app, 10), 0, "paused");
        app.world_mut().resource_mut::<Pace>().paused = false;
        app.world_mut().resource_mut::<Time<Virtual>>().pause();
        assert_eq!(run(&mut app, 10), 0, "its window can't be seen");
        app.world_mut().resource_mut::<Time<Virtual>>().unpause();
        assert_eq!(run(&mut app, 10), 10);
        app.insert_resource(Output::default());
        assert_eq!(run(&mut app, 10), 0, "there is no output");
    }

    #[test]
    fn the_listener_goes_with_the_camera() {
        let app = game();
        let setup = app.world().resource::<Setup>();
        let size = setup.blueprint.domain.size;
        let mut camera = WorldCamera::new(Vec2::new(1000.0, 500.0), size);
        let whole = listener(&camera, setup);
        assert!((whole.centre - setup.blueprint.scale.vec_to_metres(size) / 2.0).length() < 1e-3);
        camera.zoom_at(Vec2::new(900.0, 250.0), 4.0);
        let near = listener(&camera, setup);
        assert!((near.width / whole.width - 0.25).abs() < 1e-3 && near.centre.x > whole.centre.x);
    }
}
