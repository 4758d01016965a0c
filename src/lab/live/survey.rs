//! "Measure here": from the world as it is, every preset is run a little way, some of them at half and at twice the
//! detail, too, and their times and errors make the curve of this very moment. Play goes on: the work is done in the
//! background by half of a thread (a quarter, where nobody asked for it), or, where there are no threads, in slices
//! between frames.

use crate::{
    kernel::simd::InstructionSet,
    lab::{
        density::DensityError,
        dial::is_same_detail,
        jobs::{Handle, Share, pause},
        live::{
            accuracy::{Curve, CurvePoint, Here, Survey, SurveyRequest, fingerprint},
            legs::{Leg, legs},
        },
        stats,
    },
    scene::effects::{Effect, Mode},
    sim::{
        checkpoint::Checkpoint,
        effects::{Effects, status::Sleepers},
        ledger::PassLedger,
        simulation::Simulation,
        state::{Clock, ParticleStore, Rock, Setup, SolverState},
        workers::Workers,
    },
};
use bevy::prelude::{Mut, Resource, World};
use std::sync::mpsc::Sender;

/// Ticks in which the state gets used to a quality.
const WARMUP: u32 = 30;
/// Ticks that are timed after them: two seconds in all.
const TICKS: u32 = 90;
/// Ticks from one measurement of the error to the next.
const MEASURE_EVERY: u32 = 10;

/// Runs the surveys.
#[derive(Resource, Default)]
pub struct Surveyor {
    handle: Option<Handle<Message>>,
    /// Never on a thread of its own.
    sliced: bool,
}

impl Surveyor {
    /// One that works in slices between frames, as where there are no threads.
    pub fn sliced() -> Self {
        Self { handle: None, sliced: true }
    }
}

/// What the work reports after each tick.
struct Message {
    /// Share that is done, 0 … 1.
    progress: f32,
    /// What a run found, if one came to its end.
    result: Option<Done>,
}

/// What a run found.
#[derive(Clone, Copy, Debug)]
enum Done {
    /// What a tick takes at the quality in force on one thread, with the same particles asleep, ms.
    Here(f32),
    /// A quality.
    Point(CurvePoint),
}

impl Done {
    fn note(&self, curve: &mut Curve) {
        match *self {
            Self::Here(milliseconds) => curve.here_on_one_thread = Some(milliseconds),
            Self::Point(point) => curve.points.push(point),
        }
    }
}

/// Begins, follows and ends surveys.
pub fn run(world: &mut World) {
    world.resource_scope(|world, mut surveyor: Mut<Surveyor>| {
        match world.resource_mut::<Survey>().request.take() {
            Some(SurveyRequest::Begin) => surveyor.begin(world, false),
            // Slices are time of the game's frames.
            Some(SurveyRequest::BeginQuietly) if surveyor.has_thread() => surveyor.begin(world, true),
            Some(SurveyRequest::BeginQuietly) => {}
            Some(SurveyRequest::Cancel) => {
                surveyor.handle = None;
                world.resource_mut::<Survey>().progress = None;
            }
            None => {}
        }
        surveyor.follow(&mut world.resource_mut::<Survey>());
    });
}

impl Surveyor {
    fn has_thread(&self) -> bool {
        !self.sliced && !cfg!(target_arch = "wasm32")
    }

    fn begin(&mut self, world: &mut World, quietly: bool) {
        let (setup, clock) = (world.resource::<Setup>(), world.resource::<Clock>());
        let sleep = Asleep::of(world);
        let curve = Curve {
            scene: setup.blueprint.name.clone(),
            of: fingerprint(&setup.blueprint),
            tick: clock.tick,
            here: (sleep != Asleep::All).then(|| Here {
                quality: setup.quality,
                detail: f64::from(setup.blueprint.scale.detail),
                milliseconds: tick_milliseconds(world),
            }),
            ..Curve::default()
        };
        let work = Work::new(world, sleep, quietly);
        let share = if quietly { Share::Quarter } else { Share::Half };
        *world.resource_mut::<Survey>() = Survey { request: None, progress: Some(0.0), curve };
        self.handle = Some(match self.sliced {
            true => Handle::sliced(|messages| work.run(messages)),
            false => Handle::start(share, |messages| work.run(messages)),
        });
    }

