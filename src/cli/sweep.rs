//! `sweep`: what accuracy costs in a scene, setting by setting.

use crate::{
    cli::{
        args::SweepArguments,
        failure::{self, Failure},
        journal, output, progress,
        start::{Start, Wanted},
    },
    lab::{
        experiment::{
            ExperimentError,
            journal::{Journal, JournalFile, OpenError},
        },
        sweep::{
            ErrorMeasure, Sweep,
            design::{Scope, Setting, other_threads, settings},
            presets::Order,
            row::Row,
            summary::{self, Subject},
            table,
        },
    },
    scene::{KNOBS, Knob, Part},
    sim::{checkpoint::Checkpoint, simulation::Simulation, state::Sources, workers::Workers},
};
use std::{
    fs,
    io::{self, Write},
    num::NonZero,
    path::{Path, PathBuf},
};

/// Ticks that a scene with emitters or wind runs before it is measured, so that they have filled it: 4 s.
const RUN_IN: u64 = 240;

/// Ticks of a run, and of a quick one.
const TICKS: [u64; 2] = [300, 120];

/// Runs of a setting.
const ROUNDS: u64 = 5;

/// Measures the scenes one after the other. With `--check`, presets that are out of order fail it once all are measured.
pub(super) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    check_settings(&arguments.settings)?;
    let length = length(arguments)?;
    // What can be refused is refused before anything is simulated or written, and what can't be written before anything is
    // simulated.
    let SweepArguments { settings, detail, .. } = arguments;
    let wanted = Wanted { settings, detail: *detail, ..Wanted::default() };
    let starts = arguments.scenes.iter().map(|scene| Opening::of(Start::read(scene, wanted.clone())?));
    let starts: Vec<Opening> = starts.collect::<Result<_, Failure>>()?;
    let folders = folders(arguments, &starts)?;
    let journals: Vec<JournalFile> = folders.iter().map(|folder| journal_in(folder)).collect::<Result<_, _>>()?;
    output::note_missing_charts("sweep");
    let program = journal::program();
    let mut disorder = Vec::new();
    for ((start, folder), journal) in starts.into_iter().zip(&folders).zip(journals) {
        let name = start.name.clone();
        let order = measure(arguments, length, &program, start, folder, journal)?;
        disorder.extend(order.complaint().map(|complaint| format!("{name}: {complaint}")));
    }
    if arguments.check && !disorder.is_empty() {
        return Err(Failure::Outcome(disorder.join("; ")));
    }
    Ok(())
}

/// A world before the first tick of the sweep.
struct Opening {
    name: String,
    is_scene: bool,
    simulation: Simulation,
}

impl Opening {
    fn of(start: Start) -> Result<Self, Failure> {
        let Start { checkpoint, is_scene } = start;
        let simulation = Simulation::resume(&checkpoint, Workers::default());
        let opening = Self { name: checkpoint.setup.blueprint.name.clone(), is_scene, simulation };
        opening.checkpoint().map(|_| opening)
    }

    /// The world as it is now, if there is something to measure.
    fn checkpoint(&self) -> Result<Checkpoint, Failure> {
        let checkpoint = Checkpoint::of(self.simulation.world());
        if checkpoint.is_idle() {
            return Err(Failure::Usage(format!(
                "{}: nothing moves in this scene, so there is nothing to measure; allowed: scenes with liquid, moving air, \
                 emitters or wind",
                self.name
            )));
        }
        Ok(checkpoint)
    }

    /// Runs to the moment that all runs set out from.
    fn run_in(&mut self, asked: Option<u64>) -> Result<Checkpoint, Failure> {
        let sources = self.simulation.world().resource::<Sources>();
        let fed = !sources.emitters.is_empty() || !sources.winds.is_empty();
        for _ in 0..asked.unwrap_or(if fed && self.is_scene { RUN_IN } else { 0 }) {
            self.simulation.tick();
        }
        // All that was there may have run out by now.
        self.checkpoint()
    }
}

/// Ticks of a run, and those of them that are left out.
fn length(arguments: &SweepArguments) -> Result<(u64, u64), Failure> {
    let ticks = arguments.ticks.unwrap_or(TICKS[usize::from(arguments.quick)]);
    let warmup = arguments.warmup.unwrap_or((ticks / 5).saturating_sub(1));
    failure::check_warmup(warmup, ticks)?;
    Ok((ticks, warmup))
}

/// Refuses to set what the sweep itself varies.
fn check_settings(settings: &[(String, String)]) -> Result<(), Failure> {
    let is_own = |knob: &Knob| [Part::Solver, Part::Air].contains(&knob.part);
    match settings.iter().find(|(key, _)| Knob::find(key).is_some_and(is_own)) {
        Some((key, value)) => {
            let allowed: Vec<_> = KNOBS.iter().filter(|knob| !is_own(knob)).map(|knob| knob.name).collect();
            let allowed = allowed.join(", ");
            let what = "the sweep turns this knob itself; allowed: parameters of the scene";
            Err(Failure::Usage(format!("--set {key}={value}: {what}, {allowed}")))
        }
        None => Ok(()),
    }
}

