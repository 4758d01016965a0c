//! What follows a control without a click: in each block it comes nearer by a share, and within the block it goes straight.

use crate::{block::LEN, math::decay};

/// Below this a loudness is none: −80 dB of full scale.
const INAUDIBLE: f32 = 1e-4;

/// Share of its way that what follows with a time constant (s) goes in a block.
pub(crate) fn share(time: f32, rate: f32) -> f32 {
    1.0 - decay(LEN as f32 / (time * rate))
}

/// A straight way through a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ramp {
    /// Value before its first frame.
    pub(crate) from: f32,
    /// What each frame adds.
    pub(crate) step: f32,
}

impl Ramp {
    /// From one value to another.
    pub(crate) fn between(from: f32, to: f32) -> Self {
        Self { from, step: (to - from) / LEN as f32 }
    }

    /// Its value at the end of a frame.
    pub(crate) fn at(self, frame: usize) -> f32 {
        self.from + self.step * (frame + 1) as f32
    }

    /// Whether nothing of what it scales is heard.
    pub(crate) fn is_silent(self) -> bool {
        self.from == 0.0 && self.step == 0.0
    }
}

/// A value that follows another one, upwards and downwards with a time constant each.
#[derive(Clone, Debug)]
pub(crate) struct Follower {
    value: f32,
    rise: f32,
    fall: f32,
}

impl Follower {
    /// Time constants upwards and downwards, s.
    pub(crate) fn new(rise: f32, fall: f32, rate: f32) -> Self {
        Self { value: 0.0, rise: share(rise, rate), fall: share(fall, rate) }
    }

    /// Where it is.
    pub(crate) fn value(&self) -> f32 {
        self.value
    }

    /// Through the next block towards `goal`.
    pub(crate) fn follow(&mut self, goal: f32) -> Ramp {
        let from = self.value;
        let share = if goal > from { self.rise } else { self.fall };
        self.value += (goal - from) * share;
        // It arrives: a loudness that only came nearer to nothing would sound for ever.
        if (goal - self.value).abs() < INAUDIBLE {
            self.value = goal;
        }
        Ramp::between(from, self.value)
    }
}

/// How loud a sound is on the left and on the right.
#[derive(Clone, Debug)]
pub(crate) struct Loudness([Follower; 2]);

impl Loudness {
    /// Time constants upwards and downwards, s.
    pub(crate) fn new(rise: f32, fall: f32, rate: f32) -> Self {
        Self([Follower::new(rise, fall, rate), Follower::new(rise, fall, rate)])
    }

    /// Through the next block towards these.
    pub(crate) fn follow(&mut self, gains: [f32; 2]) -> [Ramp; 2] {
        let [left, right] = &mut self.0;
        [left.follow(gains[0]), right.follow(gains[1])]
    }
}

/// Whether nothing is heard on either side.
pub(crate) fn is_silent(gains: &[Ramp; 2]) -> bool {
    gains.iter().all(|gain| gain.is_silent())
}
