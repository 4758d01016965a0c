//! The world of a case: a scene at a quality, ticked with a clock beside it.

use crate::{
    kernel::{
        params::{Preset, Quality},
        particles::Particles,
        units::TICKS_PER_SECOND,
    },
    lab::{
        balance::Matter,
        exam::{case::Setting, drive::pause},
        headless::Headless,
        sampler::matter,
    },
    scene::{
        self, SceneError, SceneFile,
        blueprint::{Blueprint, Effect, EffectModes, Mode},
    },
    sim::{
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

/// What simulating took, ns: what is measured and drawn in between doesn't count.
#[derive(Clone, Debug, Default)]
pub(super) struct Clockwork(Arc<AtomicU64>);

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
pub(super) struct Stage {
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

/// A scene of the game's menu, with settings put in.
pub(super) fn builtin(name: &str, settings: &[(&str, f64)], setting: &Setting) -> Result<Blueprint, SceneError> {
    build(&scene::load(name)?, settings, setting.preset)
}

/// A scene of the exam's own (`assets/exam`), with settings put in.
pub(super) fn own(
    name: &str,
    text: &'static str,
    settings: &[(&str, f64)],
    setting: &Setting,
) -> Result<Blueprint, SceneError> {
    build(&scene::from_text(name, text)?, settings, setting.preset)
}

fn build(file: &SceneFile, settings: &[(&str, f64)], preset: Preset) -> Result<Blueprint, SceneError> {
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), value.to_string())).collect();
    // What rests has to come to rest, and stay there, by the method alone.
    file.build(&settings, Some(preset), &EffectModes::from([(Effect::Sleep, Mode::Off)]))
}
