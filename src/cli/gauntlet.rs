//! `gauntlet`: hard cases stay stable.

use crate::{
    cli::{
        args::GauntletArguments,
        failure::Failure,
        report::{Report, watched},
    },
    lab::gauntlet::{CASES, Case, Size, document, jobs, run_all, summary, table},
    sim::gauntlet::{Row, Verdict},
};

/// Runs the gauntlet and prints its rows. A case that fails at any quality fails it.
pub(super) fn gauntlet(arguments: &GauntletArguments) -> Result<(), Failure> {
    let GauntletArguments { cases, options } = arguments;
    let report = Report::new(options)?;
    let wanted = |case: &Case| options.wants(cases, case.name, case.size == Size::Quick);
    let jobs = jobs(CASES, wanted, &options.presets());
    let rows = watched(|says| run_all(&jobs, report.threads, |done, of, job| says(done, of, &job.title())))?;
    report.write(
        &rows,
        |processor| document(&rows, processor, &options.command("gauntlet", cases)),
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
