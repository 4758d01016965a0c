//! Sleep is a part of the world: saved, put back, and the same on every processor.

use super::{asleep, disc, dry_box, emitter, lake, two_ponds, until_asleep};
use crate::support::{Furnish, ROCK, Sandbox, WATER};
use glam::Vec2;
use powder_master::{
    kernel::simd::InstructionSet,
    sim::{control, intent::Intent, pace::Pace, save},
};

#[test]
fn a_world_put_back_or_loaded_while_it_sleeps_goes_on_to_the_bit() {
    let mut world = two_ponds();
    world.emitters.push(emitter());
    let mut sandbox = Sandbox::of(world.clone());
    sandbox.tick(240);
    assert_eq!(asleep(&sandbox), 800, "one pond sleeps, the other moves");
    let frozen = control::freeze(sandbox.app.world());
    let saved = save::encode(sandbox.app.world());
    let play = |sandbox: &mut Sandbox| {
        sandbox.tick(20);
        sandbox.push(Intent::Draw { element: WATER, stroke: disc(Vec2::new(100.0, 35.0), 2.0) });
        sandbox.tick(200).hash()
    };
    let straight = play(&mut sandbox);
    control::thaw(sandbox.app.world_mut(), &frozen);
    assert_eq!(control::freeze(sandbox.app.world()), frozen, "a snapshot of a thawed world is another");
    assert_eq!(play(&mut sandbox), straight, "undone");
    let mut other = Sandbox::scene("empty", &[]);
    save::load(other.app.world_mut(), save::decode(&saved).unwrap_or_else(|error| panic!("{error}")));
    assert_eq!(save::encode(other.app.world()), saved, "a loaded world is saved as another");
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
        let mut sandbox = Sandbox::of(lake());
        until_asleep(&mut sandbox, 400);
        sandbox.get_mut::<Pace>().paused = true;
        sandbox.push(stroke).tick(2);
        let frozen = control::freeze(sandbox.app.world());
        let mut other = Sandbox::of(lake());
        control::thaw(other.app.world_mut(), &frozen);
        sandbox.get_mut::<Pace>().paused = false;
        assert_eq!(sandbox.tick(40).hash(), other.tick(40).hash(), "{stroke:?}");
        assert_eq!(asleep(&sandbox), 0, "{stroke:?} does not wake the lake");
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
        let mut sandbox = Sandbox::of(world).with_threads(threads).with_lanes(set);
        until_asleep(&mut sandbox, 600);
        sandbox.push(Intent::Stamp { element: WATER, stroke: disc(Vec2::new(40.0, 70.0), 3.0) });
        sandbox.tick(60);
        assert_eq!(asleep(&sandbox), 4500, "one of the lakes woke");
        sandbox.hash()
    };
    let widest = InstructionSet::detect();
    let expected = run(1, widest);
    for threads in [2, 3] {
        assert_eq!(run(threads, widest), expected, "{threads} threads");
    }
    assert_eq!(run(1, InstructionSet::Baseline), expected, "other lanes");
}
