//! Blasts: a crack that turns into a rumble as it dies away, over a thump that sinks.

use crate::{
    block::{Block, LEN},
    controls::Controls,
    filter::{Filters, Part, Shape},
    math::{pan_gains, sine},
    smooth::{Follower, Loudness, is_silent},
};

/// Time constants with which a blast comes and dies away, s.
const RISE: f32 = 0.002;
const FALL: f32 = 0.19;

#[derive(Clone, Debug)]
pub(crate) struct Blast {
    /// The pressure that arrived, as it dies away.
    pressure: Follower,
    loudness: Loudness,
    /// The crack and the rumble.
    filters: Filters,
    /// Where in its turn the thump is.
    turns: f32,
    rate: f32,
}

impl Blast {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            pressure: Follower::new(RISE, FALL, rate),
            loudness: Loudness::new(RISE, 0.02, rate),
            filters: Filters::new(
                [Shape { part: Part::Low, q: 0.7, level: 0.45 }, Shape { part: Part::Band, q: 0.7, level: 0.6 }],
                rate,
            ),
            turns: 0.0,
            rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, out: &mut Block) {
        self.pressure.follow(controls.blast_level);
        let pressure = self.pressure.value();
        let gains = self.loudness.follow(pan_gains(controls.blast_pan).map(|gain| gain * pressure));
        if is_silent(&gains) {
            return;
        }
        self.filters.tune([90.0 + 2800.0 * pressure * pressure, 55.0 + 60.0 * pressure]);
        self.filters.render(noise, &gains, out);
        let step = (26.0 + 34.0 * pressure) / self.rate;
        for (k, frame) in out.iter_mut().enumerate() {
            let thump = 0.8 * sine(self.turns + step * (k + 1) as f32);
            for side in 0..2 {
                frame[side] += gains[side].at(k) * thump;
            }
        }
        self.turns = (self.turns + step * LEN as f32).fract();
    }
}
