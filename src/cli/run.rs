//! `run`: a scene without a window, and what is to be known of it.

use crate::{
    cli::{
        args::{RunArguments, Ticks},
        failure::{self, Failure},
        gauges::{self, Sink},
        output, progress,
        start::Start,
        threads,
    },
    kernel::params::Preset,
    lab::{
        self,
        autopilot::{self, Autopilot, Goal, controller::Verdict},
        gauges::table::Readings,
        live::{LivePlugin, accuracy::Watched},
        metrics::Metrics,
        picture::{DISC_RADIUS, LONG_SIDE, Picture},
        reference::{Follower, Reference},
        run::{Observer, Plan},
        sampler::Sampler,
        sound::track::Track,
        tables::{distances, particles, trace::Trace},
    },
    sim::{
        checkpoint::Checkpoint,
        control,
        intent::Intent,
        new_file::NewFile,
        recording::{Entry, Segment},
        simulation::Simulation,
        state::Setup,
        workers::Workers,
    },
};
use bevy::{ecs::world::World, platform::time::Instant};
use std::{
    io::{self, Write},
    path::Path,
};

/// Ticks of a run that does not say: 10 s.
const DEFAULT_TICKS: u64 = 600;

/// Runs a scene and writes what was asked for.
pub(super) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    check_outputs(arguments)?;
    gauges::check(arguments)?;
    let (start, recorded) = Start::of_run(arguments)?;
    let plan = plan(arguments, recorded)?;
    threads::start(arguments.machine.threads)?;
    let mut trace = arguments.trace.as_deref().map(output::create).transpose()?.map(Trace::new);
    let mut track = arguments.wav.as_deref().map(|path| track(path, plan.ticks)).transpose()?;

    let mut simulation = begin(&start, arguments);
    let mut readings = gauges::begin(arguments, simulation.world())?;
    let reference =
        arguments.reference.as_deref().map(|path| reference(path, simulation.world(), &plan)).transpose()?;
    let mut follower = reference.as_ref().map(Follower::new);
    let begun = Instant::now();
    let mut sampler = arguments.metrics.is_some().then(|| Sampler::new(simulation.world(), plan.warmup));
    let watchers = (sampler.as_mut(), follower.as_mut(), trace.as_mut());
    let ran = simulate(&mut simulation, &plan, watchers, track.as_mut(), readings.as_mut());
    let seconds = begun.elapsed().as_secs_f64();

    let world = simulation.world();
    let mut metrics = sampler.map(|sampler| sampler.finish(world));
    if let (Some(metrics), Some(follower)) = (&mut metrics, &follower) {
        metrics.accuracy.distance = Some(follower.mean(plan.warmup));
    }
    // What can be written is, whatever can't: it may be the result of hours.
    let traced = match (&arguments.trace, trace) {
        (Some(path), Some(trace)) => {
            ran.and_then(|()| trace.finish()?.finish()).map(drop).map_err(|error| Failure::unwritten(path, error))
        }
        _ => Ok(()),
    };
    let heard = match (&arguments.wav, track) {
        (Some(path), Some(track)) => {
            track.finish().and_then(NewFile::finish).map(drop).map_err(|error| Failure::unwritten(path, error))
        }
        _ => Ok(()),
    };
    let read = match (&arguments.readings, readings) {
        (Some(path), Some(readings)) => gauges::finish(path, readings),
        _ => Ok(()),
    };
    let compared = match (&arguments.reference, &follower) {
        (Some(path), Some(follower)) => output::write(path, |file| distances::write(follower.points(), file)),
        _ => Ok(()),
    };
    let written = write_outputs(arguments, world, metrics.as_ref());
    traced.and(heard).and(read).and(compared).and(written)?;
    if [&arguments.metrics, &arguments.readings].into_iter().any(|path| output::is_stdout(path.as_deref())) {
        return Ok(());
    }
    let (ticks, hash) = (plan.ticks, control::hash(world));
    let scene = &arguments.scene;
    output::print(&format!("scene={scene} ticks={ticks} wall_seconds={seconds:.3} hash={hash:016x}{}\n", flown(world)))
}

/// The world at its start, with an autopilot if it has a bound to hold.
fn begin(start: &Start, arguments: &RunArguments) -> Simulation {
    let simulation = match goal(arguments) {
        None => Simulation::resume(&start.checkpoint, Workers::default()),
        Some(goal) => {
            let plugins = (LivePlugin, autopilot::plugin);
            let mut simulation = Simulation::with_plugins(&start.checkpoint, Workers::default(), plugins);
            simulation.get_mut::<Watched>().0 = true;
            simulation.get_mut::<Autopilot>().hold(Some(goal));
            simulation
        }
    };
    simulation.with_instructions(arguments.machine.simd)
}

/// What the autopilot is to hold.
fn goal(arguments: &RunArguments) -> Option<Goal> {
    arguments.hold_ms.map(Goal::Time).or(arguments.hold_error.map(|percent| Goal::Error(percent / 100.0)))
}

