//! How far a long work is, on stderr; nothing if that is no terminal.

use crate::lab::run::Observer;
use bevy::ecs::world::World;
use indicatif::{ProgressBar, ProgressStyle};
use std::io;

/// A line that says what is being done.
pub(super) fn status() -> ProgressBar {
    styled(ProgressBar::new_spinner(), "{wide_msg}")
}

/// A bar for work in so many parts.
pub(super) fn bar(parts: u64) -> ProgressBar {
    styled(ProgressBar::new(parts), "{prefix}[{bar:24.█·}] {percent:>3} %  {pos} of {len}, {eta} left  {wide_msg}")
}

fn styled(bar: ProgressBar, template: &str) -> ProgressBar {
    // A template that can't be read gives a plain bar.
    bar.with_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()))
}

/// A bar of ticks.
impl Observer for ProgressBar {
    fn after_tick(&mut self, _world: &World) -> io::Result<()> {
        self.inc(1);
        Ok(())
    }
}
