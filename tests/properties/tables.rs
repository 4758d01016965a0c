//! Properties of every table of elements that is not refused: whatever melts, burns, reacts and breaks by it, no energy is made,
//! nothing multiplies, and nothing is colder or hotter than anything may be.

use glam::{IVec2, Vec2};
use powder_master::kernel::{
    air::Air,
    decay::{Decays, table::DecayTable},
    element::{Category, Element, ElementBreak, ElementChange, ElementDecay, ElementId, ElementTable, ElementTouch},
    fracture::{fracture, table::FractureTable},
    heat::{
        Heat, HeatRecord, Warm, change, chemical, held,
        table::{HeatTable, curves},
        units::{HOTTEST, ROOM},
    },
    parallel::Team,
    params::{AIR_DENSITY, AirAdvection, AirParams, AirScheme, Domain, OpenSides},
    particles::Particles,
    random::Random,
    reactions::{Reactions, table::ReactionTable},
    relabel::Relabelled,
    simd::InstructionSet,
    solids::{Solids, centre},
    sources::Rect,
    units::{Scale, TICK_SECONDS},
};

/// Tables, and ticks of a world of each.
const TABLES: u64 = 800;
/// Fewest of them that must be sound, for what holds of these to say anything.
const SOUND: u64 = 60;
const TICKS: u64 = 40;
/// Cells of a side of the box.
const SIDE: i32 = 14;
/// Ticks from one blow to the next.
const BLOWS: u64 = 10;
const SCALE: Scale = Scale { spacing: 0.1, detail: 1.0 };
const SCHEME: AirScheme = AirScheme { courant: 0.7, advection: AirAdvection::FirstOrder };

fn team() -> Team {
    Team { instructions: InstructionSet::detect(), threads: 1 }
}

struct Dice(Random);

impl Dice {
    fn comes(&mut self, one_of: usize) -> bool {
        self.0.below(one_of) == 0
    }

    fn one<T: Clone>(&mut self, of: &[T]) -> T {
        of[self.0.below(of.len())].clone()
    }

    fn kelvin(&mut self) -> f32 {
        self.one(&[1.0, 77.0, 200.0, 280.0, 293.0, 320.0, 373.0, 600.0, 1500.0, 3000.0, 4000.0])
    }

    /// An element to which nothing happens yet.
    fn row(&mut self, k: usize) -> Element {
        let mut row = Element {
            capacity: self.one(&[0.2, 0.3, 1.0, 2.5, 5.0]),
            conductivity: self.one(&[0.0, 0.1, 1.0, 80.0, 500.0]),
            density: self.one(&[0.1, 300.0, 1000.0, 13_000.0]),
            energy: self.one(&[0.0, 0.0, 500.0, 2000.0, 8000.0]),
            ..Element::plain(&format!("e{k}"), k == 0 || self.comes(4))
        };
        if !row.fixed {
            row.category = self.one(&[Category::Liquids, Category::Powders, Category::Gases]);
            row.friction = if row.category == Category::Powders { 30.0 } else { 0.0 };
        }
        row
    }

    /// So many names of elements that are `wanted`, or any if none is; and of the air.
    fn names(&mut self, rows: &[Element], count: usize, wanted: impl Fn(&Element) -> bool) -> Vec<String> {
        (0..count).map(|_| if self.comes(8) { "air".to_owned() } else { self.one_of(rows, &wanted) }).collect()
    }

    /// The name of an element that is `wanted`, or of any if none is.
    fn one_of(&mut self, rows: &[Element], wanted: impl Fn(&Element) -> bool) -> String {
        let mut names: Vec<&String> = rows.iter().filter(|row| wanted(row)).map(|row| &row.name).collect();
        if names.is_empty() {
            names = rows.iter().map(|row| &row.name).collect();
        }
        self.one(&names).clone()
    }

