//! An axis of plain numbers: from where to where, and which are marked.

use std::ops::RangeInclusive;

/// Marks that an axis has about.
const MARKS: f64 = 4.0;

/// The part of an axis that is shown, and the distance of its marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    step: f64,
}

impl Scale {
    /// An axis that holds all of `values`, between two marks; it is at least as long as `least`.
    pub fn around(values: impl Iterator<Item = f64>, least: f64) -> Self {
        let (low, high) = values
            .filter(|value| value.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        let (low, high) = if low > high { (0.0, least) } else { (low, high) };
        let lack = (least - (high - low)).max(0.0);
        // What is never below 0 has its axis from there on.
        let (low, high) =
            if low >= 0.0 && low < lack { (0.0, high.max(least)) } else { (low - lack / 2.0, high + lack / 2.0) };
        let step = nice((high - low) / MARKS);
        Self { low: (low / step).floor() * step, high: (high / step).ceil() * step, step }
    }

    /// Where a value stands, as a share of the axis from its low end.
    pub fn share(&self, value: f64) -> f32 {
        ((value - self.low) / (self.high - self.low)) as f32
    }

    /// What it shows.
    pub fn range(&self) -> RangeInclusive<f64> {
        self.low..=self.high
    }

    /// The marked values, rising.
    pub fn marks(&self) -> impl Iterator<Item = f64> + use<> {
        let Self { low, high, step } = *self;
        let count = ((high - low) / step).round() as u32;
        (0..=count).map(move |k| low + f64::from(k) * step)
    }

    /// Decimals that tell the marks apart.
    pub fn decimals(&self) -> usize {
        let mut decimals = 0;
        let mut step = self.step;
        while step < 0.999 && decimals < 6 {
            (step, decimals) = (step * 10.0, decimals + 1);
        }
        decimals
    }
}

/// The least of 1, 2 and 5 times a power of ten that is no less.
fn nice(step: f64) -> f64 {
    let mut power = 1.0;
    while power > step {
        power /= 10.0;
    }
    while power * 10.0 <= step {
        power *= 10.0;
    }
    [1.0, 2.0, 5.0, 10.0].map(|times| times * power).into_iter().find(|nice| *nice >= step * 0.999).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_holds_its_values_between_marks_that_rise_evenly() {
        for values in [&[0.0, 0.37][..], &[-3.0, 812.0], &[20.0, 20.001], &[5e-4], &[], &[-0.2, -0.1], &[9.99e5, 1e6]] {
            let scale = Scale::around(values.iter().copied(), 0.01);
            let marks: Vec<f64> = scale.marks().collect();
            assert!((3..=8).contains(&marks.len()), "{values:?}: {marks:?}");
            assert!(
                values.iter().all(|value| (-1e-4..=1.0001).contains(&scale.share(*value))),
                "{values:?}: {scale:?}"
            );
            let steps: Vec<f64> = marks.windows(2).map(|pair| pair[1] - pair[0]).collect();
            assert!(steps.iter().all(|step| (step / steps[0] - 1.0).abs() < 1e-6 && *step > 0.0), "{marks:?}");
            assert!(scale.range().end() - scale.range().start() >= 0.0099);
            let texts: Vec<String> = marks.iter().map(|mark| format!("{mark:.*}", scale.decimals())).collect();
            assert!(texts.windows(2).all(|pair| pair[0] != pair[1]), "{texts:?}");
        }
    }

    #[test]
    fn nonsense_makes_an_axis_too() {
        let scale = Scale::around([f64::NAN, f64::INFINITY, 2.0].into_iter(), 1.0);
        assert!(scale.share(2.0).is_finite() && scale.range().contains(&2.0));
    }
}
