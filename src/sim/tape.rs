//! A tape: states of a world, and what happened to it from each of them on. What the recorder writes to.

use crate::{
    kernel::params::{Domain, Preset, Quality},
    scene::{blueprint::Blueprint, effects::EffectModes},
    sim::{
        control,
        effects::Effects,
        mark::Mark,
        recording::{End, Entry, Writer},
        save,
        snapshot::Snapshot,
        state::Setup,
    },
};
use bevy::prelude::World;
use std::{collections::VecDeque, mem::size_of, sync::Arc};

/// A state with all that it takes to go on from it.
#[derive(Clone, Debug)]
pub struct Start {
    blueprint: Arc<Blueprint>,
    domain: Domain,
    quality: (Preset, Quality),
    effects: EffectModes,
    state: Snapshot,
}

impl Start {
    /// The world as it is.
    pub fn of(world: &World) -> Self {
        let setup = world.resource::<Setup>();
        Self {
            blueprint: setup.blueprint.clone(),
            domain: setup.domain,
            quality: (setup.preset, setup.quality),
            effects: world.resource::<Effects>().modes(),
            state: control::freeze(world),
        }
    }

    /// Name of the scene that it is a state of.
    pub fn scene(&self) -> &str {
        &self.blueprint.name
    }

    /// The state.
    pub fn state(&self) -> &Snapshot {
        &self.state
    }

    /// It as a save file.
    pub fn encode(&self) -> Vec<u8> {
        save::encode_state(&self.blueprint, self.domain, self.quality, &self.effects, self.state.clone())
    }
}

/// What happened from a state on.
#[derive(Clone, Debug)]
pub struct Segment {
    /// The state.
    pub start: Arc<Start>,
    /// Whether the state is what the segment before ended with.
    pub follows: bool,
    /// What the edit stage took, oldest first.
    pub entries: Vec<Entry>,
    /// The mark of each tick.
    pub marks: Vec<Mark>,
}

impl Segment {
    /// The tick that comes next.
    pub fn now(&self) -> u64 {
        self.start.state.clock.tick + self.marks.len() as u64
    }

    /// Bytes that it takes, to a good approximation.
    fn size_in_memory(&self) -> usize {
        let input = self.entries.capacity() * size_of::<Entry>() + self.marks.capacity() * size_of::<Mark>();
        self.start.state.size_in_memory() + input
    }
}

/// Segments, oldest first.
#[derive(Clone, Debug, Default)]
pub struct Tape {
    segments: VecDeque<Segment>,
}

impl Tape {
    /// Whether nothing is on it.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// What is written to now.
    pub fn last(&self) -> Option<&Segment> {
        self.segments.back()
    }

    /// Begins a segment, in the place of one in which nothing has happened. `follows`: at the state that the segment before
    /// has come to.
    pub fn begin(&mut self, start: Arc<Start>, mut follows: bool) {
        if self.last().is_some_and(|last| last.entries.is_empty() && last.marks.is_empty()) {
            // Where a jump led to the one that goes, it leads to this one.
            follows &= self.segments.pop_back().is_some_and(|replaced| replaced.follows);
        }
        self.segments.push_back(Segment { start, follows, entries: Vec::new(), marks: Vec::new() });
    }

    /// Writes an intent.
    pub fn note(&mut self, entry: Entry) {
        if let Some(segment) = self.segments.back_mut() {
            segment.entries.push(entry);
        }
    }

    /// Writes what a tick came to.
    pub fn mark(&mut self, mark: Mark) {
        if let Some(segment) = self.segments.back_mut() {
            segment.marks.push(mark);
        }
    }

    /// Ticks on it.
    pub fn ticks(&self) -> u64 {
        self.segments.iter().map(|segment| segment.marks.len() as u64).sum()
    }

    /// Bytes that it takes, to a good approximation.
    pub fn size_in_memory(&self) -> usize {
        self.segments.iter().map(Segment::size_in_memory).sum()
    }

    /// Forgets the oldest segments as long as the others hold `ticks`, or while all take more than `bytes`.
    pub fn forget(&mut self, ticks: u64, bytes: usize) {
        while let (Some(oldest), true) = (self.segments.front(), self.segments.len() > 1) {
            let rest = self.ticks() - oldest.marks.len() as u64;
            if rest < ticks && self.size_in_memory() <= bytes {
                break;
            }
            self.segments.pop_front();
        }
    }

    /// It as a file. A segment that follows the one before needs no state of its own there.
    pub fn encode(&self, end: End) -> Vec<u8> {
        let mut writer = Writer::new();
        for (k, segment) in self.segments.iter().enumerate() {
            if k == 0 || !segment.follows {
                writer.start(&segment.start.encode());
            }
            writer.ticks(&segment.entries, &segment.marks);
        }
        writer.end(end);
        writer.take()
    }
}
