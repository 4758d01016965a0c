//! Recordings: the same world again from any moment on, and the first tick that is not the same.

use crate::{
    monkey::whim,
    support::{Random, SimulationExt, WATER, blueprint},
};
use glam::Vec2;
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
        simd::InstructionSet,
    },
    lab::gauntlet::CASES,
    scene::{
        self,
        effects::{Effect, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        intent::Intent,
        pace::Pace,
        recorder::{self, KEPT_TICKS, Recorder, SEGMENT_TICKS},
        recording::{End, Recording, Writer},
        replay::{Difference, Replay},
        simulation::Simulation,
        state::{Clock, Setup},
        workers::Workers,
    },
};

use std::sync::Arc;

/// Small forms of the largest scenes.
fn small(name: &str) -> &'static [(&'static str, &'static str)] {
    match name {
        "dam_break" => &[("columns", "20")],
        "empty" => &[("columns", "100"), ("rows", "60")],
        _ => &[],
    }
}

fn recorded(name: &str, settings: &[(&str, &str)]) -> Simulation {
    let start = Checkpoint::of_scene(Arc::new(blueprint(name, settings)));
    Simulation::with_plugins(&start, Workers::default(), recorder::plugin)
}

fn file(simulation: &Simulation) -> Vec<u8> {
    let world = simulation.world();
    let recorder = world.resource::<Recorder>();
    let end = recorder::end_now(world);
    recorder.recording(end).unwrap_or_else(|| recorder.last_minute(end))
}

fn read(bytes: &[u8]) -> Recording {
    Recording::decode(bytes).unwrap_or_else(|error| panic!("{error}"))
}

/// Ticks and hash of a recording, run again.
fn again(recording: &Recording, workers: Workers, set: InstructionSet) -> Result<(u64, u64), Difference> {
    let mut replay = Replay::new(recording, workers, set).unwrap_or_else(|error| panic!("{error}"));
    while replay.tick()? {}
    let hash = replay.finish()?;
    Ok((replay.done(), hash))
}

fn same(recording: &Recording) -> (u64, u64) {
    again(recording, Workers::default(), InstructionSet::detect()).unwrap_or_else(|difference| panic!("{difference}"))
}

#[test]
#[cfg_attr(debug_assertions, ignore = "heavy: in release only")]
fn whims_in_every_built_in_scene_are_the_same_again_from_the_middle_on() {
    for (k, name) in scene::builtin_names().into_iter().enumerate() {
        let mut simulation = recorded(name, small(name));
        let size = simulation.get::<Setup>().blueprint.domain.size;
        let mut random = Random::new(300 + k as u64);
        let mut play = |simulation: &mut Simulation, ticks: u32| {
            for _ in 0..ticks {
                for _ in 0..random.index(3) {
                    simulation.push(whim(&mut random, size));
                }
                if random.index(20) == 0 {
                    let preset = Preset::ALL[random.index(5)];
                    simulation.push(Intent::Quality { preset, quality: preset.quality() });
                }
                if random.index(15) == 0 {
                    let mode = [Mode::Auto, Mode::On, Mode::Off][random.index(3)];
                    simulation.push(Intent::Effect { effect: Effect::ALL[random.index(Effect::ALL.len())], mode });
                }
                simulation.get_mut::<Pace>().paused = random.index(6) == 0;
                simulation.run(1);
            }
            simulation.get_mut::<Pace>().paused = false;
        };
        play(&mut simulation, 40);
        simulation.get::<Recorder>().begin(simulation.world(), None);
        let begun = simulation.get::<Clock>().tick;
        play(&mut simulation, 100);
        // Edits of a world that stands, at the very end.
        simulation.get_mut::<Pace>().paused = true;
        simulation.push(whim(&mut random, size)).run(1);
        let recording = read(&file(&simulation));
        assert_eq!(recording.segments.len(), 1);
        assert!(recording.segments[0].tick == begun && begun > 20, "{name}: it does not begin in the middle");
        let ticks = simulation.get::<Clock>().tick - begun;
        assert_eq!(same(&recording), (ticks, simulation.hash()), "{name}");
        if k % 3 == 0 {
            let other = again(&recording, Workers::new(3).unwrap(), InstructionSet::available()[0]);
            assert_eq!(other, Ok((ticks, simulation.hash())), "{name}: other threads and lanes");
        }
    }
}

#[test]
fn undo_and_reset_begin_a_segment_and_the_whole_is_the_same_again() {
    let mut simulation = recorded("dam_break", &[("columns", "12")]);
    simulation.get::<Recorder>().begin(simulation.world(), None);
    let pour = |simulation: &mut Simulation, x: f32| {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(x, 15.0), 2.0);
        simulation.push(Intent::Draw { element: WATER, stroke }).run(12);
    };
    pour(&mut simulation, 15.0);
    let before = control::freeze(simulation.world());
    pour(&mut simulation, 20.0);
    control::thaw(simulation.world_mut(), &before);
    pour(&mut simulation, 25.0);
    control::reset(simulation.world_mut());
    pour(&mut simulation, 30.0);
    let recording = read(&file(&simulation));
    let segments: Vec<_> = recording.segments.iter().map(|segment| (segment.tick, segment.marks.len())).collect();
    assert_eq!(segments, [(0, 24), (12, 12), (0, 12)], "what was undone stays in it");
    assert_eq!(same(&recording), (48, simulation.hash()));
    assert_eq!(read(&simulation.get::<Recorder>().last_minute(recorder::end_now(simulation.world()))), recording);
}

