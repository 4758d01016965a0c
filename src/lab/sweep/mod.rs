//! The sweep: what accuracy costs in a scene. From one checkpoint, every setting of a design runs the same ticks; what came out
//! is held against what it took.
//!
//! ```text
//! design ─► Setting… ─► measure (a run, timed and sampled) ─► journal (kept, so that a sweep goes on where it stopped)
//!                                                               │
//!             table (curve.csv) ◄─ row (runs of a setting together, what is wrong with them) ◄─┘
//!             summary (summary.md) ◄─ front (who is beaten by whom), presets (are they in order)
//! ```
//!
//! Runs are interleaved: a round runs every setting once, and the next round starts elsewhere, so that a disturbance of
//! the machine falls on a run and not on a setting. A run is deterministic: only the first of a setting is sampled for
//! accuracy, the others are timed and their worlds compared.

pub mod design;
#[cfg(feature = "charts")]
pub mod draw;
pub mod front;
pub mod journal;
mod measure;
pub mod presets;
pub mod row;
#[cfg(test)]
mod shipped;
pub mod summary;
pub mod table;

use crate::{
    kernel::params::{Preset, Quality},
    lab::{machine::processor, run::Plan},
    sim::{checkpoint::Checkpoint, snapshot::hash_bytes, workers::Workers},
};
use design::Setting;
use journal::{Journal, Record};
use row::Row;
use std::{
    collections::{BTreeMap, BTreeSet},
    io,
};

/// What counts as the error of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorMeasure {
    /// 99th percentile of the density error.
    Density,
    /// Distance of the air's velocity to the reference's.
    Air,
}

/// Liquid that fills less of the box than this, where air moves, is there to show the air.
const LITTLE_LIQUID: f64 = 0.05;

impl ErrorMeasure {
    /// What the scene is about: its air if that moves and liquid fills less than a twentieth of the box.
    pub fn of(start: &Checkpoint) -> Self {
        let size = start.setup.domain.size;
        let filled = start.state.particles.len() as f64 / (f64::from(size.x) * f64::from(size.y));
        if start.has_air() && filled < LITTLE_LIQUID { Self::Air } else { Self::Density }
    }

    /// Name with its unit, for the axis.
    pub fn title(self) -> &'static str {
        match self {
            Self::Density => "density error, 99th percentile",
            Self::Air => "distance of mean air velocity to the reference",
        }
    }
}

/// A sweep of a scene.
pub struct Sweep<'a> {
    /// Where every run sets out from.
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

/// How far a sweep is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Runs that are done.
    pub done: usize,
    /// What runs next.
    pub what: &'a str,
}

/// Why a sweep ends early.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// The system gives no threads.
    #[error("the threads can't be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The journal can't be written.
    #[error(transparent)]
    Journal(#[from] io::Error),
    /// Two runs of the same setting differ.
    #[error("{0}: two runs from the same start differ")]
    NotRepeatable(String),
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

    /// Runs what the journal doesn't have yet, and puts all together.
    ///
    /// # Errors
    /// If threads can't be had, the journal can't be written, or a world does not come out the same twice.
    pub fn run(&self, journal: &mut Journal, says: &mut dyn FnMut(Progress)) -> Result<Vec<Row>, SweepError> {
        let threads: BTreeSet<usize> = self.settings.iter().map(|setting| setting.threads).collect();
        let pools = threads.into_iter().map(|threads| Ok((threads, Workers::new(threads)?)));
        let workers: BTreeMap<usize, Workers> = pools.collect::<Result<_, rayon::ThreadPoolBuildError>>()?;
        let plan = Plan { ticks: self.ticks, warmup: self.warmup, ..Plan::default() };
        let mut reference = None;
        let mut done = 0;
        for round in 0..self.rounds {
            let first = round as usize * self.settings.len() / self.rounds as usize;
            for setting in self.settings[first..].iter().chain(&self.settings[..first]) {
                if journal.find(setting, round).is_none() {
                    let mut say = |what: &str| says(Progress { done, what });
                    let found = journal.found(setting).cloned();
                    if found.is_none() && reference.is_none() {
                        say("the reference");
                        reference = Some(measure::reference(self.start, &plan)?);
                    }
                    say(&setting.name);
                    let sampled = reference.as_ref().filter(|_| found.is_none());
                    let record = measure::run(self.start, &plan, setting, &workers[&setting.threads], sampled)?;
                    check_repeats(journal, setting, &record)?;
                    journal.add(setting, round, record)?;
                }
                done += 1;
            }
        }
        Ok(self.rows(journal))
    }

    /// What the journal has of each setting; settings without a run are left out.
    fn rows(&self, journal: &Journal) -> Vec<Row> {
        let mut rows: Vec<Row> = (self.settings.iter())
            .filter_map(|setting| {
                let records: Vec<&Record> = (0..self.rounds).filter_map(|round| journal.find(setting, round)).collect();
                Row::new(setting, self.measure, &records, journal.found(setting)?)
            })
            .collect();
        front::mark(&mut rows, self.start.has_air() && self.measure == ErrorMeasure::Density);
        rows
    }
}

fn check_repeats(journal: &Journal, setting: &Setting, record: &Record) -> Result<(), SweepError> {
    if journal.hash(setting).is_none_or(|hash| hash == record.hash) {
        Ok(())
    } else {
        Err(SweepError::NotRepeatable(setting.name.clone()))
    }
}

/// The knobs that make a difference: without air its own do not.
fn effective(quality: Quality, has_air: bool) -> Quality {
    let Quality { air_cell, air_courant, air_advection, .. } = Preset::Reference.quality();
    if has_air { quality } else { Quality { air_cell, air_courant, air_advection, ..quality } }
}
