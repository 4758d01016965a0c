//! The simulation in an app of your own: opens a scene and pours water under a pointer, which moves by itself here. With
//! `DefaultPlugins` in place of `MinimalPlugins` the cursor can move it.
//!
//!     cargo run --release --no-default-features --example minimal

use bevy::{prelude::*, time::TimeUpdateStrategy};
use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    scene::{self, effects::EffectModes},
    sim::SimulationPlugin,
    sim::checkpoint::Checkpoint,
    sim::intent::{Intent, IntentQueue},
    sim::state::{Clock, ParticleStore, Setup},
};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = scene::load("empty")?.build(&[], None, &EffectModes::new())?;
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, SimulationPlugin))
        .insert_resource(TimeUpdateStrategy::FixedTimesteps(1)) // A tick a frame; without it, in real time.
        .add_systems(FixedPreUpdate, pour)
        .add_systems(Last, stop);
    Checkpoint::of_scene(scene.into()).restore(app.world_mut());
    app.run();
    Ok(())
}

fn pour(setup: Res<Setup>, clock: Res<Clock>, mut intents: ResMut<IntentQueue>) {
    let Some(element) = setup.blueprint.elements.find("water") else { return };
    let pointer = setup.blueprint.domain.size * Vec2::new(0.2 + clock.tick as f32 / 500.0, 0.8);
    intents.push(Intent::Draw { element, stroke: Stroke::dab(BrushShape::Disc, pointer, 4.0) });
}

fn stop(clock: Res<Clock>, particles: Res<ParticleStore>, mut exit: MessageWriter<AppExit>) {
    if clock.tick == 300 {
        println!("{} particles after {} ticks", particles.len(), clock.tick);
        exit.write(AppExit::Success);
    }
}
