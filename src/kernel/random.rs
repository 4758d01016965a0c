//! Numbers that look random and are the same each time and everywhere: made of a number, so that no order and no thread
//! shows in them, or in a sequence.

use crate::units::TICK_SECONDS;
use serde::{Deserialize, Serialize};

/// Scrambles a number (the finaliser of MurmurHash3): neighbouring numbers become unrelated ones.
pub fn mix(mut word: u32) -> u32 {
    word ^= word >> 16;
    word = word.wrapping_mul(0x85eb_ca6b);
    word ^= word >> 13;
    word = word.wrapping_mul(0xc2b2_ae35);
    word ^ (word >> 16)
}

/// Below what a die of a tick, any number, falls as often as this a second: with the chance `r Δt / (1 + r Δt)`, the step of an
/// implicit Euler.
pub fn threshold(rate: f32) -> u32 {
    let share = f64::from(rate) * f64::from(TICK_SECONDS);
    (share / (1.0 + share) * 4_294_967_296.0) as u32
}

/// The high 24 bits as a number from 0 to below 1.
pub fn share(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

/// The low 16 bits as a number in −1 … 1.
pub fn unit(bits: u32) -> f32 {
    (bits & 0xffff) as f32 / 32_767.5 - 1.0
}

/// A sequence of numbers, known by the number that it begins with: a linear congruential generator (Knuth, MMIX).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Random(u64);

impl Random {
    /// The sequence of a number.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Any number: the upper half of the state, as the lower bits of such a generator repeat soon.
    pub fn number(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as u32
    }

    /// A whole number from 0 to below `count`.
    pub fn below(&mut self, count: usize) -> usize {
        self.number() as usize % count
    }

    /// A number from 0 to 1.
    pub fn share(&mut self) -> f32 {
        self.number() as f32 / 4_294_967_296.0
    }

    /// A number from −1 to 1.
    pub fn offset(&mut self) -> f32 {
        2.0 * self.share() - 1.0
    }
}
