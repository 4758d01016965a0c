//! `exam`: physics against known answers.

use crate::{
    cli::{
        args::ExamArguments,
        failure::Failure,
        output::{self, STDOUT},
        progress::StatusLine,
    },
    kernel::params::Preset,
    lab::{
        exam::{CASES, Case, document, jobs, sit_all, summary, table},
        machine::processor,
    },
    sim::exam::{Row, Verdict},
};
use serde_json::json;
use std::{io::Write, path::Path, sync::Mutex, thread::available_parallelism};

/// Sits the exam and prints its rows. Rows at `balanced` or better that are beyond their tolerance fail it.
pub(super) fn exam(arguments: &ExamArguments) -> Result<(), Failure> {
    let files = [&arguments.json, &arguments.markdown].map(|file| file.as_deref());
    let to_stdout = files.map(|file| file == Some(Path::new(STDOUT)));
    if to_stdout == [true, true] {
        return Err(Failure::Usage("--json and --markdown can't both have stdout; allowed: a file for one".into()));
    }
    let on_disk: Vec<&Path> = files.into_iter().flatten().filter(|file| *file != Path::new(STDOUT)).collect();
    output::check(&on_disk)?;
    let presets = presets(arguments);
    let wanted = |case: &Case| match arguments.cases.is_empty() {
        true => case.quick || !arguments.quick,
        false => arguments.cases.iter().any(|name| name == case.name),
    };
    let jobs = jobs(CASES, wanted, &presets);
    let threads = arguments.threads.map_or_else(|| available_parallelism().map_or(1, usize::from), |n| n as usize);
    let line = Mutex::new(StatusLine::new());
    let rows = sit_all(&jobs, threads, |done, of, job| {
        if let Ok(line) = line.lock() {
            line.say(&format!("{:3} %  {done} of {of}, {}", 100 * done / of, job.title()));
        }
    })?;
    drop(line);
    if let Some(path) = files[0] {
        output::write_json(path, &json!({ "processor": processor(), "threads": threads, "rows": rows }))?;
    }
    if let Some(path) = files[1] {
        let text = document(&rows, &processor(), "powder-master exam --markdown docs/exam.md");
        if to_stdout[1] { output::print(&text)? } else { output::write(path, |file| file.write_all(text.as_bytes()))? }
    }
    if !to_stdout.contains(&true) {
        output::print(&format!("{}\n{}\n", table(&rows), summary(&rows)))?;
    }
    verdict(&rows)
}

/// The qualities that were asked for, in their order.
fn presets(arguments: &ExamArguments) -> Vec<Preset> {
    let default = if arguments.quick { &[Preset::Balanced][..] } else { &Preset::ALL[..] };
    let asked = if arguments.qualities.is_empty() { default } else { &arguments.qualities[..] };
    Preset::ALL.into_iter().filter(|preset| asked.contains(preset)).collect()
}

fn verdict(rows: &[Row]) -> Result<(), Failure> {
    let failed = || rows.iter().filter(|row| row.verdict == Verdict::Fail);
    match failed().next() {
        None => Ok(()),
        Some(first) => Err(Failure::Outcome(format!(
            "{} of {} rows fail at balanced or better, the first is {}, {} at {}",
            failed().count(),
            rows.len(),
            first.case,
            first.quantity,
            first.setting
        ))),
    }
}
