//! The hiss of grains that slide on one another: a band of noise, rough from the grains that catch and let go.

use crate::{
    block::Block,
    controls::Controls,
    filter::{Filters, Part, Shape},
    math::pan_gains,
    noise::Chance,
    smooth::{Follower, Loudness, is_silent},
};

/// How often grains catch, 1/s.
const CATCHES: f32 = 1800.0;

#[derive(Clone, Debug)]
pub(crate) struct Hiss {
    loudness: Loudness,
    pitch: Follower,
    /// The hiss, and the thud of the heap under it.
    filters: Filters,
    chance: Chance,
    /// How loud the grains are that slide just now, and how much of that a frame leaves.
    rough: f32,
    fade: f32,
    /// Chance that one catches in a frame.
    catches: f32,
}

impl Hiss {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            loudness: Loudness::new(0.03, 0.1, rate),
            pitch: Follower::new(0.05, 0.15, rate),
            filters: Filters::new(
                [Shape { part: Part::Band, q: 0.7, level: 1.0 }, Shape { part: Part::Band, q: 0.8, level: 0.3 }],
                rate,
            ),
            chance: Chance::new(8),
            rough: 0.0,
            fade: 1.0 - 900.0 / rate.max(8000.0),
            catches: CATCHES / rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, out: &mut Block) {
        let gains = self.loudness.follow(pan_gains(controls.hiss_pan).map(|gain| gain * controls.hiss_level));
        if is_silent(&gains) {
            return;
        }
        self.pitch.follow(controls.hiss_pitch);
        let pitch = self.pitch.value().max(400.0);
        self.filters.tune([pitch, 0.07 * pitch]);
        let mut caught = *noise;
        for frame in &mut caught {
            self.rough *= self.fade;
            if self.chance.unit() < self.catches {
                self.rough += 0.9 * self.chance.unit();
            }
            *frame = frame.map(|sample| sample * (0.25 + self.rough));
        }
        self.filters.render(&caught, &gains, out);
    }
}
