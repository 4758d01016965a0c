//! All gauges of a world, and what they read.

use crate::{
    kernel::{element::ElementId, units::TICKS_PER_SECOND},
    lab::gauges::{
        crossings::{Crossings, crosses},
        place::Place,
        spot::{self, SpotReading},
        still::Still,
    },
    scene::passes::Pass,
    sim::{
        generation::Generation,
        state::{Clock, ParticleStore, Setup},
    },
};
use bevy::prelude::{App, FixedUpdate, IntoScheduleConfigs, Mut, Res, Resource, World};
use std::collections::VecDeque;

/// Most gauges that there can be.
pub const MOST: usize = 8;

/// Readings that the game keeps of each: those of the last five minutes, some 2 MB.
const KEPT: usize = 5 * 60 * TICKS_PER_SECOND as usize;

/// What a line reads, for each metre of depth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineReading {
    /// Volume that went to its right in the tick, m²/s. A particle is d²/ρ₀ of it.
    pub flow: f64,
    /// The same, mean since it is counted; none in the first tick.
    pub mean: Option<f64>,
    /// Particles that went to its right since then, less those that went back.
    pub crossed: i64,
}

/// What a gauge reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// At a place.
    Spot(SpotReading),
    /// Through a line.
    Line(LineReading),
}

/// What a gauge read after a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Ticks done.
    pub tick: u64,
    /// What it read.
    pub reading: Reading,
}

/// Particles that crossed a line.
#[derive(Clone, Debug, Default)]
struct Count {
    /// Tick from which on it counts.
    since: u64,
    /// In the last tick and since it counts, each in all and by element.
    now: Crossed,
    all: Crossed,
}

/// Particles that crossed to the right, less those that crossed back.
#[derive(Clone, Debug, Default)]
struct Crossed {
    net: i64,
    by_element: Vec<i64>,
}

impl Crossed {
    fn clear(&mut self, elements: usize) {
        self.net = 0;
        self.by_element.clear();
        self.by_element.resize(elements, 0);
    }

    fn add(&mut self, element: ElementId, way: i64) {
        self.net += way;
        self.by_element[element.index()] += way;
    }
}

/// A gauge.
#[derive(Clone, Debug)]
pub struct Gauge {
    /// Its number: 1 is the first.
    pub number: u32,
    /// Where it is.
    pub place: Place,
    samples: VecDeque<Sample>,
    count: Count,
}

impl Gauge {
    /// What it read, oldest first: as many readings as are kept.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = &Sample> {
        self.samples.iter()
    }

    /// What it read last.
    pub fn latest(&self) -> Option<&Reading> {
        self.samples.back().map(|sample| &sample.reading)
    }

    /// Tick from which on a line counts.
    pub fn since(&self) -> u64 {
        self.count.since
    }

    /// Particles of an element that crossed a line to the right since it counts, less those that crossed back; and the same in
    /// the last tick.
    pub fn crossed(&self, element: ElementId) -> [i64; 2] {
        [&self.count.all, &self.count.now].map(|crossed| crossed.by_element.get(element.index()).copied().unwrap_or(0))
    }

    fn is_line(&self) -> bool {
        matches!(self.place, Place::Line { .. })
    }

    fn start_counting(&mut self, tick: u64, elements: usize) {
        self.count.since = tick;
        self.count.now.clear(elements);
        self.count.all.clear(elements);
    }

    fn keep(&mut self, sample: Sample, kept: usize) {
        if self.samples.len() == kept {
            self.samples.pop_front();
        }
        self.samples.push_back(sample);
    }
}

/// All gauges of a world. Empty it holds nothing.
#[derive(Resource, Clone, Debug)]
pub struct Gauges {
    all: Vec<Gauge>,
    crossings: Crossings,
    still: Still,
    /// The world that they are in.
    generation: Generation,
    /// Ticks done when they were read last.
    tick: u64,
    /// Readings that are kept of each.
    kept: usize,
}

impl Default for Gauges {
    fn default() -> Self {
        Self::keeping(KEPT)
    }
}

