//! The simulation of a case: it yields after each tick, and a stopwatch counts what simulating takes.

use crate::{
    kernel::{params::Quality, particles::Particles, units::TICKS_PER_SECOND},
    lab::{
        balance::{Matter, matter},
        jobs::pause,
    },
    scene::blueprint::Blueprint,
    sim::{
        ledger::PassLedger,
        pace::longest_frame,
        simulation::Simulation,
        state::{AirGrid, Setup},
        workers::Workers,
    },
};
use bevy::{ecs::world::World, platform::time::Instant};
use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

/// Time that simulating took, ns: what is measured and drawn in between doesn't count.
#[derive(Clone, Debug, Default)]
pub struct Stopwatch(Arc<AtomicU64>);

impl Stopwatch {
    /// Time so far, ms.
    pub fn milliseconds(&self) -> f64 {
        Duration::from_nanos(self.0.load(Ordering::Relaxed)).as_secs_f64() * 1e3
    }

    fn time<T>(&self, work: impl FnOnce() -> T) -> T {
        let begun = Instant::now();
        let result = work();
        self.0.fetch_add(begun.elapsed().as_nanos() as u64, Ordering::Relaxed);
        result
    }
}

/// The simulation of a case.
pub struct CaseSimulation {
    simulation: Simulation,
    stopwatch: Stopwatch,
    /// Ticks done.
    pub ticks: u32,
}

impl CaseSimulation {
    /// The world of a blueprint, on one thread: cases run side by side.
    pub fn new(blueprint: Blueprint, stopwatch: &Stopwatch) -> Self {
        let simulation = stopwatch.time(|| Simulation::new(Arc::new(blueprint), Workers::single()));
        Self { simulation, stopwatch: stopwatch.clone(), ticks: 0 }
    }

    /// Runs a tick.
    pub async fn tick(&mut self) {
        self.stopwatch.time(|| self.simulation.tick());
        self.ticks += 1;
        pause().await;
    }

    /// Runs a frame of the game that comes `late` after the last one, in place of a tick; gives the ticks that it ran.
    pub async fn frame(&mut self, late: Duration) -> u64 {
        let median = self.world().resource::<PassLedger>().tick().median();
        let time = late.min(longest_frame(median, Duration::ZERO, 1.0));
        let ticks = time.as_nanos() / Duration::from_secs_f64(1.0 / f64::from(TICKS_PER_SECOND)).as_nanos();
        for _ in 0..ticks {
            self.stopwatch.time(|| self.simulation.tick());
        }
        pause().await;
        ticks as u64
    }

    /// Carries out the intents that wait, without a tick.
    pub fn edit(&mut self) {
        self.simulation.apply_edits();
    }

    /// Runs for a simulated time, s.
    pub async fn run(&mut self, seconds: f64) {
        for _ in 0..(seconds * f64::from(TICKS_PER_SECOND)).round() as u32 {
            self.tick().await;
        }
    }

    /// Simulated time so far, s.
    pub fn seconds(&self) -> f64 {
        f64::from(self.ticks) / f64::from(TICKS_PER_SECOND)
    }

    /// The world, to read.
    pub fn world(&self) -> &World {
        self.simulation.world()
    }

    /// The world, to change between ticks.
    pub fn world_mut(&mut self) -> &mut World {
        self.simulation.world_mut()
    }

    /// Its particles.
    pub fn matter(&self) -> Matter<'_> {
        matter(self.world())
    }

    /// Arrays of the particles.
    pub fn particles(&self) -> &Particles {
        self.matter().particles
    }

    /// Its air.
    pub fn air(&self) -> &AirGrid {
        self.world().resource()
    }

    /// The quality in force.
    pub fn quality(&self) -> Quality {
        self.world().resource::<Setup>().quality
    }

    /// Particle spacing d, m.
    pub fn spacing(&self) -> f64 {
        f64::from(self.matter().scale.spacing)
    }

    /// The scene's own spacing, m: the spacing at a quality of detail 1.
    pub fn own_spacing(&self) -> f64 {
        f64::from(self.matter().scale.own_spacing())
    }
}
