//! How a world takes what is thrown at it: a copy is run for ten seconds in the background, on one thread, and judged after every
//! tick. It is the same world to the bit as long as its player does nothing else to it.

use super::list::Throw;
use crate::{
    kernel::{simd::InstructionSet, units::TICKS_PER_SECOND},
    lab::{
        gauntlet::{
            judged::{Found, Judged},
            rule::{Measured, Rule},
        },
        jobs::{Handle, Share, pause},
    },
    sim::{
        checkpoint::Checkpoint,
        numbers::figure,
        recording::Entry,
        script::Script,
        simulation::Simulation,
        state::{ParticleStore, SolverState},
        workers::Workers,
    },
};
use bevy::prelude::{App, ResMut, Resource, Update, World};
use std::sync::mpsc::Sender;

/// How long it is judged, s: what was thrown comes to rest, and what was set off comes to its end.
pub const SECONDS: u32 = 10;

/// The same in ticks.
pub(super) const TICKS: u32 = SECONDS * TICKS_PER_SECOND;

/// How far it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Progress {
    /// Nothing was thrown yet.
    #[default]
    Idle,
    /// It is judged; the share that is done, 0 … 1.
    Running(f32),
    /// It held: particles at the end, and which rule came nearest to its bound.
    Held {
        /// Particles at the end.
        particles: usize,
        /// The rule that came nearest to its bound, in words.
        nearest: String,
    },
    /// It did not: what broke, a line for each rule. `known` if all of that is what the plain method is known to do.
    Broke {
        /// A line for each rule.
        faults: Vec<String>,
        /// Whether the plain method explains all of it.
        known: bool,
    },
}

/// What was thrown last, and what comes of it.
#[derive(Resource, Default)]
pub struct StressTest {
    throw: Option<&'static Throw>,
    progress: Progress,
    handle: Option<Handle<Progress>>,
}

/// Keeps a stress test.
pub fn plugin(app: &mut App) {
    app.init_resource::<StressTest>().add_systems(Update, follow);
}

impl StressTest {
    /// Judges a copy of `world`, to which `input` is done.
    pub fn begin(world: &mut World, throw: &'static Throw, input: Vec<Entry>) {
        let start = Checkpoint::of(world);
        let instructions = world.resource::<SolverState>().instructions;
        let script = world.get_resource::<Script>().cloned();
        let handle = Handle::start(Share::Half, move |messages| run(start, (instructions, script), input, messages));
        *world.resource_mut::<Self>() =
            Self { throw: Some(throw), progress: Progress::Running(0.0), handle: Some(handle) };
    }

    /// What was thrown last.
    pub fn throw(&self) -> Option<&'static Throw> {
        self.throw
    }

    /// How far it is.
    pub fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Whether it is judged now.
    pub fn is_running(&self) -> bool {
        self.handle.is_some()
    }

    fn advance(&mut self) {
        let Some(handle) = &mut self.handle else { return };
        if let Some(progress) = handle.advance().pop() {
            self.progress = progress;
        }
        if handle.is_over() {
            self.handle = None;
            if let Progress::Running(_) = self.progress {
                self.progress = Progress::Broke { faults: vec!["the program panicked".to_owned()], known: false };
            }
        }
    }
}

/// Follows the stress test.
fn follow(mut test: ResMut<StressTest>) {
    if test.is_running() {
        test.advance();
    }
}

async fn run(
    start: Checkpoint,
    (instructions, script): (InstructionSet, Option<Script>),
    input: Vec<Entry>,
    messages: Sender<Progress>,
) {
    // Without threads, the calling one is all there is.
    let mut simulation =
        Simulation::resume(&start, Workers::new(1).unwrap_or_default()).with_instructions(instructions);
    if let Some(script) = script {
        simulation.world_mut().insert_resource(script);
    }
    drop(start);
    let mut judged = Judged::new(simulation, input, TICKS);
    for tick in 0..TICKS {
        judged.tick();
        if messages.send(Progress::Running((tick + 1) as f32 / TICKS as f32)).is_err() {
            return;
        }
        pause().await;
    }
    let particles = judged.world().resource::<ParticleStore>().len();
    // Nobody may wait for it any more.
    let _ = messages.send(verdict(&judged.finish(), particles));
}

/// What was found, for a player.
pub(super) fn verdict(found: &Found, particles: usize) -> Progress {
    let faults: Vec<(Rule, String)> =
        found.findings().iter().filter_map(|finding| Some((finding.rule, finding.fault()?))).collect();
    if faults.is_empty() {
        return Progress::Held { particles, nearest: nearest(found) };
    }
    let known = faults.iter().all(|(rule, _)| found.excuses(*rule));
    Progress::Broke { faults: faults.into_iter().map(|(_, fault)| fault).collect(), known }
}

/// The rule that came nearest to its bound.
fn nearest(found: &Found) -> String {
    let measured = found.findings().iter().filter_map(|finding| Some((finding.rule, finding.measured.as_ref().ok()?)));
    let share = |(_, measured): &(Rule, &Measured)| measured.share();
    let nearest = measured.max_by(|a, b| share(a).total_cmp(&share(b)));
    nearest.map_or_else(String::new, |(rule, measured)| {
        format!("{} {} of {} {}", rule.name(), figure(measured.value), figure(measured.bound), rule.value())
    })
}
