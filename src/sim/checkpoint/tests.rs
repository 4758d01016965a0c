//! Files that were cut, changed or made up.

use super::{
    contents::Contents,
    file::{SAVE, seal},
    *,
};
use crate::{
    kernel::{
        air::Air,
        element::ElementId,
        random::Random,
        sleep::SleepRecord,
        sources::{Drain, Emitter, Rect, Wind},
    },
    scene::{self, effects::EffectModes},
    sim::{
        file::{FileError, VERSION},
        intent::{Intent, IntentQueue},
        simulation::Simulation,
        snapshot::hash_bytes,
        state::{Clock, Counters, ParticleStore, Rock, Sources},
        workers::Workers,
    },
};
use glam::Vec2;
use std::sync::Arc;

fn start(scene: &str, settings: &[(&str, &str)]) -> Simulation {
    let settings: Vec<(String, String)> = settings.iter().map(|&(key, value)| (key.into(), value.into())).collect();
    let file = scene::load(scene).expect("a built-in scene");
    let blueprint = file.build(&settings, None, &EffectModes::new()).expect("its settings");
    Simulation::new(Arc::new(blueprint), Workers::default())
}

fn encode(simulation: &Simulation) -> Vec<u8> {
    Checkpoint::of(simulation.world()).encode()
}

/// A small world with something of everything, a few ticks old.
fn small() -> Simulation {
    let mut simulation = start("empty", &[("columns", "16"), ("rows", "16")]);
    let stroke = crate::kernel::brush::Stroke::rectangle(Vec2::new(4.0, 2.0), Vec2::new(8.0, 6.0));
    let rock = crate::kernel::brush::Stroke::rectangle(Vec2::new(10.0, 0.0), Vec2::new(12.0, 2.0));
    let mut queue = simulation.world_mut().resource_mut::<IntentQueue>();
    queue.push(Intent::Stamp { element: ElementId(1), stroke });
    queue.push(Intent::Stamp { element: ElementId(0), stroke: rock });
    let area = Rect { min: Vec2::splat(8.0), max: Vec2::splat(12.0) };
    let mut sources = simulation.world_mut().resource_mut::<Sources>();
    let velocity = Vec2::new(1.0, -1.0);
    let (element, rate) = (ElementId(1), 30.0);
    sources.emitters.push(Emitter { element, area, velocity, rate, total: Some(9), start: 1, given: 0, due: 0.0 });
    sources.winds.push(Wind { area, velocity, rate: 2.0 });
    sources.drains.push(Drain { area: Rect { min: Vec2::splat(14.0), max: Vec2::splat(15.0) } });
    simulation.run(5);
    assert!(
        simulation.world().resource::<ParticleStore>().len() >= 16
            && simulation.world().resource::<Rock>().count() == 4
    );
    simulation
}

fn contents(bytes: &[u8]) -> Contents<'static> {
    postcard::from_bytes(&bytes[SAVE.magic.len() + 10..]).expect("the contents of a good file")
}

fn refusal(bytes: &[u8]) -> String {
    let text = Checkpoint::decode(bytes).expect_err("a bad file was read").to_string();
    assert!(!text.contains('\n') && text.len() < 200, "not one clear line: {text}");
    text
}

#[test]
fn what_was_written_is_read() {
    let simulation = small();
    let bytes = encode(&simulation);
    let saved = Checkpoint::decode(&bytes).expect("its own file");
    assert_eq!(saved.state.hash(), simulation.hash());
    assert_eq!((&*saved.setup.blueprint.name, &*saved.setup.blueprint.title), ("empty", "Empty"));
    let mut other = start("dam_break", &[("columns", "4")]);
    saved.restore(other.world_mut());
    assert_eq!(encode(&other), bytes, "saving a loaded world gives another file");
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let bytes = encode(&small());
    for len in 0..bytes.len() {
        refusal(&bytes[..len]);
    }
    // The same with a header that fits what is left.
    let body = &bytes[SAVE.magic.len() + 10..];
    for len in 0..body.len() {
        let mut cut = bytes[..SAVE.magic.len() + 2].to_vec();
        cut.extend(hash_bytes(&body[..len]).to_le_bytes());
        cut.extend(&body[..len]);
        refusal(&cut);
    }
    let mut longer = body.to_vec();
    longer.push(0);
    let mut file = bytes[..SAVE.magic.len() + 2].to_vec();
    file.extend(hash_bytes(&longer).to_le_bytes());
    file.extend(&longer);
    assert!(refusal(&file).contains("behind its end"));
}

