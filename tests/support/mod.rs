//! Worlds to test, and what tests keep asking of a simulation.

use glam::Vec2;
use powder_master::{
    kernel::{
        element::{Element, ElementId, ElementTable},
        params::Domain,
        particles::Particles,
        pbf::Solver,
        random,
        simd::InstructionSet,
        solids::Solids,
    },
    scene::{self, blueprint::Blueprint, effects::EffectModes, passes::Pass},
    sim::{
        checkpoint::Checkpoint,
        ledger::PassLedger,
        simulation::Simulation,
        state::{Books, Census, Counters, ParticleStore, Rock, Setup, SolverState},
        workers::Workers,
    },
};
use std::sync::Arc;

/// Rows of the built-in element table.
pub const ROCK: ElementId = ElementId(0);
/// See [`ROCK`].
pub const WATER: ElementId = ElementId(1);

/// The start of a built-in scene with settings put in; tests change its fields as they need.
pub fn blueprint(scene: &str, settings: &[(&str, &str)]) -> Blueprint {
    let settings: Vec<(String, String)> = settings.iter().map(|&(key, value)| (key.into(), value.into())).collect();
    let file = scene::load(scene).unwrap_or_else(|error| panic!("{error}"));
    file.build(&settings, None, &EffectModes::new()).unwrap_or_else(|error| panic!("{error}"))
}

/// A closed box of `columns × rows` cells of still air, without gravity and with nothing in it.
pub fn empty_box(columns: u32, rows: u32) -> Blueprint {
    let mut blueprint = blueprint("empty", &[]);
    blueprint.domain = Domain { size: Vec2::new(columns as f32, rows as f32), gravity: Vec2::ZERO };
    blueprint.solids = Solids::new(columns, rows);
    blueprint
}

/// Runs a start, large enough for threads to share its particles, on every instruction set and on several numbers of threads.
///
/// # Panics
/// If a bit differs.
pub fn assert_same_bits_everywhere(start: &Blueprint, ticks: u32) {
    assert!(start.particles.len() >= 6_000, "below the sharing threshold nothing is shared");
    let run =
        |set, threads| Simulation::of(start.clone()).with_instructions(set).with_threads(threads).run(ticks).hash();
    let best = InstructionSet::detect();
    let first = run(best, 1);
    for threads in [2, 3, 8] {
        assert_eq!(run(best, threads), first, "{threads} threads");
    }
    for set in InstructionSet::available() {
        assert_eq!(run(set, 1), first, "{set:?}");
    }
}

/// Saves a world, reads the file, and runs both for some ticks: the one as it was, the other on three threads.
///
/// # Panics
/// If a bit of the two differs, or what their books say.
pub fn assert_goes_on_from_a_save(simulation: &mut Simulation, ticks: u32) {
    let file = Checkpoint::of(simulation.world()).encode();
    let saved = Checkpoint::decode(&file).unwrap_or_else(|error| panic!("{error}"));
    let workers = Workers::new(3).unwrap_or_else(|error| panic!("{error}"));
    let mut again = Simulation::resume(&saved, workers);
    assert_eq!(again.hash(), simulation.hash(), "as it is read");
    assert_eq!(again.run(ticks).hash(), simulation.run(ticks).hash(), "after {ticks} ticks");
    assert_eq!(again.get::<Books>(), simulation.get::<Books>());
}

/// What tests add to the start of a world by hand.
pub trait Furnish {
    /// The element of a name.
    fn element(&self, name: &str) -> ElementId;
    /// Adds a particle of water; returns its id.
    fn water(&mut self, position: Vec2, velocity: Vec2) -> u32;
    /// Fills the cells `low … high` (high not included) with water at rest, one in the middle of each.
    fn pool(&mut self, low: (i32, i32), high: (i32, i32));
    /// Puts rock into the cells `low … high` (high not included).
    fn rock(&mut self, low: (i32, i32), high: (i32, i32));
    /// Moves every particle by up to [`NUDGE`] in each coordinate.
    fn nudge(&mut self, seed: u64);
}

/// Some roundings of a position in a box of a few dozen cells, d: what two runs may differ by that ought to be the same
/// but for rounding.
pub const NUDGE: f32 = 1e-5;

/// Root of the mean square of the distances of each particle of `other` to that of `one`, taken to its `place`, d.
pub fn apart(one: &Simulation, other: &Simulation, place: impl Fn(Vec2) -> Vec2) -> f64 {
    let (a, b) = (one.particles(), other.particles());
    assert_eq!(a.len(), b.len());
    let square = |(i, j): (u32, u32)| f64::from(place(a.position(i as usize)).distance_squared(b.position(j as usize)));
    let total: f64 = a.in_id_order().into_iter().zip(b.in_id_order()).map(square).sum();
    (total / a.len() as f64).sqrt()
}

impl Furnish for Blueprint {
    fn element(&self, name: &str) -> ElementId {
        self.elements.find(name).unwrap_or_else(|| panic!("no element {name}"))
    }

