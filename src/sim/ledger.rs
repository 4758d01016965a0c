//! The pass ledger: what each stage of a tick cost, what it worked on, and what it was spared. Written by the stages, read
//! by the HUD and `--metrics`.
//!
//! **What it saves** to leave particles or cells alone is never measured, since it does not happen. It is estimated: what a
//! pass was spared times what it took for one of them, by its own clock, when it last had enough of them (docs/effects.md
//! compares that with worlds in which nothing is left out). A pass that never ran has no such time, and what it would take
//! is unknown.

use crate::scene::passes::{Pass, Unit};
use bevy::prelude::Resource;
use std::{cmp::Ordering, time::Duration};

/// What a tick works on if nothing is left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extent {
    /// Movable particles times substeps.
    pub particles: u64,
    /// Cells of the air times substeps of the air, the fewest that it may take.
    pub cells: u64,
}

impl Extent {
    /// What `pass` works on then, where that is not what it worked on.
    fn of(self, pass: Pass) -> Option<u64> {
        let all = if pass.unit() == Unit::Cells { self.cells } else { self.particles };
        pass.row().each_substep.then_some(all)
    }
}

/// What a call of a pass did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Call {
    /// Particles or cells that it worked on.
    pub touched: u64,
    /// Those that it left alone, where they are more than what [`Extent`] tells.
    pub spared: u64,
}

impl From<usize> for Call {
    fn from(touched: usize) -> Self {
        Self { touched: touched as u64, spared: 0 }
    }
}

/// Fewest particles or cells of a tick from which the time for one of them is learnt, where there are as many: with few,
/// what a call itself takes would be taken for theirs. Changing this affects only what savings are estimated at.
const ENOUGH: u64 = 1024;

/// Ticks of which the times are kept for medians.
const HISTORY: usize = 64;

/// What one pass cost.
#[derive(Clone, Debug, Default)]
pub struct PassRecord {
    /// Calls since the ledger was cleared.
    pub calls: u64,
    /// Time in all since then.
    pub total: Duration,
    /// Particles or cells that it worked on in all, each as often as it did.
    pub touched: u64,
    /// Particles or cells that it was spared in all: those that slept, and all where it was not called.
    pub spared: u64,
    /// The same of the last tick.
    pub last: Work,
    now: Work,
    recent: Vec<Duration>,
    /// Time for a particle or cell in the last ticks with enough of them, ns.
    each: Vec<f32>,
    /// Number of those ticks.
    learnt: usize,
}

/// What a pass did in a tick.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Calls.
    pub calls: u32,
    /// Particles or cells worked on.
    pub touched: u64,
    /// Particles or cells left alone.
    pub spared: u64,
    /// Time that it took.
    pub time: Duration,
}

impl PassRecord {
    /// Median time a tick over the last ticks (64 at most) since the ledger was cleared.
    pub fn median(&self) -> Duration {
        median(&self.recent, Duration::cmp).unwrap_or_default()
    }

    /// Time for a particle or cell, ns: median over the last ticks (64 at most) in which there were enough of them. `None`
    /// if there never were.
    pub fn each(&self) -> Option<f64> {
        median(&self.each, f32::total_cmp).map(f64::from)
    }

    /// What it saved in the last tick to leave alone what was left alone, ms; `None` if that is unknown.
    pub fn saved_last(&self) -> Option<f64> {
        self.worth(self.last.spared)
    }

    /// The same of all ticks since the ledger was cleared, ms.
    pub fn saved(&self) -> Option<f64> {
        self.worth(self.spared)
    }

    fn worth(&self, spared: u64) -> Option<f64> {
        if spared == 0 { Some(0.0) } else { self.each().map(|each| each * spared as f64 * 1e-6) }
    }

    /// Closes a tick in which it would have worked on `whole` if nothing had been left out.
    fn close(&mut self, whole: Option<u64>, tick: usize) {
        let work = &mut self.now;
        if let Some(whole) = whole {
            work.spared = work.spared.max(whole.saturating_sub(work.touched));
        }
        let enough = work.touched > 0 && work.touched >= ENOUGH.min(work.touched + work.spared);
        if enough {
            let each = (work.time.as_nanos() as f64 / work.touched as f64) as f32;
            put(&mut self.each, self.learnt, each);
            self.learnt += 1;
        }
        self.touched += work.touched;
        self.spared += work.spared;
        put(&mut self.recent, tick, work.time);
        self.last = std::mem::take(work);
    }
}

