//! Runs a recording again and compares every tick with what was recorded.

use crate::{
    kernel::simd::InstructionSet,
    sim::{
        file::FileError,
        mark::{Mark, Marker},
        recording::{End, Input, Recording, Segment},
        simulation::Simulation,
        state::{AirGrid, Clock, ParticleStore, Rock},
        workers::Workers,
    },
};
use bevy::prelude::World;
use serde::Serialize;
use std::fmt;

/// The first tick that is not what it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Difference {
    /// How many ticks the world had done after it.
    pub tick: u64,
    /// Which tick of the recording it is, from 1.
    pub nth: u64,
    /// What was recorded; nothing if only the state behind the last tick differs.
    pub recorded: Option<Mark>,
    /// What came out.
    pub found: Mark,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { tick, nth, recorded, found } = self;
        let Some(recorded) = recorded else {
            return write!(f, "tick {tick} is the same, but what was done after it gives another world");
        };
        write!(f, "tick {tick} is the first that differs (number {nth} of the recording): ")?;
        if recorded.particles != found.particles {
            return write!(f, "{} moving particles, recorded {}", found.particles, recorded.particles);
        }
        let both = recorded.matter != found.matter && recorded.surroundings != found.surroundings;
        f.write_str(match recorded.matter != found.matter {
            true if both => "the particles, and air or rock",
            true => "the particles",
            false => "air or rock",
        })
    }
}

/// A recording that runs again.
pub struct Replay<'a> {
    recording: &'a Recording,
    /// The segment that runs, its world, the input that waits and how many of its ticks are done.
    segment: usize,
    simulation: Simulation,
    input: Input,
    marks: usize,
    marker: Marker,
    done: u64,
}

impl<'a> Replay<'a> {
    /// The start of a recording, for `workers` to run on the lanes of `instructions`.
    ///
    /// # Errors
    /// If a state can't be read.
    pub fn new(recording: &'a Recording, workers: Workers, instructions: InstructionSet) -> Result<Self, FileError> {
        Self::from_segment(recording, 0, workers, instructions)
    }

    /// The start of its last segment.
    ///
    /// # Errors
    /// If a state can't be read.
    pub fn of_last(
        recording: &'a Recording,
        workers: Workers,
        instructions: InstructionSet,
    ) -> Result<Self, FileError> {
        Self::from_segment(recording, recording.segments.len() - 1, workers, instructions)
    }

    fn from_segment(
        recording: &'a Recording,
        segment: usize,
        workers: Workers,
        instructions: InstructionSet,
    ) -> Result<Self, FileError> {
        let start = recording.segments[segment].start()?;
        let simulation = Simulation::resume(&start, workers).with_instructions(instructions);
        let input = Input::new(recording.segments[segment].entries.clone());
        Ok(Self { recording, segment, simulation, input, marks: 0, marker: Marker::default(), done: 0 })
    }

    /// The world.
    pub fn world(&self) -> &World {
        self.simulation.world()
    }

    /// Ticks that were run.
    pub fn done(&self) -> u64 {
        self.done
    }

    /// Runs the next tick and compares it; `false` if there is none.
    ///
    /// # Errors
    /// If it is not what was recorded.
    pub fn tick(&mut self) -> Result<bool, Difference> {
        while self.marks == self.now().marks.len() {
            if self.segment + 1 == self.recording.segments.len() {
                return Ok(false);
            }
            self.go_to(self.segment + 1);
        }
        let recorded = self.now().marks[self.marks];
        self.input.give(self.simulation.world_mut());
        self.simulation.tick();
        self.marks += 1;
        self.done += 1;
        let found = self.mark();
        let tick = self.now().tick + self.marks as u64;
        if found != recorded {
            return Err(Difference { tick, nth: self.done, recorded: Some(recorded), found });
        }
        Ok(true)
    }

    /// Does what was done to the world after the last tick, while it stood, and compares the end.
    ///
    /// # Errors
    /// If it is not what was recorded.
    pub fn finish(&mut self) -> Result<u64, Difference> {
        self.input.give(self.simulation.world_mut());
        self.simulation.apply_edits();
        let hash = self.simulation.hash();
        match self.recording.end {
            Some(End::Stopped { hash: recorded }) if recorded != hash => {
                let tick = self.world().resource::<Clock>().tick;
                Err(Difference { tick, nth: self.done, recorded: None, found: self.mark() })
            }
            _ => Ok(hash),
        }
    }

    /// Runs one more tick than was recorded: the one in which the program panicked.
    pub fn go_beyond(&mut self) {
        self.simulation.tick();
    }

    fn now(&self) -> &'a Segment {
        &self.recording.segments[self.segment]
    }

    fn go_to(&mut self, segment: usize) {
        // Every state was looked at when the recording was read.
        if let Ok(start) = self.recording.segments[segment].start() {
            start.restore(self.simulation.world_mut());
        }
        (self.segment, self.marks) = (segment, 0);
        self.input = Input::new(self.now().entries.clone());
        self.marker = Marker::default();
    }

    fn mark(&mut self) -> Mark {
        let world = self.simulation.world();
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        self.marker.mark(particles, rock, world.resource::<AirGrid>(), world.resource::<Clock>())
    }
}