    fn water(&mut self, position: Vec2, velocity: Vec2) -> u32 {
        let id = self.next_id;
        self.next_id += 1;
        self.particles.push(id, WATER, position, velocity);
        id
    }

    fn pool(&mut self, low: (i32, i32), high: (i32, i32)) {
        for y in low.1..high.1 {
            for x in low.0..high.0 {
                self.water(Vec2::new(x as f32 + 0.5, y as f32 + 0.5), Vec2::ZERO);
            }
        }
    }

    fn rock(&mut self, low: (i32, i32), high: (i32, i32)) {
        for y in low.1..high.1 {
            for x in low.0..high.0 {
                if self.solids.insert(glam::IVec2::new(x, y), ROCK, self.next_id) {
                    self.next_id += 1;
                }
            }
        }
    }

    fn nudge(&mut self, seed: u64) {
        let mut random = Random::new(seed);
        for at in self.particles.x.iter_mut().chain(&mut self.particles.y) {
            *at += random.within(-NUDGE, NUDGE);
        }
    }
}

/// What tests keep asking of a simulation.
pub trait SimulationExt: Sized {
    /// The start of a blueprint.
    fn of(blueprint: Blueprint) -> Self;
    /// The start of a built-in scene.
    fn scene(scene: &str, settings: &[(&str, &str)]) -> Self {
        Self::of(blueprint(scene, settings))
    }
    /// Uses exactly `threads` threads from here on.
    fn with_threads(self, threads: usize) -> Self;
    /// Uses another solver from here on.
    fn with_solver(self, solver: Solver) -> Self;
    /// The movable particles.
    fn particles(&self) -> &Particles;
    /// The movable particles, to change them between ticks.
    fn particles_mut(&mut self) -> &mut Particles;
    /// The rock.
    fn rock(&self) -> &Rock;
    /// What the limiters did.
    fn counters(&self) -> Counters;
    /// Particles by element.
    fn census(&self) -> &Census;
    /// The element of a name.
    fn element(&self, name: &str) -> ElementId;
    /// How much there is of an element, particles and rock.
    fn count(&self, name: &str) -> usize;
    /// Calls of a pass since the ledger was cleared.
    fn calls(&self, pass: Pass) -> u64;
    /// Root of the mean square of the speeds, d a tick.
    fn rms_speed(&self) -> f64;
}

impl SimulationExt for Simulation {
    fn of(blueprint: Blueprint) -> Self {
        Self::new(Arc::new(blueprint), Workers::default())
    }

    fn with_threads(mut self, threads: usize) -> Self {
        *self.get_mut::<Workers>() = Workers::new(threads).unwrap_or_else(|error| panic!("{error}"));
        self
    }

    fn with_solver(mut self, solver: Solver) -> Self {
        self.get_mut::<SolverState>().0 = solver;
        self
    }

    fn particles(&self) -> &Particles {
        self.get::<ParticleStore>()
    }

    fn particles_mut(&mut self) -> &mut Particles {
        &mut self.get_mut::<ParticleStore>().0
    }

    fn rock(&self) -> &Rock {
        self.get()
    }

    fn counters(&self) -> Counters {
        *self.get()
    }

    fn census(&self) -> &Census {
        self.get()
    }

    fn element(&self, name: &str) -> ElementId {
        self.get::<Setup>().elements().find(name).unwrap_or_else(|| panic!("no element {name}"))
    }

    fn count(&self, name: &str) -> usize {
        let wanted = self.element(name);
        let moves = self.particles().element.iter().filter(|element| **element == wanted).count();
        moves + self.rock().iter().filter(|(_, element, _)| *element == wanted).count()
    }

    fn calls(&self, pass: Pass) -> u64 {
        self.get::<PassLedger>().record(pass).calls
    }

    fn rms_speed(&self) -> f64 {
        let particles = self.particles();
        let sum: f64 = (0..particles.len()).map(|i| f64::from(particles.velocity(i).length_squared())).sum();
        (sum / particles.len().max(1) as f64).sqrt() / 60.0
    }
}

/// The same numbers in every run.
pub struct Random(random::Random);

impl Random {
    /// Numbers that belong to `seed`.
    pub fn new(seed: u64) -> Self {
        Self(random::Random::new(seed))
    }

    /// A number in `low … high`.
    pub fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.0.share()
    }

    /// One of `0 … count`, count not included.
    pub fn index(&mut self, count: usize) -> usize {
        self.0.below(count)
    }

    /// A point in `[0, size.x] × [0, size.y]`.
    pub fn point(&mut self, size: Vec2) -> Vec2 {
        Vec2::new(self.within(0.0, size.x), self.within(0.0, size.y))
    }
}

/// The element table with the water changed.
pub fn with_water(blueprint: &mut Blueprint, change: impl Fn(&mut Element)) {
    let mut rows: Vec<Element> = blueprint.elements.iter().map(|(_, element)| element.clone()).collect();
    change(&mut rows[WATER.index()]);
    blueprint.elements = Arc::new(ElementTable::new(rows));
}