#[test]
fn headers_say_what_is_wrong() {
    let bytes = encode(&small());
    assert_eq!(refusal(b""), FileError::Foreign("save file").to_string());
    assert_eq!(refusal(b"\x89PNG\r\n\x1a\n and more"), FileError::Foreign("save file").to_string());
    let mut newer = bytes.clone();
    newer[SAVE.magic.len()] = 200;
    newer[SAVE.magic.len() + 1] = 0;
    assert!(refusal(&newer).contains(&format!("format 200; this program reads format {VERSION}")));
}

#[test]
fn every_flipped_bit_is_noticed() {
    let bytes = encode(&small());
    let mut changed = bytes.clone();
    for bit in 0..8 * bytes.len() {
        changed[bit / 8] ^= 1 << (bit % 8);
        refusal(&changed);
        changed[bit / 8] ^= 1 << (bit % 8);
    }
}

#[test]
fn flips_behind_a_right_checksum_neither_panic_nor_make_a_world_that_does() {
    let bytes = encode(&small());
    let body = &bytes[SAVE.magic.len() + 10..];
    let mut simulation = small();
    let mut random = Random::new(99);
    let mut random = || random.number() as usize;
    let (mut read, mut refused) = (0, 0);
    for _ in 0..6000 {
        let mut changed = body.to_vec();
        for _ in 0..1 + random() % 3 {
            let at = random() % changed.len();
            changed[at] = if random() % 2 == 0 { changed[at] ^ 1 << (random() % 8) } else { random() as u8 };
        }
        let mut file = bytes[..SAVE.magic.len() + 2].to_vec();
        file.extend(hash_bytes(&changed).to_le_bytes());
        file.extend(&changed);
        match Checkpoint::decode(&file) {
            Err(error) => {
                assert!(!error.to_string().contains('\n') && error.to_string().len() < 300, "{error}");
                refused += 1;
            }
            Ok(saved) => {
                read += 1;
                // What is read must run; a few of them are enough.
                let cells = saved.setup.domain.size.x * saved.setup.domain.size.y;
                assert!(cells < 1e4, "a box of {cells} cells out of a file of {} bytes", file.len());
                if read % 20 == 0 {
                    saved.restore(simulation.world_mut());
                    simulation.run(3);
                }
            }
        }
    }
    assert!(read > 100 && refused > 100, "{read} files read, {refused} refused: the flips test nothing");
}