/// How the autopilot stands with its bound at the end, if it flew.
fn flown(world: &World) -> String {
    let Some(autopilot) = world.get_resource::<Autopilot>() else { return String::new() };
    let quality = world.resource::<Setup>().quality;
    let held = match autopilot.verdict() {
        Verdict::Holds => "yes",
        Verdict::Beyond => "no",
        Verdict::Settling => "settling",
    };
    format!(" held={held} moves={} quality={}x{}", autopilot.moves(), quality.substeps, quality.iterations)
}

fn check_outputs(arguments: &RunArguments) -> Result<(), Failure> {
    let files = [
        arguments.metrics.as_deref(),
        arguments.particles.as_deref(),
        arguments.trace.as_deref(),
        arguments.reference.as_deref(),
        arguments.png.as_deref(),
        arguments.wav.as_deref(),
        arguments.readings.as_deref(),
        arguments.snapshot.as_deref(),
    ];
    output::check(&files.into_iter().flatten().collect::<Vec<_>>())
}

/// How far to run, and on what input; `recorded` has the quality that the recording begins at.
fn plan(arguments: &RunArguments, recorded: Option<(Segment, Preset)>) -> Result<Plan, Failure> {
    let (segment, quality) = recorded.unzip();
    let recorded = segment.as_ref().map(|segment| segment.marks.len().max(1) as u64);
    let seconds = arguments.seconds.map(|Ticks(ticks)| ticks);
    let ticks = arguments.ticks.or(seconds).or(recorded).unwrap_or(DEFAULT_TICKS);
    failure::check_warmup(arguments.warmup, ticks)?;
    let entries = segment.map(|segment| segment.entries).unwrap_or_default();
    // Who asks for a quality or for an effect gets it from the first tick to the last.
    let wanted = |intent: &Intent| match intent {
        Intent::Quality { .. } => arguments.quality.is_none(),
        Intent::Effect { effect, .. } => !arguments.effects.iter().any(|(asked, _)| asked == effect),
        _ => true,
    };
    // Lengths were in the d of the quality that was in force: beside the detail that was asked for, presets have their
    // own.
    let mut detail = quality.map_or(1.0, Preset::detail);
    let mut own = |entry: Entry| {
        if let Intent::Quality { preset, .. } = entry.intent {
            detail = preset.detail();
        }
        let factor = arguments.quality.map_or(1.0, |preset| preset.detail() / detail);
        Entry { intent: entry.intent.scaled(factor as f32), ..entry }
    };
    let input = entries.into_iter().map(&mut own).filter(|entry| wanted(&entry.intent)).collect();
    Ok(Plan { ticks, warmup: arguments.warmup, input, complete: recorded == Some(ticks) })
}

/// The same start run at `reference` quality.
fn reference(path: &Path, world: &World, plan: &Plan) -> Result<Reference, Failure> {
    let mut progress = progress::bar(plan.ticks);
    Reference::record(&Checkpoint::of(world), plan, Workers::default(), &mut progress)
        .map_err(|error| Failure::unwritten(path, error))
}

/// The sound of so many ticks, to be written to a file.
fn track(path: &Path, ticks: u64) -> Result<Track<NewFile>, Failure> {
    Track::begin(output::create(path)?, ticks).map_err(|error| Failure::unwritten(path, error))
}

/// Runs the plan before all that watch it.
fn simulate(
    simulation: &mut Simulation,
    plan: &Plan,
    (sampler, follower, trace): (Option<&mut Sampler>, Option<&mut Follower>, Option<&mut Trace<NewFile>>),
    track: Option<&mut Track<NewFile>>,
    readings: Option<&mut Readings<Sink>>,
) -> io::Result<()> {
    let mut progress = progress::bar(plan.ticks);
    let mut observers: Vec<&mut dyn Observer> = vec![&mut progress];
    observers.extend(sampler.map(|sampler| sampler as &mut dyn Observer));
    observers.extend(follower.map(|follower| follower as &mut dyn Observer));
    observers.extend(trace.map(|trace| trace as &mut dyn Observer));
    observers.extend(track.map(|track| track as &mut dyn Observer));
    observers.extend(readings.map(|readings| readings as &mut dyn Observer));
    lab::run::run(simulation, plan, &mut observers)
}

/// Writes each file that can be; the first that can't is the failure.
fn write_outputs(arguments: &RunArguments, world: &World, metrics: Option<&Metrics>) -> Result<(), Failure> {
    let mut outcome = Ok(());
    if let Some(path) = &arguments.particles {
        outcome = outcome.and(output::write(path, |file| particles::write(world, file)));
    }
    if let Some(path) = &arguments.png {
        let picture = Picture::of_world(world, LONG_SIDE, DISC_RADIUS);
        outcome = outcome.and(output::write(path, |file| picture.write_png(file)));
    }
    if let Some(path) = &arguments.snapshot {
        outcome = outcome.and(output::write(path, |file| file.write_all(&Checkpoint::of(world).encode())));
    }
    if let (Some(path), Some(metrics)) = (&arguments.metrics, metrics) {
        outcome = outcome.and(output::write_json(path, metrics));
    }
    outcome
}
