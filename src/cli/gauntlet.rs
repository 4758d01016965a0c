//! `gauntlet`: hard cases stay stable.

use crate::{
    cli::{
        args::GauntletArguments,
        failure::Failure,
        progress::StatusLine,
        report::{Report, presets},
    },
    lab::gauntlet::{CASES, Case, Size, document, jobs, run_all, summary, table},
    sim::gauntlet::{Row, Verdict},
};
use std::sync::Mutex;

/// Runs the gauntlet and prints its rows. A case that fails at any quality fails it.
pub(super) fn gauntlet(arguments: &GauntletArguments) -> Result<(), Failure> {
    let report = Report::new(arguments.json.as_deref(), arguments.markdown.as_deref(), arguments.threads)?;
    let wanted = |case: &Case| match arguments.cases.is_empty() {
        true => case.size == Size::Quick || !arguments.quick,
        false => arguments.cases.iter().any(|name| name == case.name),
    };
    let jobs = jobs(CASES, wanted, &presets(&arguments.qualities, arguments.quick));
    let line = Mutex::new(StatusLine::new());
    let rows = run_all(&jobs, report.threads, |done, of, job| {
        if let Ok(line) = line.lock() {
            line.say(&format!("{:3} %  {done} of {of}, {}", 100 * done / of, job.title()));
        }
    })?;
    drop(line);
    report.write(
        &rows,
        |processor| document(&rows, processor, "powder-master gauntlet --markdown docs/gauntlet.md"),
        || format!("{}\n{}\n", table(&rows), summary(&rows)),
    )?;
    verdict(&rows)
}

fn verdict(rows: &[Row]) -> Result<(), Failure> {
    let failed = || rows.iter().filter(|row| row.verdict == Verdict::Fail);
    match failed().next() {
        None => Ok(()),
        Some(first) => Err(Failure::Outcome(format!(
            "{} of {} runs fail, the first is {} at {}: {}",
            failed().count(),
            rows.len(),
            first.case,
            first.quality,
            first.broken.join("; ")
        ))),
    }
}
