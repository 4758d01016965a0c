//! A limiter that looks ahead: what would be louder than the ceiling is turned down before it comes, and so is never bent.
//!
//! In each block it finds by what its peak must be multiplied. Of that it takes the lowest over [`WINDOW`] blocks, lets it rise
//! slowly, and takes the mean of the last [`MEAN`]; frames come out [`DELAY`] blocks after they came in. Each of the means'
//! terms was the lowest over a window that has the block that comes out, and the one before it, in it: so neither end of the
//! straight way that the gain takes through that block is above what the block bears.

use crate::{
    block::{Block, SILENCE},
    smooth::{Ramp, share},
};

/// Highest sample: −1 dB of full scale.
pub const CEILING: f32 = 0.891_250_9;

/// Terms of the mean.
const MEAN: usize = 8;
/// Blocks by which the sound is late.
pub(crate) const DELAY: usize = MEAN;
/// Blocks over which the lowest is taken: those from the one before that which comes out to the newest.
const WINDOW: usize = DELAY + 2;
/// Time constant with which it turns up again, s.
const RELEASE: f32 = 0.15;

#[derive(Clone, Debug)]
pub(crate) struct Limiter {
    waiting: [Block; DELAY],
    needs: [f32; WINDOW],
    means: [f32; MEAN],
    /// Number of blocks that came in.
    count: usize,
    gain: f32,
    held: f32,
    release: f32,
}

impl Limiter {
    pub(crate) fn new(rate: f32) -> Self {
        Self {
            waiting: [SILENCE; DELAY],
            needs: [1.0; WINDOW],
            means: [1.0; MEAN],
            count: 0,
            gain: 1.0,
            held: 1.0,
            release: share(RELEASE, rate),
        }
    }

    /// Takes a block, and gives back the one of [`DELAY`] blocks ago.
    pub(crate) fn pass(&mut self, block: &mut Block) {
        let peak = block.iter().flatten().fold(0.0_f32, |peak, sample| peak.max(sample.abs()));
        self.needs[self.count % WINDOW] = if peak > CEILING { CEILING / peak } else { 1.0 };
        let lowest = self.needs.iter().fold(1.0_f32, |lowest, need| lowest.min(*need));
        self.held = lowest.min(self.held + (1.0 - self.held) * self.release);
        self.means[self.count % MEAN] = self.held;
        let gain = self.means.iter().sum::<f32>() / MEAN as f32;
        let ramp = Ramp::between(self.gain, gain);
        self.gain = gain;
        std::mem::swap(block, &mut self.waiting[self.count % DELAY]);
        self.count = self.count.wrapping_add(1);
        for (k, frame) in block.iter_mut().enumerate() {
            // The sums may be off by their rounding.
            *frame = frame.map(|sample| (sample * ramp.at(k)).clamp(-CEILING, CEILING));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{block::LEN, math::sine, noise::Chance};

    /// By how much a sound is turned down at each frame.
    fn gains(sound: impl Fn(usize) -> f32, frames: usize) -> Vec<f32> {
        let mut limiter = Limiter::new(48_000.0);
        let mut out = Vec::new();
        for start in (0..frames).step_by(LEN) {
            let mut block = SILENCE;
            for (k, frame) in block.iter_mut().enumerate() {
                *frame = [sound(start + k), -sound(start + k)];
            }
            limiter.pass(&mut block);
            out.extend(block.map(|[left, _]| left));
        }
        let late = out.split_off(DELAY * LEN);
        late.into_iter().enumerate().map(|(k, sample)| sample / sound(k)).collect()
    }

    #[test]
    fn what_is_below_the_ceiling_is_left_alone() {
        let sound = |k: usize| 0.45 + 0.4 * sine((k as f32 * 0.01).fract());
        assert!(gains(sound, 4096).iter().all(|gain| (gain - 1.0).abs() < 1e-6));
    }

    #[test]
    fn what_is_too_loud_is_turned_down_smoothly_and_never_bent() {
        // A burst of six times the full scale, between faint sound.
        let loud = |k: usize| if (9000..9100).contains(&k) { 6.0 } else { 0.1 };
        let gains = gains(loud, 48_000);
        let steepest = gains.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
        assert!(steepest < 1.1 / (MEAN * LEN) as f32, "the gain jumps by {steepest}");
        let clamped = gains[9000..9100].iter().map(|gain| gain * 6.0).fold(0.0, f32::max);
        assert!(clamped <= CEILING * 1.000_001 && clamped > 0.7 * CEILING, "{clamped}");
        assert!(gains[8000] > 0.999_999 && gains[47_000] > 0.95, "it is turned down where nothing is loud");
    }

    /// The means alone hold the ceiling: the clamp behind them is for the rounding.
    #[test]
    fn the_gain_is_what_the_block_bears_whatever_comes() {
        let mut chance = Chance::new(5);
        let (mut limiter, mut peaks) = (Limiter::new(48_000.0), Vec::new());
        for k in 0..20_000 {
            let peak = if chance.unit() < 0.1 { 30.0 * chance.unit() } else { 0.5 };
            peaks.push(peak);
            let mut block = [[peak, 0.0]; LEN];
            let before = limiter.gain;
            limiter.pass(&mut block);
            if k >= DELAY {
                let most = before.max(limiter.gain) * peaks[k - DELAY];
                assert!(most <= CEILING * 1.000_01, "{most} in block {k}");
            }
        }
    }
}
