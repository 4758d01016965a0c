//! Splashes: the slap of water on what stops it, and the bubbles that it closes over.

use crate::{
    block::{Block, LEN},
    controls::Controls,
    filter::{Filters, Part, Shape},
    grains::{Grain, Grains},
    math::{exp2, pan_gains},
    noise::Chance,
    smooth::{Loudness, is_silent},
};

/// Share of a splash's level that its slap has.
const SLAP: f32 = 0.6;
/// Middle of the slap of bubbles of 3 mm, Hz.
const SLAP_PITCH: f32 = 1500.0;

#[derive(Clone, Debug)]
pub(crate) struct Splash {
    loudness: Loudness,
    /// The slap and its body.
    filters: Filters,
    chance: Chance,
    rate: f32,
}

impl Splash {
    pub(crate) fn new(rate: f32) -> Self {
        let band = |q, level| Shape { part: Part::Band, q, level: SLAP * level };
        Self {
            loudness: Loudness::new(0.004, 0.13, rate),
            filters: Filters::new([band(0.6, 0.55), band(0.8, 0.8)], rate),
            chance: Chance::new(2),
            rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, grains: &mut Grains, out: &mut Block) {
        let level = controls.splash_level;
        if level > 0.0 {
            for _ in 0..self.chance.count(controls.splash_rate * LEN as f32 / self.rate) {
                grains.add(bubble(&mut self.chance, controls.splash_radius, level, controls.splash_pan));
            }
        }
        let gains = self.loudness.follow(pan_gains(controls.splash_pan).map(|gain| gain * level));
        if is_silent(&gains) {
            return;
        }
        // Large bubbles come with a deep slap.
        let pitch = (SLAP_PITCH * (0.003 / controls.splash_radius).sqrt()).clamp(300.0, 4000.0);
        self.filters.tune([pitch, 0.2 * pitch]);
        self.filters.render(noise, &gains, out);
    }
}

/// One of many bubbles, most of which have about the radius `most` (m). Small ones are more frequent, large ones louder.
pub(crate) fn bubble(chance: &mut Chance, most: f32, level: f32, pan: f32) -> Grain {
    let size = exp2(0.8 * chance.normal());
    let loudness = chance.unit();
    let level = 1.1 * level * (size * size.sqrt()).min(2.2) * loudness * loudness;
    Grain::bubble((most * size).clamp(0.0003, 0.025), level, pan + 0.3 * chance.signed())
}
