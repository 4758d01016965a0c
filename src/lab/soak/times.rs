//! Times of ticks by classes: a period's quantiles, in the same memory however long it is.

use serde::{Deserialize, Serialize};

/// Classes from one time to twice that: each is 1.1 % wide.
const PER_DOUBLING: f64 = 64.0;

/// Lower end of the first class, ms. All below is in it.
const LEAST: f64 = 1e-3;

/// Classes: up to 2²⁷ times the least, 134 s. All above is in the last.
const CLASSES: usize = 27 * PER_DOUBLING as usize;

/// How many ticks took how long.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Times(Vec<u64>);

impl Default for Times {
    fn default() -> Self {
        Self(vec![0; CLASSES])
    }
}

impl Times {
    /// Counts a tick.
    pub fn add(&mut self, ms: f64) {
        let class = ((ms / LEAST).log2() * PER_DOUBLING).max(0.0) as usize;
        self.0[class.min(CLASSES - 1)] += 1;
    }

    /// A quantile, ms: the middle of its class, so at most 0.6 % off. 0 of no tick.
    pub fn quantile(&self, q: f64) -> f64 {
        let count: u64 = self.0.iter().sum();
        let place = (q * count.saturating_sub(1) as f64).round() as u64;
        let mut below = 0;
        let class = self.0.iter().position(|ticks| {
            below += ticks;
            below > place
        });
        class.map_or(0.0, |class| LEAST * ((class as f64 + 0.5) / PER_DOUBLING).exp2())
    }

    /// Forgets all, and keeps its memory.
    pub fn clear(&mut self) {
        self.0.fill(0);
    }

    /// Whether it is one of this program.
    pub fn is_sound(&self) -> bool {
        self.0.len() == CLASSES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_as_exact_as_a_class_is_wide() {
        let mut times = Times::default();
        assert_eq!(times.quantile(0.5), 0.0);
        (1..=1000).for_each(|k| times.add(f64::from(k) * 0.01));
        for (q, ms) in [(0.0, 0.01), (0.5, 5.0), (0.99, 9.9), (1.0, 10.0)] {
            assert!((times.quantile(q) / ms - 1.0).abs() < 0.01, "{q}: {}", times.quantile(q));
        }
        [0.0, -1.0, f64::NAN, 1e-9, 1e9, f64::INFINITY].into_iter().for_each(|ms| times.add(ms));
        assert!(times.quantile(0.0) < 0.002 && times.quantile(1.0) > 1e5);
        times.clear();
        assert_eq!(times, Times::default());
    }
}
