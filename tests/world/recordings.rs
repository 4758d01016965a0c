//! Recordings: the same world again from any moment on, and the first tick that is not the same.

use crate::{
    monkey::whim,
    support::{Random, Sandbox, WATER},
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
        control,
        intent::Intent,
        pace::Pace,
        recorder::{self, KEPT_TICKS, Recorder, SEGMENT_TICKS},
        recording::{End, Recording, Writer},
        replay::{Difference, Replay},
        save,
        state::{Clock, Setup},
        workers::Workers,
    },
};

/// Small forms of the largest scenes.
fn small(name: &str) -> &'static [(&'static str, &'static str)] {
    match name {
        "dam_break" => &[("columns", "20")],
        "empty" => &[("columns", "100"), ("rows", "60")],
        _ => &[],
    }
}

fn recorded(name: &str, settings: &[(&str, &str)]) -> Sandbox {
    let mut sandbox = Sandbox::scene(name, settings);
    recorder::plugin(&mut sandbox.app);
    sandbox
}

fn file(sandbox: &Sandbox) -> Vec<u8> {
    let world = sandbox.app.world();
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
fn whims_in_every_built_in_scene_are_the_same_again_from_the_middle_on() {
    for (k, name) in scene::builtin_names().into_iter().enumerate() {
        let mut sandbox = recorded(name, small(name));
        let size = sandbox.get::<Setup>().blueprint.domain.size;
        let mut random = Random::new(300 + k as u64);
        let mut play = |sandbox: &mut Sandbox, ticks: u32| {
            for _ in 0..ticks {
                for _ in 0..random.index(3) {
                    sandbox.push(whim(&mut random, size));
                }
                if random.index(20) == 0 {
                    let preset = Preset::ALL[random.index(5)];
                    sandbox.push(Intent::Quality { preset, quality: preset.quality() });
                }
                if random.index(15) == 0 {
                    let mode = [Mode::Auto, Mode::On, Mode::Off][random.index(3)];
                    sandbox.push(Intent::Effect { effect: Effect::ALL[random.index(Effect::ALL.len())], mode });
                }
                sandbox.get_mut::<Pace>().paused = random.index(6) == 0;
                sandbox.tick(1);
            }
            sandbox.get_mut::<Pace>().paused = false;
        };
        play(&mut sandbox, 40);
        sandbox.get::<Recorder>().begin(sandbox.app.world(), None);
        let begun = sandbox.get::<Clock>().tick;
        play(&mut sandbox, 100);
        // Edits of a world that stands, at the very end.
        sandbox.get_mut::<Pace>().paused = true;
        sandbox.push(whim(&mut random, size)).tick(1);
        let recording = read(&file(&sandbox));
        assert_eq!(recording.stretches.len(), 1);
        assert!(recording.stretches[0].tick == begun && begun > 20, "{name}: it does not begin in the middle");
        let ticks = sandbox.get::<Clock>().tick - begun;
        assert_eq!(same(&recording), (ticks, sandbox.hash()), "{name}");
        if k % 3 == 0 {
            let other = again(&recording, Workers::new(3).unwrap(), InstructionSet::available()[0]);
            assert_eq!(other, Ok((ticks, sandbox.hash())), "{name}: other threads and lanes");
        }
    }
}

#[test]
fn undo_and_reset_begin_a_stretch_and_the_whole_is_the_same_again() {
    let mut sandbox = recorded("dam_break", &[("columns", "12")]);
    sandbox.get::<Recorder>().begin(sandbox.app.world(), None);
    let pour = |sandbox: &mut Sandbox, x: f32| {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(x, 15.0), 2.0);
        sandbox.push(Intent::Draw { element: WATER, stroke }).tick(12);
    };
    pour(&mut sandbox, 15.0);
    let before = control::freeze(sandbox.app.world());
    pour(&mut sandbox, 20.0);
    control::thaw(sandbox.app.world_mut(), &before);
    pour(&mut sandbox, 25.0);
    control::reset(sandbox.app.world_mut());
    pour(&mut sandbox, 30.0);
    let recording = read(&file(&sandbox));
    let stretches: Vec<_> = recording.stretches.iter().map(|stretch| (stretch.tick, stretch.marks.len())).collect();
    assert_eq!(stretches, [(0, 24), (12, 12), (0, 12)], "what was undone stays in it");
    assert_eq!(same(&recording), (48, sandbox.hash()));
    assert_eq!(read(&sandbox.get::<Recorder>().last_minute(recorder::end_now(sandbox.app.world()))), recording);
}

