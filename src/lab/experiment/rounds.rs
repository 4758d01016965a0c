//! Rounds of runs, and what the runs of a setting come to together.

use crate::lab::stats;

/// Round and setting of each run, in their order: every round runs each setting once and begins with another one.
pub fn interleaved(settings: usize, rounds: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..rounds).flat_map(move |round| {
        let first = round * settings / rounds;
        (0..settings).map(move |k| (round, (first + k) % settings))
    })
}

/// A figure of all runs of a setting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Their median.
    pub median: f64,
    /// The least and the greatest.
    pub range: [f64; 2],
}

impl Spread {
    /// The figure over the runs; `None` without any.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut values: Vec<f64> = values.into_iter().collect();
        let range = [values.iter().copied().min_by(f64::total_cmp)?, stats::largest(&values)?];
        Some(Self { median: stats::quantile(&mut values, 0.5)?, range })
    }

    /// The range as a share of the median.
    pub fn share(&self) -> f64 {
        (self.range[1] - self.range[0]) / self.median
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_round_has_each_setting_once_and_begins_with_another() {
        let runs: Vec<(usize, usize)> = interleaved(4, 2).collect();
        assert_eq!(runs, [(0, 0), (0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (1, 0), (1, 1)]);
        assert_eq!(interleaved(0, 3).count() + interleaved(3, 0).count(), 0);
    }

    #[test]
    fn runs_go_together_by_their_median_and_show_their_spread() {
        let spread = Spread::of([1.2, 0.9, 3.0]).unwrap();
        assert_eq!((spread.median, spread.range), (1.2, [0.9, 3.0]));
        assert!((spread.share() - 1.75).abs() < 1e-12);
        assert_eq!(Spread::of([]), None);
    }
}
