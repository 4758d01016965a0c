//! A logarithmic axis: where a value stands on it, and which values are marked.

use crate::sim::numbers::short;
use bevy::math::ops::{exp2, log10};
use tr::tr;

/// Least length of an axis, decades.
const LEAST: f32 = 1.0;
/// Room beyond the outermost values, decades.
const MARGIN: f32 = 0.18;
/// Up to this length the 2 and the 5 of each decade have a label, too, decades.
const SHORT: f32 = 2.1;

/// The part of the axis that is shown, as logarithms to the base of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    low: f32,
    high: f32,
}

/// A marked value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// The value.
    pub value: f32,
    /// Whether it is written.
    pub labelled: bool,
    /// Whether it is a power of ten.
    pub power: bool,
}

impl Axis {
    /// An axis that holds all of `values`, which are above 0. Its ends are on half decades, so that it does not follow
    /// every move of a value.
    pub fn around(values: impl Iterator<Item = f32>) -> Self {
        let logs = values.map(log10).filter(|log| log.is_finite());
        let (low, high) =
            logs.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), log| (low.min(log), high.max(log)));
        if low > high {
            return Self { low: -0.5, high: 0.5 };
        }
        let mut axis = Self { low: ((low - MARGIN) * 2.0).floor() / 2.0, high: ((high + MARGIN) * 2.0).ceil() / 2.0 };
        while axis.high - axis.low < LEAST {
            axis.low -= 0.5;
            axis.high += 0.5;
        }
        axis
    }

    /// Where a value stands, as a share of the axis from its low end.
    pub fn share(&self, value: f32) -> f32 {
        (log10(value.max(f32::MIN_POSITIVE)) - self.low) / (self.high - self.low)
    }

    /// Ones, twos and fives of each decade, rising.
    pub fn marks(&self) -> Vec<Mark> {
        let mut marks = Vec::new();
        for decade in self.low.floor() as i32..=self.high.ceil() as i32 {
            for step in [1.0, 2.0, 5.0] {
                let value = step * power_of_ten(decade);
                let share = self.share(value);
                if (-1e-3..=1.001).contains(&share) {
                    let power = step == 1.0;
                    marks.push(Mark { value, labelled: power || self.high - self.low <= SHORT, power });
                }
            }
        }
        marks
    }
}

fn power_of_ten(exponent: i32) -> f32 {
    // 2^(e log₂ 10), cleaned of its rounding: marks are few and their labels short.
    let value = exp2(exponent as f32 * std::f32::consts::LOG2_10);
    format!("{value:.0e}").parse().unwrap_or(value)
}

/// An error as a text.
pub fn percent(error: f32) -> String {
    format!("{} %", short(100.0 * error))
}

/// The same of an error that there need not be.
pub fn percent_or_none(error: Option<f32>) -> String {
    error.map_or_else(|| tr!("error" => "none"), percent)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_holds_its_values_and_rises() {
        let axis = Axis::around([0.3, 24.0].into_iter());
        let shares: Vec<f32> = [0.3, 1.0, 4.0, 24.0].map(|value| axis.share(value)).into();
        assert!(shares.windows(2).all(|pair| pair[1] > pair[0]), "{shares:?}");
        assert!(shares[0] > 0.0 && shares[3] < 1.0, "{shares:?}");
        assert!((axis.share(1.0) - axis.share(0.1) - (axis.share(10.0) - axis.share(1.0))).abs() < 1e-5);
    }

    #[test]
    fn marks_are_exact_inside_and_not_too_many() {
        let marks = Axis::around([0.3, 24.0].into_iter()).marks();
        assert!(marks.iter().any(|mark| mark.value == 1.0 && mark.labelled && mark.power));
        assert!(marks.iter().any(|mark| mark.value == 0.2) && marks.iter().any(|mark| mark.value == 50.0));
        let wide = Axis::around([0.01, 200.0].into_iter());
        assert!(wide.marks().iter().filter(|mark| mark.labelled).count() < 8);
        assert!(wide.marks().iter().all(|mark| (-0.01..=1.01).contains(&wide.share(mark.value))));
    }

    #[test]
    fn nothing_one_value_and_nonsense_still_make_an_axis() {
        for values in [vec![], vec![0.7], vec![0.0, f32::NAN, 3.0]] {
            let axis = Axis::around(values.iter().copied());
            assert!(axis.share(2.0).is_finite() && axis.marks().len() >= 3, "{values:?}");
        }
    }
}
