//! Frame pacing: how much of a frame's time becomes ticks. Late frames slow the world down; they never enlarge a tick
//! and never pile up.

use crate::{
    kernel::units::TICKS_PER_SECOND,
    lab::split::Split,
    sim::{
        ledger::PassLedger,
        pace::{Pace, longest_frame},
        state::Clock,
    },
};
use bevy::prelude::{Real, Res, ResMut, Resource, Time, Virtual};
use std::time::Duration;

/// One tick.
const TICK: Duration = Duration::from_nanos(1_000_000_000 / TICKS_PER_SECOND as u64);
/// Ticks a second are counted over this time.
const WINDOW: Duration = Duration::from_millis(750);

/// Slowest and fastest speed.
pub const SPEED_RANGE: std::ops::RangeInclusive<f32> = 0.0625..=4.0;

/// How fast the world really runs and how fast frames come.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Tempo {
    /// Frames a second.
    pub frames_per_second: f32,
    /// Ticks a second; keeps its last value while the world stands.
    pub ticks_per_second: f32,
    /// Share of the wanted speed that the machine keeps up with, if it does not keep up.
    pub lag: Option<f32>,
    /// Whether frames come only when something changes.
    pub rests: bool,
    /// Simulated time that frames were too late for since the scene began, s.
    missed: f64,
    frame_time: Duration,
    frames: u32,
    tick_time: Duration,
    tick: u64,
    /// The tick of the last frame.
    seen: u64,
    pace: Pace,
}

impl Tempo {
    /// Ticks that frames were too late for since the scene began: what a hitch cost. They are left out and not caught up
    /// with.
    pub fn dropped(&self) -> f64 {
        self.missed * f64::from(TICKS_PER_SECOND)
    }

    /// What a frame takes but for its ticks, of which one costs `tick`; nothing before there was one.
    fn rest_of_frame(&self, tick: Duration) -> Duration {
        if self.frames_per_second <= 0.0 {
            return Duration::ZERO;
        }
        let ticks = self.ticks_per_second * tick.as_secs_f32();
        Duration::from_secs_f32((1.0 - ticks).max(0.0) / self.frames_per_second)
    }

    /// Notes how much of a frame of `elapsed`, at the player's speed, became `simulated` time.
    fn note_hitch(&mut self, elapsed: Duration, speed: f32, simulated: Duration) {
        let missed = elapsed.as_secs_f64() * f64::from(speed) - simulated.as_secs_f64();
        // What is left when nothing was cut is rounding.
        if missed > 1e-6 {
            self.missed += missed;
        }
    }

    /// Counts a frame of `elapsed` that left the world at `tick`.
    fn count(&mut self, elapsed: Duration, tick: u64, pace: Pace) {
        // What came before the first tick was loading.
        if tick < self.seen || tick == 0 {
            self.missed = 0.0;
        }
        self.seen = tick;
        if !self.rests {
            self.frame_time += elapsed;
            self.frames += 1;
        }
        if self.frame_time >= WINDOW {
            self.frames_per_second = self.frames as f32 / self.frame_time.as_secs_f32();
            (self.frame_time, self.frames) = (Duration::ZERO, 0);
        }
        if pace.paused || pace != self.pace || tick < self.tick {
            (self.tick, self.tick_time, self.pace, self.lag) = (tick, Duration::ZERO, pace, None);
            return;
        }
        self.tick_time += elapsed;
        if self.tick_time >= WINDOW {
            self.ticks_per_second = (tick - self.tick) as f32 / self.tick_time.as_secs_f32();
            let share = self.ticks_per_second / (TICKS_PER_SECOND as f32 * pace.speed);
            self.lag = (share < 0.95).then_some(share);
            (self.tick, self.tick_time) = (tick, Duration::ZERO);
        }
    }
}

