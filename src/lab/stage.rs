//! A world that is simulated beside others, as the exam and the gauntlet do: ticked, with a clock beside it.

use crate::{
    kernel::{params::Quality, particles::Particles, units::TICKS_PER_SECOND},
    lab::{balance::Matter, drive::pause, headless::Headless, sampler::matter},
    scene::blueprint::Blueprint,
    sim::{
        ledger::PassLedger,
        pace::{Pace, longest_frame},
        state::{AirGrid, Clock, Setup},
        workers::Workers,
    },
};
use bevy::{
    ecs::world::World,
    platform::time::Instant,
    time::{Fixed, Time, TimeUpdateStrategy, Virtual},
};
use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

/// What simulating took, ns: what is measured and drawn in between doesn't count.
#[derive(Clone, Debug, Default)]
pub struct Clockwork(Arc<AtomicU64>);

impl Clockwork {
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

/// The world of a case.
pub(crate) struct Stage {
    headless: Headless,
    clockwork: Clockwork,
    /// Ticks done.
    pub ticks: u32,
}

impl Stage {
    /// The world of a blueprint, on one thread: cases run side by side.
    pub fn new(blueprint: Blueprint, clockwork: &Clockwork) -> Self {
        let headless = clockwork.time(|| Headless::new(Arc::new(blueprint), Workers::single()));
        Self { headless, clockwork: clockwork.clone(), ticks: 0 }
    }

    /// Runs a tick.
    pub async fn tick(&mut self) {
        self.clockwork.time(|| self.headless.tick());
        self.ticks += 1;
        pause().await;
    }

    /// Runs a frame of the game that comes `late` after the last one, in place of a tick; gives the ticks that it ran.
    pub async fn frame(&mut self, late: Duration) -> u64 {
        let before = self.world().resource::<Clock>().tick;
        let median = self.world().resource::<PassLedger>().tick().median();
        let world = self.world_mut();
        world.insert_resource(Time::<Fixed>::from_hz(f64::from(TICKS_PER_SECOND)));
        world.resource_mut::<Time<Virtual>>().set_max_delta(longest_frame(median, 1.0));
        world.insert_resource(TimeUpdateStrategy::ManualDuration(late));
        self.clockwork.time(|| self.headless.tick());
        self.world_mut().insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
        pause().await;
        self.world().resource::<Clock>().tick - before
    }

    /// Carries out the intents that wait, without a tick.
    pub fn edit(&mut self) {
        let pace = std::mem::replace(
            &mut *self.world_mut().resource_mut::<Pace>(),
            Pace { paused: true, steps_due: 0, ..Pace::default() },
        );
        self.headless.tick();
        *self.world_mut().resource_mut::<Pace>() = pace;
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

    pub fn world(&self) -> &World {
        self.headless.world()
    }

    pub fn world_mut(&mut self) -> &mut World {
        self.headless.world_mut()
    }

    pub fn matter(&self) -> Matter<'_> {
        matter(self.world())
    }

    pub fn particles(&self) -> &Particles {
        self.matter().particles
    }

    pub fn air(&self) -> &AirGrid {
        self.world().resource()
    }

    pub fn quality(&self) -> Quality {
        self.world().resource::<Setup>().quality
    }

    /// Particle spacing d, m.
    pub fn spacing(&self) -> f64 {
        f64::from(self.matter().scale.spacing)
    }
}