#[test]
fn a_recording_begun_right_after_a_jump_leaves_the_jump_in_the_last_minute() {
    let mut simulation = recorded("dam_break", &[("columns", "12")]);
    simulation.run(10);
    let before = control::freeze(simulation.world());
    simulation.run(10);
    control::thaw(simulation.world_mut(), &before);
    simulation.get_mut::<Pace>().paused = true;
    simulation.run(1);
    simulation.get::<Recorder>().begin(simulation.world(), None);
    simulation.get_mut::<Pace>().paused = false;
    simulation.run(10);
    let last_minute = read(&simulation.get::<Recorder>().last_minute(recorder::end_now(simulation.world())));
    assert_eq!(last_minute.segments.len(), 2, "the jump is not in it");
    assert_eq!(same(&last_minute), (30, simulation.hash()));
    assert_eq!(same(&read(&file(&simulation))), (10, simulation.hash()));
}

/// A hard case of the gauntlet with its script, as the game plays it where it is watched, recorded from its 20th tick on.
fn watched(name: &str, ticks: u32) -> (Simulation, Recording) {
    let case = CASES.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
    let mut simulation = recorded("empty", &[]);
    case.play(simulation.world_mut(), Preset::Draft).unwrap_or_else(|error| panic!("{error}"));
    simulation.run(20);
    simulation.get::<Recorder>().begin(simulation.world(), None);
    simulation.run(ticks);
    let recording = read(&file(&simulation));
    (simulation, recording)
}

#[test]
fn what_a_script_does_to_a_hard_case_is_in_its_recording() {
    let intents = |recording: &Recording, wanted: fn(&Intent) -> bool| {
        let entries = recording.segments.iter().flat_map(|segment| &segment.entries);
        entries.filter(|entry| wanted(&entry.intent)).count()
    };
    let turns = |intent: &Intent| matches!(intent, Intent::Gravity { .. });
    for (name, ticks, wanted, count) in [
        ("gravity_flips", 60, turns as fn(&Intent) -> bool, 60),
        ("gravity_turns", 60, turns, 6),
        ("effects_toggle", 60, |intent| matches!(intent, Intent::Effect { .. }), 60 * Effect::ALL.len()),
        ("quality_changes", 60, |intent| matches!(intent, Intent::Quality { .. }), 60),
        ("suction", 30, |intent| matches!(intent, Intent::Press { .. }), 10),
    ] {
        let (simulation, recording) = watched(name, ticks);
        assert_eq!(recording.segments.len(), 1, "{name}");
        assert_eq!(intents(&recording, wanted), count, "{name}");
        assert_eq!(same(&recording), (u64::from(ticks), simulation.hash()), "{name}");
    }
}

#[test]
fn what_a_script_breaks_without_an_intent_begins_a_segment() {
    let (simulation, recording) = watched("poison", 40);
    let begins: Vec<u64> = recording.segments.iter().map(|segment| segment.tick).collect();
    assert_eq!(begins, [20, 30, 40], "particles become no number after 20, 30 and 40 ticks");
    assert_eq!(same(&recording), (40, simulation.hash()));
}

#[test]
fn undo_gives_gravity_back_a_save_keeps_it_and_a_reset_ends_it() {
    let mut simulation = recorded("dam_break", &[("columns", "12")]);
    let scenes = simulation.get::<Setup>().domain.gravity;
    let before = Checkpoint::of(simulation.world());
    let up = -2.0 * scenes;
    simulation.push(Intent::Gravity { gravity: up }).run(10);
    assert_eq!(
        (simulation.get::<Setup>().domain.gravity, simulation.get::<Setup>().blueprint.domain.gravity),
        (up, scenes)
    );
    before.restore(simulation.world_mut());
    assert_eq!(simulation.get::<Setup>().domain.gravity, scenes);
    simulation.push(Intent::Gravity { gravity: up }).run(10);
    let saved =
        Checkpoint::decode(&Checkpoint::of(simulation.world()).encode()).unwrap_or_else(|error| panic!("{error}"));
    let mut other = Simulation::scene("empty", &[]);
    saved.restore(other.world_mut());
    assert_eq!(other.get::<Setup>().domain.gravity, up);
    simulation.run(10);
    assert_eq!(other.run(10).hash(), simulation.hash(), "a saved world falls another way");
    control::reset(simulation.world_mut());
    assert_eq!(simulation.get::<Setup>().domain.gravity, scenes);
    simulation.run(10);
    let recording = read(&file(&simulation));
    assert_eq!(recording.segments.len(), 3, "undo and reset");
    assert_eq!(same(&recording), (40, simulation.hash()));
}

