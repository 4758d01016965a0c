//! `exam`: physics against known answers.

use crate::{
    cli::{
        args::ExamArguments,
        failure::Failure,
        report::{Report, watched},
    },
    lab::exam::{CASES, Case, document, jobs, sit_all, summary, table},
    sim::exam::{Row, Verdict},
};

/// Sits the exam and prints its rows. Rows at `balanced` or better that are beyond their tolerance fail it.
pub(super) fn exam(arguments: &ExamArguments) -> Result<(), Failure> {
    let ExamArguments { cases, options } = arguments;
    let report = Report::new(options)?;
    let wanted = |case: &Case| options.wants(cases, case.name, case.quick);
    let jobs = jobs(CASES, wanted, &options.presets());
    let rows = watched(|says| sit_all(&jobs, report.threads, |done, of, job| says(done, of, &job.title())))?;
    report.write(
        &rows,
        |processor| document(&rows, processor, &options.command("exam", cases)),
        || format!("{}\n{}\n", table(&rows), summary(&rows)),
    )?;
    verdict(&rows)
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
