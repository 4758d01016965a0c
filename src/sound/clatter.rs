//! Grains that strike: short knocks, more and deeper ones the harder they strike.

use crate::{
    block::LEN,
    controls::Controls,
    grains::{Grain, Grains},
    math::exp2,
    noise::Chance,
};

/// Knocks of a level of 0.1, 1/s.
const KNOCKS: f32 = 60.0;

#[derive(Clone, Debug)]
pub(crate) struct Clatter {
    chance: Chance,
    rate: f32,
}

impl Clatter {
    pub(crate) fn new(rate: f32) -> Self {
        Self { chance: Chance::new(9), rate }
    }

    pub(crate) fn render(&mut self, controls: &Controls, grains: &mut Grains) {
        let level = controls.clatter_level;
        if level <= 0.0 {
            return;
        }
        let chance = &mut self.chance;
        for _ in 0..chance.count(KNOCKS * (level / 0.1).sqrt() * LEN as f32 / self.rate) {
            // Hard knocks come from heavy lumps.
            let hard = chance.unit();
            grains.add(Grain {
                pitch: 1100.0 * exp2(0.9 * chance.normal() - 2.0 * level - hard),
                rise: 0.0,
                decay: 130.0 * exp2(0.7 * chance.signed()),
                noise: 0.5,
                level: 2.0 * level * (0.1 + hard * hard),
                pan: controls.clatter_pan + 0.35 * chance.signed(),
            });
        }
    }
}
