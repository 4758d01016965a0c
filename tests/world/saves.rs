//! Save files of whole worlds: they come back to the bit and go on as if nothing had been.

use crate::support::{Random, SimulationExt, WATER, assert_goes_on_from_a_save, blueprint};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
    },
    scene::effects::{Effect, Mode},
    sim::{
        checkpoint::Checkpoint,
        control,
        effects::Effects,
        intent::Intent,
        simulation::Simulation,
        state::{Clock, Setup},
    },
};

fn pour(simulation: &mut Simulation, random: &mut Random, size: Vec2) {
    let stroke = Stroke::dab(BrushShape::Disc, random.point(size), 3.0);
    simulation.push(Intent::Draw { element: WATER, stroke });
    simulation.push(Intent::Blow { stroke, velocity: random.point(Vec2::splat(60.0)) });
}

fn reload(world: &Simulation) -> Simulation {
    let bytes = Checkpoint::of(world.world()).encode();
    let mut other = Simulation::scene("empty", &[("columns", "16"), ("rows", "16")]);
    other.run(3);
    Checkpoint::decode(&bytes).unwrap_or_else(|error| panic!("{error}")).restore(other.world_mut());
    other
}

#[test]
fn a_loaded_world_goes_on_to_the_bit() {
    for (scene, settings) in [
        ("dam_break", &[("columns", "14")][..]),
        ("rest_density", &[]),
        ("communicating_vessels", &[("left", "2")]),
        ("wind_tunnel", &[]),
        ("sealed_air", &[]),
    ] {
        let mut world = Simulation::scene(scene, settings);
        let size = world.get::<Setup>().blueprint.domain.size;
        let mut random = Random::new(4);
        for _ in 0..5 {
            pour(&mut world, &mut random, size);
            world.run(6);
        }
        let mut loaded = reload(&world);
        assert_eq!(loaded.hash(), world.hash(), "{scene}: the round trip changes the world");
        assert_eq!(*loaded.get::<Clock>(), *world.get::<Clock>());
        for simulation in [&mut loaded, &mut world] {
            let mut random = Random::new(5);
            pour(simulation, &mut random, size);
            simulation.run(100);
            pour(simulation, &mut random, size);
            simulation.run(100);
        }
        assert_eq!(loaded.hash(), world.hash(), "{scene}: a loaded world goes another way");
    }
}

#[test]
fn reset_goes_back_to_the_loaded_state() {
    let mut world = Simulation::scene("rest_density", &[]);
    world.run(50);
    let mut loaded = reload(&world);
    loaded.run(40);
    assert_ne!(loaded.hash(), world.hash());
    control::reset(loaded.world_mut());
    assert_eq!(loaded.hash(), world.hash(), "reset after a load goes elsewhere than to the loaded state");
    assert_eq!(loaded.run(40).hash(), world.run(40).hash());
}

#[test]
fn a_file_keeps_scene_quality_and_effects() {
    let mut blueprint = blueprint("rest_density", &[("ratio", "2"), ("particle_limit", "1234")]);
    blueprint.effects.insert(Effect::Tension, Mode::Off);
    let mut world = Simulation::of(blueprint);
    let quality = powder_master::kernel::params::Quality { iterations: 7, ..Preset::Fine.quality() };
    world.set_quality(Preset::Fine, quality).unwrap();
    world.get_mut::<Effects>().get_mut(Effect::Viscosity).mode = Mode::On;
    world.run(30);
    let loaded = reload(&world);
    let (before, after) = (world.get::<Setup>(), loaded.get::<Setup>());
    assert_eq!((after.preset, after.quality), (Preset::Fine, quality));
    assert_eq!(after.blueprint.parameters, before.blueprint.parameters);
    assert_eq!(after.blueprint.fluid, before.blueprint.fluid);
    assert_eq!(after.blueprint.particle_limit, 1234);
    assert_eq!((&after.blueprint.name, &after.blueprint.title), (&before.blueprint.name, &before.blueprint.title));
    assert_eq!(after.blueprint.elements, before.blueprint.elements);
    assert_eq!(loaded.get::<Effects>().modes(), world.get::<Effects>().modes());
}

#[test]
fn a_world_with_a_bad_particle_can_be_saved() {
    let mut world = Simulation::scene("dam_break", &[("columns", "6")]);
    world.run(5);
    world.particles_mut().x[7] = f32::NAN;
    let mut loaded = reload(&world);
    assert_eq!(loaded.particles().len(), 71);
    assert_eq!(loaded.run(30).hash(), world.run(30).hash());
    let size = world.get::<Setup>().domain.size;
    world.particles_mut().x[3] = -2.0;
    world.particles_mut().y[5] = size.y + 3.0;
    assert_eq!(reload(&world).particles().len(), 69, "a world with escaped particles can't be loaded");
}

/// The air follows the rock that comes and goes by itself, or a save of such a world is not sound.
#[test]
fn a_world_whose_rock_burned_or_was_eaten_goes_on_from_a_save() {
    for (scene, ticks, gone) in [("burning_house", 400, "wood"), ("acid", 300, "metal")] {
        let mut world = Simulation::scene(scene, &[]);
        let before = world.count(gone);
        world.run(ticks);
        assert!(world.count(gone) < before, "{scene}: {before} of {gone} before, {}", world.count(gone));
        assert_goes_on_from_a_save(&mut world, 30);
    }
}
