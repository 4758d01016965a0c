//! Going back: the states of the last half minute, newest first, to the bit what they were.

use crate::{
    monkey::whim,
    support::{Random, SimulationExt, blueprint},
};
use glam::Vec2;
use powder_master::{
    kernel::{brush::Stroke, params::Preset, simd::InstructionSet},
    sim::{
        checkpoint::Checkpoint,
        control,
        intent::Intent,
        recorder::{self, REWIND_BYTES, Recorder},
        recording::Recording,
        reel::{Frame, Reel, Step},
        replay::Replay,
        simulation::Simulation,
        state::{Clock, Setup},
        workers::Workers,
    },
};
use std::sync::Arc;

/// A world that keeps states to go back to.
fn kept(name: &str, settings: &[(&str, &str)]) -> Simulation {
    let start = Checkpoint::of_scene(Arc::new(blueprint(name, settings)));
    let simulation = Simulation::with_plugins(&start, Workers::default(), recorder::plugin);
    simulation.get::<Recorder>().keep_keys();
    simulation
}

fn begin(simulation: &Simulation) -> Reel {
    let now = Checkpoint::of(simulation.world());
    Reel::begin(simulation.world(), &now).unwrap_or_else(|| panic!("nothing is recorded"))
}

/// The state before the one that was given last.
fn before(reel: &mut Reel) -> Option<Frame> {
    loop {
        match reel.step() {
            Step::Frame(frame) => return Some(*frame),
            Step::Wait => assert!(reel.prepare(), "it waits for nothing"),
            Step::End => return None,
        }
    }
}

/// Ticks done, intents taken, hash.
fn seen(simulation: &Simulation) -> (u64, u64, u64) {
    let clock = simulation.get::<Clock>();
    (clock.tick, clock.edits, simulation.hash())
}

fn seen_in(frame: &Frame) -> (u64, u64, u64) {
    let clock = frame.state.state.clock;
    (clock.tick, clock.edits, frame.state.state.hash())
}

/// Plays by hand in every tick, and warms what is there; the states behind all ticks.
fn play(simulation: &mut Simulation, random: &mut Random, ticks: u32) -> Vec<(u64, u64, u64)> {
    let size = simulation.get::<Setup>().blueprint.domain.size;
    let tick = |_| {
        if random.index(3) == 0 {
            simulation.push(whim(random, size));
        }
        if random.index(6) == 0 {
            let (at, degrees) = (random.point(size), random.within(-200.0, 900.0));
            let stroke = Stroke { radius: 6.0, ..Stroke::rectangle(at, at + Vec2::splat(4.0)) };
            simulation.push(Intent::Warm { stroke, degrees });
        }
        simulation.tick();
        seen(simulation)
    };
    (0..ticks).map(tick).collect()
}

/// A recording of the last minute, run again; its ticks and its hash.
fn again(simulation: &Simulation) -> (u64, u64) {
    let recorder = simulation.get::<Recorder>();
    recorder.keep_up(simulation.world());
    let bytes = recorder.last_minute(recorder::end_now(simulation.world()));
    replayed(&bytes)
}

fn replayed(bytes: &[u8]) -> (u64, u64) {
    let recording = Recording::decode(bytes).unwrap_or_else(|error| panic!("{error}"));
    let replay = Replay::new(&recording, Workers::default(), InstructionSet::detect());
    let mut replay = replay.unwrap_or_else(|error| panic!("{error}"));
    while replay.tick().unwrap_or_else(|difference| panic!("{difference}")) {}
    let hash = replay.finish().unwrap_or_else(|difference| panic!("{difference}"));
    (replay.done(), hash)
}

#[test]
fn every_state_is_to_the_bit_what_it_was_with_hands_air_and_heat() {
    for (k, name) in ["waterfall", "volcano", "burning_house", "geyser", "hourglass"].into_iter().enumerate() {
        let mut simulation = kept(name, &[]);
        let mut states = vec![seen(&simulation)];
        states.extend(play(&mut simulation, &mut Random::new(700 + k as u64), 70));
        let mut reel = begin(&simulation);
        // The last is the one that the world is in.
        states.pop();
        for state in states.iter().rev() {
            let frame = before(&mut reel).unwrap_or_else(|| panic!("{name}: nothing before tick {}", state.0 + 1));
            assert_eq!(seen_in(&frame), *state, "{name}");
        }
        assert!(before(&mut reel).is_none(), "{name}: before the beginning there is something");
    }
}

