//! Boiling: bubbles that rise and burst, and steam that hisses.

use crate::{
    block::{Block, LEN},
    controls::Controls,
    filter::{Filters, Part, Shape},
    grains::Grains,
    math::pan_gains,
    noise::{Chance, Wander},
    smooth::{Loudness, is_silent},
    splash::bubble,
};

/// Radius of most bubbles, m.
const RADIUS: f32 = 0.0035;

#[derive(Clone, Debug)]
pub(crate) struct Boil {
    loudness: Loudness,
    /// The steam, and the rumble of the kettle.
    filters: Filters,
    sputter: Wander,
    chance: Chance,
    rate: f32,
}

impl Boil {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            loudness: Loudness::new(0.05, 0.2, rate),
            filters: Filters::new(
                [Shape { part: Part::Band, q: 0.6, level: 0.4 }, Shape { part: Part::Band, q: 1.0, level: 0.55 }],
                rate,
            ),
            sputter: Wander::new(13, 14.0, rate),
            chance: Chance::new(14),
            rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, grains: &mut Grains, out: &mut Block) {
        let level = controls.boil_level;
        if level > 0.0 {
            for _ in 0..self.chance.count(controls.boil_rate * LEN as f32 / self.rate) {
                grains.add(bubble(&mut self.chance, RADIUS, level, controls.boil_pan));
            }
        }
        let sputter = 1.0 + 0.4 * self.sputter.next();
        let gains = self.loudness.follow(pan_gains(controls.boil_pan).map(|gain| gain * level * sputter));
        if is_silent(&gains) {
            return;
        }
        self.filters.tune([5200.0, 420.0]);
        self.filters.render(noise, &gains, out);
    }
}
