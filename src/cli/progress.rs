//! A line on the terminal that says how far a long work is. Nothing if stderr is no terminal.

use crate::lab::run::Observer;
use bevy::{ecs::world::World, platform::time::Instant};
use std::{
    io::{self, IsTerminal, Write},
    time::Duration,
};

/// A line on stderr that is written over and over.
pub(super) struct StatusLine {
    terminal: bool,
}

/// Width of a bar, characters.
const BAR: usize = 24;

/// A bar that is full when `done` of `all` are done.
pub(super) fn bar(done: usize, all: usize) -> String {
    let full = (BAR * done).checked_div(all).unwrap_or(BAR).min(BAR);
    format!("[{}{}]", "█".repeat(full), "·".repeat(BAR - full))
}

impl StatusLine {
    /// An empty line.
    pub(super) fn new() -> Self {
        Self { terminal: io::stderr().is_terminal() }
    }

    /// Says something in place of what was said last.
    pub(super) fn say(&self, text: &str) {
        if self.terminal {
            // A terminal that is gone must not end the work.
            let _ = write!(io::stderr(), "\r\x1b[K{text}");
        }
    }
}

impl Drop for StatusLine {
    fn drop(&mut self) {
        self.say("");
    }
}

/// Time from one word of progress to the next.
const EVERY: Duration = Duration::from_millis(200);

/// Shows the progress of a run.
pub(super) struct Progress {
    line: StatusLine,
    ticks: u64,
    done: u64,
    shown: Instant,
}

impl Progress {
    /// Progress of a run of `ticks`.
    pub(super) fn new(ticks: u64) -> Self {
        Self { line: StatusLine::new(), ticks, done: 0, shown: Instant::now() }
    }
}

impl Observer for Progress {
    fn after_tick(&mut self, _world: &World) -> io::Result<()> {
        self.done += 1;
        if self.shown.elapsed() >= EVERY {
            self.shown = Instant::now();
            self.line.say(&format!("{:3} %  tick {} of {}", 100 * self.done / self.ticks, self.done, self.ticks));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_fills_from_the_left_and_never_spills() {
        assert_eq!(bar(0, 10), format!("[{}]", "·".repeat(24)));
        assert_eq!(bar(5, 10), format!("[{}{}]", "█".repeat(12), "·".repeat(12)));
        assert_eq!(bar(12, 10), format!("[{}]", "█".repeat(24)));
        assert_eq!(bar(0, 0), format!("[{}]", "█".repeat(24)));
    }
}