/// Cost of every pass and of the ticks as a whole.
#[derive(Resource, Clone, Debug, Default)]
pub struct PassLedger {
    records: [PassRecord; Pass::ALL.len()],
    tick: PassRecord,
}

impl PassLedger {
    /// Notes a call of `pass` that took `time`.
    pub fn note(&mut self, pass: Pass, call: Call, time: Duration) {
        let record = &mut self.records[pass as usize];
        record.calls += 1;
        record.total += time;
        record.now.calls += 1;
        record.now.touched += call.touched;
        record.now.spared += call.spared;
        record.now.time += time;
    }

    /// The record of `pass`.
    pub fn record(&self, pass: Pass) -> &PassRecord {
        &self.records[pass as usize]
    }

    /// The record of whole ticks.
    pub fn tick(&self) -> &PassRecord {
        &self.tick
    }

    /// Closes a tick that took `time` in all.
    pub fn end_tick(&mut self, extent: Extent, time: Duration) {
        let tick = self.tick.calls as usize;
        self.tick.calls += 1;
        self.tick.total += time;
        put(&mut self.tick.recent, tick, time);
        for (pass, record) in Pass::ALL.into_iter().zip(&mut self.records) {
            record.close(extent.of(pass), tick);
        }
    }

    /// Time of the last tick.
    pub fn last_tick(&self) -> Duration {
        let newest = (self.tick.calls as usize + HISTORY - 1) % HISTORY;
        self.tick.recent.get(newest).copied().unwrap_or_default()
    }

    /// Begins anew. What a pass takes for a particle or cell is still known.
    pub fn clear(&mut self) {
        let before = std::mem::take(self);
        for (record, before) in self.records.iter_mut().zip(before.records) {
            (record.each, record.learnt) = (before.each, before.learnt);
        }
    }
}

/// Keeps the `nth` value, in place of the oldest.
fn put<T>(recent: &mut Vec<T>, nth: usize, value: T) {
    match recent.get_mut(nth % HISTORY) {
        Some(oldest) => *oldest = value,
        None => recent.push(value),
    }
}

fn median<T: Copy>(values: &[T], order: impl Fn(&T, &T) -> Ordering) -> Option<T> {
    let mut sorted = values.to_vec();
    sorted.sort_unstable_by(order);
    sorted.get(sorted.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ns(count: u64) -> Duration {
        Duration::from_nanos(count)
    }

    #[test]
    fn what_is_spared_is_worth_what_the_pass_took_for_as_many() {
        let mut ledger = PassLedger::default();
        let extent = Extent { particles: 4000, cells: 0 };
        for _ in 0..3 {
            ledger.note(Pass::Solve, 2000.into(), ns(20_000));
            ledger.note(Pass::Solve, 2000.into(), ns(20_000));
            ledger.end_tick(extent, ns(50_000));
        }
        assert_eq!(ledger.record(Pass::Solve).saved_last(), Some(0.0), "nothing was spared");
        // A quarter is awake; a few others come at a price that is the call's, not theirs.
        ledger.note(Pass::Solve, 10.into(), ns(9_000));
        ledger.end_tick(extent, ns(10_000));
        let record = ledger.record(Pass::Solve);
        assert_eq!((record.last.calls, record.last.touched, record.last.spared), (1, 10, 3990));
        assert!((record.saved_last().unwrap() - 3990.0 * 10e-6).abs() < 1e-9, "{:?}", record.saved_last());
        assert_eq!((record.touched, record.spared), (12_010, 3990));
        assert_eq!(
            ledger.record(Pass::Viscosity).saved_last(),
            None,
            "it never ran: what it would have taken is unknown"
        );
        assert_eq!(ledger.record(Pass::Air).saved_last(), Some(0.0), "there is no air");
    }

    #[test]
    fn all_that_there_is_is_enough_to_learn_from() {
        let mut ledger = PassLedger::default();
        ledger.note(Pass::Bin, 50.into(), ns(1000));
        ledger.end_tick(Extent { particles: 50, cells: 0 }, ns(2000));
        assert_eq!(ledger.record(Pass::Bin).each(), Some(20.0));
        ledger.clear();
        assert_eq!((ledger.record(Pass::Bin).calls, ledger.record(Pass::Bin).spared), (0, 0));
        ledger.end_tick(Extent { particles: 100, cells: 0 }, ns(2000));
        assert_eq!(ledger.record(Pass::Bin).saved(), Some(100.0 * 20e-6));
    }
}
