//! `sweep`: what accuracy costs in a scene, setting by setting.

use crate::{
    cli::{
        args::SweepArguments,
        failure::Failure,
        output,
        progress::{StatusLine, bar},
        start::Start,
    },
    kernel::simd::InstructionSet,
    lab::{
        headless::Headless,
        moment::Moment,
        sweep::{
            ErrorMeasure, Progress, Sweep, SweepError,
            design::{Scope, other_threads, settings},
            draw,
            journal::Journal,
            row::Row,
            summary::{self, Subject},
            table,
        },
    },
    scene::{KNOBS, WORD_KNOBS},
    sim::{snapshot::hash_bytes, state::Sources, workers::Workers},
};
use bevy::platform::time::Instant;
use std::{
    fs,
    io::{self, Write},
    num::NonZero,
    path::{Path, PathBuf},
};

/// Ticks that a scene with taps or fans runs before it is measured, so that they have filled it: 4 s.
const RUN_IN: u64 = 240;

/// Ticks of a run, and of a quick one.
const TICKS: [u64; 2] = [300, 120];

/// Runs of a setting.
const ROUNDS: u64 = 3;

/// Measures the scenes one after the other.
pub(super) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    check_settings(&arguments.settings)?;
    let length = length(arguments)?;
    // All is read before anything is simulated.
    let starts: Vec<Start> =
        (arguments.scenes.iter()).map(|scene| Start::of_sweep(scene, &arguments.settings)).collect::<Result<_, _>>()?;
    let folders = folders(arguments, &starts)?;
    let program = program();
    for (start, folder) in starts.into_iter().zip(folders) {
        measure(arguments, length, &program, start, &folder)?;
    }
    Ok(())
}

/// Ticks of a run, and those of them that are left out.
#[derive(Clone, Copy)]
struct Length {
    ticks: u64,
    warmup: u64,
}

fn length(arguments: &SweepArguments) -> Result<Length, Failure> {
    let ticks = arguments.ticks.unwrap_or(TICKS[usize::from(arguments.quick)]);
    let warmup = arguments.warmup.unwrap_or((ticks / 5).saturating_sub(1));
    if warmup < ticks {
        return Ok(Length { ticks, warmup });
    }
    let most = ticks - 1;
    Err(Failure::Usage(format!("--warmup {warmup} leaves nothing of the {ticks} ticks; allowed: 0 to {most}")))
}

/// Refuses to set what the sweep itself varies.
fn check_settings(settings: &[(String, String)]) -> Result<(), Failure> {
    let of_liquid = ["rest_density", "relaxation", "constraint_floor", "tension_strength", "tension_distance"];
    let own = |key: &str| {
        let is_knob = KNOBS.iter().any(|knob| knob.name == key) || WORD_KNOBS.iter().any(|knob| knob.name == key);
        is_knob && !of_liquid.contains(&key) && key != "particle_limit"
    };
    match settings.iter().find(|(key, _)| own(key)) {
        Some((key, value)) => Err(Failure::Usage(format!(
            "--set {key}={value}: the sweep turns this knob itself; allowed: parameters of the scene, {}, particle_limit",
            of_liquid.join(", ")
        ))),
        None => Ok(()),
    }
}

/// The folder of each scene, made if it is not there.
fn folders(arguments: &SweepArguments, starts: &[Start]) -> Result<Vec<PathBuf>, Failure> {
    let names: Vec<&str> = starts.iter().map(Start::name).collect();
    if let Some(k) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
        return Err(Failure::Usage(format!("the scene {} is named twice; allowed: each scene once", names[k])));
    }
    let folder = |name: &&str| if names.len() == 1 { arguments.out.clone() } else { arguments.out.join(name) };
    let folders: Vec<PathBuf> = names.iter().map(folder).collect();
    for folder in &folders {
        fs::create_dir_all(folder)
            .map_err(|error| Failure::Usage(format!("{}: can't be made a folder: {error}", folder.display())))?;
        let files = [JOURNAL, "curve.csv", "curve.svg", "curve.png", "summary.md"].map(|name| folder.join(name));
        output::check(&files.each_ref().map(PathBuf::as_path))?;
    }
    Ok(folders)
}

/// Pixels of the PNG for each of the SVG's.
const PNG_SCALE: f32 = 2.0;

/// The finished runs.
const JOURNAL: &str = "runs.jsonl";