impl Gauges {
    /// No gauge; of those that are set so many readings are kept.
    pub fn keeping(kept: usize) -> Self {
        Self {
            all: Vec::new(),
            crossings: Crossings::default(),
            still: Still::default(),
            generation: Generation::default(),
            tick: 0,
            kept: kept.max(1),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Bytes held.
    pub fn held(&self) -> usize {
        let readings: usize = self.all.iter().map(|gauge| gauge.samples.capacity() * size_of::<Sample>()).sum();
        self.all.capacity() * size_of::<Gauge>() + readings + self.crossings.held() + self.still.held()
    }

    /// All, by their numbers.
    pub fn iter(&self) -> std::slice::Iter<'_, Gauge> {
        self.all.iter()
    }

    /// Takes one away; whether there was one of this number. With the last goes all that is held.
    pub fn remove(&mut self, number: u32) -> bool {
        let before = self.all.len();
        self.all.retain(|gauge| gauge.number != number);
        if !self.all.iter().any(Gauge::is_line) {
            self.crossings = Crossings::default();
        }
        if self.all.is_empty() {
            self.clear();
        }
        self.all.len() < before
    }

    /// Takes all away.
    pub fn clear(&mut self) {
        *self = Self::keeping(self.kept);
    }

    /// Sets a gauge with the lowest number that is free, which it returns. At a place it reads `world` at once.
    ///
    /// # Errors
    /// If it can't be there, or there are [`MOST`] of them: what is wrong, and what is allowed.
    pub fn set(&mut self, world: &World, place: Place) -> Result<u32, String> {
        self.follow(world);
        let setup = world.resource::<Setup>();
        place.check(setup)?;
        if self.all.len() == MOST {
            return Err(format!("there are {MOST} gauges; allowed: {MOST} at most"));
        }
        if self.all.is_empty() {
            (self.generation, self.tick) = (Generation::of(world), world.resource::<Clock>().tick);
        }
        let free = |number: &u32| self.all.iter().all(|gauge| gauge.number != *number);
        let number = (1..=MOST as u32).find(free).unwrap_or(1);
        let mut gauge = Gauge { number, place, samples: VecDeque::new(), count: Count::default() };
        match place {
            Place::Spot { at, radius } => {
                let reading = Reading::Spot(spot::read(world, at, radius, &mut self.still));
                gauge.keep(Sample { tick: self.tick, reading }, self.kept);
            }
            Place::Line { .. } => {
                gauge.start_counting(self.tick, setup.elements().len());
                if !self.all.iter().any(Gauge::is_line) {
                    self.crossings.look(world.resource::<ParticleStore>());
                }
            }
        }
        let after = self.all.partition_point(|gauge| gauge.number < number);
        self.all.insert(after, gauge);
        Ok(number)
    }

    /// Moves a gauge, if it can be there and there is one of this number. What it read stays, of where it was then; a line counts anew.
    /// At a place it reads `world` at once.
    pub fn move_to(&mut self, world: &World, number: u32, place: Place) {
        self.follow(world);
        let setup = world.resource::<Setup>();
        let Self { all, still, kept, tick, .. } = self;
        let Some(gauge) = all.iter_mut().find(|gauge| gauge.number == number) else { return };
        if gauge.place == place || place.check(setup).is_err() {
            return;
        }
        gauge.place = place;
        match place {
            Place::Spot { at, radius } => {
                let reading = Reading::Spot(spot::read(world, at, radius, still));
                gauge.samples.pop_back_if(|sample| sample.tick == *tick);
                gauge.keep(Sample { tick: *tick, reading }, *kept);
            }
            Place::Line { .. } => gauge.start_counting(*tick, setup.elements().len()),
        }
    }

    /// Goes along with a world that was put in the place of another: in a new scene there are no gauges; in an earlier state of the
    /// same what was read later is forgotten, and lines count anew.
    pub fn follow(&mut self, world: &World) {
        let now = Generation::of(world);
        if self.all.is_empty() || now == self.generation {
            return;
        }
        if now.scene != self.generation.scene {
            return self.clear();
        }
        let (setup, tick) = (world.resource::<Setup>(), world.resource::<Clock>().tick);
        (self.generation, self.tick) = (now, tick);
        let mut has_lines = false;
        for gauge in &mut self.all {
            while gauge.samples.back().is_some_and(|sample| sample.tick >= tick) {
                gauge.samples.pop_back();
            }
            gauge.start_counting(tick, setup.elements().len());
            has_lines |= gauge.is_line();
        }
        if has_lines {
            self.crossings.look(world.resource::<ParticleStore>());
        }
    }

    /// Reads all after a tick.
    pub fn read(&mut self, world: &World) {
        self.follow(world);
        let tick = world.resource::<Clock>().tick;
        if self.all.is_empty() || tick == self.tick {
            return;
        }
        self.tick = tick;
        self.count(world);
        let Self { all, still, kept, .. } = self;
        let setup = world.resource::<Setup>();
        for gauge in all {
            let reading = match gauge.place {
                Place::Spot { at, radius } => Reading::Spot(spot::read(world, at, radius, still)),
                Place::Line { .. } => {
                    let Count { since, now, all } = &gauge.count;
                    let ticks = tick.saturating_sub(*since);
                    let mean = (ticks > 0).then(|| flow(setup, all.net) / ticks as f64);
                    Reading::Line(LineReading { flow: flow(setup, now.net), mean, crossed: all.net })
                }
            };
            gauge.keep(Sample { tick, reading }, *kept);
        }
    }

    /// Counts what crossed the lines in the last tick.
    fn count(&mut self, world: &World) {
        let Self { all, crossings, .. } = self;
        if !all.iter().any(Gauge::is_line) {
            return;
        }
        let setup = world.resource::<Setup>();
        let (scale, elements) = (setup.blueprint.scale, setup.elements().len());
        all.iter_mut().for_each(|gauge| gauge.count.now.clear(elements));
        crossings.follow(world.resource::<ParticleStore>(), |moved| {
            for gauge in all.iter_mut() {
                let Place::Line { from, to } = gauge.place else { continue };
                let way = crosses(&moved, scale.vec_to_kernel(from), scale.vec_to_kernel(to));
                if way != 0 {
                    gauge.count.now.add(moved.element, way);
                    gauge.count.all.add(moved.element, way);
                }
            }
        });
    }
}

/// So many particles in a tick as a flow, m²/s.
pub fn flow(setup: &Setup, particles: i64) -> f64 {
    let spacing = f64::from(setup.blueprint.scale.spacing);
    let area = spacing * spacing / f64::from(setup.blueprint.fluid.rest_density);
    particles as f64 * area * f64::from(TICKS_PER_SECOND)
}

/// Adds gauges to the world that is played.
pub fn plugin(app: &mut App) {
    app.init_resource::<Gauges>().add_systems(FixedUpdate, read.after(Pass::Measure).run_if(any));
}

/// Run condition: there is a gauge.
pub fn any(gauges: Res<Gauges>) -> bool {
    !gauges.is_empty()
}

fn read(world: &mut World) {
    world.resource_scope(|world, mut gauges: Mut<Gauges>| gauges.read(world));
}
