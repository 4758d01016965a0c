//! `merge`: the JSON of all shards of a run becomes that of the run.

use crate::{
    cli::{
        args::MergeArguments,
        failure::Failure,
        judge::{Outcome, Words},
        output::Outputs,
        random, scenes,
    },
    kernel::params::Preset,
    lab::{
        cases::{Case, Shard, read_rows},
        exam::ExamCase,
        gauntlet::{GauntletCase, random::Tally},
        soak,
    },
};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::{fs, path::Path};

/// Merges the files and writes what one run would have written. What failed in a shard fails the merged run.
pub(super) fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    let MergeArguments { files, json, markdown } = arguments;
    let outputs = Outputs::new(json.as_deref(), markdown.as_deref())?;
    let parts: Vec<Part> = files.iter().map(|path| Part::read(path)).collect::<Result<_, _>>()?;
    let mut words = Words::new("merge");
    files.iter().for_each(|path| words.word(&path.display().to_string()));
    let command = words.text();
    let kind: String = parts[0].field("kind")?;
    if let Some(other) = parts.iter().find(|part| part.value["kind"] != kind.as_str()) {
        return Err(other.bad(&format!("is not of a {kind}, as {} is; allowed: shards of one run", parts[0].name)));
    }
    match kind.as_str() {
        random::KIND => {
            let tallies = parts.iter().map(|part| part.field("tally")).collect::<Result<_, _>>()?;
            let (processor, threads) = machine(&parts)?;
            random::write(&Tally::merge(tallies).map_err(refused)?, &outputs, &command, &processor, threads)
        }
        scenes::KIND => {
            let tallies = parts.iter().map(|part| part.field("tally")).collect::<Result<_, _>>()?;
            let (processor, threads) = machine(&parts)?;
            scenes::write(
                &soak::gallery::Tally::merge(tallies).map_err(refused)?,
                &outputs,
                &command,
                &processor,
                threads,
            )
        }
        kind if kind == ExamCase::SUITE.command => merge_rows::<ExamCase>(&parts)?.write(&outputs, &command),
        kind if kind == GauntletCase::SUITE.command => merge_rows::<GauntletCase>(&parts)?.write(&outputs, &command),
        _ => {
            Err(parts[0].bad("is nothing that can be merged; allowed: what `exam --json` or `gauntlet --json` writes"))
        }
    }
}

fn refused(what: String) -> Failure {
    Failure::Usage(what)
}

/// A file that was read.
struct Part {
    name: String,
    value: Value,
}

impl Part {
    fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let bad = |what: String| Failure::Usage(format!("{name}: {what}"));
        let bytes = fs::read(path).map_err(|error| bad(format!("can't be read: {error}")))?;
        let value = serde_json::from_slice(&bytes)
            .map_err(|error| bad(format!("{error}; allowed: the JSON that a shard wrote")))?;
        Ok(Self { name, value })
    }

    fn bad(&self, what: &str) -> Failure {
        Failure::Usage(format!("{}: {what}", self.name))
    }

    fn field<T: DeserializeOwned>(&self, key: &str) -> Result<T, Failure> {
        T::deserialize(&self.value[key])
            .map_err(|error| self.bad(&format!("`{key}`: {error}; allowed: the JSON that a shard wrote")))
    }
}

/// The processor and the threads of all parts; where they differ, all processors.
fn machine(parts: &[Part]) -> Result<(String, usize), Failure> {
    let mut processors: Vec<String> = parts.iter().map(|part| part.field("processor")).collect::<Result<_, _>>()?;
    processors.sort_unstable();
    processors.dedup();
    Ok((processors.join("; "), parts[0].field("threads")?))
}

fn merge_rows<C: Case>(parts: &[Part]) -> Result<Outcome<C>, Failure> {
    let shards: Vec<Option<Shard>> = parts.iter().map(|part| part.field("shard")).collect::<Result<_, _>>()?;
    Shard::check_complete(shards).map_err(refused)?;
    let first = &parts[0];
    let (run, qualities, detail): (String, Vec<String>, f64) =
        (first.field("run")?, first.field("qualities")?, first.field("detail")?);
    let mut rows = Vec::new();
    for part in parts {
        if part.value["run"] != run.as_str() || part.value["qualities"] != first.value["qualities"] {
            return Err(part.bad(&format!("is not of `{run}`, as {} is; allowed: shards of one run", first.name)));
        }
        rows.extend(part.field::<Vec<Value>>("rows")?);
    }
    let presets: Option<Vec<Preset>> = qualities.iter().map(|name| Preset::find(name)).collect();
    let presets = presets.ok_or_else(|| first.bad("`qualities`: allowed: names of `list qualities`"))?;
    let rows = read_rows::<C>(rows, &presets, detail).map_err(|what| first.bad(&what))?;
    let (processor, threads) = machine(parts)?;
    Ok(Outcome { run, shard: None, presets, detail, processor, threads, rows })
}
