//! A headless game to test: the simulation's own plugin in a bare `App`, one tick an update, and what tests keep asking
//! of it.

use bevy::{
    MinimalPlugins,
    app::App,
    prelude::{Fixed, Time},
    time::TimeUpdateStrategy,
};
use glam::Vec2;
use powder_master::{
    kernel::{
        element::ElementId, params::Domain, particles::Particles, pbf::Solver, simd::InstructionSet, solids::Solids,
    },
    scene::{
        self,
        blueprint::Blueprint,
        effects::{EffectModes, Pass},
    },
    sim::{
        SimulationPlugin, control,
        intent::{Intent, IntentQueue},
        ledger::PassLedger,
        state::{Census, Counters, ParticleStore, Rock, SolverState},
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

/// What tests add to the start of a world by hand.
pub trait Furnish {
    /// Adds a particle of water; returns its id.
    fn water(&mut self, position: Vec2, velocity: Vec2) -> u32;
    /// Fills the cells `low … high` (high not included) with water at rest, one in the middle of each.
    fn pool(&mut self, low: (i32, i32), high: (i32, i32));
    /// Puts rock into the cells `low … high` (high not included).
    fn rock(&mut self, low: (i32, i32), high: (i32, i32));
    /// Moves every particle by up to [`NUDGE`] in each coordinate.
    fn nudge(&mut self);
}

/// Some roundings of a position in a box of a few dozen cells, d: what two runs may differ by that ought to be the same
/// but for rounding.
pub const NUDGE: f32 = 1e-5;

/// Root of the mean square of the distances of each particle of `other` to that of `one`, taken to its `place`, d.
pub fn apart(one: &Sandbox, other: &Sandbox, place: impl Fn(Vec2) -> Vec2) -> f64 {
    let (a, b) = (one.particles(), other.particles());
    assert_eq!(a.len(), b.len());
    let square = |(i, j): (u32, u32)| f64::from(place(a.position(i as usize)).distance_squared(b.position(j as usize)));
    let total: f64 = a.in_id_order().into_iter().zip(b.in_id_order()).map(square).sum();
    (total / a.len() as f64).sqrt()
}

impl Furnish for Blueprint {
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

    fn nudge(&mut self) {
        let mut random = Random::new(7);
        for at in self.particles.x.iter_mut().chain(&mut self.particles.y) {
            *at += random.within(-NUDGE, NUDGE);
        }
    }
}

/// A world that runs.
pub struct Sandbox {
    /// The app, for what has no shortcut here.
    pub app: App,
}

impl Sandbox {
    /// The start of a blueprint.
    pub fn of(blueprint: Blueprint) -> Self {
        let mut app = App::new();
        app.add_plugins((MinimalPlugins, SimulationPlugin));
        app.insert_resource(Time::<Fixed>::from_hz(60.0));
        app.insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        control::load(app.world_mut(), Arc::new(blueprint));
        app.finish();
        app.cleanup();
        // The clock's first update has no time in it and runs no tick.
        app.update();
        Self { app }
    }

    /// The start of a built-in scene.
    pub fn scene(scene: &str, settings: &[(&str, &str)]) -> Self {
        Self::of(blueprint(scene, settings))
    }

    /// Uses exactly `threads` threads from here on.
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.app.insert_resource(Workers::new(threads).unwrap_or_else(|error| panic!("{error}")));
        self
    }

    /// Uses the lanes of `set` from here on.
    pub fn with_lanes(mut self, set: InstructionSet) -> Self {
        self.app.world_mut().resource_mut::<SolverState>().instructions = set;
        self
    }

    /// Uses another solver from here on.
    pub fn with_solver(mut self, solver: Solver) -> Self {
        self.app.insert_resource(SolverState(solver));
        self
    }

    /// Runs `ticks` ticks.
    pub fn tick(&mut self, ticks: u32) -> &mut Self {
        for _ in 0..ticks {
            self.app.update();
        }
        self
    }

    /// Queues an intent for the next tick.
    pub fn push(&mut self, intent: Intent) -> &mut Self {
        self.app.world_mut().resource_mut::<IntentQueue>().push(intent);
        self
    }

    /// Hash of the state.
    pub fn hash(&self) -> u64 {
        control::hash(self.app.world())
    }

    /// The movable particles.
    pub fn particles(&self) -> &Particles {
        self.app.world().resource::<ParticleStore>()
    }

    /// The movable particles, to change them between ticks.
    pub fn particles_mut(&mut self) -> &mut Particles {
        &mut self.app.world_mut().resource_mut::<ParticleStore>().into_inner().0
    }

    /// The rock.
    pub fn rock(&self) -> &Rock {
        self.app.world().resource::<Rock>()
    }

    /// What the limiters did.
    pub fn counters(&self) -> Counters {
        *self.app.world().resource::<Counters>()
    }

    /// Particles by element.
    pub fn census(&self) -> &Census {
        self.app.world().resource::<Census>()
    }

    /// Calls of a pass since the ledger was cleared.
    pub fn calls(&self, pass: Pass) -> u64 {
        self.app.world().resource::<PassLedger>().record(pass).calls
    }

    /// A resource.
    pub fn get<R: bevy::prelude::Resource>(&self) -> &R {
        self.app.world().resource::<R>()
    }

    /// A resource, to change it between ticks.
    pub fn get_mut<R: bevy::prelude::Resource<Mutability = bevy::ecs::component::Mutable>>(&mut self) -> &mut R {
        self.app.world_mut().resource_mut::<R>().into_inner()
    }

    /// Root of the mean square of the speeds, d a tick.
    pub fn rms_speed(&self) -> f64 {
        let particles = self.particles();
        let sum: f64 = (0..particles.len()).map(|i| f64::from(particles.velocity(i).length_squared())).sum();
        (sum / particles.len().max(1) as f64).sqrt() / 60.0
    }
}

/// Marsaglia's xorshift: the same numbers in every run.
pub struct Random(u64);

impl Random {
    /// Numbers that belong to `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    /// A number in `low … high`.
    pub fn within(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// One of `0 … count`, count not included.
    pub fn index(&mut self, count: usize) -> usize {
        (self.bits() >> 11) as usize % count
    }

    /// A point in `[0, size.x] × [0, size.y]`.
    pub fn point(&mut self, size: Vec2) -> Vec2 {
        Vec2::new(self.within(0.0, size.x), self.within(0.0, size.y))
    }
}
