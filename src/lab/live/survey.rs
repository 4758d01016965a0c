//! "Measure here": from the world as it is, every preset is run a little way, and its time and error make the curve of
//! this very moment. Play goes on: the work is done by one thread that rests as long as it works, or, where there are no
//! threads, in slices between frames.

use crate::{
    kernel::params::{Preset, Quality},
    lab::{density::density_error, live::tick_milliseconds, stats},
    sim::{
        accuracy::{Curve, CurvePoint, Survey, SurveyRequest},
        autopilot::ladder,
        ledger::PassLedger,
        state::{Clock, ParticleStore, Rock, Setup},
        twin::{Seed, Twin},
        workers::Workers,
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{Mut, Resource, World},
};
use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::Duration,
};

/// Ticks in which the state gets used to a quality.
const WARMUP: u32 = 30;
/// Ticks that are timed after them: two seconds in all.
const TICKS: u32 = 90;
/// Ticks from one measurement of the error to the next.
const MEASURE_EVERY: u32 = 10;
/// Time that a slice may take of a frame.
const SLICE: Duration = Duration::from_millis(4);

/// Runs the surveys.
#[derive(Resource, Default)]
pub struct Surveyor {
    job: Option<Job>,
    /// Never on a thread of its own.
    sliced: bool,
}

impl Surveyor {
    /// One that works in slices between frames, as where there are no threads.
    pub fn sliced() -> Self {
        Self { job: None, sliced: true }
    }
}

enum Job {
    Thread { shared: Arc<Shared> },
    Slices(Box<Work>),
}

/// What the thread tells, and is told.
#[derive(Default)]
struct Shared {
    cancelled: AtomicBool,
    found: Mutex<Found>,
}

#[derive(Clone, Debug, Default)]
struct Found {
    points: Vec<CurvePoint>,
    progress: f32,
    done: bool,
}

/// Begins, follows and ends surveys.
pub fn run(world: &mut World) {
    world.resource_scope(|world, mut surveyor: Mut<Surveyor>| {
        match world.resource_mut::<Survey>().request.take() {
            Some(SurveyRequest::Begin) => surveyor.begin(world),
            Some(SurveyRequest::Cancel) => {
                surveyor.cancel();
                world.resource_mut::<Survey>().progress = None;
            }
            None => {}
        }
        surveyor.follow(&mut world.resource_mut::<Survey>());
    });
}

impl Surveyor {
    fn begin(&mut self, world: &mut World) {
        self.cancel();
        let (setup, clock) = (world.resource::<Setup>(), world.resource::<Clock>());
        let curve = Curve {
            scene: setup.blueprint.name.clone(),
            tick: clock.tick,
            here: Some((setup.quality, tick_milliseconds(world))),
            points: Vec::new(),
        };
        let work = Work::new(Seed::of(world));
        *world.resource_mut::<Survey>() = Survey { request: None, progress: Some(0.0), curve };
        self.job = Some(if self.sliced { Job::Slices(Box::new(work)) } else { start(work) });
    }

    fn cancel(&mut self) {
        if let Some(Job::Thread { shared }) = self.job.take() {
            shared.cancelled.store(true, Ordering::Relaxed);
        }
    }

    fn follow(&mut self, survey: &mut Survey) {
        let done = match &mut self.job {
            None => return,
            Some(Job::Thread { shared }) => {
                let found = shared.found.lock().unwrap_or_else(PoisonError::into_inner).clone();
                survey.curve.points = found.points;
                survey.progress = Some(found.progress);
                // A thread that is gone has nothing more to tell, whatever became of it.
                found.done || Arc::strong_count(shared) == 1
            }
            Some(Job::Slices(work)) => {
                let begun = Instant::now();
                while !work.is_done() && begun.elapsed() < SLICE {
                    survey.curve.points.extend(work.advance());
                }
                survey.progress = Some(work.progress());
                work.is_done()
            }
        };
        if done {
            (self.job, survey.progress) = (None, None);
        }
    }
}