#[test]
fn a_recording_begun_right_after_a_jump_leaves_the_jump_in_the_last_minute() {
    let mut sandbox = recorded("dam_break", &[("columns", "12")]);
    sandbox.tick(10);
    let before = control::freeze(sandbox.app.world());
    sandbox.tick(10);
    control::thaw(sandbox.app.world_mut(), &before);
    sandbox.get_mut::<Pace>().paused = true;
    sandbox.tick(1);
    sandbox.get::<Recorder>().begin(sandbox.app.world(), None);
    sandbox.get_mut::<Pace>().paused = false;
    sandbox.tick(10);
    let last_minute = read(&sandbox.get::<Recorder>().last_minute(recorder::end_now(sandbox.app.world())));
    assert_eq!(last_minute.stretches.len(), 2, "the jump is not in it");
    assert_eq!(same(&last_minute), (30, sandbox.hash()));
    assert_eq!(same(&read(&file(&sandbox))), (10, sandbox.hash()));
}

/// A hard case of the gauntlet with its script, as the game plays it where it is watched, recorded from its 20th tick on.
fn watched(name: &str, ticks: u32) -> (Sandbox, Recording) {
    let case = CASES.iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"));
    let mut sandbox = recorded("empty", &[]);
    case.play(sandbox.app.world_mut(), Preset::Draft).unwrap_or_else(|error| panic!("{error}"));
    sandbox.tick(20);
    sandbox.get::<Recorder>().begin(sandbox.app.world(), None);
    sandbox.tick(ticks);
    let recording = read(&file(&sandbox));
    (sandbox, recording)
}

#[test]
fn what_a_script_does_to_a_hard_case_is_in_its_recording() {
    let intents = |recording: &Recording, wanted: fn(&Intent) -> bool| {
        let entries = recording.stretches.iter().flat_map(|stretch| &stretch.entries);
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
        let (sandbox, recording) = watched(name, ticks);
        assert_eq!(recording.stretches.len(), 1, "{name}");
        assert_eq!(intents(&recording, wanted), count, "{name}");
        assert_eq!(same(&recording), (u64::from(ticks), sandbox.hash()), "{name}");
    }
}

#[test]
fn what_a_script_breaks_without_an_intent_begins_a_stretch() {
    let (sandbox, recording) = watched("poison", 40);
    let begins: Vec<u64> = recording.stretches.iter().map(|stretch| stretch.tick).collect();
    assert_eq!(begins, [20, 30, 40], "particles become no number after 20, 30 and 40 ticks");
    assert_eq!(same(&recording), (40, sandbox.hash()));
}

/// Gravity is no part of a state that undo puts back, but of the scene that reset begins again.
#[test]
fn gravity_stays_through_undo_and_saves_and_ends_with_a_reset() {
    let mut sandbox = recorded("dam_break", &[("columns", "12")]);
    let scenes = sandbox.get::<Setup>().domain.gravity;
    let before = control::freeze(sandbox.app.world());
    let up = -2.0 * scenes;
    sandbox.push(Intent::Gravity { gravity: up }).tick(10);
    assert_eq!((sandbox.get::<Setup>().domain.gravity, sandbox.get::<Setup>().blueprint.domain.gravity), (up, scenes));
    control::thaw(sandbox.app.world_mut(), &before);
    sandbox.tick(10);
    let saved = save::decode(&save::encode(sandbox.app.world())).unwrap_or_else(|error| panic!("{error}"));
    let mut other = Sandbox::scene("empty", &[]);
    save::load(other.app.world_mut(), saved);
    assert_eq!(other.get::<Setup>().domain.gravity, up);
    sandbox.tick(10);
    assert_eq!(other.tick(10).hash(), sandbox.hash(), "a saved world falls another way");
    control::reset(sandbox.app.world_mut());
    assert_eq!(sandbox.get::<Setup>().domain.gravity, scenes);
    sandbox.tick(10);
    let recording = read(&file(&sandbox));
    assert_eq!(recording.stretches.len(), 3, "undo and reset");
    assert_eq!(same(&recording), (40, sandbox.hash()));
}

