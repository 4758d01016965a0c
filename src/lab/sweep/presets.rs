//! Whether the presets are what they claim: each exacter and dearer than the one before, and none a bad buy.

use super::{
    ErrorMeasure,
    front::point,
    row::{NEGLIGIBLE, Row},
};
use crate::kernel::params::Preset;
use std::fmt;

/// The presets that are steps of accuracy, cheapest first.
pub const STEPS: [Preset; 5] = [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine, Preset::Reference];

/// A row is a better buy by a margin if it takes this much less time, as a share: along the front from `draft` to
/// `balanced` the error goes with the time to the power of -1.4, so that this buys what the other margin is,
const TIME_MARGIN: f64 = 0.1;

/// or has this much less error: more than runs of the same flow scatter when air or iterations are changed a little.
const ERROR_MARGIN: f64 = 0.15;

/// What is wrong with the presets in a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// A step of accuracy takes no more time than the one before it.
    TimeFalls {
        /// The two presets and their ms.
        pair: [(Preset, f64); 2],
    },
    /// A step of accuracy has no less error than the one before it.
    ErrorRises {
        /// The two presets and their errors.
        pair: [(Preset, f64); 2],
    },
    /// The world does not come out sound.
    Invalid {
        /// The preset.
        preset: Preset,
        /// What is wrong.
        faults: String,
    },
    /// Another setting is faster in every run, and as exact, and one of the two by a margin; not said of a preset that
    /// has next to no error.
    Beaten {
        /// The preset.
        preset: Preset,
        /// The other setting.
        by: String,
    },
}

impl fmt::Display for Trouble {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TimeFalls { pair: [(a, a_ms), (b, b_ms)] } => {
                write!(formatter, "`{}` → `{}`: the time falls, {a_ms:.3} → {b_ms:.3} ms", a.name(), b.name())
            }
            Self::ErrorRises { pair: [(a, a_error), (b, b_error)] } => {
                write!(formatter, "`{}` → `{}`: the error rises, {a_error:.5} → {b_error:.5}", a.name(), b.name())
            }
            Self::Invalid { preset, faults } => write!(formatter, "`{}` is not valid: {faults}", preset.name()),
            Self::Beaten { preset, by } => {
                write!(formatter, "`{}` is not on the front: {by} is faster and as exact", preset.name())
            }
        }
    }
}

/// Everything that is wrong with the presets among these rows. Only where the error is the liquid's they have to be on the
/// front: where it is the air's, what they spend on liquid buys nothing. `air_is_unseen` as for the front.
pub fn check(rows: &[Row], measure: ErrorMeasure, air_is_unseen: bool) -> Vec<Trouble> {
    let steps: Vec<(Preset, &Row)> = STEPS
        .into_iter()
        .filter_map(|preset| Some((preset, rows.iter().find(|row| row.setting.preset == Some(preset))?)))
        .collect();
    let mut troubles = Vec::new();
    for pair in steps.windows(2) {
        let [(a, cheap), (b, dear)] = [pair[0], pair[1]];
        if dear.ms <= cheap.ms {
            troubles.push(Trouble::TimeFalls { pair: [(a, cheap.ms), (b, dear.ms)] });
        }
        // Two errors that are both next to nothing are in order.
        if dear.error >= cheap.error && dear.error > NEGLIGIBLE {
            troubles.push(Trouble::ErrorRises { pair: [(a, cheap.error), (b, dear.error)] });
        }
    }
    for (preset, own) in steps {
        if !own.is_valid() {
            troubles.push(Trouble::Invalid { preset, faults: own.faults.join(", ") });
        } else if measure == ErrorMeasure::Density
            && let Some(other) = rows.iter().find(|other| beats_beyond_noise(other, own, air_is_unseen))
        {
            troubles.push(Trouble::Beaten { preset, by: other.setting.name.clone() });
        }
    }
    troubles
}

