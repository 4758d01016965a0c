//! Fire: a roar that flickers, and snaps of what bursts in the heat.
//!
//! The energies of the snaps are spread as those of all that crackles, by a power law (Sethna et al. 2001, "Crackling noise"):
//! many faint ones, few loud ones.

use crate::{
    block::{Block, LEN},
    controls::Controls,
    filter::{Filters, Part, Shape},
    grains::{Grain, Grains},
    math::{exp2, pan_gains},
    noise::{Chance, Wander},
    smooth::{Loudness, is_silent},
};

/// Loudest snap of all, of full scale.
const LOUDEST: f32 = 0.5;

#[derive(Clone, Debug)]
pub(crate) struct Fire {
    loudness: Loudness,
    /// The roar, and the flare above it.
    filters: Filters,
    flicker: Wander,
    breath: Wander,
    chance: Chance,
    rate: f32,
}

impl Fire {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            loudness: Loudness::new(0.08, 0.2, rate),
            filters: Filters::new(
                [Shape { part: Part::Low, q: 0.7, level: 0.85 }, Shape { part: Part::Band, q: 0.6, level: 0.35 }],
                rate,
            ),
            flicker: Wander::new(10, 11.0, rate),
            breath: Wander::new(11, 2.0, rate),
            chance: Chance::new(12),
            rate,
        }
    }

    pub(crate) fn render(&mut self, controls: &Controls, noise: &Block, grains: &mut Grains, out: &mut Block) {
        let level = controls.fire_level;
        if level > 0.0 {
            for _ in 0..self.chance.count(controls.fire_crackle * LEN as f32 / self.rate) {
                grains.add(snap(&mut self.chance, level, controls.fire_pan));
            }
        }
        let flicker = 1.0 + 0.45 * self.flicker.next();
        let gains = self.loudness.follow(pan_gains(controls.fire_pan).map(|gain| gain * level * flicker));
        let breath = self.breath.next();
        if is_silent(&gains) {
            return;
        }
        self.filters.tune([130.0 * exp2(0.6 * breath), 620.0 * exp2(0.5 * breath)]);
        self.filters.render(noise, &gains, out);
    }
}

fn snap(chance: &mut Chance, level: f32, pan: f32) -> Grain {
    // Amplitudes a with a chance of 1/a² to be above a.
    let rank = (chance.unit() + 1e-3).sqrt();
    Grain {
        pitch: 1900.0 * exp2(0.9 * chance.normal()),
        rise: 0.0,
        decay: 320.0 * exp2(1.3 * chance.signed()),
        noise: 0.8,
        level: (1.1 * level / rank).min(LOUDEST),
        pan: pan + 0.4 * chance.signed(),
    }
}
