//! Soaks what a plan has, several scenes at a time, and keeps each that is done in a journal.

use super::{
    plan::{Job, Plan},
    row::Row,
    tally::Tally,
};
use crate::{
    lab::{experiment::journal::Journal, jobs::pool},
    scene::SceneError,
};
use std::{
    io,
    sync::{Mutex, PoisonError},
};

/// The round of a journal's runs: a scene is played once.
const ROUND: u32 = 0;

/// Soaks those of a plan's jobs that a journal does not have yet, each on one thread. `report` is called with how many of all
/// are done, and with the one that begins. Beside what came of them is how keeping it ended: a journal that can't be written
/// stops nothing.
///
/// # Errors
/// If a scene can't be built.
pub fn run(
    plan: &Plan,
    jobs: &[Job],
    journal: Option<Journal<Row>>,
    report: impl Fn(usize, &Job) + Sync,
) -> Result<(Tally, io::Result<()>), SceneError> {
    let known = |job: &Job| journal.as_ref().and_then(|journal| journal.find(&job.title(), ROUND)).cloned();
    let (mut rows, mut left) = (Vec::new(), Vec::new());
    for job in jobs {
        match known(job) {
            Some(row) => rows.push(row),
            None => left.push(*job),
        }
    }
    let done_before = rows.len();
    let kept = Mutex::new((journal, Ok(())));
    let one = |job: &Job| {
        let row = Row::of(plan, job, &plan.start(job)?);
        let (journal, outcome) = &mut *kept.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Err(error)) = journal.as_mut().map(|journal| journal.add(&job.title(), ROUND, row.clone())) {
            *outcome = Err(error);
        }
        Ok(row)
    };
    let report = |done: usize, job: &Job| report(done_before + done, job);
    for row in pool::run(&left, plan.threads, |job| job.cost, report, one) {
        rows.push(row?);
    }
    let (_, outcome) = kept.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok((Tally::new(plan, rows), outcome))
}
