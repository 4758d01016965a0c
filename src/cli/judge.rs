//! `exam`: physics against known answers. `gauntlet`: hard cases stay stable.

use crate::{
    cli::{args::CaseArguments, failure::Failure, output::Outputs, progress},
    kernel::params::Preset,
    lab::{
        cases::{
            Case, Figures, Row, Shard, Size, Verdict, about_detail, document, failure, jobs, run_all, summary, table,
        },
        machine::processor,
    },
};
use serde_json::json;
use std::{path::PathBuf, thread::available_parallelism};

/// Rows and what made them.
pub(super) struct Outcome<C: Case> {
    /// What was asked for: cases, qualities, detail.
    pub run: String,
    /// Which part of it this is, if it is not all.
    pub shard: Option<Shard>,
    /// Qualities that were asked for.
    pub presets: Vec<Preset>,
    /// Detail that was asked for.
    pub detail: f64,
    /// The processor that it ran on.
    pub processor: String,
    /// Runs at a time.
    pub threads: usize,
    /// What came of it.
    pub rows: Vec<Row<C::Figures>>,
}

/// Runs the cases of a suite and prints their rows. A case that fails fails the command; where it is `timed`, one that takes too
/// long does, too.
pub(super) fn judge<C: Case>(arguments: &CaseArguments<C>, timed: bool) -> Result<(), Failure> {
    let CaseArguments { json, markdown, detail, shard, .. } = arguments;
    let outputs = Outputs::new(json.as_deref(), markdown.as_deref())?;
    let threads = threads(arguments);
    let presets = arguments.presets();
    let jobs = jobs((C::SUITE.cases)(), |case| arguments.wants(case), &presets, *detail);
    let own = |(k, _): &(u64, _)| shard.is_none_or(|shard| shard.has(*k));
    let jobs: Vec<_> = (0..).zip(jobs).filter(own).map(|(_, job)| job).collect();
    let bar = progress::bar(jobs.len() as u64);
    let mut rows = run_all(&jobs, threads, |done, job| {
        bar.set_position(done as u64);
        bar.set_message(job.title());
    })?;
    drop(bar);
    for row in rows.iter_mut().filter(|_| timed) {
        if row.figures.count_time() {
            row.verdict = Verdict::Fail;
        }
    }
    let run = arguments.run();
    let outcome = Outcome::<C> { run, shard: *shard, presets, detail: *detail, processor: processor(), threads, rows };
    outcome.write(&outputs, &arguments.command(timed))
}

/// Runs at a time.
pub(super) fn threads<C: Case>(arguments: &CaseArguments<C>) -> usize {
    arguments.threads.map_or_else(|| available_parallelism().map_or(1, usize::from), |n| n as usize)
}

impl<C: Case> Outcome<C> {
    /// Writes and prints it; a case that failed is the failure of the command.
    pub(super) fn write(&self, outputs: &Outputs<'_>, command: &str) -> Result<(), Failure> {
        let Self { run, shard, presets, detail, processor, threads, rows } = self;
        let presets: Vec<&str> = presets.iter().map(|preset| preset.name()).collect();
        let value = || {
            json!({
                "kind": C::SUITE.command, "run": run, "shard": shard, "qualities": presets, "processor": processor,
                "threads": threads, "detail": detail, "rows": rows,
            })
        };
        let head = about_detail(*detail).map_or_else(String::new, |text| format!("{text}\n\n"));
        let text = || format!("{head}{}\n{}\n", table::<C>(rows), summary::<C>(rows));
        outputs.write(value, || document::<C>(rows, processor, command, *detail), text)?;
        failure::<C>(rows).map_or(Ok(()), |failure| Err(Failure::Outcome(failure)))
    }
}

impl<C: Case> CaseArguments<C> {
    /// Whether a case is wanted: one that is named, or where none is, any; with `--quick` one that is quick.
    fn wants(&self, case: &C) -> bool {
        let about = case.about();
        match self.cases.as_slice() {
            [] => about.size <= if self.quick { Size::Quick } else { Size::Long },
            named => named.iter().any(|case| case.about().name == about.name),
        }
    }

    /// The qualities that were asked for, in their order; none means all, or with `quick` `balanced`.
    pub(super) fn presets(&self) -> Vec<Preset> {
        let default = if self.quick { &[Preset::Balanced][..] } else { &Preset::ALL[..] };
        let asked = if self.qualities.is_empty() { default } else { &self.qualities };
        Preset::ALL.into_iter().filter(|preset| asked.contains(preset)).collect()
    }

    /// What is run, as the command that runs all of it.
    fn run(&self) -> String {
        let mut words = Words::new(C::SUITE.command);
        self.say_run(&mut words);
        words.text()
    }

    /// What is run, as options.
    pub(super) fn say_run(&self, words: &mut Words) {
        self.cases.iter().for_each(|case| words.option("--case", case.about().name));
        self.qualities.iter().for_each(|quality| words.option("--quality", quality.name()));
        if self.detail != 1.0 {
            words.option("--detail", &self.detail.to_string());
        }
    }

    /// The command that was given, with its options, to be written where its results are.
    fn command(&self, timed: bool) -> String {
        let mut words = Words::new(C::SUITE.command);
        self.say_run(&mut words);
        self.say_rest(&mut words);
        if self.quick {
            words.flag("--quick");
        }
        if timed {
            words.flag("--timed");
        }
        words.text()
    }

    /// How it is run, and where its results go.
    pub(super) fn say_rest(&self, words: &mut Words) {
        let path = |file: &Option<PathBuf>| file.as_ref().map(|path| path.display().to_string());
        for (name, value) in [
            ("--threads", self.threads.map(|threads| threads.to_string())),
            ("--shard", self.shard.map(|shard| shard.to_string())),
            ("--json", path(&self.json)),
            ("--markdown", path(&self.markdown)),
        ] {
            value.iter().for_each(|value| words.option(name, value));
        }
    }
}

/// The words of a command.
pub(super) struct Words(Vec<String>);

impl Words {
    /// Of a command of the program.
    pub(super) fn new(command: &str) -> Self {
        Self(vec!["powder-master".to_owned(), command.to_owned()])
    }

    /// Adds an option with its value.
    pub(super) fn option(&mut self, name: &str, value: &str) {
        self.flag(name);
        self.word(value);
    }

    /// Adds an option without a value.
    pub(super) fn flag(&mut self, name: &str) {
        self.0.push(name.to_owned());
    }

    /// Adds a value.
    pub(super) fn word(&mut self, value: &str) {
        // What a shell would take apart stands in quotes.
        let is_plain = value.chars().all(|char| char.is_alphanumeric() || "-_./,+=:@".contains(char));
        self.0.push(if is_plain { value.to_owned() } else { format!("'{}'", value.replace('\'', r"'\''")) });
    }

    /// The command.
    pub(super) fn text(&self) -> String {
        self.0.join(" ")
    }
}
