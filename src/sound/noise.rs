//! Chance: white noise, and what wanders slowly.

use crate::{
    block::{Block, LEN},
    smooth::share,
};

/// A row of numbers that look like chance (xorshift32; Marsaglia 2003, "Xorshift RNGs").
#[derive(Clone, Debug)]
pub(crate) struct Chance(u32);

impl Chance {
    /// A row of its own for each seed.
    pub(crate) fn new(seed: u32) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9) | 1)
    }

    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// Evenly between −1 and 1.
    pub(crate) fn signed(&mut self) -> f32 {
        self.next() as i32 as f32 * (1.0 / 2_147_483_648.0)
    }

    /// Evenly between 0 and 1.
    pub(crate) fn unit(&mut self) -> f32 {
        (self.next() >> 8) as f32 * (1.0 / 16_777_216.0)
    }

    /// Roughly normal, with a deviation of 1: the sum of three.
    pub(crate) fn normal(&mut self) -> f32 {
        self.signed() + self.signed() + self.signed()
    }

    /// How many of `expected` events come to pass; on average so many.
    pub(crate) fn count(&mut self, expected: f32) -> usize {
        let whole = expected as usize;
        whole + usize::from(self.unit() < expected - whole as f32)
    }

    /// White noise, another on each side, of `density` times the amplitude of full scale.
    pub(crate) fn fill(&mut self, noise: &mut Block, density: f32) {
        for frame in noise {
            *frame = [self.signed() * density, self.signed() * density];
        }
    }
}

/// A number between −1 and 1 that wanders: it goes for another one as often as not.
#[derive(Clone, Debug)]
pub(crate) struct Wander {
    chance: Chance,
    value: f32,
    goal: f32,
    /// Chance of another goal in a block.
    turn: f32,
    share: f32,
}

impl Wander {
    /// It turns so many times a second.
    pub(crate) fn new(seed: u32, turns: f32, rate: f32) -> Self {
        let turn = turns * LEN as f32 / rate;
        Self { chance: Chance::new(seed), value: 0.0, goal: 0.0, turn, share: share(0.5 / turns, rate) }
    }

    /// Its value in the next block.
    pub(crate) fn next(&mut self) -> f32 {
        if self.chance.unit() < self.turn {
            self.goal = self.chance.signed();
        }
        self.value += (self.goal - self.value) * self.share;
        self.value
    }
}
