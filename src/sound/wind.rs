//! Wind: noise that howls at a pitch, in gusts.

use crate::{
    block::Block,
    controls::Controls,
    filter::{Filters, Part, Shape},
    math::{exp2, pan_gains},
    noise::Wander,
    smooth::{Follower, Loudness, is_silent},
};

#[derive(Clone, Debug)]
pub(crate) struct Wind {
    loudness: Loudness,
    pitch: Follower,
    /// The body and the howl.
    filters: Filters,
    gust: Wander,
    drift: Wander,
}

impl Wind {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            loudness: Loudness::new(0.12, 0.2, rate),
            pitch: Follower::new(0.2, 0.35, rate),
            filters: Filters::new(
                [Shape { part: Part::Low, q: 0.7, level: 0.75 }, Shape { part: Part::Band, q: 4.0, level: 0.65 }],
                rate,
            ),
            gust: Wander::new(6, 1.2, rate),
            drift: Wander::new(7, 0.7, rate),
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, out: &mut Block) {
        let (gust, drift) = (self.gust.next(), self.drift.next());
        let level = controls.wind_level * (1.0 + 0.35 * gust);
        let gains = self.loudness.follow(pan_gains(controls.wind_pan).map(|gain| gain * level));
        if is_silent(&gains) {
            return;
        }
        self.pitch.follow(controls.wind_pitch);
        // A gust is louder and higher at once.
        let pitch = self.pitch.value().max(40.0) * exp2(0.25 * gust + 0.2 * drift);
        self.filters.tune([0.8 * pitch, pitch]);
        self.filters.render(noise, &gains, out);
    }
}