#[test]
fn the_first_tick_that_differs_is_named() {
    let mut sandbox = recorded("waterfall", &[]);
    sandbox.tick(30);
    sandbox.get::<Recorder>().begin(sandbox.app.world(), None);
    sandbox.tick(60);
    // Something reaches into the world behind the recorder's back, after tick 90.
    sandbox.particles_mut().vx[17] += 1e-4;
    sandbox.tick(30);
    let recording = read(&file(&sandbox));
    let found = again(&recording, Workers::default(), InstructionSet::detect()).expect_err("it differs");
    assert_eq!((found.tick, found.nth), (91, 61), "{found}");
    assert!(found.to_string().contains("tick 91 is the first that differs (number 61 of the recording)"), "{found}");
    assert!(found.to_string().contains("particles"), "{found}");
}

#[test]
fn a_file_that_was_tampered_with_differs_at_the_tick_where_it_was() {
    let mut sandbox = recorded("dam_break", &[("columns", "12")]);
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(20.0, 15.0), 2.0);
    sandbox.tick(10);
    sandbox.push(Intent::Draw { element: WATER, stroke }).tick(20);
    let good = read(&file(&sandbox));
    let write = |change: &dyn Fn(&mut Recording)| {
        let mut changed = good.clone();
        change(&mut changed);
        let mut writer = Writer::new();
        for stretch in &changed.stretches {
            // The state has not changed; this is how it came into the file.
            let mut world = Sandbox::scene("dam_break", &[("columns", "12")]);
            world.tick(stretch.tick as u32);
            writer.start(&save::encode(world.app.world()));
            writer.ticks(&stretch.entries, &stretch.marks);
        }
        writer.end(changed.end.unwrap());
        read(&writer.take())
    };
    assert_eq!(write(&|_| ()), good);
    let differs = |change: &dyn Fn(&mut Recording)| {
        again(&write(change), Workers::default(), InstructionSet::detect()).expect_err("it differs")
    };
    let found = differs(&|recording| recording.stretches[0].entries.clear());
    assert_eq!(found.tick, 11, "{found}");
    assert!(found.to_string().contains("288 moving particles, recorded "), "{found}");
    let found = differs(&|recording| recording.stretches[0].entries[0].tick = 15);
    assert_eq!(found.tick, 11, "{found}");
    let found = differs(&|recording| recording.stretches[0].marks[24].surroundings ^= 1);
    assert_eq!(found.tick, 25, "{found}");
    assert!(found.to_string().ends_with("air or rock"), "{found}");
    let found = differs(&|recording| recording.end = Some(End::Stopped { hash: 5 }));
    assert_eq!((found.tick, found.recorded), (30, None), "{found}");
}

#[test]
fn the_last_minute_is_kept_and_no_more_than_a_segment_beyond() {
    let mut sandbox = recorded("empty", &[("columns", "16"), ("rows", "16")]);
    let stroke = Stroke::dab(BrushShape::Disc, Vec2::new(8.0, 8.0), 2.0);
    for second in 0..125 {
        if second % 20 == 3 {
            sandbox.push(Intent::Draw { element: WATER, stroke });
        }
        sandbox.tick(60);
        let recording = read(&file(&sandbox));
        let all = sandbox.get::<Clock>().tick;
        let kept = recording.ticks();
        assert_eq!(recording.stretches.len(), 1, "it follows itself without a jump");
        assert!(kept >= KEPT_TICKS.min(all) && kept < KEPT_TICKS + SEGMENT_TICKS as u64 + 60, "{kept} of {all}");
        assert_eq!(recording.stretches[0].tick + kept, all);
    }
    assert_eq!(same(&read(&file(&sandbox))).1, sandbox.hash());
    let bytes = sandbox.get::<Recorder>().size_in_memory();
    assert!(bytes < 1 << 20, "a small world takes {bytes} bytes");
}
