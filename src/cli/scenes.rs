//! `gauntlet --scenes`: each scene of the gallery for some minutes at each quality, under a player by script.

use crate::{
    cli::{
        args::GauntletArguments,
        failure::Failure,
        journal,
        judge::{Words, threads},
        output::{self, Outputs},
        progress,
    },
    lab::{
        experiment::journal::{Journal, JournalFile, OpenError},
        machine::processor,
        soak::gallery::{Plan, Row, Tally, run},
    },
    scene,
    sim::fault,
};
use serde_json::json;
use std::path::Path;

/// Random choices of the player, unless others are asked for: those of `soak`.
const SEED: u64 = 1;

/// What the JSON of the scenes says that it is.
pub(super) const KIND: &str = "scenes gauntlet";

/// Soaks the scenes that are named, or all, and prints what came of each. One that is not sound fails the command.
pub(super) fn scenes(arguments: &GauntletArguments, named: &[&'static str]) -> Result<(), Failure> {
    let GauntletArguments { cases, seed, minutes, journal, .. } = arguments;
    let (json, markdown, journal) = (cases.json.as_deref(), cases.markdown.as_deref(), journal.as_deref());
    output::check(&[json, markdown, journal].into_iter().flatten().collect::<Vec<_>>())?;
    let outputs = Outputs::new(json, markdown)?;
    let (seed, detail, shard) = (seed.unwrap_or(SEED), cases.detail, cases.shard);
    let is_wanted = |scene: &&str| named.is_empty() || named.contains(scene);
    let scenes = scene::builtin_names().into_iter().filter(is_wanted).collect();
    let (presets, threads) = (cases.presets(), threads(cases));
    let plan = Plan { scenes, minutes: *minutes, seed, detail, presets, shard, threads };
    let jobs = plan.jobs()?;
    let kept = journal.map(|path| open(path, &plan)).transpose()?;
    // A panic is told with what else is not sound.
    fault::watch(false);
    let bar = progress::bar(jobs.len() as u64);
    let (tally, kept) = run(&plan, &jobs, kept, |done, job| {
        bar.set_position(done as u64);
        bar.set_message(job.title());
    })?;
    drop(bar);
    let written = write(&tally, &outputs, &command(arguments, named), &processor(), plan.threads);
    written.and(kept.map_err(|error| Failure::unwritten(journal.unwrap_or(Path::new("")), error)))
}

/// The journal at a path, with what it has of the plan's scenes.
fn open(path: &Path, plan: &Plan) -> Result<Journal<Row>, Failure> {
    let bad = |what: &str| Failure::Usage(format!("{}: {what}", path.display()));
    let mut file = JournalFile::open(path).map_err(|error| match error {
        OpenError::InUse => bad("another run writes here; allowed: to wait for its end, or another file"),
        OpenError::Io(error) => Failure::unwritten(path, error),
    })?;
    let unwritten = |error| Failure::unwritten(path, error);
    if file.is_foreign().map_err(unwritten)? {
        return Err(bad("is no journal of `gauntlet --scenes`; allowed: one, or a file that is not there yet"));
    }
    Journal::read(file, plan.campaign(&journal::program())).map_err(unwritten)
}

/// Writes and prints what came of the scenes; one that is not sound is the failure of the command.
pub(super) fn write(
    tally: &Tally,
    outputs: &Outputs<'_>,
    command: &str,
    processor: &str,
    threads: usize,
) -> Result<(), Failure> {
    let value = || json!({ "kind": KIND, "processor": processor, "threads": threads, "tally": tally });
    let text = || {
        let failed: String = tally.failed().into_iter().map(|line| line + "\n").collect();
        let end = if failed.is_empty() { "" } else { "\n" };
        format!("{}\n{failed}{end}{}\n", tally.table(), tally.summary())
    };
    outputs.write(value, || tally.document(command, processor), text)?;
    tally.failure().map_or(Ok(()), |failure| Err(Failure::Outcome(failure)))
}

/// The command that was given, with its options.
fn command(arguments: &GauntletArguments, named: &[&str]) -> String {
    let GauntletArguments { cases, seed, minutes, journal, .. } = arguments;
    let mut words = Words::new("gauntlet");
    words.flag("--scenes");
    named.iter().for_each(|scene| words.word(scene));
    words.option("--minutes", &minutes.to_string());
    seed.iter().for_each(|seed| words.option("--seed", &seed.to_string()));
    cases.say_run(&mut words);
    cases.say_rest(&mut words);
    journal.iter().for_each(|path| words.option("--journal", &path.display().to_string()));
    words.text()
}
