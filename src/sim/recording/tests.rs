//! Recordings that were cut, changed or made up.

use super::{
    file::{RECORDING, STATE, TICKS},
    *,
};
use crate::{
    kernel::{
        brush::Stroke,
        element::ElementId,
        params::{Preset, Quality},
        particles::Particles,
        piece::{Piece, Turn},
        solids::Solids,
    },
    scene::{
        self,
        effects::{Effect, EffectModes, Mode},
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        file::{FileError, VERSION},
        intent::{Intent, IntentQueue},
        mark::Mark,
        recorder::{self, Recorder},
        simulation::Simulation,
        workers::Workers,
    },
};
use glam::{IVec2, Vec2};
use std::sync::Arc;

/// A small world with something of everything, recorded: water, rock, wind, other qualities and effects, a reset.
fn recorded() -> (Simulation, Vec<u8>) {
    let settings = [("columns", "16"), ("rows", "16")].map(|(key, value)| (key.to_owned(), value.to_owned()));
    let blueprint = scene::load("empty").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
    let mut simulation =
        Simulation::with_plugins(&Checkpoint::of_scene(Arc::new(blueprint)), Workers::default(), recorder::plugin);
    let push = |simulation: &mut Simulation, intent| simulation.world_mut().resource_mut::<IntentQueue>().push(intent);
    let stroke = Stroke::rectangle(Vec2::new(4.0, 2.0), Vec2::new(8.0, 6.0));
    push(&mut simulation, Intent::Stamp { element: ElementId(1), stroke });
    let rock = Stroke::rectangle(Vec2::new(10.0, 0.0), Vec2::new(12.0, 2.0));
    push(&mut simulation, Intent::Stamp { element: ElementId(0), stroke: rock });
    (0..4).for_each(|_| simulation.tick());
    push(&mut simulation, Intent::Blow { stroke, velocity: Vec2::new(30.0, 5.0) });
    push(&mut simulation, Intent::Quality { preset: Preset::Fine, quality: Preset::Fine.quality() });
    push(&mut simulation, Intent::Effect { effect: Effect::Viscosity, mode: Mode::On });
    (0..4).for_each(|_| simulation.tick());
    control::reset(simulation.world_mut());
    push(&mut simulation, Intent::Draw { element: ElementId(1), stroke });
    (0..4).for_each(|_| simulation.tick());
    let bytes = simulation.world().resource::<Recorder>().last_minute(recorder::end_now(simulation.world()));
    (simulation, bytes)
}

fn refusal(bytes: &[u8]) -> String {
    let text = Recording::decode(bytes).expect_err("a bad file was read").to_string();
    assert!(!text.contains('\n') && text.len() < 300, "not one clear line: {text}");
    text
}

/// A file of one state with these ticks.
fn made_up(entries: &[Entry], marks: usize) -> Vec<u8> {
    let mark = Mark { particles: 1, matter: 2, surroundings: 3 };
    let good = Recording::decode(&recorded().1).expect("its own file");
    let mut writer = Writer::new();
    writer.start(&good.segments[1].save());
    writer.ticks(entries, &vec![mark; marks]);
    writer.end(End::Crashed);
    writer.take()
}

#[test]
fn what_was_written_is_read() {
    let (simulation, bytes) = recorded();
    let recording = Recording::decode(&bytes).expect("its own file");
    assert_eq!(recording.end, Some(End::Stopped { hash: control::hash(simulation.world()) }));
    let ticks: Vec<_> = recording.segments.iter().map(|segment| (segment.tick, segment.marks.len())).collect();
    assert_eq!(ticks, [(0, 8), (0, 4)]);
    let due: Vec<u64> = recording.segments[0].entries.iter().map(|entry| entry.tick).collect();
    assert_eq!(due, [0, 0, 4, 4, 4]);
    assert_eq!(recording.segments[1].entries.len(), 1);
    assert_eq!(Recording::salvage(&bytes).expect("a whole file"), recording);
}

#[test]
fn a_file_cut_anywhere_is_refused_and_what_is_whole_of_it_salvaged() {
    let (_, bytes) = recorded();
    let whole = Recording::decode(&bytes).expect("its own file");
    let mut salvaged = std::collections::BTreeSet::new();
    for len in 0..bytes.len() {
        refusal(&bytes[..len]);
        match Recording::salvage(&bytes[..len]) {
            Ok(recording) => {
                assert_eq!(recording.end, None);
                assert!(recording.segments.iter().zip(&whole.segments).all(|(part, all)| {
                    all.entries.starts_with(&part.entries) && all.marks.starts_with(&part.marks)
                }));
                salvaged.insert((recording.segments.len(), recording.ticks()));
            }
            Err(error) => assert!(salvaged.is_empty(), "{len} bytes: {error}, but fewer were good"),
        }
    }
    assert_eq!(salvaged.into_iter().collect::<Vec<_>>(), [(1, 0), (1, 8), (2, 8), (2, 12)]);
}

