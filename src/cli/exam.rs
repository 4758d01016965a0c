//! `exam`: physics against known answers.

use crate::{
    cli::{
        args::ExamArguments,
        failure::Failure,
        progress::StatusLine,
        report::{Report, presets},
    },
    lab::exam::{CASES, Case, document, jobs, sit_all, summary, table},
    sim::exam::{Row, Verdict},
};
use std::sync::Mutex;

/// Sits the exam and prints its rows. Rows at `balanced` or better that are beyond their tolerance fail it.
pub(super) fn exam(arguments: &ExamArguments) -> Result<(), Failure> {
    let report = Report::new(arguments.json.as_deref(), arguments.markdown.as_deref(), arguments.threads)?;
    let wanted = |case: &Case| match arguments.cases.is_empty() {
        true => case.quick || !arguments.quick,
        false => arguments.cases.iter().any(|name| name == case.name),
    };
    let jobs = jobs(CASES, wanted, &presets(&arguments.qualities, arguments.quick));
    let line = Mutex::new(StatusLine::new());
    let rows = sit_all(&jobs, report.threads, |done, of, job| {
        if let Ok(line) = line.lock() {
            line.say(&format!("{:3} %  {done} of {of}, {}", 100 * done / of, job.title()));
        }
    })?;
    drop(line);
    report.write(
        &rows,
        |processor| document(&rows, processor, "powder-master exam --markdown docs/exam.md"),
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
