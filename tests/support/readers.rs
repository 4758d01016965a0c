//! Every reader of bytes from outside, each as a function that may do anything with them but panic, hang or eat memory.
//! The corpus test runs them over files, the fuzzer over what it thinks of. Beside the reader's own limits they check what
//! it promises: a fault is one line, and what is accepted is sound.

use bevy::app::Plugins;
use powder_master::{
    kernel::simd::InstructionSet,
    scene::{self, SceneError, builtin_names, effects::EffectModes, readers},
    sim::{
        checkpoint::Checkpoint,
        picture,
        recording::{Recording, Writer},
        replay::Replay,
        simulation::Simulation,
        snapshot::Snapshot,
        stamp::{Stamp, fitted},
        state::Setup,
        workers::Workers,
    },
    web::link::Link,
};

/// A name and what it stands for. The corpus of each is `tests/corpus/NAME`.
pub type Reader = (&'static str, fn(&[u8]));

/// All readers.
pub const READERS: [Reader; 9] = [
    ("scene", read_scene),
    ("elements", read_elements),
    ("expression", read_expression),
    ("settings", read_settings),
    ("picture", read_picture),
    ("recording", read_recording),
    ("save", read_save),
    ("link", read_link),
    ("stamp", read_stamp),
];

/// A small scene with parameters for `--set`.
const SMALL: &str = "(title: \"Small\", parameters: {\"n\": (default: 6, min: 4, max: 12, integer: true, description: \"\")},
    spacing: 0.1, size: (\"n * d\", \"8 * d\"), contents: [(element: \"water\", shape: Rect(min: (0, 0), max: (0.4, 0.4)))])";

/// Ticks of a recording that are run.
const TICKS: usize = 12;

/// Cells of a world that is worth running for a look at it.
const FEW: usize = 4096;

fn one_line(error: impl std::fmt::Display) {
    let error = error.to_string();
    assert!(!error.contains('\n'), "a fault of several lines: {error}");
}

fn judged<T>(result: Result<T, SceneError>) -> Option<T> {
    result.map_err(one_line).ok()
}

fn read_scene(bytes: &[u8]) {
    let Some(file) = judged(readers::scene(bytes)) else { return };
    let Some(blueprint) = judged(file.build(&[], None, &EffectModes::new())) else { return };
    let count = blueprint.particles.len() + blueprint.solids.count();
    assert!(count <= blueprint.particle_limit as usize, "more particles than the limit");
    let particles = &blueprint.particles;
    assert!(particles.x.iter().chain(&particles.y).chain(&particles.vx).chain(&particles.vy).all(|v| v.is_finite()));
}

fn read_elements(bytes: &[u8]) {
    if let Some(table) = judged(readers::element_table(bytes)) {
        assert!((1..=255).contains(&table.len()));
    }
}

fn read_expression(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Ok(value) = readers::expression(text, 0.1) {
        assert!(value.is_finite(), "{value}");
    }
}

/// One `KEY=VALUE` a line.
fn read_settings(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let pairs = text.lines().take(64).filter_map(|line| line.split_once('='));
    let settings: Vec<_> = pairs.map(|(key, value)| (key.to_owned(), value.to_owned())).collect();
    let Some(file) = judged(scene::from_text("small", SMALL)) else { unreachable!("the small scene is sound") };
    judged(file.build(&settings, None, &EffectModes::new()));
}

fn read_picture(bytes: &[u8]) {
    if let Err(error) = readers::picture(bytes) {
        one_line(error);
    }
    // It may carry a world.
    match picture::read_world(bytes) {
        Ok(start) => {
            go_on(&start);
        }
        Err(error) => one_line(error),
    }
}

/// A whole recording, or parts of one without their checksums.
fn read_recording(bytes: &[u8]) {
    let whole = if Recording::is_meant(bytes) { bytes.to_vec() } else { put_together(bytes) };
    for outcome in [Recording::decode(&whole), Recording::salvage(&whole)] {
        match outcome {
            // Each state in it is a save file of its own.
            Ok(recording) => {
                let mut is_cheap = true;
                for state in recording.segments.iter().map(|segment| segment.start()) {
                    match state {
                        Ok(start) => is_cheap &= go_on(&start),
                        Err(error) => one_line(error),
                    }
                }
                if is_cheap {
                    replay(&recording);
                }
            }
            Err(error) => one_line(error),
        }
    }
}

/// A recording of parts that are each a kind, a length of two bytes and a body: the first line, the version and all
/// checksums are put to them, those of its states, too.
pub fn put_together(mut parts: &[u8]) -> Vec<u8> {
    let mut whole = Writer::new().take();
    while let Some((&[kind, low, high], rest)) = parts.split_first_chunk() {
        let (body, rest) = rest.split_at(usize::from(u16::from_le_bytes([low, high])).min(rest.len()));
        let body = if kind == b'S' { sealed(body) } else { body.to_vec() };
        whole.push(kind);
        whole.extend((body.len() as u32).to_le_bytes());
        whole.extend((hash(&body) ^ u64::from(kind)).to_le_bytes());
        whole.extend(body);
        parts = rest;
    }
    whole
}

/// What [`put_together`] makes this recording of.
pub fn taken_apart(recording: &[u8]) -> Vec<u8> {
    let header = Writer::new().take().len();
    let mut rest = recording.get(header..).unwrap_or_default();
    let mut parts = Vec::new();
    while let Some((&[kind, l0, l1, l2, l3], behind)) = rest.split_first_chunk() {
        let (body, behind) = behind[8..].split_at(u32::from_le_bytes([l0, l1, l2, l3]) as usize);
        let body = if kind == b'S' { &body[MAGIC.len() + 10..] } else { body };
        parts.push(kind);
        parts.extend((body.len() as u16).to_le_bytes());
        parts.extend(body);
        rest = behind;
    }
    parts
}

/// 64-bit FNV-1a.
fn hash(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The first line, the version and the checksum, and what they stand before: without them every change would be found by
/// its checksum and nothing behind it be reached.
fn sealed(body: &[u8]) -> Vec<u8> {
    let empty = empty_save();
    let version = empty.get(MAGIC.len()..MAGIC.len() + 2).unwrap_or_default();
    [MAGIC, version, &hash(body).to_le_bytes(), body].concat()
}

const MAGIC: &[u8] = b"PowderMaster\n";

fn empty_save() -> &'static [u8] {
    static EMPTY: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    EMPTY.get_or_init(|| Checkpoint::of(small_world(()).world()).encode())
}

/// The small scene.
pub fn small_world<M>(plugins: impl Plugins<M>) -> Simulation {
    world_of(SMALL, plugins)
}

/// A scene with more plugins, not yet run.
pub fn world_of<M>(text: &'static str, plugins: impl Plugins<M>) -> Simulation {
    let blueprint = scene::from_text("small", text).and_then(|file| file.build(&[], None, &EffectModes::new()));
    let blueprint = blueprint.unwrap_or_else(|error| panic!("{error}"));
    Simulation::with_plugins(&Checkpoint::of_scene(std::sync::Arc::new(blueprint)), Workers::single(), plugins)
}

/// A whole save file, or what stands behind its header.
fn read_save(bytes: &[u8]) {
    let whole = if bytes.starts_with(MAGIC) { bytes.to_vec() } else { sealed(bytes) };
    match Checkpoint::decode(&whole) {
        Ok(start) => {
            go_on(&start);
        }
        Err(error) => one_line(error),
    }
}

/// Its input must be sound, too; that what was made up comes to the marks that were made up is not to be expected.
fn replay(recording: &Recording) {
    let Ok(mut replay) = Replay::new(recording, Workers::single(), InstructionSet::detect()) else { return };
    for _ in 0..TICKS {
        if let Ok(false) = replay.tick() {
            replay.finish().map(drop).unwrap_or_else(one_line);
            return;
        }
    }
}

/// What was accepted must also run, if that is cheap; whether it is.
fn go_on(start: &Checkpoint) -> bool {
    let Snapshot { particles, solids, air, .. } = &*start.state;
    let cells = (solids.columns() * solids.rows()) as usize + air.columns() * air.rows();
    if cells > FEW || particles.len() > 256 {
        return false;
    }
    let quality = start.setup.quality;
    let is_cheap = quality.substeps * quality.iterations <= 16;
    if is_cheap {
        let mut simulation = Simulation::resume(start, Workers::single());
        simulation.tick();
        simulation.hash();
    }
    is_cheap
}

/// What is read must fit into a world, or be refused by it.
fn read_stamp(bytes: &[u8]) {
    let stamp = match Stamp::decode(bytes) {
        Ok(stamp) => stamp,
        Err(error) => return one_line(error),
    };
    assert_eq!(Stamp::decode(&stamp.encode()), Ok(stamp.clone()));
    let world = world_of(SMALL, |_: &mut bevy::app::App| {});
    let setup = world.world().resource::<Setup>();
    let cheap = stamp.piece.count() <= 256 && stamp.piece.size.as_i64vec2().element_product() < FEW as i64;
    match stamp.piece(setup.elements()) {
        Ok(piece) if cheap => fitted(&piece, &setup.blueprint).map(drop).unwrap_or_else(one_line),
        Ok(_) => {}
        Err(error) => one_line(error),
    }
}

fn read_link(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Link::read(text) {
        // Another name would be a path, and a page has none; of the scenes those that are small.
        Ok(link) if builtin_names().contains(&link.scene.as_str()) && link.settings.is_empty() => {
            link.build().map(drop).unwrap_or_else(one_line);
        }
        Ok(_) => {}
        Err(error) => one_line(error),
    }
}