/// Starts a thread for the work; without threads it is done in slices.
fn start(work: Work) -> Job {
    let shared = Arc::new(Shared::default());
    let (theirs, slot) = (shared.clone(), Arc::new(Mutex::new(Some(work))));
    let taken = slot.clone();
    let started = thread::Builder::new().name("survey".into()).spawn(move || {
        let work = taken.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(work) = work {
            work_aside(work, &theirs);
        }
    });
    // Where no thread starts, nobody else wants the work.
    let left = started.err().and_then(|_| slot.lock().unwrap_or_else(PoisonError::into_inner).take());
    left.map_or(Job::Thread { shared }, |work| Job::Slices(Box::new(work)))
}

fn work_aside(mut work: Work, shared: &Shared) {
    while !work.is_done() && !shared.cancelled.load(Ordering::Relaxed) {
        let begun = Instant::now();
        let point = work.advance();
        let mut found = shared.found.lock().unwrap_or_else(PoisonError::into_inner);
        found.points.extend(point);
        (found.progress, found.done) = (work.progress(), work.is_done());
        drop(found);
        // Half of the time belongs to the game.
        thread::sleep(begun.elapsed());
    }
}

/// A survey, tick by tick.
struct Work {
    seed: Seed,
    /// Qualities to run, the dearest first, and the work of each.
    left: Vec<(Preset, Quality)>,
    run: Option<Run>,
    done: f32,
    total: f32,
}

/// The world at one of the qualities.
struct Run {
    preset: Preset,
    quality: Quality,
    twin: Twin,
    ticks: u32,
    means: Vec<f64>,
    p99s: Vec<f64>,
}

impl Work {
    fn new(seed: Seed) -> Self {
        let mut left: Vec<_> = Preset::ALL.into_iter().map(|preset| (preset, preset.quality())).collect();
        if left.iter().all(|(_, quality)| *quality != seed.setup.quality) {
            left.push((seed.setup.preset, seed.setup.quality));
        }
        left.sort_by(|(_, a), (_, b)| ladder::work(b).total_cmp(&ladder::work(a)));
        let total = left.iter().map(|(_, quality)| ladder::work(quality)).sum();
        Self { seed, left, run: None, done: 0.0, total }
    }

    fn is_done(&self) -> bool {
        self.left.is_empty() && self.run.is_none()
    }

    /// Share that is done, 0 … 1.
    fn progress(&self) -> f32 {
        let under_way = self
            .run
            .as_ref()
            .map_or(0.0, |run| ladder::work(&run.quality) * run.ticks as f32 / (WARMUP + TICKS) as f32);
        ((self.done + under_way) / self.total).min(1.0)
    }

    /// Does one tick of the work; the point if that finishes one.
    fn advance(&mut self) -> Option<CurvePoint> {
        if self.run.is_none() {
            let (preset, quality) = self.left.pop()?;
            self.run = Some(Run::new(&self.seed, preset, quality));
        }
        let point = self.run.as_mut()?.advance()?;
        self.run = None;
        self.done += ladder::work(&point.quality);
        Some(point)
    }
}

impl Run {
    fn new(seed: &Seed, preset: Preset, quality: Quality) -> Self {
        // Without threads, the calling one is all there is.
        let mut twin = Twin::new(seed, Workers::new(1).unwrap_or_default());
        twin.set_quality(preset, quality);
        Self { preset, quality, twin, ticks: 0, means: Vec::new(), p99s: Vec::new() }
    }

    fn advance(&mut self) -> Option<CurvePoint> {
        if self.ticks == WARMUP {
            self.twin.world_mut().resource_mut::<PassLedger>().clear();
        }
        self.twin.tick();
        self.ticks += 1;
        if self.ticks > WARMUP && self.ticks.is_multiple_of(MEASURE_EVERY) {
            self.measure();
        }
        (self.ticks == WARMUP + TICKS).then(|| CurvePoint {
            preset: self.preset,
            quality: self.quality,
            milliseconds: tick_milliseconds(self.twin.world()),
            error: stats::mean(&self.means).map(|mean| mean as f32),
            p99: stats::mean(&self.p99s).map(|p99| p99 as f32),
        })
    }

    fn measure(&mut self) {
        let world = self.twin.world();
        let blueprint = &world.resource::<Setup>().blueprint;
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        let rest = f64::from(blueprint.fluid.rest_density);
        if let Some(error) = density_error(particles, rock, blueprint.domain.size, rest) {
            self.means.push(error.mean);
            self.p99s.push(error.p99);
        }
    }
}
