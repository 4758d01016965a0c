//! Recordings and saves: the same world again, and half a file.

use crate::{folder, good, metrics, program, refused};
use powder_master::{
    kernel::brush::{BrushShape, Stroke},
    lab::run::{self, Plan},
    scene,
    sim::{
        checkpoint::Checkpoint,
        intent::Intent,
        recorder::{self, Recorder},
        recording::{Entry, Recording, Writer},
        simulation::Simulation,
        workers::Workers,
    },
};
use serde_json::Value;
use std::sync::Arc;

/// A person at work in the scene `empty`: a ledge of rock, water placed and poured, some of it taken away, wind. The
/// recording of it and the hash of the world that came out.
fn record() -> (Vec<u8>, u64) {
    let settings = [("columns", "40"), ("rows", "30")].map(|(key, value)| (key.to_owned(), value.to_owned()));
    let blueprint = Arc::new(scene::load("empty").unwrap().build(&settings, None, &Default::default()).unwrap());
    let (rock, water) = (blueprint.elements.find("rock").unwrap(), blueprint.elements.find("water").unwrap());
    let at = |x: f32, y: f32| glam::Vec2::new(x, y);
    let line = |from, to| Stroke { shape: BrushShape::Disc, from, to, radius: 1.2 };
    let tap = line(at(25.0, 25.0), at(25.0, 25.0));
    let mut intents = vec![
        (0, Intent::Draw { element: rock, stroke: line(at(5.0, 5.0), at(30.0, 8.0)) }),
        (0, Intent::Stamp { element: water, stroke: Stroke::rectangle(at(8.0, 15.0), at(20.0, 22.0)) }),
        (30, Intent::Erase { stroke: line(at(3.0, 3.0), at(12.0, 12.0)) }),
        (30, Intent::Blow { stroke: line(at(20.0, 20.0), at(20.0, 20.0)), velocity: at(40.0, 3.7) }),
    ];
    intents.extend((5..40).map(|tick| (tick, Intent::Draw { element: water, stroke: tap })));
    intents.sort_by_key(|(tick, _)| *tick);
    let input = intents.into_iter().map(|(tick, intent)| Entry { tick, intent }).collect();
    let mut simulation =
        Simulation::with_plugins(&Checkpoint::of_scene(blueprint), Workers::default(), recorder::plugin);
    run::run(&mut simulation, &Plan { ticks: 60, input, ..Plan::default() }, &mut []).unwrap();
    let world = simulation.world();
    (world.resource::<Recorder>().last_minute(recorder::end_now(world)), simulation.hash())
}

#[test]
fn a_recording_is_the_same_world_again() {
    let here = folder("replay");
    let (bytes, hash) = record();
    std::fs::write(here.join("mine.pmr"), &bytes).unwrap();
    let line = format!("same: 60 ticks, hash {hash:016x}\n");
    assert_eq!(good(&here, &["replay", "mine.pmr"]), line);
    assert_eq!(good(&here, &["replay", "mine.pmr", "--threads", "2", "--simd", "scalar"]), line);
    let outcome: Value = serde_json::from_str(&good(&here, &["replay", "mine.pmr", "--json", "-"])).unwrap();
    assert_eq!((&outcome["same"], &outcome["ticks"]), (&Value::from(true), &Value::from(60)));
    assert_eq!(outcome["hash"], format!("{hash:016x}"));

    let found = metrics(&here, &["run", "mine.pmr"]);
    assert_eq!(found["hash"], format!("{hash:016x}"));
    assert_eq!(found["ticks"], 60, "as long as it was recorded");
    assert_eq!(found["parameters"]["columns"], 40.0, "with the parameters that it was recorded with");
    let finer = metrics(&here, &["run", "mine.pmr", "--quality", "fine"]);
    assert_eq!(finer["quality"], "fine");
    assert_ne!(finer["hash"], found["hash"]);
    refused(&here, &["run", "mine.pmr", "--set", "rows=40"], 2, &["mine.pmr", "no use for --set"]);
    refused(&here, &["run", "mine.pmr", "--hold-ms", "1"], 2, &["mine.pmr", "no use for --hold-ms"]);
    refused(&here, &["play", "mine.pmr", "--quality", "fine"], 2, &["mine.pmr", "no use for --quality"]);
}