    /// What may happen to an element; most of it, but not all, is as it must be.
    fn add_fates(&mut self, rows: &mut [Element], k: usize) {
        let own = rows[k].clone();
        if self.comes(4) {
            // What holds more takes heat both to melt and to freeze to it.
            let hot = self.comes(2);
            let at = if hot { self.one(&[320.0, 373.0, 1500.0]) } else { self.one(&[77.0, 200.0, 280.0]) };
            let holds_more =
                |row: &Element| row.energy == own.energy && row.capacity >= own.capacity && row.name != own.name;
            let count = self.one(&[1, 1, 2, 5]);
            rows[k].changes.push(ElementChange {
                above: hot.then_some(at),
                below: (!hot).then_some(at),
                into: self.names(rows, count, holds_more),
                latent: None,
            });
        }
        if self.comes(2) {
            let count = self.one(&[1, 2, 4]);
            rows[k].decays = Some(ElementDecay {
                above: if self.comes(2) { Some(self.kelvin()) } else { None },
                seconds: self.one(&[0.02, 0.1, 1.0]),
                needs_air: self.comes(2),
                into: self.names(rows, count, |row| row.energy <= own.energy && row.name != own.name),
            });
        }
        let alike = |row: &Element| !row.fixed && row.energy == own.energy;
        // Where nothing is alike, most rows do without.
        if own.fixed && (rows.iter().any(alike) || self.comes(40)) {
            let into = if self.comes(40) { "air".to_owned() } else { self.one_of(rows, alike) };
            rows[k].breaks = Some(ElementBreak { above: self.one(&[100.0, 1e3, 1e4, 1e7]), into });
        }
        // One row for two elements: those that come later have it.
        if k > 0 && self.comes(2) {
            let with = rows[self.0.below(k)].name.clone();
            let into = self.names(rows, 2, |_| true);
            rows[k].touches.push(ElementTouch {
                with,
                into: (into[0].clone(), into[1].clone()),
                rate: self.one(&[1.0, 60.0]),
                between: if self.comes(3) { Some((200.0, 2000.0)) } else { None },
                light: !self.comes(8),
            });
        }
    }
}

/// A world of a table.
struct Bench {
    elements: ElementTable,
    heat: HeatTable,
    touches: ReactionTable,
    decays: DecayTable,
    fractures: FractureTable,
    domain: Domain,
    particles: Particles,
    solids: Solids,
    air: Air,
    record: HeatRecord,
    /// Cells of rock that broke.
    broken: usize,
}

impl Bench {
    /// Lumps of any element and temperature in most cells; nothing if the table is refused.
    fn new(dice: &mut Dice) -> Option<Self> {
        let count = 3 + dice.0.below(6);
        let mut rows: Vec<Element> = (0..count).map(|k| dice.row(k)).collect();
        (0..count).for_each(|k| dice.add_fates(&mut rows, k));
        curves(&rows).ok()?;
        let (touches, decays) = (ReactionTable::of_rows(&rows, 1.0).ok()?, DecayTable::of_rows(&rows, 1.0).ok()?);
        let fractures = FractureTable::of_rows(&rows).ok()?;
        let elements = ElementTable::new(rows);
        let heat = HeatTable::new(&elements);
        let (mut particles, mut solids) = (Particles::default(), Solids::new(SIDE as u32, SIDE as u32));
        for k in 0..SIDE * SIDE {
            let (cell, element) = (IVec2::new(k % SIDE, k / SIDE), ElementId(dice.0.below(elements.len()) as u8));
            let [least, most] = heat.curve(element).range();
            let holds = heat.curve(element).heat(dice.kelvin()).clamp(least, most);
            if dice.comes(5) {
                continue;
            }
            if elements.get(element).fixed {
                solids.insert(cell, element, k as u32);
                solids.set_heat(cell, holds);
            } else {
                particles.push_warm(k as u32, element, centre(cell), Vec2::ZERO, holds);
            }
        }
        let domain = Domain { size: Vec2::splat(SIDE as f32), gravity: Vec2::ZERO };
        let params = AirParams { sound_speed: 400.0, density: AIR_DENSITY, open: OpenSides::default() };
        let (air, record) = (Air::new(domain.size, 2.0, params), HeatRecord::default());
        Some(Self { elements, heat, touches, decays, fractures, domain, particles, solids, air, record, broken: 0 })
    }

    fn energy(&self) -> i64 {
        let Self { particles, solids, heat, record, .. } = self;
        held(particles, solids) + chemical(particles, solids, heat) + record.outside()
    }

    fn lumps(&self) -> u64 {
        (self.particles.len() + self.solids.count()) as u64 + self.record.gone
    }

    fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.elements.len()];
        let rock = self.solids.iter().map(|(_, element, _)| element);
        self.particles.element.iter().copied().chain(rock).for_each(|element| counts[element.index()] += 1);
        counts
    }

    /// Coldest and hottest of what can't change by getting colder or hotter, K.
    fn ends(&self) -> [f32; 2] {
        let rock = self.solids.iter().map(|(cell, element, _)| (element, self.solids.heat(cell)));
        let particles = (0..self.particles.len()).map(|i| (self.particles.element[i], self.particles.heat_of(i)));
        particles.chain(rock).fold([f32::MAX, f32::MIN], |[low, high], (element, heat)| {
            let curve = self.heat.curve(element);
            let (kelvin, [least, most]) = (curve.temperature(heat), curve.bounds());
            assert!(kelvin.is_finite());
            let low = if least == i32::MIN { low } else { low.min(kelvin) };
            [low, if most == i32::MAX { high } else { high.max(kelvin) }]
        })
    }

    /// Air that presses hard in a corner of the box.
    fn blow(&mut self, dice: &mut Dice) {
        let (at, pushes) = (dice.one(&[0.0, 0.5]), dice.one(&[1.5, 3.0, 10.0]));
        let min = self.domain.size * Vec2::new(at, dice.one(&[0.0, 0.5]));
        self.air.set_solids(&self.solids);
        self.air.fill(Rect { min, max: min + 0.5 * self.domain.size }, pushes, ROOM);
    }

    /// The air moves, and breaks what can't bear it.
    fn press(&mut self, relabelled: &mut Relabelled) {
        self.air.set_solids(&self.solids);
        self.air.step(&[], SCHEME, team(), TICK_SECONDS);
        let Self { elements, heat: table, fractures, domain, particles, solids, air, record, .. } = self;
        let mut warm = Warm { particles, solids, elements, table, domain, scale: SCALE };
        fracture(&mut warm, fractures, air, record, relabelled);
        self.broken += relabelled.places.len();
    }

    fn tick(&mut self, buffers: &mut (Reactions, Decays, Heat, Relabelled), tick: u64) {
        let counts = self.counts();
        let (reactions, burning, heat, relabelled) = buffers;
        self.press(relabelled);
        let Self { elements, heat: table, touches, decays, domain, particles, solids, record, .. } = self;
        let mut warm = Warm { particles, solids, elements, table, domain, scale: SCALE };
        reactions.react(&mut warm, (touches, &counts), record, relabelled, tick, 1);
        burning.run(&mut warm, decays, record, relabelled, tick);
        change(&mut warm, record, relabelled);
        heat.flow(&mut warm, record, team(), TICK_SECONDS);
    }
}

#[test]
fn no_table_of_elements_makes_energy_or_matter() {
    let (mut sound, mut changed, mut breaking, mut broken) = (0, 0, 0, 0);
    for seed in 0..TABLES {
        let mut dice = Dice(Random::new(seed));
        let Some(mut bench) = Bench::new(&mut dice) else { continue };
        sound += 1;
        let (energy, lumps) = (bench.energy(), bench.lumps());
        let mut buffers = Default::default();
        breaking += u32::from(bench.fractures.weakest(&bench.counts()).is_some());
        for tick in 0..TICKS {
            if tick % BLOWS == 0 {
                bench.blow(&mut dice);
            }
            bench.tick(&mut buffers, tick);
            assert_eq!(bench.energy(), energy, "table {seed} makes energy in tick {tick}");
            assert_eq!(bench.lumps(), lumps, "table {seed} makes lumps in tick {tick}");
            let [coldest, hottest] = bench.ends();
            assert!(coldest >= 0.0 && hottest <= HOTTEST + 0.01, "table {seed}: {coldest} to {hottest} K");
        }
        changed += u32::from(bench.record.reacted > 0 || !bench.record.turns.is_empty());
        broken += u32::from(bench.broken > 0);
    }
    // Tables of all kinds come, and most of the sound ones do something.
    assert!(sound > SOUND && sound < TABLES * 9 / 10, "{sound} of {TABLES} are sound");
    assert!(changed > sound as u32 / 2, "in {changed} of {sound} anything changes");
    assert!(broken > breaking / 2 && broken > 20, "in {broken} of {breaking} with rock that breaks any does");
}
