//! What a recording consists of, in memory as on disk.

use crate::sim::{checkpoint::Checkpoint, file::FileError, intent::Intent, mark::Mark};
use serde::{Deserialize, Serialize};
use std::{borrow::Cow, collections::VecDeque, mem::size_of};

/// An intent and when it was taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Ticks that the world had done.
    pub tick: u64,
    /// The intent.
    pub intent: Intent,
}

/// How a recording ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum End {
    /// It was ended.
    Stopped {
        /// Hash of the world then (`control::hash`).
        hash: u64,
    },
    /// The program panicked: in the tick after the last one that has a mark, or outside of ticks.
    Crashed,
}

/// The state that a segment begins with.
#[derive(Clone, Debug)]
enum Start {
    /// Taken from a running world.
    Taken(Checkpoint),
    /// Read from a file, as a save file. It is unfolded only when it is asked for: a small file may hold many worlds.
    Read(Vec<u8>),
}

impl Start {
    fn save(&self) -> Cow<'_, [u8]> {
        match self {
            Self::Taken(checkpoint) => checkpoint.encode().into(),
            Self::Read(save) => save.into(),
        }
    }
}

impl PartialEq for Start {
    fn eq(&self, other: &Self) -> bool {
        self.save() == other.save()
    }
}

/// A state on the way through a segment.
#[derive(Clone, Debug)]
pub(super) struct Key {
    /// Ticks of the segment that are done there, and intents that are taken.
    pub done: usize,
    pub entries: usize,
    pub state: Checkpoint,
}

/// What happened from a state on.
#[derive(Clone, Debug)]
pub struct Segment {
    start: Start,
    /// Ticks that the state has done.
    pub tick: u64,
    /// Whether the state is what the segment before ended with.
    follows: bool,
    /// What the edit stage took, oldest first.
    pub entries: Vec<Entry>,
    /// The mark of each tick.
    pub marks: Vec<Mark>,
    /// States on the way, oldest first (`keys`).
    pub(super) keys: VecDeque<Key>,
}

impl PartialEq for Segment {
    /// States on the way follow from the rest.
    fn eq(&self, other: &Self) -> bool {
        let of = |segment: &Self| (segment.tick, segment.follows);
        of(self) == of(other)
            && (&self.start, &self.entries, &self.marks) == (&other.start, &other.entries, &other.marks)
    }
}

impl Segment {
    fn new(start: Start, tick: u64, follows: bool) -> Self {
        Self { start, tick, follows, entries: Vec::new(), marks: Vec::new(), keys: VecDeque::new() }
    }

    /// The beginning of a segment in a file: a save file, and the ticks that its world has done.
    pub(super) fn read(save: Vec<u8>, tick: u64) -> Self {
        Self::new(Start::Read(save), tick, false)
    }

    /// The state.
    ///
    /// # Errors
    /// None for a recording that was read: reading looks at every state.
    pub fn start(&self) -> Result<Checkpoint, FileError> {
        match &self.start {
            Start::Taken(checkpoint) => Ok(checkpoint.clone()),
            Start::Read(save) => Checkpoint::decode(save),
        }
    }

    /// The state as a save file.
    pub fn save(&self) -> Cow<'_, [u8]> {
        self.start.save()
    }

    /// The tick that comes next.
    pub fn now(&self) -> u64 {
        self.tick + self.marks.len() as u64
    }

    /// Bytes that it takes without the states on the way, to a good approximation.
    fn bytes(&self) -> usize {
        let start = match &self.start {
            Start::Taken(checkpoint) => checkpoint.bytes(),
            Start::Read(save) => save.len(),
        };
        let pieces: usize = self.entries.iter().map(|entry| entry.intent.memory()).sum();
        start + pieces + self.entries.capacity() * size_of::<Entry>() + self.marks.capacity() * size_of::<Mark>()
    }
}

/// Segments, oldest first. One that was read has at least one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recording {
    /// The segments. Where one does not follow the one before, something put another world in the place of the one at
    /// hand (undo, reset, another scene).
    pub segments: Vec<Segment>,
    /// How it ended; nothing while it runs, and if a file breaks off.
    pub end: Option<End>,
}

impl Recording {
    /// Ticks in all.
    pub fn ticks(&self) -> u64 {
        self.segments.iter().map(|segment| segment.marks.len() as u64).sum()
    }

    /// Bytes that it takes without the states on the way, to a good approximation.
    pub fn bytes(&self) -> usize {
        self.segments.iter().map(Segment::bytes).sum()
    }

    /// Begins a segment, in the place of one in which nothing has happened. `follows`: at the state that the segment before
    /// has come to.
    pub(in crate::sim) fn begin(&mut self, start: Checkpoint, mut follows: bool) {
        if let Some(replaced) = self.segments.pop_if(|last| last.entries.is_empty() && last.marks.is_empty()) {
            // Where another world was put in place of the one that goes, so it was of this one.
            follows &= replaced.follows;
        }
        let tick = start.state.clock.tick;
        self.segments.push(Segment::new(Start::Taken(start), tick, follows));
    }

    /// Writes an intent.
    pub(in crate::sim) fn note(&mut self, entry: Entry) {
        if let Some(segment) = self.segments.last_mut() {
            segment.entries.push(entry);
        }
    }

    /// Writes what a tick came to.
    pub(in crate::sim) fn mark(&mut self, mark: Mark) {
        if let Some(segment) = self.segments.last_mut() {
            segment.marks.push(mark);
        }
    }

    /// Forgets the oldest segments as long as the others hold `ticks`, or while all take more than `bytes`.
    pub(in crate::sim) fn forget(&mut self, ticks: u64, bytes: usize) {
        while self.segments.len() > 1 {
            let rest = self.ticks() - self.segments[0].marks.len() as u64;
            if rest < ticks && self.bytes() <= bytes {
                break;
            }
            self.segments.remove(0);
        }
    }

    /// Whether a segment goes on from the one before it.
    pub(super) fn follows(&self, nth: usize) -> bool {
        nth > 0 && self.segments[nth].follows
    }
}
