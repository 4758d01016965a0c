//! What was observed of late, and means of it.

use bevy::math::ops;
use std::collections::VecDeque;

/// Observations that a mean is taken over at least: two leave nothing between them when both ends are trimmed.
const LEAST: usize = 3;

/// A mean, and how well it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mean {
    /// The mean.
    pub value: f32,
    /// Its standard error.
    pub error: f32,
}

/// The newest observations.
#[derive(Clone, Debug, Default)]
pub struct Window {
    /// Seconds and value, oldest first.
    seen: VecDeque<(f32, f32)>,
    /// Memory of [`Self::mean`]: values, sorted if some are to be left out.
    values: Vec<f32>,
}

impl Window {
    /// Takes a value that was measured over `seconds` and forgets what is older than `longest`, s.
    pub fn push(&mut self, value: f32, seconds: f32, longest: f32) {
        self.seen.push_back((seconds, value));
        let mut span: f32 = self.seen.iter().map(|seen| seen.0).sum();
        while self.seen.len() > LEAST && span > longest + seconds {
            span -= self.seen.pop_front().map_or(0.0, |oldest| oldest.0);
        }
    }

    /// Forgets all.
    pub fn clear(&mut self) {
        self.seen.clear();
    }

    /// The mean over the newest `seconds`, if so much was observed. The share `trim` (0 … 0.3) of the observations is left
    /// out at either end, at least one unless `trim` is 0.
    pub fn mean(&mut self, seconds: f32, trim: f32) -> Option<Mean> {
        let (mut span, mut count) = (0.0, 0);
        let mut newest = self.seen.iter().rev();
        while span < seconds - 1e-4 || count < LEAST {
            span += newest.next()?.0;
            count += 1;
        }
        self.values.clear();
        self.values.extend(self.seen.iter().rev().take(count).map(|seen| seen.1));
        if trim > 0.0 {
            self.values.sort_unstable_by(f32::total_cmp);
        }
        let trimmed = (trim * count as f32).ceil() as usize;
        let kept = &self.values[trimmed..count - trimmed];
        let number = kept.len() as f32;
        let value = kept.iter().sum::<f32>() / number;
        let squares = kept.iter().map(|kept| (kept - value) * (kept - value)).sum::<f32>();
        // Few know their own spread badly: about Student's t at one standard deviation.
        let few = 1.0 + 1.0 / number;
        Some(Mean { value, error: few * ops::sqrt(squares / (number * (number - 1.0).max(1.0))) })
    }
}
