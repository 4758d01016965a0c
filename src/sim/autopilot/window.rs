//! What was observed of late, and means of it over windows.

use bevy::math::ops;
use std::collections::VecDeque;

/// How much a mean is taken over: at least so much time, s, and so many observations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Time, s.
    pub seconds: f32,
    /// Least number of observations, 3 at least: two leave nothing between them when both ends are trimmed.
    pub count: usize,
}

/// A mean, and how well it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The mean.
    pub mean: f32,
    /// Its standard error.
    pub error: f32,
}

/// The newest observations, at one position.
#[derive(Clone, Debug, Default)]
pub struct Observations {
    /// Seconds and value, oldest first.
    seen: VecDeque<(f32, f32)>,
    /// Memory of [`Self::estimate`]: values, sorted if some are to be left out.
    values: Vec<f32>,
}

impl Observations {
    /// Takes a value that was measured over `seconds` and forgets what is older than `window`.
    pub fn push(&mut self, value: f32, seconds: f32, window: Window) {
        self.seen.push_back((seconds, value));
        let mut span: f32 = self.seen.iter().map(|seen| seen.0).sum();
        while self.seen.len() > window.count && span > window.seconds + seconds {
            span -= self.seen.pop_front().map_or(0.0, |oldest| oldest.0);
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.seen.clear();
    }

    /// The mean over the newest `window`, if so much was observed. The share `trim` (0 … 0.3) of the observations is left
    /// out at either end, at least one unless `trim` is 0.
    pub fn estimate(&mut self, window: Window, trim: f32) -> Option<Estimate> {
        let (mut span, mut count) = (0.0, 0);
        for seen in self.seen.iter().rev() {
            (span, count) = (span + seen.0, count + 1);
            if span >= window.seconds - 1e-4 && count >= window.count {
                break;
            }
        }
        if span < window.seconds - 1e-4 || count < window.count {
            return None;
        }
        self.values.clear();
        self.values.extend(self.seen.iter().rev().take(count).map(|seen| seen.1));
        if trim > 0.0 {
            self.values.sort_unstable_by(f32::total_cmp);
        }
        let trimmed = (trim * count as f32).ceil() as usize;
        let kept = &self.values[trimmed..count - trimmed];
        let number = kept.len() as f32;
        let mean = kept.iter().sum::<f32>() / number;
        let squares = kept.iter().map(|value| (value - mean) * (value - mean)).sum::<f32>();
        // Few know their own spread badly: about Student's t at one standard deviation.
        let few = 1.0 + 1.0 / number;
        Some(Estimate { mean, error: few * ops::sqrt(squares / (number * (number - 1.0).max(1.0))) })
    }
}
