//! Whether and how fast the world runs, and how much of a late frame becomes ticks.

use crate::kernel::units::TICK_SECONDS;
use bevy::prelude::Resource;
use std::time::Duration;

/// Time that the ticks of one frame may take, also where all else in it takes less.
pub const FRAME_BUDGET: Duration = Duration::from_millis(20);
/// Most ticks in a frame, however cheap they are.
pub const MOST_TICKS: u32 = 8;

/// Pause, single steps and speed.
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Whether time stands still. Edits still happen.
    pub paused: bool,
    /// Ticks to run although it is paused.
    pub steps_due: u32,
    /// Simulated seconds for each real one that the player asked for, 1/16 … 4.
    pub speed: f32,
    /// Whether the past is shown: then nothing else moves, and whether it is paused is for when that ends.
    pub rewinds: bool,
}

impl Default for Pace {
    fn default() -> Self {
        Self { paused: false, steps_due: 0, speed: 1.0, rewinds: false }
    }
}

impl Pace {
    /// Whether the next fixed update is a tick (not only edits).
    pub fn ticks(&self) -> bool {
        !self.rewinds && (!self.paused || self.steps_due > 0)
    }

    /// Whether what is seen are states between two ticks, and nothing on its way from one to the next.
    pub fn stands(&self) -> bool {
        self.paused || self.rewinds
    }
}

/// Run condition: the world's time moves in this fixed update.
pub fn time_moves(pace: bevy::prelude::Res<Pace>) -> bool {
    pace.ticks()
}

/// Most ticks that one frame may run when a tick costs `tick` and all else in it takes `rest`: where frames are slow by their picture,
/// the world keeps its speed as long as its ticks don't take longer than that.
fn ticks_per_frame(tick: Duration, rest: Duration) -> u32 {
    if tick.is_zero() {
        return MOST_TICKS;
    }
    // A frame that took longer than all of them was a hitch, which the next ones are not to take after.
    let rest = rest.min(Duration::from_secs_f32(MOST_TICKS as f32 * TICK_SECONDS));
    let affordable = FRAME_BUDGET.max(rest).as_nanos() / tick.as_nanos();
    affordable.clamp(1, u128::from(MOST_TICKS)) as u32
}

/// Real time of a frame that becomes ticks when one costs `tick`, all else in it takes `rest`, and the world runs at `speed`; what is
/// beyond is dropped, so that a frame that came late by any time does not make the next one late as well.
pub fn longest_frame(tick: Duration, rest: Duration, speed: f32) -> Duration {
    // The bound is on the real time of a frame, before the speed is applied. Together with an overstep below one tick, `n`
    // ticks of time can't hold more than `n` ticks.
    Duration::from_secs_f32(ticks_per_frame(tick, rest) as f32 * TICK_SECONDS / speed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_that_cost_more_run_fewer_to_a_frame() {
        let ms = |ms: f32| ticks_per_frame(Duration::from_secs_f32(ms / 1000.0), Duration::from_millis(15));
        assert_eq!(ms(0.0), 8);
        assert_eq!(ms(1.0), 8);
        assert_eq!(ms(6.0), 3);
        assert_eq!(ms(10.5), 1);
        assert_eq!(ms(500.0), 1);
    }

    #[test]
    fn where_the_picture_is_slow_ticks_may_take_as_long_as_it() {
        let in_frame = |tick, rest| ticks_per_frame(Duration::from_millis(tick), Duration::from_millis(rest));
        assert_eq!(in_frame(6, 90), 8, "a tenth of a second is six ticks, which fit");
        assert_eq!(in_frame(15, 90), 6);
        assert_eq!(in_frame(100, 90), 1);
        assert_eq!([in_frame(1, 60_000), in_frame(40, 60_000)], [8, 3], "a hitch is not caught up with");
    }
}
