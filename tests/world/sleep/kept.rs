//! Sleep is a part of the world: saved, put back, and the same on every processor.

use super::{asleep, disc, dry_box, emitter, lake, two_ponds, until_asleep};
use crate::support::{Furnish, ROCK, SimulationExt, WATER};
use glam::Vec2;
use powder_master::{
    kernel::simd::InstructionSet,
    sim::{checkpoint::Checkpoint, control, intent::Intent, pace::Pace, simulation::Simulation},
};

#[test]
fn a_world_put_back_or_loaded_while_it_sleeps_goes_on_to_the_bit() {
    let mut world = two_ponds();
    world.emitters.push(emitter());
    let mut simulation = Simulation::of(world.clone());
    simulation.run(240);
    assert_eq!(asleep(&simulation), 800, "one pond sleeps, the other moves");
    let frozen = control::freeze(simulation.world());
    let saved = Checkpoint::of(simulation.world()).encode();
    let play = |simulation: &mut Simulation| {
        simulation.run(20);
        simulation.push(Intent::Draw { element: WATER, stroke: disc(Vec2::new(100.0, 35.0), 2.0) });
        simulation.run(200).hash()
    };
    let straight = play(&mut simulation);
    control::thaw(simulation.world_mut(), &frozen);
    assert_eq!(control::freeze(simulation.world()), frozen, "a snapshot of a thawed world is another");
    assert_eq!(play(&mut simulation), straight, "undone");
    let mut other = Simulation::scene("empty", &[]);
    Checkpoint::decode(&saved).unwrap_or_else(|error| panic!("{error}")).restore(other.world_mut());
    assert_eq!(Checkpoint::of(other.world()).encode(), saved, "a loaded world is saved as another");
    assert_eq!(play(&mut other), straight, "loaded");
}

#[test]
fn an_edit_while_paused_is_in_what_is_saved() {
    let strokes = [
        Intent::Erase { stroke: disc(Vec2::new(40.0, 18.0), 3.0) },
        Intent::Draw { element: ROCK, stroke: disc(Vec2::new(40.0, 50.0), 3.0) },
        Intent::Stamp { element: WATER, stroke: disc(Vec2::new(40.0, 22.0), 2.0) },
    ];
    for stroke in strokes {
        let mut simulation = Simulation::of(lake());
        until_asleep(&mut simulation, 400);
        simulation.get_mut::<Pace>().paused = true;
        simulation.push(stroke.clone()).run(2);
        let frozen = control::freeze(simulation.world());
        let mut other = Simulation::of(lake());
        control::thaw(other.world_mut(), &frozen);
        simulation.get_mut::<Pace>().paused = false;
        assert_eq!(simulation.run(40).hash(), other.run(40).hash(), "{stroke:?}");
        assert_eq!(asleep(&simulation), 0, "{stroke:?} does not wake the lake");
    }
}

#[test]
fn sleeping_and_waking_give_the_same_bits_on_every_processor() {
    // Enough particles for more than one thread.
    let run = |threads: usize, set: InstructionSet| {
        let mut world = dry_box(200, 80);
        world.pool((0, 0), (90, 50));
        world.rock((90, 0), (92, 60));
        world.rock((108, 0), (110, 60));
        world.pool((110, 0), (200, 50));
        let mut simulation = Simulation::of(world).with_threads(threads).with_instructions(set);
        until_asleep(&mut simulation, 600);
        simulation.push(Intent::Stamp { element: WATER, stroke: disc(Vec2::new(40.0, 70.0), 3.0) });
        simulation.run(60);
        assert_eq!(asleep(&simulation), 4500, "one of the lakes woke");
        simulation.hash()
    };
    let widest = InstructionSet::detect();
    let expected = run(1, widest);
    for threads in [2, 3] {
        assert_eq!(run(threads, widest), expected, "{threads} threads");
    }
    assert_eq!(run(1, InstructionSet::Baseline), expected, "other lanes");
}
