//! All runs of a sweep.

use super::{design::Setting, error::ErrorMeasure, front, measure, record::Record, row::Row};
use crate::{
    lab::{
        experiment::{ExperimentError, interleaved, journal::Journal},
        machine::processor,
        reference::Reference,
        run::Plan,
    },
    sim::{checkpoint::Checkpoint, snapshot::hash_bytes, workers::Workers},
};
use std::collections::{BTreeMap, BTreeSet};

/// A sweep of a scene.
pub struct Sweep<'a> {
    /// Where every run starts.
    pub start: &'a Checkpoint,
    /// What the error is.
    pub measure: ErrorMeasure,
    /// What is measured.
    pub settings: Vec<Setting>,
    /// Ticks of a run.
    pub ticks: u64,
    /// Ticks of these that are left out of times and samples.
    pub warmup: u64,
    /// Runs of each setting.
    pub rounds: u32,
}

impl Sweep<'_> {
    /// Runs in all.
    pub fn runs(&self) -> usize {
        self.settings.len() * self.rounds as usize
    }

    /// What the journal knows this sweep's runs by: equal only where the results must be.
    pub fn campaign(&self, program: &str) -> String {
        let Self { ticks, warmup, start, .. } = self;
        format!("{program} {} {:016x} {warmup}/{ticks}", processor(), hash_bytes(&start.encode()))
    }

    /// Runs what the journal doesn't have yet, and puts all together. `report` is called with how many runs are done and the name
    /// of the next.
    ///
    /// # Errors
    /// If threads can't be had, the journal can't be written, or a world does not come out the same twice.
    pub fn run(
        &self,
        journal: &mut Journal<Record>,
        report: &mut dyn FnMut(usize, &str),
    ) -> Result<Vec<Row>, ExperimentError> {
        let threads: BTreeSet<usize> = self.settings.iter().map(|setting| setting.threads).collect();
        let pools = threads.into_iter().map(|threads| Ok((threads, Workers::new(threads)?)));
        let workers: BTreeMap<usize, Workers> = pools.collect::<Result<_, rayon::ThreadPoolBuildError>>()?;
        let plan = Plan { ticks: self.ticks, warmup: self.warmup, ..Plan::default() };
        let mut reference = None;
        for (done, (round, k)) in interleaved(self.settings.len(), self.rounds as usize).enumerate() {
            let (setting, round) = (&self.settings[k], round as u32);
            let key = setting.key();
            if journal.find(&key, round).is_some() {
                continue;
            }
            let mut say = |what: &str| report(done, what);
            let reference = match &mut reference {
                Some(reference) => reference,
                none => {
                    say("the converged run");
                    // On all threads: its time is not what counts.
                    none.insert(Reference::converged(self.start, &plan, &Workers::default())?)
                }
            };
            say(&setting.name);
            let record = measure::run(self.start, &plan, setting, round, &workers[&setting.threads], reference)?;
            let others = self.settings.iter().filter(|other| other.world() == setting.world());
            if others.filter_map(|other| journal.find(&other.key(), round)).any(|other| other.hash != record.hash) {
                return Err(ExperimentError::NotRepeatable(setting.name.clone()));
            }
            journal.add(&key, round, record)?;
        }
        Ok(self.rows(journal))
    }

    /// What the journal has of each setting; settings without a run are left out.
    fn rows(&self, journal: &Journal<Record>) -> Vec<Row> {
        let row = |setting: &Setting| {
            let key = setting.key();
            let records: Vec<&Record> = (0..self.rounds).filter_map(|round| journal.find(&key, round)).collect();
            Row::new(setting, self.measure, &records)
        };
        let mut rows: Vec<Row> = self.settings.iter().filter_map(row).collect();
        front::mark(&mut rows, self.start.has_air() && self.measure == ErrorMeasure::Density);
        rows
    }
}