    fn follow(&mut self, survey: &mut Survey) {
        let Some(handle) = &mut self.handle else { return };
        for Message { progress, result } in handle.advance() {
            survey.progress = Some(progress);
            result.iter().for_each(|result| result.note(&mut survey.curve));
        }
        if handle.is_over() {
            (self.handle, survey.progress) = (None, None);
        }
    }
}

/// How much of a world sleeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asleep {
    None,
    Some,
    All,
}

impl Asleep {
    fn of(world: &World) -> Self {
        let Sleepers { particles: (asleep, particles), tiles: (still, tiles) } = Sleepers::in_world(world);
        match (asleep + still, particles + tiles) {
            (0, _) => Self::None,
            (sleepers, all) if sleepers == all => Self::All,
            _ => Self::Some,
        }
    }
}

/// A survey, tick by tick.
struct Work {
    start: Checkpoint,
    /// Instructions that the solver uses.
    instructions: InstructionSet,
    /// What is to be run, the most expensive first.
    left: Vec<Leg>,
    run: Option<Run>,
    done: f32,
    total: f32,
}

/// The world at one of the settings.
struct Run {
    leg: Leg,
    simulation: Simulation,
    ticks: u32,
    errors: Vec<DensityError>,
}

impl Work {
    fn new(world: &World, asleep: Asleep, quietly: bool) -> Self {
        let start = Checkpoint::of(world);
        let count = world.resource::<ParticleStore>().len() + world.resource::<Rock>().count();
        let mut left = legs(&start.setup, count as f64, quietly);
        left.sort_by(|a, b| b.work().total_cmp(&a.work()));
        // The game's own time is of a world with sleepers: what its threads make of it shows against the same world.
        if asleep == Asleep::Some {
            left.push(Leg { sleep: true, ..Leg::in_force(&start.setup) });
        }
        let total = left.iter().map(Leg::work).sum();
        let instructions = world.resource::<SolverState>().instructions;
        Self { start, instructions, left, run: None, done: 0.0, total }
    }

    fn is_done(&self) -> bool {
        self.left.is_empty() && self.run.is_none()
    }

    /// Does all of it, a tick at a time.
    async fn run(mut self, messages: Sender<Message>) {
        while !self.is_done() {
            let result = self.advance();
            if messages.send(Message { progress: self.progress(), result }).is_err() {
                return;
            }
            pause().await;
        }
    }

    /// Share that is done, 0 … 1.
    fn progress(&self) -> f32 {
        let under_way =
            self.run.as_ref().map_or(0.0, |run| run.leg.work() * run.ticks as f32 / (WARMUP + TICKS) as f32);
        ((self.done + under_way) / self.total).min(1.0)
    }

    /// Does one tick of the work; the result if that finishes a run.
    fn advance(&mut self) -> Option<Done> {
        while self.run.is_none() {
            let leg = self.left.pop()?;
            self.run = Run::new(&self.start, self.instructions, leg);
            if self.run.is_none() {
                // A world that does not fit a detail has no point there.
                self.done += leg.work();
            }
        }
        let run = self.run.as_mut()?;
        let result = run.advance()?;
        self.done += run.leg.work();
        self.run = None;
        Some(result)
    }
}

