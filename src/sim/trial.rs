//! Whether it pays to share ticks out, found by trying.
//!
//! That is a matter of the machine and of the moment: threads of one core, cores that are far apart, a quota, other programs. What
//! comes out is the same to the bit either way, so that the other way can be tried while the world goes on.

use std::{
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// Ticks that are measured of each way. The slowest is left out: something may have come between once. What comes between again and
/// again counts.
const MEASURED: u32 = 6;
/// Ticks before the first trial: by then buffers have grown.
const FIRST: u32 = 24;
/// Ticks from one trial to the next: in it, so many as are measured take what the worse way takes.
const PERIOD: u32 = 360;
/// The other way is taken where it needs no more than this share of the time.
const WORTH_A_CHANGE: f32 = 0.95;

/// A tick alone that takes longer would be felt: half of a frame. None is tried that might, and one that does is the last.
const FELT: Duration = Duration::from_millis(8);

/// The way that is taken, and what is known of both.
#[derive(Debug, Default)]
pub(super) struct Trial {
    is_alone: AtomicBool,
    notes: Mutex<Notes>,
}

#[derive(Debug)]
struct Notes {
    /// Ticks until the next trial begins; 0 in a trial.
    left: u32,
    /// Ticks measured in this trial: of the way taken before, and then of the other.
    measured: u32,
    /// Those of the way taken before, and of the other.
    times: [Times; 2],
}

/// Times of some ticks for a unit of work, s.
#[derive(Clone, Copy, Debug, Default)]
struct Times {
    sum: f32,
    longest: f32,
}

impl Times {
    fn add(&mut self, time: f32) {
        self.sum += time;
        self.longest = self.longest.max(time);
    }

    fn all_but_the_longest(self) -> f32 {
        self.sum - self.longest
    }
}

impl Default for Notes {
    fn default() -> Self {
        Self { left: FIRST, measured: 0, times: [Times::default(); 2] }
    }
}

impl Trial {
    /// Whether the next tick is done by the calling thread alone.
    pub fn is_alone(&self) -> bool {
        self.is_alone.load(Ordering::Relaxed)
    }

    /// Notes that so many units of work (particle-substeps) took so long, on so many threads if they were shared, and decides how the
    /// next tick is done.
    pub fn note(&self, work: usize, time: Duration, threads: usize) {
        let mut notes = self.notes.lock().unwrap_or_else(PoisonError::into_inner);
        let notes = &mut *notes;
        if self.is_alone() && time > FELT {
            self.turn();
            *notes = Notes { left: PERIOD, ..Notes::default() };
            return;
        }
        if notes.left > 0 {
            notes.left -= 1;
            return;
        }
        notes.times[usize::from(notes.measured >= MEASURED)].add(time.as_secs_f32() / work as f32);
        notes.measured += 1;
        if notes.measured == MEASURED {
            let mean = notes.times[0].all_but_the_longest() / (MEASURED - 1) as f32 * work as f32;
            if !self.is_alone() && mean * threads as f32 > FELT.as_secs_f32() {
                *notes = Notes { left: PERIOD, ..Notes::default() };
            } else {
                self.turn();
            }
        } else if notes.measured == 2 * MEASURED {
            let [before, other] = notes.times.map(Times::all_but_the_longest);
            if other >= WORTH_A_CHANGE * before {
                self.turn();
            }
            *notes = Notes { left: PERIOD, ..Notes::default() };
        }
    }

    /// Takes the other way.
    fn turn(&self) {
        self.is_alone.fetch_xor(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes ticks of 1,000 units that take so many ns a unit, shared and alone; returns how many of them were alone.
    fn play(trial: &Trial, ticks: u32, time: impl Fn(u32, bool) -> u64) -> u32 {
        let mut alone = 0;
        for tick in 0..ticks {
            let is_alone = trial.is_alone();
            alone += u32::from(is_alone);
            trial.note(1000, Duration::from_nanos(1000 * time(tick, is_alone)), 2);
        }
        alone
    }

    #[test]
    fn ticks_are_shared_where_that_pays_and_the_other_way_is_tried_now_and_then() {
        let trial = Trial::default();
        assert_eq!(play(&trial, FIRST, |_, _| 1), 0, "nothing is tried while buffers grow");
        let alone = play(&trial, 10_000, |_, is_alone| if is_alone { 100 } else { 60 });
        assert!((150..=180).contains(&alone) && !trial.is_alone(), "{alone} of 10,000 ticks are alone");
    }

    #[test]
    fn ticks_are_done_alone_where_sharing_is_slower_and_shared_again_where_it_is_not() {
        let trial = Trial::default();
        let alone = play(&trial, 10_000, |_, is_alone| if is_alone { 100 } else { 120 });
        assert!(alone > 9_700 && trial.is_alone(), "{alone} of 10,000 ticks are alone");
        let alone = play(&trial, 10_000, |_, is_alone| if is_alone { 100 } else { 60 });
        assert!(alone < 600 && !trial.is_alone(), "{alone} of 10,000 ticks are alone");
    }

    #[test]
    fn what_comes_between_once_decides_nothing_and_what_does_again_and_again_does() {
        // Another program takes some time in one tick, of each trial or of three.
        for (every, is_alone) in [(2 * MEASURED, false), (3, true)] {
            let trial = Trial::default();
            let late = |tick: u32| if tick % every == 1 { 1000 } else { 0 };
            play(&trial, 5_000, |tick, is_alone| if is_alone { 100 } else { 60 + late(tick) });
            assert_eq!(trial.is_alone(), is_alone, "one tick of {every} is late");
        }
    }

    #[test]
    fn two_ways_as_fast_are_not_taken_in_turn() {
        let trial = Trial::default();
        play(&trial, 1000, |_, is_alone| if is_alone { 99 } else { 100 });
        assert!(!trial.is_alone());
    }

    #[test]
    fn no_tick_is_tried_alone_that_might_be_felt_and_one_that_is_felt_is_the_last() {
        // Half of 8 ms for 1,000 units on two threads.
        let trial = Trial::default();
        assert_eq!(play(&trial, 2000, |_, _| 4_100), 0);
        assert!(play(&trial, 2000, |_, _| 3_900) > 0);
        let trial = Trial::default();
        play(&trial, 200, |_, is_alone| if is_alone { 100 } else { 120 });
        assert!(trial.is_alone());
        // The world grows.
        assert_eq!(play(&trial, 200, |_, is_alone| if is_alone { 9_000 } else { 6_000 }), 1);
    }

    #[test]
    fn a_clock_that_stands_changes_nothing() {
        let trial = Trial::default();
        play(&trial, 1000, |_, _| 0);
        assert!(!trial.is_alone());
    }
}