#[test]
fn headers_say_what_is_wrong() {
    let (_, bytes) = recorded();
    assert_eq!(refusal(b""), FileError::Foreign("recording").to_string());
    assert_eq!(refusal(b"PowderMaster\n\x01\x00"), FileError::Foreign("recording").to_string(), "a save file");
    let old = refusal(b"{\"powder_master_replay\":1,\"scene\":\"empty\"}\n");
    assert!(old.contains(&format!("format 1; this program reads format {VERSION}")), "{old}");
    let mut newer = bytes.clone();
    newer[RECORDING.magic.len()] = 200;
    newer[RECORDING.magic.len() + 1] = 0;
    assert!(refusal(&newer).contains(&format!("format 200; this program reads format {VERSION}")));
    let mut longer = bytes.clone();
    longer.push(0);
    assert!(refusal(&longer).contains("behind its end"));
    let mut endless = Writer::new();
    endless.start(&Recording::decode(&bytes).unwrap().segments[0].save());
    assert!(refusal(&endless.take()).contains("no end"));
    let mut blank = Writer::new();
    blank.end(End::Crashed);
    assert!(refusal(&blank.take()).contains("no state"));
    let mut late = Writer::new();
    late.ticks(&[], &[Mark { particles: 0, matter: 0, surroundings: 0 }]);
    assert!(refusal(&late.take()).contains("begin with a state"));
}

#[test]
fn every_flipped_bit_is_noticed() {
    let (_, bytes) = recorded();
    let mut changed = bytes.clone();
    // A state has its own test of every bit.
    for byte in (0..bytes.len()).filter(|byte| byte % 7 == 0 || *byte < 60 || bytes.len() - byte < 300) {
        for bit in 0..8 {
            changed[byte] ^= 1 << bit;
            refusal(&changed);
            changed[byte] ^= 1 << bit;
        }
    }
}

#[test]
fn huge_counts_behind_a_right_checksum_take_no_memory() {
    let good = Recording::decode(&recorded().1).expect("its own file");
    for count in [&[0xff, 0xff, 0xff, 0xff, 0x0f][..], &[0xff; 9], &[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1]]
    {
        let mut writer = Writer::new();
        writer.start(&good.segments[0].save());
        writer.chunk(TICKS, count);
        writer.end(End::Crashed);
        assert!(refusal(&writer.take()).contains("damaged"));
        let mut marks = vec![0];
        marks.extend(count);
        let mut writer = Writer::new();
        writer.start(&good.segments[0].save());
        writer.chunk(TICKS, &marks);
        assert!(refusal(&writer.take()).contains("damaged"));
    }
    // A length that says more than there is.
    let mut bytes = Writer::new().take();
    bytes.push(STATE);
    bytes.extend(u32::MAX.to_le_bytes());
    bytes.extend([0; 40]);
    assert!(refusal(&bytes).contains("breaks off"));
}

/// A piece of one particle with a speed, pasted somewhere.
fn paste(element: ElementId, speed: f32, at: f32) -> Intent {
    let mut particles = Particles::default();
    particles.push(0, element, Vec2::ONE, Vec2::splat(speed));
    let piece = Piece::of(&particles, &Solids::new(4, 4), IVec2::ZERO, IVec2::splat(4), 0.1);
    Intent::Paste { piece: Arc::new(piece), at: Vec2::splat(at), turn: Turn::default() }
}

#[test]
fn made_up_input_is_refused_by_name() {
    let stroke = Stroke::rectangle(Vec2::ZERO, Vec2::ONE);
    let air = |tick| Entry { tick, intent: Intent::ClearAir };
    assert!(Recording::decode(&made_up(&[air(0), air(3), air(3)], 3)).is_ok());
    let of = |intent| vec![Entry { tick: 1, intent }];
    let pour = |velocity, share| Intent::Pour { element: ElementId(1), stroke, velocity, share };
    let none = Quality { substeps: 0, ..Preset::Fine.quality() };
    for (entries, says) in [
        (vec![air(4)], "tick 4; allowed here: 0 to 3"),
        (vec![air(2), air(1)], "tick 1; allowed here: 2 to 3"),
        (of(Intent::Stamp { element: ElementId(200), stroke }), "element 200"),
        (of(Intent::Fill { element: ElementId(1), at: Vec2::new(0.0, f32::NAN) }), "not a number"),
        (of(Intent::Erase { stroke: Stroke { radius: f32::INFINITY, ..stroke } }), "not a number"),
        (of(Intent::Press { stroke, amount: f32::NAN }), "not a number"),
        (of(Intent::Blow { stroke, velocity: Vec2::splat(f32::INFINITY) }), "not a number"),
        (of(pour(Vec2::new(0.0, 1e9), 1.0)), "the velocity of what is poured is [0, 1000000000]; allowed"),
        (of(pour(Vec2::splat(f32::NAN), 1.0)), "the velocity of what is poured is [NaN, NaN]; allowed"),
        (of(pour(Vec2::ZERO, 1.5)), "1.5 of a tick; allowed: 0 … 1"),
        (of(pour(Vec2::ZERO, f32::NAN)), "NaN of a tick; allowed: 0 … 1"),
        (of(Intent::Quality { preset: Preset::Fine, quality: none }), "substeps is 0"),
        (of(Intent::Gravity { gravity: Vec2::new(f32::NAN, 0.0) }), "gravity is NaN"),
        (of(Intent::Gravity { gravity: Vec2::splat(1e9) }), "allowed: 0 to 1500"),
        (of(Intent::Replace { element: ElementId(200), stroke }), "element 200"),
        (of(Intent::EraseAround { element: ElementId(1), at: Vec2::new(0.0, f32::NAN) }), "not a number"),
        (of(paste(ElementId(1), 1.0, f32::NAN)), "not a number"),
        (of(paste(ElementId(1), f32::NAN, 1.0)), "a piece: a value of a particle"),
        (of(paste(ElementId(200), 1.0, 1.0)), "a piece: it is of elements that are not there"),
        (of(paste(ElementId(0), 1.0, 1.0)), "a piece: it is of elements that are not there"),
    ] {
        let text = refusal(&made_up(&entries, 3));
        assert!(text.contains(says), "`{text}` does not say `{says}`");
    }
}
