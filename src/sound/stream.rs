//! Running water: a rumble, a rush that comes and goes, and a babble of bubbles.

use crate::{
    block::{Block, LEN},
    controls::Controls,
    filter::{Filters, Part, Shape},
    grains::Grains,
    math::{exp2, pan_gains},
    noise::{Chance, Wander},
    smooth::{Follower, Loudness, is_silent},
    splash::bubble,
};

/// Pitch of the rumble, as a share of the rush's.
const RUMBLE: f32 = 0.2;
/// Bubbles of a stream of level 0.1, 1/s.
const BUBBLES: f32 = 90.0;

#[derive(Clone, Debug)]
pub(crate) struct Stream {
    loudness: Loudness,
    pitch: Follower,
    /// The rumble and the rush.
    deep: Filters,
    /// A gurgle, and the spray.
    thin: Filters,
    surge: Wander,
    drift: Wander,
    chance: Chance,
    rate: f32,
}

impl Stream {
    pub(crate) fn new(rate: f32) -> Self {
        let band = |q, level| Shape { part: Part::Band, q, level };
        Self {
            loudness: Loudness::new(0.06, 0.18, rate),
            pitch: Follower::new(0.15, 0.3, rate),
            deep: Filters::new([band(0.6, 0.55), band(0.5, 0.6)], rate),
            thin: Filters::new([band(5.0, 0.2), band(0.5, 0.22)], rate),
            surge: Wander::new(3, 5.0, rate),
            drift: Wander::new(4, 1.5, rate),
            chance: Chance::new(5),
            rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, grains: &mut Grains, out: &mut Block) {
        let level = controls.stream_level;
        let (surge, drift) = (self.surge.next(), self.drift.next());
        let gains =
            self.loudness.follow(pan_gains(controls.stream_pan).map(|gain| gain * level * (1.0 + 0.25 * surge)));
        if is_silent(&gains) {
            return;
        }
        self.pitch.follow(controls.stream_pitch);
        let pitch = self.pitch.value().max(100.0) * exp2(0.3 * drift);
        if level > 0.0 {
            for _ in 0..self.chance.count(BUBBLES * (level / 0.1).sqrt() * LEN as f32 / self.rate) {
                // The bubbles of slow water are larger.
                let radius = 3.0 / (1.6 * pitch);
                grains.add(bubble(&mut self.chance, radius, 0.45 * level, controls.stream_pan + 0.2 * drift));
            }
        }
        self.deep.tune([RUMBLE * pitch, pitch]);
        self.thin.tune([0.7 * pitch * exp2(0.5 * surge), 5.0 * pitch]);
        self.deep.render(noise, &gains, out);
        self.thin.render(noise, &gains, out);
    }
}