/// Lets at most as many ticks into the next frame as it can afford, at the player's speed.
pub fn set_pace(
    pace: Res<Pace>,
    ledger: Res<PassLedger>,
    split: Res<Split>,
    tempo: Res<Tempo>,
    mut time: ResMut<Time<Virtual>>,
) {
    // While the world stands, fixed updates only carry edits: at slow motion's rate they would feel late.
    let speed = if pace.ticks() { pace.speed.clamp(*SPEED_RANGE.start(), *SPEED_RANGE.end()) } else { 1.0 };
    if time.relative_speed() != speed {
        time.set_relative_speed(speed);
    }
    let tick = ledger.tick().median() + split.tick_time();
    // A frame that wakes a resting game goes on as if it had not slept.
    let longest = if tempo.rests { TICK } else { longest_frame(tick, tempo.rest_of_frame(tick), speed) };
    time.set_max_delta(longest);
}

/// Keeps the counts that the HUD shows.
pub fn measure_tempo(
    mut tempo: ResMut<Tempo>,
    time: Res<Time<Real>>,
    simulated: Res<Time<Virtual>>,
    clock: Res<Clock>,
    pace: Res<Pace>,
) {
    // Time that was slept away was not missed.
    if !pace.paused && pace.ticks() && !tempo.rests {
        tempo.note_hitch(time.delta(), simulated.relative_speed(), simulated.delta());
    }
    tempo.count(time.delta(), clock.tick, *pace);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tempo_counts_ticks_and_frames_and_survives_a_reset() {
        let mut tempo = Tempo::default();
        for frame in 1..=100 {
            tempo.count(Duration::from_millis(20), frame, Pace::default());
        }
        assert!((tempo.frames_per_second - 50.0).abs() < 1.0);
        assert!((tempo.ticks_per_second - 50.0).abs() < 1.0);
        let lag = tempo.lag.expect("50 of 60 is late");
        assert!((lag - 5.0 / 6.0).abs() < 0.02);
        tempo.count(Duration::from_millis(20), 0, Pace::default());
        assert_eq!(tempo.lag, None, "a reset world starts a new count");
    }

    #[test]
    fn what_a_frame_takes_but_for_its_ticks_is_what_they_leave() {
        let mut tempo = Tempo::default();
        assert_eq!(tempo.rest_of_frame(Duration::from_millis(5)), Duration::ZERO);
        for frame in 1..=100 {
            tempo.count(Duration::from_millis(50), 3 * frame, Pace::default());
        }
        let rest = |tick| tempo.rest_of_frame(Duration::from_millis(tick)).as_secs_f32();
        assert!((rest(5) - 0.035).abs() < 0.002, "{}", rest(5));
        assert_eq!(rest(20), 0.0, "ticks that were dearer a moment ago");
    }

    #[test]
    fn a_hitch_is_counted_in_ticks_and_forgotten_with_the_scene() {
        let mut tempo = Tempo::default();
        tempo.note_hitch(Duration::from_millis(16), 1.0, Duration::from_millis(16));
        tempo.count(Duration::from_millis(16), 10, Pace::default());
        assert_eq!(tempo.dropped(), 0.0);
        tempo.note_hitch(Duration::from_secs(10), 0.5, Duration::from_millis(100));
        tempo.count(Duration::from_secs(10), 16, Pace::default());
        assert!((tempo.dropped() - 4.9 * 60.0).abs() < 1e-3, "{}", tempo.dropped());
        tempo.count(Duration::from_millis(16), 1, Pace::default());
        assert_eq!(tempo.dropped(), 0.0, "another scene has its own");
    }

    #[test]
    fn slow_motion_and_pause_are_not_late() {
        let mut tempo = Tempo::default();
        let slow = Pace { speed: 0.25, ..Pace::default() };
        for frame in 0..200 {
            tempo.count(Duration::from_millis(10), frame * 15 / 100, slow);
        }
        assert_eq!(tempo.lag, None);
        for _ in 0..200 {
            tempo.count(Duration::from_millis(10), 30, Pace { paused: true, ..slow });
        }
        assert_eq!(tempo.lag, None);
    }
}