/// The folder of each scene, made if it is not there.
fn folders(arguments: &SweepArguments, starts: &[Opening]) -> Result<Vec<PathBuf>, Failure> {
    let names: Vec<&str> = starts.iter().map(|start| start.name.as_str()).collect();
    if let Some(k) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
        return Err(Failure::Usage(format!("the scene {} is named twice; allowed: each scene once", names[k])));
    }
    let folder = |name: &&str| if names.len() == 1 { arguments.out.clone() } else { arguments.out.join(name) };
    let folders: Vec<PathBuf> = names.iter().map(folder).collect();
    for folder in &folders {
        fs::create_dir_all(folder)
            .map_err(|error| Failure::Usage(format!("{}: can't be made a folder: {error}", folder.display())))?;
        let files = [JOURNAL, "curve.csv", "curve.svg", "curve.png", "truth.svg", "truth.png", "summary.md"]
            .map(|name| folder.join(name));
        output::check(&files.each_ref().map(PathBuf::as_path))?;
    }
    Ok(folders)
}

/// The journal in a folder, which no other sweep may write as long as this one runs.
fn journal_in(folder: &Path) -> Result<JournalFile, Failure> {
    let path = folder.join(JOURNAL);
    JournalFile::open(&path).map_err(|error| match error {
        OpenError::InUse => Failure::Usage(format!(
            "{}: {error}, and runs of two at once would disturb each other's times; allowed: to wait for its end, or \
             another --out",
            path.display()
        )),
        OpenError::Io(error) => Failure::unwritten(&path, error),
    })
}

/// The finished runs.
const JOURNAL: &str = "runs.jsonl";

fn measure(
    arguments: &SweepArguments,
    (ticks, warmup): (u64, u64),
    program: &str,
    mut start: Opening,
    folder: &Path,
    file: JournalFile,
) -> Result<Order, Failure> {
    let line = progress::status();
    line.set_message(format!("{}: to the moment that is measured", start.name));
    let checkpoint = start.run_in(arguments.start)?;
    drop(line);
    let Opening { name: scene, simulation, .. } = start;
    // The run-in's world is not needed any more.
    drop(simulation);
    let measure = ErrorMeasure::of(&checkpoint);
    let threads = arguments.threads as usize;
    let scope = Scope {
        measure,
        has_air: checkpoint.has_air(),
        threads,
        other_threads: other_threads(threads, std::thread::available_parallelism().map_or(1, NonZero::get)),
        quick: arguments.quick,
        only: arguments.only.clone(),
    };
    let rounds = arguments.repeat.unwrap_or(if arguments.quick { 1 } else { ROUNDS }) as u32;
    let own = |(k, _): &(u64, Setting)| arguments.shard.is_none_or(|shard| shard.has(*k));
    let settings = (0..).zip(settings(&scope)).filter(own).map(|(_, setting)| setting).collect();
    let sweep = Sweep { start: &checkpoint, measure, settings, ticks, warmup, rounds };
    let path = folder.join(JOURNAL);
    let unwritten = |error: io::Error| Failure::unwritten(&path, error);
    let mut journal = Journal::read(file, sweep.campaign(program)).map_err(unwritten)?;
    let line = progress::bar(sweep.runs() as u64).with_prefix(format!("{scene} "));
    let rows = sweep.run(&mut journal, &mut |done, what| {
        line.set_position(done as u64);
        line.set_message(what.to_owned());
    });
    let rows = rows.map_err(|error| match error {
        ExperimentError::Journal(error) => unwritten(error),
        error => Failure::Outcome(format!("{scene}: {error}")),
    })?;
    drop(line);
    let parameters = checkpoint.setup.blueprint.parameters.iter();
    let parameters: String = parameters.map(|(name, value)| format!(", {name} {value}")).collect();
    let subject = Subject {
        scene: &scene,
        parameters: &parameters,
        measure,
        has_air: checkpoint.has_air(),
        start: checkpoint.state.clock.tick,
        ticks,
        warmup,
        threads,
    };
    write(folder, &subject, &rows)?;
    Ok(subject.order(&rows))
}

fn write(folder: &Path, subject: &Subject, rows: &[Row]) -> Result<(), Failure> {
    let summary = summary::text(subject, rows);
    output::write(&folder.join("curve.csv"), |file| table::write(rows, file))?;
    output::write(&folder.join("summary.md"), |file| file.write_all(summary.as_bytes()))?;
    #[cfg(feature = "charts")]
    {
        use crate::lab::sweep::draw;
        let mut charts = vec![("curve", draw::chart(subject, rows))];
        if rows.iter().any(|row| row.true_error().is_some()) {
            charts.push(("truth", draw::chart_of_truth(subject, rows)));
        }
        for (name, chart) in charts {
            output::write(&folder.join(name).with_extension("svg"), |file| file.write_all(chart.svg()?.as_bytes()))?;
            output::write(&folder.join(name).with_extension("png"), |file| chart.write_png(file, 2))?;
        }
    }
    output::print(&summary)
}
