//! Every file of the corpus through its reader, so that what the fuzzer once found stays found; and every file of each
//! through all the others.

#[path = "support/readers.rs"]
mod readers;

use glam::{IVec2, Vec2};
use powder_master::{
    kernel::{
        brush::{BrushShape, Stroke},
        element::ElementId,
        params::Preset,
        particles::Particles,
        piece::{Piece, Turn},
        simd::InstructionSet,
        solids::Solids,
        sources::{Drain, Emitter, Rect},
    },
    scene::effects::{Effect, Mode},
    sim::{
        checkpoint::Checkpoint,
        intent::{Intent, IntentQueue},
        picture,
        recorder::{self, Recorder},
        recording::Recording,
        replay::Replay,
        springs::Springs,
        stamp::Stamp,
        workers::Workers,
    },
};
use readers::{READERS, put_together, small_world, taken_apart, world_of};
use std::{
    fs,
    panic::catch_unwind,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// Longest that a file may take, on a slow machine and without optimisation.
const LONGEST: Duration = Duration::from_secs(20);

fn corpus(name: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(name);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files
}

#[test]
fn no_file_of_the_corpus_breaks_its_reader_or_any_other() {
    let mut failed = Vec::new();
    for (of, _) in READERS {
        let files = corpus(of);
        assert!(!files.is_empty(), "the corpus of {of} is empty");
        for file in files {
            let bytes = fs::read(&file).expect("can be read");
            assert!(bytes.len() <= 8192, "{}: a seed is small", file.display());
            for (name, read) in READERS {
                let begun = Instant::now();
                let result = catch_unwind(|| read(&bytes));
                if result.is_err() || begun.elapsed() > LONGEST {
                    failed.push(format!("{name} with {} after {:?}", file.display(), begun.elapsed()));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn what_is_cut_or_changed_anywhere_breaks_no_reader() {
    for (name, read) in READERS {
        for file in corpus(name) {
            let bytes = fs::read(&file).expect("can be read");
            let step = (bytes.len() / 12).max(1);
            for at in (0..bytes.len()).step_by(step) {
                read(&bytes[..at]);
                let mut changed = bytes.clone();
                changed[at] ^= 0x81;
                read(&changed);
            }
        }
    }
}

/// The seed `file` of the corpus, written anew if that is wanted (`WRITE_CORPUS=1 cargo test --test readers`).
fn seed(file: &str, bytes: &[u8]) -> Vec<u8> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(file);
    if std::env::var_os("WRITE_CORPUS").is_some() {
        fs::write(&file, bytes).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
    fs::read(&file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

/// A scene of few cells with an emitter, a wind, a drain, rock, and air that is not at rest.
const LIVELY: &str = "(title: \"Lively\", spacing: 0.1, size: (1.2, 0.8), quality: (preset: draft), particle_limit: 60,
    contents: [(element: \"rock\", shape: Rect(min: (0.8, 0), max: (0.9, 0.3))),
        (element: \"water\", shape: Rect(min: (0, 0), max: (0.4, 0.3)))],
    emitters: [(element: \"water\", min: (0.5, 0.5), max: (0.7, 0.7), rate: 60, total: 20, velocity: (1, 0))],
    winds: [(min: (0, 0.4), max: (0.3, 0.8), velocity: (5, 1), rate: 2)],
    drains: [(min: (1.1, 0), max: (1.2, 0.1))],
    pressures: [(min: (0, 0), max: (0.6, 0.6), pressure: 2, temperature: 500)], open: (right: true))";

fn every_intent() -> Vec<Intent> {
    let (rock, water) = (ElementId(0), ElementId(1));
    let mut particles = Particles::default();
    particles.push_warm(0, water, Vec2::new(0.5, 1.5), Vec2::new(3.0, 1.0), 700);
    let mut solids = Solids::new(3, 2);
    solids.insert(IVec2::new(2, 0), rock, 1);
    let piece = Arc::new(Piece::of(&particles, &solids, IVec2::ZERO, IVec2::new(3, 2), 0.1));
    let area = |min: Vec2| Rect { min, max: min + 1.0 };
    let flow = Emitter {
        element: water,
        area: area(Vec2::ZERO),
        velocity: Vec2::X,
        rate: 30.0,
        total: Some(5),
        start: 0,
        given: 0,
        due: 0.0,
    };
    let springs = Springs { emitters: vec![flow], drains: vec![Drain { area: area(Vec2::X) }] };
    let stroke = Stroke { shape: BrushShape::Disc, from: Vec2::new(5.0, 5.0), to: Vec2::new(7.0, 6.0), radius: 1.5 };
    vec![
        Intent::Draw { element: water, stroke },
        Intent::Stamp { element: rock, stroke: Stroke::rectangle(Vec2::new(9.0, 5.0), Vec2::new(10.0, 7.0)) },
        Intent::Fill { element: water, at: Vec2::new(2.5, 6.5) },
        Intent::Erase { stroke: Stroke { shape: BrushShape::Square, ..stroke } },
        Intent::Blow { stroke, velocity: Vec2::new(80.0, -20.0) },
        Intent::Press { stroke, amount: 0.5 },
        Intent::ClearAir,
        Intent::Quality { preset: Preset::Balanced, quality: Preset::Balanced.quality() },
        Intent::Effect { effect: Effect::Vorticity, mode: Mode::Off },
        Intent::Gravity { gravity: Vec2::new(30.0, 90.0) },
        Intent::Warm { stroke, degrees: -40.0 },
        Intent::SetTemperature { stroke, kelvin: 400.0 },
        Intent::Ignite { stroke },
        Intent::Replace { element: rock, stroke },
        Intent::ReplaceAround { element: water, at: Vec2::new(9.5, 5.5) },
        Intent::EraseOnly { element: water, stroke },
        Intent::EraseAround { element: water, at: Vec2::new(2.5, 1.5) },
        Intent::Paste { piece, at: Vec2::new(3.0, 6.0), turn: Turn::default().quarter() },
        Intent::SetEmitter { element: water, stroke: Stroke::dab(BrushShape::Disc, Vec2::new(6.0, 1.0), 0.5) },
        Intent::SetDrain { stroke: Stroke::dab(BrushShape::Square, Vec2::new(1.0, 7.0), 0.5) },
        Intent::RemoveSources { stroke: Stroke::dab(BrushShape::Disc, Vec2::new(6.0, 1.0), 0.5) },
        Intent::PasteSources { springs: springs.placed(IVec2::new(5, 1), IVec2::new(3, 2), Turn::default()) },
    ]
}

#[test]
fn the_seed_of_stamps_is_of_this_format() {
    let mut world = world_of(LIVELY, recorder::plugin);
    (0..3).for_each(|_| world.tick());
    let stamp = Stamp::of(world.world(), IVec2::ZERO, IVec2::new(12, 8));
    let kept = seed("stamp/lively", &stamp.encode());
    let holds = |stamp: Stamp| stamp.elements.len() == 2 && stamp.piece.count() > 10 && stamp.springs.count() == 2;
    assert!(Stamp::decode(&kept).is_ok_and(holds));
}

#[test]
fn the_seeds_of_saves_and_recordings_are_of_this_format() {
    for (name, mut world, intents) in [
        ("small", small_world(recorder::plugin), vec![]),
        // One of everything, so that a fuzzer need not find them.
        ("lively", world_of(LIVELY, recorder::plugin), every_intent()),
    ] {
        (0..3).for_each(|_| world.tick());
        for intent in intents {
            world.world_mut().resource_mut::<IntentQueue>().push(intent);
            world.tick();
        }
        let kept = seed(&format!("save/{name}"), &Checkpoint::of(world.world()).encode());
        Checkpoint::decode(&kept).unwrap_or_else(|error| panic!("{error}"));
        let shared = picture::encode(4, 3, &[60; 36], &Checkpoint::of(world.world()).encode()).expect("so many pixels");
        let kept = seed(&format!("picture/{name}-world"), &shared);
        picture::read_world(&kept).unwrap_or_else(|error| panic!("{error}"));
        let world = world.world();
        let recorded = world.resource::<Recorder>().last_minute(recorder::end_now(world));
        let kept = seed(&format!("recording/{name}"), &recorded);
        let recording = Recording::decode(&kept).unwrap_or_else(|error| panic!("{error}"));
        let mut replay = Replay::new(&recording, Workers::single(), InstructionSet::detect()).expect("it was read");
        while replay.tick().unwrap_or_else(|difference| panic!("{difference}")) {}
        // What the fuzzer changes: the same without what only fits what was not changed.
        let parts = seed(&format!("recording/{name}-parts"), &taken_apart(&recorded));
        assert_eq!(Recording::decode(&put_together(&parts)), Ok(recording));
    }
}