/// What the journal knows this build by: results of another are not mixed with its own.
fn program() -> String {
    let build = std::env::current_exe().and_then(fs::read).map_or(0, |bytes| hash_bytes(&bytes));
    format!("{} {build:016x}", env!("CARGO_PKG_VERSION"))
}

fn measure(
    arguments: &SweepArguments,
    Length { ticks, warmup }: Length,
    program: &str,
    start: Start,
    folder: &Path,
) -> Result<(), Failure> {
    let scene = start.name().to_owned();
    let line = StatusLine::new();
    line.say(&format!("{scene}: to the moment that is measured"));
    let (moment, run_in) = moment(arguments, start)?;
    let measure = ErrorMeasure::of(&moment);
    let threads = arguments.threads as usize;
    let scope = Scope {
        measure,
        has_air: moment.has_air(),
        threads,
        other_threads: other_threads(threads, std::thread::available_parallelism().map_or(1, NonZero::get)),
        quick: arguments.quick,
        only: arguments.only.clone(),
    };
    let rounds = arguments.repeat.unwrap_or(if arguments.quick { 1 } else { ROUNDS }) as u32;
    let sweep = Sweep { moment: &moment, measure, settings: settings(&scope), ticks, warmup, rounds };
    let path = folder.join(JOURNAL);
    let mut journal =
        Journal::open(&path, sweep.campaign(program)).map_err(|error| Failure::unwritten(&path, &error))?;
    let mut pace = Pace { begun: Instant::now(), before: None };
    let rows = sweep.run(&mut journal, &mut |progress| line.say(&pace.text(&scene, progress)));
    let rows = rows.map_err(|error| match error {
        SweepError::Journal(error) => Failure::unwritten(&path, &error),
        error => Failure::Outcome(format!("{scene}: {error}")),
    })?;
    drop(line);
    let parameters: Vec<String> =
        moment.blueprint().parameters.iter().map(|(name, value)| format!(", {name} {value}")).collect();
    let subject = Subject {
        scene: &scene,
        parameters: &parameters.concat(),
        measure,
        has_air: moment.has_air(),
        start: run_in,
        ticks,
        warmup,
        threads,
    };
    write(folder, &subject, &rows)
}

/// The moment that all runs set out from, and the ticks that lie before it.
fn moment(arguments: &SweepArguments, start: Start) -> Result<(Moment, u64), Failure> {
    let name = start.name().to_owned();
    let is_scene = start.is_scene();
    let mut headless = Headless::begin(Workers::default(), |world| start.load(world, InstructionSet::detect()));
    let sources = headless.world().resource::<Sources>();
    let fed = !sources.emitters.is_empty() || !sources.winds.is_empty();
    let run_in = arguments.start.unwrap_or(if fed && is_scene { RUN_IN } else { 0 });
    for _ in 0..run_in {
        headless.tick();
    }
    let moment = Moment::of(headless.world());
    if moment.is_idle() {
        return Err(Failure::Usage(format!(
            "{name}: nothing moves in this scene, so there is nothing to measure; allowed: scenes with liquid, moving \
             air, taps or fans"
        )));
    }
    Ok((moment, run_in))
}

/// Knows how long the rest will take.
struct Pace {
    begun: Instant,
    /// Runs that were done when it began.
    before: Option<usize>,
}

impl Pace {
    fn text(&mut self, scene: &str, Progress { done, runs, what }: Progress) -> String {
        let before = *self.before.get_or_insert(done);
        let per_run = self.begun.elapsed().as_secs_f64() / (done - before).max(1) as f64;
        let left = match (per_run * (runs - done) as f64).round() {
            _ if done == before => String::new(),
            seconds if seconds < 100.0 => format!("  {seconds} s left"),
            seconds => format!("  {:.0} min left", seconds / 60.0),
        };
        format!("{scene} {} {done} of {runs}{left}  {what}", bar(done, runs))
    }
}

fn write(folder: &Path, subject: &Subject, rows: &[Row]) -> Result<(), Failure> {
    let summary = summary::text(subject, rows);
    output::write(&folder.join("curve.csv"), |file| table::write(rows, file))?;
    output::write(&folder.join("summary.md"), |file| file.write_all(summary.as_bytes()))?;
    let chart = draw::chart(subject, rows);
    output::write(&folder.join("curve.svg"), |file| file.write_all(chart.svg().as_bytes()))?;
    output::write(&folder.join("curve.png"), |file| chart.write_png(file, PNG_SCALE).map_err(io::Error::other))?;
    output::print(&summary)
}