#[test]
fn made_up_contents_are_refused_by_name() {
    let good = contents(&encode(&small()));
    assert!(Checkpoint::decode(&seal(&good)).is_ok());
    type Change = fn(&mut Contents);
    let cases: [(&str, Change); 38] = [
        ("spacing", |c| c.scene.to_mut().scale.spacing = 0.0),
        ("spacing", |c| c.scene.to_mut().scale.spacing = f32::NAN),
        ("width", |c| c.domain.size.x = 1e9),
        ("height", |c| c.domain.size.y = f32::NAN),
        ("number of cells", |c| c.domain.size = Vec2::splat(32_000.0)),
        ("gravity", |c| c.domain.gravity.x = f32::INFINITY),
        ("rest_density", |c| c.scene.to_mut().fluid.rest_density = 0.0),
        ("relaxation", |c| c.scene.to_mut().fluid.relaxation = -1.0),
        ("substeps", |c| c.quality.substeps = 0),
        ("substeps", |c| c.quality.substeps = u32::MAX),
        ("iterations", |c| c.quality.iterations = 65),
        ("kernel_radius", |c| c.quality.kernel_radius = 1e-6),
        ("correction_limit", |c| c.quality.correction_limit = f32::NAN),
        ("air_cell", |c| c.quality.air_cell = 0.001),
        ("air stands on other cells", |c| c.quality.air_cell = 3.5),
        ("sound_speed", |c| c.scene.to_mut().air.sound_speed = 0.0),
        ("other parameters", |c| c.scene.to_mut().air.sound_speed *= 1.5),
        ("particle_limit", |c| c.scene.to_mut().particle_limit = 0),
        ("more than its limit", |c| c.scene.to_mut().particle_limit = 3),
        ("number of elements", |c| c.elements.clear()),
        ("name of element 0", |c| c.elements[0].name = "a\nb".to_owned()),
        ("name of element 1: `rock` is taken", |c| c.elements[1].name = "rock".to_owned()),
        ("density of element 1: 0 is out of range", |c| c.elements[1].density = 0.0),
        ("flow", |c| c.elements[1].flow = f32::NAN),
        ("first element", |c| c.scene.to_mut().first_element = Some("gold".to_owned())),
        ("differ in length", |c| c.particles.vx.truncate(3)),
        ("x of a particle is no number", |c| c.particles.x[2] = f32::NAN),
        ("vy of a particle is no number", |c| c.particles.vy[2] = f32::INFINITY),
        ("outside the box", |c| c.particles.x[2] = 16.5),
        ("outside the box", |c| c.particles.y[2] = -0.5),
        ("inside rock", |c| (c.particles.x[2], c.particles.y[2]) = (11.5, 1.5)),
        ("no movable element", |c| c.particles.element[0] = ElementId(0)),
        ("no movable element", |c| c.particles.element[0] = ElementId(200)),
        ("no fixed element", |c| c.rock[0].element = ElementId(1)),
        ("rock is outside", |c| c.rock[0].column = u32::MAX),
        ("there twice", |c| (c.rock[0].column, c.rock[0].row) = (c.rock[1].column, c.rock[1].row)),
        ("two particles have the id", |c| c.rock[0].id = c.particles.id[0]),
        ("not given yet", |c| c.clock.next_id = 3),
    ];
    let more: [(&str, Change); 16] = [
        ("an area", |c| c.sources.winds[0].area.min.x = 1e6),
        ("a corner", |c| c.sources.drains[0].area.max.y = f32::NAN),
        ("the rate of an emitter", |c| c.sources.emitters[0].rate = f32::NAN),
        ("due of an emitter", |c| c.sources.emitters[0].due = -1.0),
        ("emitter gives", |c| c.sources.emitters[0].element = ElementId(0)),
        ("its air fills a box of [40, 40]", |c| {
            c.air = Air::new(Vec2::splat(40.0), c.quality.air_cell, c.scene.air);
        }),
        ("does not follow its rock", |c| c.rock.clear()),
        ("a parameter", |c| c.scene.to_mut().parameters.values_mut().for_each(|value| *value = f64::NAN)),
        ("a pressure of its water", |c| c.kept.pressure = vec![f32::NAN]),
        ("a pressure of its water", |c| c.kept.grains = vec![vec![1e13]]),
        ("its tick is 18446744073709551615; allowed: 0 to 9007199254740992", |c| c.clock.tick = u64::MAX),
        ("its number of edits", |c| c.clock.edits = u64::MAX),
        ("the start of an emitter", |c| c.sources.emitters[0].start = u64::MAX),
        ("too many emitters", |c| c.sources.drains = vec![c.sources.drains[0]; 1001]),
        ("its air fills a box of [15.5, 16]", |c| {
            c.air = Air::new(Vec2::new(15.5, 16.0), c.quality.air_cell, c.scene.air);
        }),
        ("emitters or winds cover 128000000 cells; allowed: at most 64000000", |c| {
            (c.domain.size, c.sleep) = (Vec2::splat(8000.0), SleepRecord::default());
            let area = Rect { min: Vec2::splat(-9.0), max: Vec2::splat(9000.0) };
            c.sources.winds = vec![Wind { area, ..c.sources.winds[0] }; 2];
        }),
    ];
    for (expected, change) in cases.into_iter().chain(more) {
        let mut contents = good.clone();
        change(&mut contents);
        let text = refusal(&seal(&contents));
        assert!(text.contains(expected), "`{text}` does not say `{expected}`");
    }
}

/// Counts at the end of their numbers: nothing overflows, and what finds no number any more is refused and counted.
#[test]
fn a_world_at_the_end_of_its_numbers_goes_on() {
    let mut contents = contents(&encode(&small()));
    contents.clock.next_id = u32::MAX - 1;
    (contents.clock.tick, contents.clock.edits) = (1 << 53, 1 << 53);
    contents.sources.emitters[0].total = None;
    contents.sources.emitters[0].given = u32::MAX;
    contents.sources.emitters[0].due = 1e6;
    let mut simulation = start("dam_break", &[("columns", "4")]);
    Checkpoint::decode(&seal(&contents)).expect("it is sound").restore(simulation.world_mut());
    simulation.world_mut().resource_mut::<IntentQueue>().push(Intent::ClearAir);
    let before = simulation.world().resource::<ParticleStore>().len();
    simulation.run(5);
    assert_eq!(simulation.world().resource::<ParticleStore>().len(), before + 1, "there was one id left");
    assert!(simulation.world().resource::<Counters>().refused > 0);
    assert_eq!(simulation.world().resource::<Clock>().tick, (1 << 53) + 5);
    contents.clock.tick += 5;
    let text = refusal(&seal(&contents));
    assert!(text.contains("its tick"), "{text}");
}
