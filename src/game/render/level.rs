//! How much of the picture is drawn: all of it, or what weak graphics can do in time. It never touches the simulation.

use crate::{game::frame::Tempo, sim::ledger::PassLedger};
use bevy::prelude::{Real, Res, ResMut, Resource, Time};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// What a frame may take for its picture, ms, before less of it is drawn: a fifth more than a sixtieth of a second.
const SLOW: f32 = 20.0;
/// For how long it must, s.
const PATIENCE: f32 = 2.0;
/// A frame longer than this was a hitch of the system, and says nothing, s.
const HITCH: f32 = 0.5;

/// A level of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Level {
    /// Coarse surfaces, clouds without swirls, a quarter of the pixels.
    Plain,
    /// Surfaces between plain and full.
    Good,
    /// All there is.
    Full,
}

impl Level {
    /// Every level, the least first.
    pub const ALL: [Self; 3] = [Self::Plain, Self::Good, Self::Full];

    /// Name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Good => "good",
            Self::Full => "full",
        }
    }

    /// Texels of the fields of bodies and of gases to one d.
    pub fn texels(self) -> (f32, f32) {
        match self {
            Self::Plain => (2.0, 2.0),
            Self::Good => (3.0, 2.0),
            Self::Full => (4.0, 2.0),
        }
    }

    /// Pixels of the picture to one of the window, along each side.
    pub fn resolution(self) -> f32 {
        match self {
            Self::Plain => 0.5,
            Self::Good | Self::Full => 1.0,
        }
    }

    /// Whether surfaces have their light and clouds their swirls looked up pixel by pixel.
    pub fn is_rich(self) -> bool {
        self > Self::Plain
    }
}

/// The level in force.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct PictureLevel {
    /// What the player wants; if nothing, frame times decide.
    wanted: Option<Level>,
    now: Level,
    /// Time for which frames have been slow, s.
    slow: f32,
}

impl Default for PictureLevel {
    fn default() -> Self {
        Self { wanted: None, now: Level::Full, slow: 0.0 }
    }
}

impl PictureLevel {
    /// The level in force.
    pub fn now(self) -> Level {
        self.now
    }

    /// What the player wants.
    pub fn wanted(self) -> Option<Level> {
        self.wanted
    }

    /// The player wants this. Where frame times decide, they begin with all there is.
    pub fn want(&mut self, level: Option<Level>) {
        *self = Self { wanted: level, now: level.unwrap_or(Level::Full), slow: 0.0 };
    }

    /// Counts a frame that took so many seconds, `ticks` ms of which were the simulation's. The level only goes down by itself: up
    /// again it would be too slow again.
    fn count(&mut self, seconds: f32, ticks: f32) {
        if self.wanted.is_some() || seconds > HITCH {
            return;
        }
        let is_slow = 1000.0 * seconds - ticks > SLOW;
        self.slow = if is_slow { self.slow + seconds } else { (self.slow - seconds).max(0.0) };
        if self.slow > PATIENCE && self.now > Level::Plain {
            self.slow = 0.0;
            self.now = if self.now == Level::Full { Level::Good } else { Level::Plain };
        }
    }
}

/// Lets the times of the frames decide.
pub fn follow_frames(
    mut level: ResMut<PictureLevel>,
    time: Res<Time<Real>>,
    tempo: Res<Tempo>,
    ledger: Res<PassLedger>,
) {
    // A resting game has no frames to speak of.
    if tempo.rests {
        return;
    }
    let ticks = (tempo.ticks_per_second / tempo.frames_per_second.max(1.0)).max(1.0);
    let mut next = *level;
    next.count(time.delta_secs(), ticks * milliseconds(ledger.last_tick()));
    if next != *level {
        *level = next;
    }
}

fn milliseconds(time: Duration) -> f32 {
    1000.0 * time.as_secs_f32()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(level: &mut PictureLevel, frames: usize, seconds: f32, ticks: f32) -> Level {
        for _ in 0..frames {
            level.count(seconds, ticks);
        }
        level.now()
    }

    #[test]
    fn slow_frames_lower_the_level_step_by_step_and_fast_ones_leave_it() {
        let mut level = PictureLevel::default();
        assert_eq!(after(&mut level, 600, 0.016, 2.0), Level::Full);
        assert_eq!(after(&mut level, 40, 0.04, 2.0), Level::Full, "1.6 s are not enough");
        assert_eq!(after(&mut level, 20, 0.04, 2.0), Level::Good);
        assert_eq!(after(&mut level, 60, 0.04, 2.0), Level::Plain);
        assert_eq!(after(&mut level, 600, 0.008, 2.0), Level::Plain, "it never goes up by itself");
    }

    #[test]
    fn slow_ticks_and_hitches_are_not_the_pictures_fault() {
        let mut level = PictureLevel::default();
        assert_eq!(after(&mut level, 600, 0.05, 40.0), Level::Full);
        assert_eq!(after(&mut level, 600, 2.0, 1.0), Level::Full);
    }

    #[test]
    fn what_the_player_wants_holds_until_frame_times_decide_again() {
        let mut level = PictureLevel::default();
        level.want(Some(Level::Full));
        assert_eq!(after(&mut level, 600, 0.1, 1.0), Level::Full);
        level.want(Some(Level::Plain));
        assert_eq!(level.now(), Level::Plain);
        level.want(None);
        assert_eq!((level.now(), level.wanted()), (Level::Full, None));
    }
}