#[test]
fn what_goes_on_from_a_state_goes_the_way_that_it_went_and_is_recorded() {
    let mut simulation = kept("volcano", &[]);
    simulation.get::<Recorder>().begin(simulation.world(), None);
    let states = play(&mut simulation, &mut Random::new(41), 60);
    // Without hands from here on.
    simulation.run(40);
    let end = seen(&simulation);
    for back in [1, 37, 40, 12] {
        let mut reel = begin(&simulation);
        let frame = (0..back).map(|_| before(&mut reel).expect("it is kept")).last().expect("some");
        frame.state.restore(simulation.world_mut());
        reel.go_on_from(simulation.world(), frame.spot);
        assert_eq!(simulation.get::<Clock>().tick, 100 - back);
        simulation.run(back as u32);
        assert_eq!(seen(&simulation), end, "{back} ticks back and forth");
        assert_eq!(again(&simulation), (100, end.2), "the last minute has the way that was gone, once");
    }
    // Into what was done by hand; it does not come again.
    let mut reel = begin(&simulation);
    let frame = (0..70).map(|_| before(&mut reel).expect("it is kept")).last().expect("some");
    assert_eq!(seen_in(&frame), states[29]);
    frame.state.restore(simulation.world_mut());
    reel.go_on_from(simulation.world(), frame.spot);
    simulation.run(25);
    assert_eq!(again(&simulation), (55, simulation.hash()));
    let recorder = simulation.get::<Recorder>();
    let bytes = recorder.recording(recorder::end_now(simulation.world())).expect("it runs");
    // Each way back is a jump in it, and what was taken back is there.
    assert_eq!(replayed(&bytes), (100 + 1 + 37 + 40 + 12 + 25, simulation.hash()));
}

#[test]
fn a_reset_and_edits_while_time_stood_are_gone_back_beyond() {
    let mut simulation = kept("empty", &[("columns", "60"), ("rows", "40")]);
    let random = &mut Random::new(8);
    let first = play(&mut simulation, random, 30);
    let size = simulation.get::<Setup>().blueprint.domain.size;
    (0..3).for_each(|_| {
        simulation.push(whim(random, size)).apply_edits();
    });
    let edited = seen(&simulation);
    assert!(edited.0 == first[29].0 && edited.2 != first[29].2, "time stood, and something changed");
    control::reset(simulation.world_mut());
    let second = play(&mut simulation, random, 20);
    let reset = Checkpoint::of_scene(simulation.get::<Setup>().blueprint.clone()).state.hash();
    let mut reel = begin(&simulation);
    let mut hashes = Vec::new();
    while let Some(frame) = before(&mut reel) {
        hashes.push(seen_in(&frame).2);
    }
    let mut expected: Vec<u64> = second[..19].iter().rev().map(|state| state.2).collect();
    // What was drawn while time stood is not shown, but what it was drawn on.
    expected.push(reset);
    expected.extend(first.iter().rev().map(|state| state.2));
    expected.push(reset);
    assert_eq!(hashes, expected);
    reel.put_away();
    simulation.run(5);
    assert_eq!(again(&simulation), (55, simulation.hash()), "looking changed nothing");
}

#[test]
#[cfg_attr(debug_assertions, ignore = "560 ticks of 100,000 particles: too slow where the solver is not optimised")]
fn a_hundred_thousand_particles_keep_within_the_memory_and_reach_less_far() {
    let mut simulation = kept("dam_break", &[("columns", "224")]);
    simulation.push(Intent::Quality { preset: Preset::Classic, quality: Preset::Classic.quality() });
    let ticks = 560;
    for _ in 0..ticks {
        simulation.tick();
        assert!(simulation.get::<Recorder>().key_bytes() < REWIND_BYTES);
    }
    assert!(simulation.particles().len() > 100_000);
    let now = Checkpoint::of(simulation.world());
    let mut reel = Reel::begin(simulation.world(), &now).expect("something is recorded");
    let mut back = 0;
    while before(&mut reel).is_some() {
        back += 1;
        let held = now.bytes() + reel.bytes() + simulation.get::<Recorder>().key_bytes();
        assert!(held <= REWIND_BYTES, "{held} bytes after {back} ticks");
    }
    assert!((120..ticks).contains(&back), "{back} ticks of {ticks}");
}
