//! Going back along a recording: states on the way, so that few ticks have to be run again to come to any of its places.
//! They follow from the rest, and are no part of a file.

use crate::sim::{
    checkpoint::Checkpoint,
    recording::segment::{Entry, Key, Recording},
};

/// Most ticks from one state to the next that are run again.
pub const KEY_TICKS: usize = 16;

/// A place in a recording, between two ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// Number of the segment.
    pub segment: usize,
    /// How many of its ticks are done.
    pub done: usize,
    /// How many of its intents are taken.
    pub entries: usize,
}

/// A part of a recording that lies before a place.
#[derive(Clone, Debug)]
pub struct Stretch {
    /// Where it begins.
    pub begin: Spot,
    /// The state there.
    pub start: Checkpoint,
    /// What is taken from there on, before its last tick.
    pub entries: Vec<Entry>,
    /// How many ticks it is long.
    pub ticks: usize,
    /// Whether something else than its last tick led to the place: an edit while time stood, or another world that was
    /// put in the place of this one. Then its end is a state of its own.
    pub is_cut: bool,
}

impl Recording {
    /// Ticks since the newest state.
    pub(in crate::sim) fn ticks_since_key(&self) -> usize {
        let Some(segment) = self.segments.last() else { return 0 };
        segment.marks.len() - segment.keys.back().map_or(0, |key| key.done)
    }

    /// Keeps the state that the newest segment has come to.
    pub(in crate::sim) fn note_key(&mut self, state: Checkpoint) {
        if let Some(segment) = self.segments.last_mut() {
            segment.keys.push_back(Key { done: segment.marks.len(), entries: segment.entries.len(), state });
        }
    }

    /// Forgets the oldest states on the way: those more than `ticks` before the end, and more while all take more than
    /// `bytes`.
    pub(in crate::sim) fn thin(&mut self, ticks: u64, bytes: usize) {
        let (mut held, mut before_end) = (self.key_bytes(), self.ticks());
        for segment in &mut self.segments {
            while let Some(key) = segment.keys.front() {
                if before_end - key.done as u64 <= ticks && held <= bytes {
                    return;
                }
                held -= key.state.bytes();
                segment.keys.pop_front();
            }
            before_end -= segment.marks.len() as u64;
        }
    }

    /// Bytes that the states on the way take, to a good approximation.
    pub(in crate::sim) fn key_bytes(&self) -> usize {
        self.segments.iter().flat_map(|segment| &segment.keys).map(|key| key.state.bytes()).sum()
    }

    /// The end.
    pub(in crate::sim) fn end_spot(&self) -> Option<Spot> {
        let last = self.segments.last()?;
        Some(Spot { segment: self.segments.len() - 1, done: last.marks.len(), entries: last.entries.len() })
    }

    /// What lies before a place, from the nearest state on; nothing at the beginning, and where the nearest is too far away.
    pub(in crate::sim) fn stretch_before(&self, spot: Spot) -> Option<Stretch> {
        let with_ticks = |k: &usize| !self.segments[*k].marks.is_empty();
        let (k, done, available) = if spot.done > 0 {
            (spot.segment, spot.done, spot.entries)
        } else {
            let k = (0..spot.segment).rev().find(with_ticks)?;
            (k, self.segments[k].marks.len(), self.segments[k].entries.len())
        };
        let segment = &self.segments[k];
        let key = segment.keys.iter().rev().find(|key| key.done < done);
        let (begun, taken) = key.map_or((0, 0), |key| (key.done, key.entries));
        if done - begun > KEY_TICKS {
            return None;
        }
        let start = key.map_or_else(|| segment.start().ok(), |key| Some(key.state.clone()))?;
        let end = segment.entries.partition_point(|entry| entry.tick < segment.tick + done as u64).max(taken);
        let jumps = (k + 1..=spot.segment).any(|later| !self.follows(later));
        Some(Stretch {
            begin: Spot { segment: k, done: begun, entries: taken },
            start,
            entries: segment.entries[taken..end].to_vec(),
            ticks: done - begun,
            is_cut: jumps || end < available,
        })
    }

    /// Forgets what came after a place.
    pub(in crate::sim) fn cut(&mut self, spot: Spot) {
        self.segments.truncate(spot.segment + 1);
        let Some(last) = self.segments.last_mut() else { return };
        last.entries.truncate(spot.entries);
        last.marks.truncate(spot.done);
        last.keys.retain(|key| key.done < spot.done);
    }
}