impl Run {
    fn new(start: &Checkpoint, instructions: InstructionSet, leg: Leg) -> Option<Self> {
        // Without threads, the calling one is all there is.
        let mut start = start.clone().at_quality(leg.preset, leg.quality).ok()?;
        if !is_same_detail(start.setup.asked_detail(), leg.asked_detail) {
            start = start.at_detail(leg.asked_detail).ok()?;
        }
        let simulation = Simulation::resume(&start, Workers::new(1).unwrap_or_default());
        let mut simulation = simulation.with_instructions(instructions);
        if !leg.sleep {
            // A sleeping particle costs the same and has the same error at every quality.
            simulation.world_mut().resource_mut::<Effects>().get_mut(Effect::Sleep).mode = Mode::Off;
        }
        Some(Self { leg, simulation, ticks: 0, errors: Vec::new() })
    }

    fn advance(&mut self) -> Option<Done> {
        if self.ticks == WARMUP {
            self.simulation.world_mut().resource_mut::<PassLedger>().clear();
        }
        self.simulation.tick();
        self.ticks += 1;
        if !self.leg.sleep && self.ticks > WARMUP && self.ticks.is_multiple_of(MEASURE_EVERY) {
            self.errors.extend(DensityError::of_world(self.simulation.world()));
        }
        if self.ticks < WARMUP + TICKS {
            return None;
        }
        let milliseconds = tick_milliseconds(self.simulation.world());
        if self.leg.sleep {
            return Some(Done::Here(milliseconds));
        }
        Some(Done::Point(CurvePoint {
            preset: self.leg.preset,
            quality: self.leg.quality,
            detail: self.leg.detail(),
            milliseconds,
            error: stats::mean(self.errors.iter().map(|error| error.mean)).map(|mean| mean as f32),
            p99: stats::mean(self.errors.iter().map(|error| error.p99)).map(|p99| p99 as f32),
            truth: None,
            is_sound: true,
        }))
    }
}

/// What a tick of the game takes, ms: median over the last ticks.
fn tick_milliseconds(world: &World) -> f32 {
    world.resource::<PassLedger>().tick().median().as_secs_f32() * 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        scene::{self, effects::EffectModes, passes::Pass},
        sim::{simulation::Simulation, state::SleepState},
    };
    use std::sync::Arc;

    /// A pool whose water and air came to rest.
    fn pool() -> Simulation {
        let settings = [("columns", "16"), ("depth", "10")].map(|(key, value)| (key.to_owned(), value.to_owned()));
        let blueprint = scene::load("hydrostatic").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let asleep = |simulation: &Simulation| Asleep::of(simulation.world()) == Asleep::All;
        while !asleep(&simulation) {
            simulation.tick();
            assert!(simulation.world().resource::<Clock>().tick < 3000, "it does not fall asleep");
        }
        simulation
    }

    #[test]
    fn what_sleeps_is_awake_in_every_run_from_the_first_tick_to_the_last() {
        let simulation = pool();
        let mut work = Work::new(simulation.world(), Asleep::of(simulation.world()), false);
        let (legs, mut moved) = (work.left.len() as u32, 0);
        assert!(legs > Preset::ALL.len() as u32, "no other detail");
        while !work.is_done() {
            work.advance();
            if let Some(run) = &work.run {
                let world = run.simulation.world();
                assert_eq!(world.resource::<SleepState>().asleep(), 0, "{:?} sleeps at tick {}", run.leg, run.ticks);
                moved += u32::from(world.resource::<PassLedger>().record(Pass::Solve).last.calls > 0);
            }
        }
        assert!(moved >= legs * (WARMUP + TICKS - 1), "only {moved} ticks were simulated");
    }

    #[test]
    fn only_a_world_of_which_a_part_sleeps_is_run_once_more_for_its_time() {
        let simulation = pool();
        let legs = |asleep| Work::new(simulation.world(), asleep, false).left;
        let sleepers = |asleep| legs(asleep).iter().filter(|leg| leg.sleep).count();
        assert_eq!((sleepers(Asleep::None), sleepers(Asleep::All)), (0, 0));
        let some = legs(Asleep::Some);
        assert_eq!(some.iter().filter(|leg| leg.sleep).count(), 1);
        let last = some.last().expect("it is run first");
        assert!(last.sleep && last.quality == simulation.world().resource::<Setup>().quality);
    }
}
