//! What comes to rest falls asleep, where it would have come to rest; what moves never does.

use super::{apart, asleep, dry_box, emitter, gap, lake, two_ponds, until_asleep, without_sleep, work};
use crate::support::{Furnish, SimulationExt, blueprint, with_water};
use glam::Vec2;
use powder_master::{
    kernel::params::Preset,
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
        passes::Pass,
    },
    sim::{simulation::Simulation, state::Clock},
};

#[test]
fn a_still_lake_falls_asleep_and_costs_nothing() {
    for preset in [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine] {
        let mut world = lake();
        (world.preset, world.quality) = (preset, preset.quality());
        let mut simulation = Simulation::of(world);
        until_asleep(&mut simulation, 400);
        let (before, hash) = (work(&simulation), simulation.hash());
        simulation.run(600);
        assert_eq!(work(&simulation), before, "{}: passes run over sleepers", preset.name());
        assert_eq!(simulation.hash(), hash, "{}: sleepers move", preset.name());
        assert_eq!(simulation.counters().escaped, 0);
    }
}

/// Water of that thickness swings for seconds where water as it is swings for minutes.
fn thick(mut world: Blueprint) -> Blueprint {
    world.effects.insert(Effect::Viscosity, Mode::On);
    with_water(&mut world, |water| water.smoothing = 0.3);
    world
}

#[test]
fn what_settles_falls_asleep_level_and_where_it_would_have_come_to_rest() {
    // A block that falls over, thick enough to settle soon.
    let world = thick(blueprint("dam_break", &[("columns", "14")]));
    let (mut simulation, mut reference) = (Simulation::of(world.clone()), without_sleep(world));
    until_asleep(&mut simulation, 6000);
    reference.run(6000);
    let (share, height) = apart(&simulation, &reference);
    assert!(share < 0.02 && height < 0.5, "a share of {share} is elsewhere, the surface is {height} d off");
}

#[test]
fn classic_reference_and_off_never_sleep() {
    for (preset, mode) in [(Preset::Classic, Mode::Auto), (Preset::Reference, Mode::Auto), (Preset::Draft, Mode::Off)] {
        let mut world = dry_box(24, 24);
        world.pool((0, 0), (24, 4));
        (world.preset, world.quality) = (preset, preset.quality());
        world.effects.insert(Effect::Sleep, mode);
        let mut simulation = Simulation::of(world);
        let before = simulation.run(200).calls(Pass::Solve);
        simulation.run(1);
        assert_eq!(asleep(&simulation), 0, "{} sleeps", preset.name());
        assert!(simulation.calls(Pass::Solve) > before);
    }
}

#[test]
fn sleep_changes_nothing_to_the_bit_where_nothing_rests() {
    // In the waterfall a puddle rests from the start, which nothing can for longer than a second without sleep.
    for (scene, ticks) in [("dam_break", 150), ("waterfall", 50), ("wind_tunnel", 150)] {
        let mut with = Simulation::scene(scene, &[]);
        let mut without = without_sleep(blueprint(scene, &[]));
        let hash = with.run(ticks).hash();
        assert_eq!(asleep(&with), 0, "{scene}: the test is of what is awake");
        assert_eq!(hash, without.run(ticks).hash(), "{scene}");
    }
}

#[test]
fn a_body_sleeps_beside_one_that_moves() {
    let world = |emitters: bool| {
        let mut world = two_ponds();
        if emitters {
            world.emitters.push(emitter());
        }
        world
    };
    let (mut simulation, mut reference) = (Simulation::of(world(true)), without_sleep(world(true)));
    let mut slept = 0;
    for tick in 0..900 {
        simulation.run(1);
        reference.run(1);
        slept += u32::from(asleep(&simulation) == 800);
        assert!(asleep(&simulation) == 0 || gap(&simulation) > 5.0, "tick {tick}");
        if tick % 100 == 99 {
            let (share, _) = apart(&simulation, &reference);
            assert!(share < 0.1, "tick {tick}: a share of {share} is elsewhere");
        }
    }
    assert!(slept > 600, "the right pond slept for {slept} ticks only");
    assert_eq!(simulation.particles().len(), reference.particles().len());
}

#[test]
fn what_rests_without_gravity_sleeps_where_it_is() {
    let mut world = dry_box(60, 60);
    world.domain.gravity = Vec2::ZERO;
    world.pool((20, 20), (40, 40));
    let mut simulation = Simulation::of(world);
    until_asleep(&mut simulation, 400);
    let hash = simulation.hash();
    assert_eq!(simulation.run(600).hash(), hash);
    simulation.particles_mut().vx[0] = 30.0;
    simulation.run(1);
    assert_eq!(asleep(&simulation), 0, "a push does not wake it");
}

#[test]
fn vessels_fall_asleep_level() {
    let mut world = thick(blueprint("communicating_vessels", &[]));
    (world.preset, world.quality) = (Preset::Draft, Preset::Draft.quality());
    let mut simulation = Simulation::of(world.clone());
    until_asleep(&mut simulation, 12_000);
    let slept = simulation.get::<Clock>().tick;
    let mut reference = without_sleep(world);
    reference.run(slept as u32 + 300);
    let (share, height) = apart(&simulation, &reference);
    println!("asleep after {slept} ticks: share {share}, height {height}");
    // Water of 0.01 d a tick that swings from tank to tank at 1.43 /s stands 0.42 d off in the wide one and 0.67 d in the
    // narrow one when it is stopped; without sleep it may be on the other side by then.
    assert!(share < 0.02 && height < 1.3, "a share of {share} is elsewhere, the surface is {height} d off");
}
