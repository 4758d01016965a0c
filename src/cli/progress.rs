//! A line on the terminal that says how far a long run is.

use crate::lab::run::Observer;
use bevy::ecs::world::World;
use std::{
    io::{self, IsTerminal, Write},
    time::{Duration, Instant},
};

/// Time between two looks at the clock that are shown.
const EVERY: Duration = Duration::from_millis(200);

/// Shows the progress on stderr, if that is a terminal.
pub(super) struct Progress {
    ticks: u64,
    done: u64,
    shown: Instant,
    terminal: bool,
}

impl Progress {
    /// Progress of a run of `ticks`.
    pub(super) fn new(ticks: u64) -> Self {
        Self { ticks, done: 0, shown: Instant::now(), terminal: io::stderr().is_terminal() }
    }

    /// Wipes the line.
    pub(super) fn finish(self) {
        if self.terminal {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}

impl Observer for Progress {
    fn after_tick(&mut self, _world: &World) -> io::Result<()> {
        self.done += 1;
        if self.terminal && self.shown.elapsed() >= EVERY {
            self.shown = Instant::now();
            let percent = 100 * self.done / self.ticks;
            // A terminal that is gone must not end the run.
            let _ = write!(io::stderr(), "\r\x1b[K{percent:3} %  tick {} of {}", self.done, self.ticks);
        }
        Ok(())
    }
}