#[test]
fn a_clip_is_a_film_of_the_size_that_was_asked_for() {
    let here = folder("clip");
    std::fs::write(here.join("mine.pmr"), record().0).unwrap();
    let clip = |more: &[&'static str]| [&["clip", "mine.pmr", "--gif", "mine.gif"], more].concat();
    refused(&here, &clip(&["--size", "640"]), 2, &["--size", "allowed: WIDTHxHEIGHT"]);
    refused(&here, &clip(&["--fps", "51"]), 2, &["--fps", "allowed: whole numbers from 1 to 50"]);
    let output = program(&here, &clip(&["--size", "64x48", "--fps", "10"]));
    let told = String::from_utf8(output.stderr).unwrap();
    if !output.status.success() {
        // Where nothing can draw, that is said, and no file is left.
        assert!(told.contains("no graphics: ") || told.contains("this build draws nothing"), "{told}");
        assert!(!here.join("mine.gif").exists());
        return;
    }
    assert_eq!(String::from_utf8(output.stdout).unwrap(), "mine.gif: 11 frames\n", "the first and ten a second");
    let bytes = std::fs::read(here.join("mine.gif")).unwrap();
    assert_eq!((&bytes[..6], &bytes[6..10]), (&b"GIF89a"[..], &[64, 0, 48, 0][..]));
}

#[test]
fn a_replay_names_the_first_tick_that_differs() {
    let here = folder("replay_differs");
    let recording = Recording::decode(&record().0).unwrap();
    let mut writer = Writer::new();
    writer.start(&recording.segments[0].start().unwrap().encode());
    let segment = &recording.segments[0];
    // One dab of the poured water is missing: that of tick 23, which makes tick 24.
    let entries: Vec<_> = segment.entries.iter().filter(|entry| entry.tick != 23).cloned().collect();
    assert_eq!(entries.len() + 1, segment.entries.len());
    writer.ticks(&entries, &segment.marks);
    writer.end(recording.end.unwrap());
    std::fs::write(here.join("changed.pmr"), writer.take()).unwrap();
    let says = ["changed.pmr", "tick 24 is the first that differs (number 24 of the recording)"];
    refused(&here, &["replay", "changed.pmr"], 1, &says);
    refused(&here, &["replay", "changed.pmr", "--json", "out.json"], 1, &says);
    let outcome: Value = serde_json::from_slice(&std::fs::read(here.join("out.json")).unwrap()).unwrap();
    assert_eq!((&outcome["same"], &outcome["difference"]["tick"]), (&Value::from(false), &Value::from(24)));
}

#[test]
fn a_saved_world_goes_on_as_if_it_had_never_stopped() {
    let here = folder("snapshot");
    let scene = ["run", "waterfall", "--set", "flow=900"];
    let whole = metrics(&here, &[&scene[..], &["--ticks", "50"]].concat());
    good(&here, &[&scene[..], &["--ticks", "20", "--snapshot", "half.save"]].concat());
    let rest = metrics(&here, &["run", "half.save", "--ticks", "30"]);
    assert_eq!(rest["hash"], whole["hash"]);
    assert_eq!(rest["scene"], "waterfall");
    assert_eq!(rest["ticks"], 30);
    let other = metrics(&here, &["run", "half.save", "--ticks", "30", "--quality", "draft", "--effect", "air=off"]);
    assert_eq!(other["quality"], "draft");
    assert_eq!(other["effects"]["air"]["mode"], "off");
    assert_ne!(other["hash"], rest["hash"]);

    refused(&here, &["run", "half.save", "--set", "wind=0"], 2, &["half.save", "--set"]);
    let bytes = std::fs::read(here.join("half.save")).unwrap();
    std::fs::write(here.join("torn.save"), &bytes[..bytes.len() / 2]).unwrap();
    refused(&here, &["run", "torn.save"], 2, &["torn.save", "damaged"]);
    std::fs::write(here.join("poem.txt"), "roses are red").unwrap();
    refused(&here, &["run", "poem.txt"], 2, &["poem.txt", "not a save file"]);
}

#[test]
fn a_bad_recording_is_refused_in_one_line() {
    let here = folder("bad_replay");
    let (bytes, _) = record();
    let mut changed = bytes.clone();
    changed[2000] ^= 4;
    let mut newer = bytes.clone();
    (newer[23], newer[24]) = (77, 0);
    let mut huge = bytes[..25].to_vec();
    huge.extend(b"S\xff\xff\xff\xff and then nothing");
    for (name, bytes, says) in [
        ("empty", &b""[..], &["not a recording"][..]),
        ("poem", b"roses are red", &["not a recording"]),
        ("half", &bytes[..bytes.len() / 2], &["damaged", "breaks off"]),
        ("short", &bytes[..bytes.len() - 1], &["damaged"]),
        ("changed", &changed, &["damaged", "checksum"]),
        ("newer", &newer, &["format 77; this program reads format "]),
        ("old", b"{\"powder_master_replay\":1,\"scene\":\"empty\"}\n", &["format 1; this program reads format "]),
        ("huge", &huge, &["damaged", "breaks off"]),
    ] {
        std::fs::write(here.join(name), bytes).unwrap();
        refused(&here, &["replay", name], 2, &[&[name], says].concat());
    }
    for name in ["half", "changed", "newer", "old"] {
        refused(&here, &["run", name], 2, &[name, "recording"]);
        refused(&here, &["play", name], 2, &[name, "recording"]);
    }
    refused(&here, &["replay", "nothing.pmr"], 2, &["nothing.pmr", "can't be read"]);
    refused(&here, &["replay", "half", "--json", "nowhere/x"], 2, &["no folder"]);
    refused(&here, &["replay"], 2, &["<FILE>"]);
}