/// Whether a row beats another by more than their runs scatter.
fn beats_beyond_noise(row: &Row, other: &Row, air_is_unseen: bool) -> bool {
    let (a, b) = (point(row, air_is_unseen), point(other, air_is_unseen));
    row.is_valid()
        && other.error > NEGLIGIBLE
        && row.setting.threads == other.setting.threads
        && row.ms_range[1] < other.ms_range[0]
        && (a.ms <= (1.0 - TIME_MARGIN) * b.ms || a.error <= (1.0 - ERROR_MARGIN) * b.error)
        && a.error <= b.error
        && a.coarseness <= b.coarseness
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};

    fn ladder() -> Vec<Row> {
        [
            ("draft", 0.5, 0.03),
            ("fast", 0.8, 0.02),
            ("balanced", 1.0, 0.01),
            ("fine", 1.5, 0.005),
            ("reference", 9.0, 0.0),
        ]
        .map(|(name, ms, error)| row(name, ms, error))
        .into()
    }

    fn says(rows: &[Row]) -> Vec<String> {
        check(rows, ErrorMeasure::Density, false).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_ladder_is_in_order_and_classic_is_no_step_of_it() {
        let mut rows = ladder();
        rows.push(row("classic", 1.4, 0.3));
        assert_eq!(says(&rows), [""; 0]);
    }

    #[test]
    fn the_pair_that_is_out_of_order_is_named() {
        let mut rows = ladder();
        rows[2].error = 0.02;
        assert_eq!(says(&rows)[0], "`fast` → `balanced`: the error rises, 0.02000 → 0.02000");
        let mut rows = ladder();
        (rows[3].ms, rows[3].ms_range) = (0.9, [0.9, 0.9]);
        let found = says(&rows);
        assert_eq!(found[0], "`balanced` → `fine`: the time falls, 1.000 → 0.900 ms");
        assert_eq!(found[1], "`balanced` is not on the front: fine is faster and as exact");
    }

    #[test]
    fn errors_of_next_to_nothing_are_in_order() {
        let mut rows = ladder();
        (rows[3].error, rows[4].error) = (2e-5, 5e-5);
        assert_eq!(says(&rows), [""; 0]);
    }

    #[test]
    fn a_bad_buy_is_named_only_beyond_the_noise() {
        let mut rows = ladder();
        rows.push(row("2×3", 0.9, 0.01));
        assert_eq!(says(&rows), ["`balanced` is not on the front: 2×3 is faster and as exact"]);
        rows[2].ms_range = [0.85, 1.1];
        assert_eq!(says(&rows), [""; 0], "the runs overlap");
        rows[2].ms_range = [1.0, 1.0];
        (rows[5].ms, rows[5].ms_range, rows[5].error) = (0.97, [0.97, 0.97], 0.009);
        assert_eq!(says(&rows), [""; 0], "neither by a margin");
        rows[5].error = 0.008;
        assert_eq!(says(&rows).len(), 1, "exacter by a margin");
        (rows[5].ms, rows[5].ms_range) = (0.9, [0.9, 0.9]);
        let about_air = check(&rows_with(&rows, [1.0, 1.0]), ErrorMeasure::Air, false);
        assert_eq!(about_air, [], "where the air counts, the liquid's knobs are no bad buy");
        rows[5].faults.push("exploded".to_owned());
        rows[2].ms_range = [1.0, 1.0];
        assert_eq!(says(&rows), [""; 0], "what is not sound beats no one");
    }

    /// The rows with another spread of `balanced`.
    fn rows_with(rows: &[Row], ms_range: [f64; 2]) -> Vec<Row> {
        let mut rows = rows.to_vec();
        rows[2].ms_range = ms_range;
        rows
    }

    #[test]
    fn a_preset_that_comes_out_unsound_is_named() {
        let mut rows = ladder();
        rows[0].faults.push("mean density 0.900".to_owned());
        assert_eq!(says(&rows), ["`draft` is not valid: mean density 0.900"]);
    }
}
