//! The order of an error in the particle spacing, from runs at several.
//!
//! Each spacing is run from two starts of equal accuracy ([`Start`](super::set_up::Start)). The mean of their errors is
//! the error. Errors of equal size that are due to chance alone, and so have nothing in common, come apart by √2 of
//! that size: the distance of the two over √2 is the floor of the measure, and an error that is not above it is not
//! told from none. The order is the slope of the error over the spacing, by least squares on logarithms, over the
//! spacings above their floors.

use crate::{
    lab::{exam::finding::Finding, stats},
    sim::numbers::figure,
};

/// What was found at one spacing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// Spacings across what flows.
    pub across: f64,
    /// Mean of the errors of the two starts, a share.
    pub error: f64,
    /// What of it may be chance, a share.
    pub floor: f64,
}

/// The number that two runs of a finer spacing stand for, and how far it may be off, a share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Truth {
    pub value: f64,
    pub doubt: f64,
}

impl Truth {
    /// The mean of two runs. It is off by a half of their distance, if by chance alone.
    pub fn of([a, b]: [f64; 2]) -> Self {
        Self { value: 0.5 * (a + b), doubt: ((a - b) / (a + b)).abs() }
    }
}

impl Level {
    /// What two starts gave for a number that is known.
    pub fn of_numbers(across: f64, truth: Truth, got: [f64; 2]) -> Self {
        let [a, b] = got.map(|got| got / truth.value - 1.0);
        Self { across, error: 0.5 * (a.abs() + b.abs()), floor: chance((a - b).abs()).max(truth.doubt) }
    }

    fn is_above_its_floor(&self) -> bool {
        self.error > self.floor
    }
}

/// What two errors of equal size that have nothing in common would each be, by their distance.
pub(super) fn chance(distance: f64) -> f64 {
    distance * std::f64::consts::FRAC_1_SQRT_2
}

/// Order that a method of second order comes to. Surface and edges, which are known to a spacing, are of the first.
const EXPECTED: f64 = 2.0;

/// The order over these levels, coarsest first. At a finest level that is at its floor there is none.
pub(super) fn order(quantity: &'static str, levels: &[Level]) -> Finding {
    let above: Vec<(f64, f64)> = (levels.iter())
        .filter(|level| level.is_above_its_floor())
        .map(|level| (-level.across.ln(), level.error.ln()))
        .collect();
    let at_the_floor = levels.last().is_some_and(|level| level.error <= level.floor);
    let order = if at_the_floor { None } else { stats::line(&above) };
    let got = order.map_or(f64::NAN, |(slope, _)| slope);
    Finding { quantity, expected: EXPECTED, got, note: words(levels, at_the_floor), at_the_floor }
}

fn words(levels: &[Level], at_the_floor: bool) -> String {
    let list = |of: fn(&Level) -> f64| levels.iter().map(|level| figure(of(level))).collect::<Vec<_>>().join(", ");
    let end = if at_the_floor { " The finest can't be told from the truth: no order is claimed." } else { "" };
    format!(
        "errors of {} % at {} spacings across, above floors of {} %.{end}",
        list(|level| 100.0 * level.error),
        list(|level| level.across),
        list(|level| 100.0 * level.floor)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels(errors: [f64; 3], floor: f64) -> Vec<Level> {
        [20.0, 40.0, 80.0].into_iter().zip(errors).map(|(across, error)| Level { across, error, floor }).collect()
    }

    #[test]
    fn the_order_is_the_slope_over_the_spacing() {
        let found = order("order", &levels([0.04, 0.02, 0.01], 1e-4));
        assert!((found.got - 1.0).abs() < 1e-12 && !found.at_the_floor, "{found:?}");
        let found = order("order", &levels([0.01, 0.02, 0.04], 1e-4));
        assert!((found.got + 1.0).abs() < 1e-12, "worse the finer it is: {found:?}");
    }

    #[test]
    fn nothing_is_claimed_at_the_floor_and_levels_there_do_not_count() {
        let found = order("order", &levels([0.04, 0.02, 0.01], 0.011));
        assert!(found.got.is_nan() && found.at_the_floor && found.note.contains("no order is claimed"), "{found:?}");
        // By luck the coarsest has next to no error.
        let mut lucky = levels([1e-6, 0.02, 0.01], 1e-4);
        assert!((order("order", &lucky).got - 1.0).abs() < 1e-12);
        lucky[1].error = 1e-6;
        let found = order("order", &lucky);
        assert!(found.got.is_nan() && !found.at_the_floor, "one level has no slope, and is no pass: {found:?}");
    }

    #[test]
    fn the_floor_is_what_two_starts_differ_by_or_the_doubt_of_the_truth() {
        let known = Truth { value: 2.0, doubt: 0.0 };
        let level = Level::of_numbers(10.0, known, [2.2, 1.9]);
        assert!(
            (level.error - 0.075).abs() < 1e-12 && (level.floor - 0.15 / 2.0_f64.sqrt()).abs() < 1e-12,
            "{level:?}"
        );
        assert!(!level.is_above_its_floor(), "one above and one below: chance");
        assert!(Level::of_numbers(10.0, known, [2.2, 2.3]).is_above_its_floor());
        assert!(!Level::of_numbers(10.0, known, [f64::NAN, 2.3]).is_above_its_floor());
        let truth = Truth::of([2.1, 1.9]);
        assert!((truth.value - 2.0).abs() < 1e-12 && (truth.doubt - 0.05).abs() < 1e-12, "{truth:?}");
        assert!(!Level::of_numbers(10.0, truth, [2.05, 2.06]).is_above_its_floor(), "the truth is not known so well");
    }
}