#[test]
fn the_first_tick_that_differs_is_named() {
    let mut simulation = recorded("waterfall", &[]);
    simulation.run(30);
    simulation.get::<Recorder>().begin(simulation.world(), None);
    simulation.run(60);
    // Something reaches into the world behind the recorder's back, after tick 90.
    simulation.particles_mut().vx[17] += 1e-4;
    simulation.run(30);
    let recording = read(&file(&simulation));
    let found = again(&recording, Workers::default(), InstructionSet::detect()).expect_err("it differs");
    assert_eq!((found.tick, found.nth), (91, 61), "{found}");
    assert!(found.to_string().contains("tick 91 is the first that differs (number 61 of the recording)"), "{found}");
    assert!(found.to_string().contains("particles"), "{found}");
}

#[test]
fn a_file_that_was_tampered_with_differs_at_the_tick_where_it_was() {
    let mut simulation = recorded("dam_break", &[("columns", "12")]);
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(20.0, 15.0), 2.0);
    simulation.run(10);
    simulation.push(Intent::Draw { element: WATER, stroke }).run(20);
    let good = read(&file(&simulation));
    let write = |change: &dyn Fn(&mut Recording)| {
        let mut changed = good.clone();
        change(&mut changed);
        let mut writer = Writer::new();
        for segment in &changed.segments {
            // The state has not changed; this is how it came into the file.
            let mut world = Simulation::scene("dam_break", &[("columns", "12")]);
            world.run(segment.tick as u32);
            writer.start(&Checkpoint::of(world.world()).encode());
            writer.ticks(&segment.entries, &segment.marks);
        }
        writer.end(changed.end.unwrap());
        read(&writer.take())
    };
    assert_eq!(write(&|_| ()), good);
    let differs = |change: &dyn Fn(&mut Recording)| {
        again(&write(change), Workers::default(), InstructionSet::detect()).expect_err("it differs")
    };
    let found = differs(&|recording| recording.segments[0].entries.clear());
    assert_eq!(found.tick, 11, "{found}");
    assert!(found.to_string().contains("288 moving particles, recorded "), "{found}");
    let found = differs(&|recording| recording.segments[0].entries[0].tick = 15);
    assert_eq!(found.tick, 11, "{found}");
    let found = differs(&|recording| recording.segments[0].marks[24].surroundings ^= 1);
    assert_eq!(found.tick, 25, "{found}");
    assert!(found.to_string().ends_with("air or rock"), "{found}");
    let found = differs(&|recording| recording.end = Some(End::Stopped { hash: 5 }));
    assert_eq!((found.tick, found.recorded), (30, None), "{found}");
}

#[test]
fn the_last_minute_is_kept_and_no_more_than_a_segment_beyond() {
    let mut simulation = recorded("empty", &[("columns", "16"), ("rows", "16")]);
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(8.0, 8.0), 2.0);
    for second in 0..125 {
        if second % 20 == 3 {
            simulation.push(Intent::Draw { element: WATER, stroke });
        }
        simulation.run(60);
        let recording = read(&file(&simulation));
        let all = simulation.get::<Clock>().tick;
        let kept = recording.ticks();
        assert_eq!(recording.segments.len(), 1, "it follows itself without a jump");
        assert!(kept >= KEPT_TICKS.min(all) && kept < KEPT_TICKS + SEGMENT_TICKS as u64 + 60, "{kept} of {all}");
        assert_eq!(recording.segments[0].tick + kept, all);
    }
    assert_eq!(same(&read(&file(&simulation))).1, simulation.hash());
    let bytes = simulation.get::<Recorder>().bytes();
    assert!(bytes < 1 << 20, "a small world takes {bytes} bytes");
}

#[test]
fn changes_of_detail_are_the_same_again_on_other_threads() {
    let mut simulation = recorded("waterfall", &[]);
    simulation.run(20);
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(120.0, 150.0), 6.0);
    // In one tick: lengths of what follows are in the new d.
    simulation.push(Intent::Draw { element: WATER, stroke }).push(Intent::Detail { detail: 1.5 });
    simulation.push(Intent::Draw { element: WATER, stroke: stroke.scaled(1.5) }).run(5);
    simulation.push(Intent::Quality { preset: Preset::Reference, quality: Preset::Reference.quality() }).run(3);
    simulation.push(Intent::Quality { preset: Preset::Draft, quality: Preset::Draft.quality() });
    simulation.push(Intent::Detail { detail: 0.5 }).run(5);
    let recording = read(&file(&simulation));
    let hash = simulation.hash();
    assert_eq!(again(&recording, Workers::single(), InstructionSet::Baseline).expect("the same"), (33, hash));
    assert_eq!(same(&recording), (33, hash));
}
