//! `exam`: physics against known answers. `gauntlet`: hard cases stay stable.

use crate::{
    cli::{args::CaseArguments, failure::Failure, output, progress},
    kernel::params::Preset,
    lab::{
        cases::{Case, Size, about_detail, document, failure, jobs, run_all, summary, table},
        machine::processor,
    },
};
use serde_json::json;
use std::{io::Write, path::PathBuf, thread::available_parallelism};

/// Runs the cases of a suite and prints their rows. A case that fails fails the command.
pub(super) fn judge<C: Case>(arguments: &CaseArguments<C>) -> Result<(), Failure> {
    let CaseArguments { json, markdown, detail, .. } = arguments;
    let [json, markdown] = [json, markdown].map(Option::as_deref);
    if [json, markdown].into_iter().all(output::is_stdout) {
        return Err(Failure::Usage("--json and --markdown can't both have stdout; allowed: a file for one".into()));
    }
    output::check(&[json, markdown].into_iter().flatten().collect::<Vec<_>>())?;
    let threads = arguments.threads.map_or_else(|| available_parallelism().map_or(1, usize::from), |n| n as usize);
    let jobs = jobs((C::SUITE.cases)(), |case| arguments.wants(case), &arguments.presets(), *detail);
    let bar = progress::bar(jobs.len() as u64);
    let rows = run_all(&jobs, threads, |done, job| {
        bar.set_position(done as u64);
        bar.set_message(job.title());
    })?;
    drop(bar);
    let mut printed = None;
    if let Some(path) = markdown {
        let text = document::<C>(&rows, &processor(), &arguments.command(), *detail);
        if output::is_stdout(markdown) {
            printed = Some(text);
        } else {
            output::write(path, |file| file.write_all(text.as_bytes()))?;
        }
    }
    let value = || json!({ "processor": processor(), "threads": threads, "detail": detail, "rows": rows });
    let head = about_detail(*detail).map_or_else(String::new, |text| format!("{text}\n\n"));
    let text = || printed.unwrap_or_else(|| format!("{head}{}\n{}\n", table::<C>(&rows), summary::<C>(&rows)));
    output::report(json, value, text)?;
    failure::<C>(&rows).map_or(Ok(()), |failure| Err(Failure::Outcome(failure)))
}

impl<C: Case> CaseArguments<C> {
    /// Whether a case is wanted: one that is named, or where none is, any; with `--quick` one that is quick.
    fn wants(&self, case: &C) -> bool {
        let about = case.about();
        match self.cases.as_slice() {
            [] => about.size == Size::Quick || !self.quick,
            named => named.iter().any(|case| case.about().name == about.name),
        }
    }

    /// The qualities that were asked for, in their order; none means all, or with `quick` `balanced`.
    fn presets(&self) -> Vec<Preset> {
        let default = if self.quick { &[Preset::Balanced][..] } else { &Preset::ALL[..] };
        let asked = if self.qualities.is_empty() { default } else { &self.qualities };
        Preset::ALL.into_iter().filter(|preset| asked.contains(preset)).collect()
    }

    /// The command that was given, with its options, to be written where its results are.
    fn command(&self) -> String {
        let mut words = vec!["powder-master".to_owned(), C::SUITE.command.to_owned()];
        let mut option = |name: &str, value: &str| {
            words.push(name.to_owned());
            // What a shell would take apart stands in quotes.
            let is_plain = value.chars().all(|char| char.is_alphanumeric() || "-_./,+=:@".contains(char));
            words.push(if is_plain { value.to_owned() } else { format!("'{}'", value.replace('\'', r"'\''")) });
        };
        let path = |file: &Option<PathBuf>| file.as_ref().map(|path| path.display().to_string());
        self.cases.iter().for_each(|case| option("--case", case.about().name));
        self.qualities.iter().for_each(|quality| option("--quality", quality.name()));
        let detail = (self.detail != 1.0).then(|| self.detail.to_string());
        let threads = self.threads.map(|threads| threads.to_string());
        for (name, value) in [
            ("--detail", detail),
            ("--threads", threads),
            ("--json", path(&self.json)),
            ("--markdown", path(&self.markdown)),
        ] {
            value.iter().for_each(|value| option(name, value));
        }
        if self.quick {
            words.push("--quick".to_owned());
        }
        words.join(" ")
    }
}
