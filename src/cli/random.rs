//! `gauntlet --random`: worlds that nobody thought of, judged by every rule.

use crate::{
    cli::{
        args::GauntletArguments,
        failure::Failure,
        judge::{Words, threads},
        output::Outputs,
        progress,
    },
    lab::{
        gauntlet::random::{Plan, Tally, run},
        machine::processor,
    },
};
use serde_json::json;
use std::{
    path::{Path, PathBuf},
    time::{SystemTime, UNIX_EPOCH},
};

/// Folder of what fails, unless another is asked for.
const FOLDER: &str = "found";

/// Seeds that are made up: nine digits can be typed.
const SEEDS: u128 = 1_000_000_000;

/// Judges `count` random worlds and prints the worst of each rule. A world that breaks one is kept, and fails the command.
pub(super) fn random(arguments: &GauntletArguments, count: u64) -> Result<(), Failure> {
    let GauntletArguments { cases, seed, keep, .. } = arguments;
    let outputs = Outputs::new(cases.json.as_deref(), cases.markdown.as_deref())?;
    if let (Some(shard), None) = (cases.shard, seed) {
        let what = "each shard would have worlds of its own";
        return Err(Failure::Usage(format!(
            "--shard {shard} without --seed: {what}; allowed: the same --seed for all"
        )));
    }
    let folder = keep.clone().unwrap_or_else(|| PathBuf::from(FOLDER));
    check_folder(&folder)?;
    let seed = seed.unwrap_or_else(fresh);
    let plan = Plan { seed, count, presets: cases.presets(), shard: cases.shard, threads: threads(cases) };
    let bar = progress::bar(plan.worlds().len() as u64);
    let tally = run(&plan, &folder, |done, index| {
        bar.set_position(done as u64);
        bar.set_message(format!("world {seed}/{index}"));
    });
    drop(bar);
    let tally = tally.map_err(|error| Failure::unwritten(&folder, error))?;
    write(&tally, &outputs, &command(arguments, count, seed), &processor(), plan.threads)
}

/// Writes and prints what came of random worlds; one that failed is the failure of the command.
pub(super) fn write(
    tally: &Tally,
    outputs: &Outputs<'_>,
    command: &str,
    processor: &str,
    threads: usize,
) -> Result<(), Failure> {
    let value = || json!({ "kind": KIND, "processor": processor, "threads": threads, "tally": tally });
    let text = || {
        let lines = |lines: Vec<String>| lines.into_iter().map(|line| line + "\n").collect::<String>();
        let (table, failed, notes) = (tally.table(), lines(tally.failed()), lines(tally.notes()));
        format!("{table}\n{failed}{}{notes}\n{}\n", if failed.is_empty() { "" } else { "\n" }, tally.summary())
    };
    outputs.write(value, || tally.document(command, processor), text)?;
    tally.failure().map_or(Ok(()), |failure| Err(Failure::Outcome(failure)))
}

/// What the JSON of random worlds says that it is.
pub(super) const KIND: &str = "random gauntlet";

/// Refuses a folder that can't be one.
fn check_folder(folder: &Path) -> Result<(), Failure> {
    let bad = |what: &str| {
        Err(Failure::Usage(format!("--keep {}: {what}; allowed: a folder, there or not", folder.display())))
    };
    match folder {
        _ if folder.as_os_str().is_empty() => bad("an empty path"),
        _ if folder.exists() && !folder.is_dir() => bad("is a file"),
        _ => Ok(()),
    }
}

/// A seed that nobody has chosen.
fn fresh() -> u64 {
    // A clock before 1970 gives the same seed each time, which is printed all the same.
    let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
    (now.as_micros() % SEEDS) as u64
}

/// The command that gives the same again.
fn command(arguments: &GauntletArguments, count: u64, seed: u64) -> String {
    let mut words = Words::new("gauntlet");
    words.option("--random", &count.to_string());
    words.option("--seed", &seed.to_string());
    arguments.cases.qualities.iter().for_each(|quality| words.option("--quality", quality.name()));
    arguments.cases.say_rest(&mut words);
    arguments.keep.iter().for_each(|folder| words.option("--keep", &folder.display().to_string()));
    words.text()
}
