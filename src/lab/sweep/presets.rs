//! Whether the presets are what they claim: each more exact and more expensive than the one before, and none a bad buy.

use super::{
    error::ErrorMeasure,
    front::point,
    row::{NEGLIGIBLE, Row},
};
use crate::kernel::params::Preset;
use std::fmt;

/// The presets that are steps of accuracy, cheapest first.
pub const STEPS: [Preset; 5] = [Preset::Draft, Preset::Fast, Preset::Balanced, Preset::Fine, Preset::Reference];

/// A row beats another by a margin if it has this much less of time or of error, as a share, and no more of the other: what is
/// less than that nobody sees or pays for.
const MARGIN: f64 = 0.1;

/// Two means of runs are told apart if they differ by more than so many standard errors of their difference: by chance one
/// pair in twenty that are alike does.
const TOLD_APART: f64 = 2.0;

/// Whether the presets are in order in a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Order {
    /// These steps were not measured, and without all of them there is no order.
    NotJudged(Vec<Preset>),
    /// Each step costs more and is more exact than the one before it.
    Ok {
        /// The steps of which that can't be said, as they and the one before have next to no error.
        alike: Vec<String>,
        /// Whether it was also judged that no setting beats a preset by a margin.
        front: bool,
    },
    /// Everything that is wrong: a step takes no more time or has no less error than the one before it; a world does not
    /// come out sound; another setting is faster in every run and as exact, and one of the two by a margin (not said of a
    /// preset that has next to no error).
    NotOk(Vec<String>),
}

impl Order {
    /// What is wrong, in a line; `None` if the order is ok.
    pub fn complaint(&self) -> Option<String> {
        match self {
            Self::Ok { .. } => None,
            Self::NotJudged(missing) => {
                Some(format!("the order of the presets is not judged without {}", names(missing)))
            }
            Self::NotOk(troubles) => Some(format!("the presets are out of order: {}", troubles.join(", "))),
        }
    }
}

/// A paragraph in Markdown, and a list of what is wrong.
impl fmt::Display for Order {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotJudged(missing) => {
                writeln!(
                    formatter,
                    "Order: not judged. It takes all of {}; not measured: {}.",
                    names(&STEPS),
                    names(missing)
                )
            }
            Self::NotOk(troubles) => {
                writeln!(formatter, "Order: not ok.\n")?;
                troubles.iter().try_for_each(|trouble| writeln!(formatter, "- {trouble}"))
            }
            Self::Ok { alike, front } => {
                let whole = "Order: ok. Each preset costs more and is more exact than the one before it";
                if alike.is_empty() {
                    let front = if *front { ", and no setting beats it by a margin" } else { "" };
                    return writeln!(formatter, "{whole}{front}.");
                }
                let is_judged = *front && alike.len() + 1 < STEPS.len();
                let front = if is_judged { " No setting beats one with a larger error by a margin." } else { "" };
                writeln!(
                    formatter,
                    "{whole}, but where both err by less than {NEGLIGIBLE}: {}.{front}",
                    alike.join(", ")
                )
            }
        }
    }
}

fn names(presets: &[Preset]) -> String {
    presets.iter().map(|preset| format!("`{}`", preset.name())).collect::<Vec<_>>().join(", ")
}

/// What these rows say of the presets. Only where the error is the liquid's they have to be on the front: where it is the
/// air's, what they spend on liquid buys nothing. `air_is_unseen` as for the front.
pub fn judge(rows: &[Row], measure: ErrorMeasure, air_is_unseen: bool) -> Order {
    let find = |preset: Preset| rows.iter().find(|row| row.setting.preset == Some(preset));
    let missing: Vec<Preset> = STEPS.into_iter().filter(|preset| find(*preset).is_none()).collect();
    if !missing.is_empty() {
        return Order::NotJudged(missing);
    }
    let steps: Vec<(Preset, &Row)> = STEPS.into_iter().filter_map(|preset| Some((preset, find(preset)?))).collect();
    let (mut troubles, mut alike) = (Vec::new(), Vec::new());
    for pair in steps.windows(2) {
        let [(a, cheap), (b, costly)] = [pair[0], pair[1]].map(|(preset, row)| (preset.name(), row));
        // Density errors are shares of the run's own spacing: where it differs, the true error alone can tell.
        let is_as_fine = cheap.setting.detail() == costly.setting.detail();
        // Two errors that are both next to nothing can't be told apart, nor can times then that are within the margin: the
        // same work was done.
        let as_exact = is_as_fine && cheap.error.max(costly.error) <= NEGLIGIBLE;
        let in_time = as_exact && (costly.ms / cheap.ms - 1.0).abs() < MARGIN;
        if as_exact {
            let time = if in_time { " and takes as long" } else { "" };
            alike.push(format!("`{b}` is as exact as `{a}`{time}"));
        } else if is_as_fine {
            let chance = by_chance(cheap.error_scatter, costly.error_scatter);
            let [from, to] = [cheap.error, costly.error];
            if to >= from + chance {
                troubles.push(format!("`{a}` → `{b}`: the error rises, {from:.5} → {to:.5}"));
            } else if to > from - chance {
                troubles.push(format!(
                    "`{a}` → `{b}`: the error falls by no more than it may by chance ({chance:.5}), {from:.5} → {to:.5}"
                ));
            }
        }
        // By so much two true errors may differ that are the same.
        let floor =
            2.0 * cheap.found.floor.unwrap_or(0.0) + by_chance(cheap.true_error_scatter, costly.true_error_scatter);
        if let Some((from, to)) = cheap.true_error().zip(costly.true_error()).filter(|(from, to)| *to > from + floor) {
            troubles.push(format!("`{a}` → `{b}`: the true error rises, {from:.5} → {to:.5}"));
        }
        if costly.ms <= cheap.ms && !in_time {
            troubles.push(format!("`{a}` → `{b}`: the time falls, {:.3} → {:.3} ms", cheap.ms, costly.ms));
        }
    }
    let front = measure == ErrorMeasure::Density;
    for (preset, own) in steps {
        if !own.is_valid() {
            troubles.push(format!("`{}` is not valid: {}", preset.name(), own.faults.join(", ")));
        } else if front && let Some(other) = rows.iter().find(|other| beats_beyond_noise(other, own, air_is_unseen)) {
            let (name, other) = (preset.name(), &other.setting.name);
            troubles.push(format!("`{name}` is not on the front: {other} is faster and as exact"));
        }
    }
    if troubles.is_empty() { Order::Ok { alike, front } } else { Order::NotOk(troubles) }
}

/// By how much the means of two rows may differ by chance, as far as their runs tell; nothing is known of single runs.
fn by_chance(a: Option<f64>, b: Option<f64>) -> f64 {
    TOLD_APART * a.unwrap_or(0.0).hypot(b.unwrap_or(0.0))
}

/// Whether a row beats another by more than their runs scatter.
fn beats_beyond_noise(row: &Row, other: &Row, air_is_unseen: bool) -> bool {
    let (a, b) = (point(row, air_is_unseen), point(other, air_is_unseen));
    let chance = by_chance(row.error_scatter, other.error_scatter);
    row.is_valid()
        && other.error > NEGLIGIBLE
        && row.setting.threads == other.setting.threads
        && row.setting.detail() == other.setting.detail()
        && row.ms_range[1] < other.ms_range[0]
        && a.error <= b.error
        && (a.ms <= (1.0 - MARGIN) * b.ms || a.error <= (1.0 - MARGIN) * b.error - chance)
        && a.coarseness <= b.coarseness
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};
    use crate::lab::coarse::Distance;

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
        match judge(rows, ErrorMeasure::Density, false) {
            Order::NotOk(troubles) => troubles,
            Order::Ok { front: true, .. } => Vec::new(),
            order => panic!("{order}"),
        }
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
    fn what_may_be_chance_is_no_step() {
        let with_scatter = |scatter: f64| {
            let mut rows = ladder();
            rows[3].error = 0.0;
            (rows[1].error_scatter, rows[2].error_scatter) = (Some(scatter), Some(scatter));
            says(&rows)
        };
        // `fast` and `balanced` differ by 0.01: 2 √2 standard errors of each are more from 0.00354 on.
        assert_eq!(with_scatter(0.0035), [""; 0]);
        let found = with_scatter(0.0036);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(
            found[0].contains("`fast` → `balanced`: the error falls by no more than it may by chance"),
            "{found:?}"
        );
        let mut rows = ladder();
        (rows[2].error, rows[1].error_scatter) = (0.05, Some(0.001));
        assert_eq!(says(&rows)[0], "`fast` → `balanced`: the error rises, 0.02000 → 0.05000");
    }

    #[test]
    fn errors_of_next_to_nothing_are_in_order_but_not_called_more_exact() {
        let order = |rows: &[Row]| judge(rows, ErrorMeasure::Density, false).to_string();
        let mut rows = ladder();
        assert_eq!(
            order(&rows),
            "Order: ok. Each preset costs more and is more exact than the one before it, and no setting beats it by a margin.\n"
        );
        (rows[2].error, rows[3].error) = (2e-5, 5e-5);
        assert_eq!(
            order(&rows),
            "Order: ok. Each preset costs more and is more exact than the one before it, but where both err by less than 0.001: \
             `fine` is as exact as `balanced`. No setting beats one with a larger error by a margin.\n"
        );
        rows[3].ms = 1.05;
        assert!(order(&rows).contains("`fine` is as exact as `balanced` and takes as long."), "{}", order(&rows));
        rows[3].ms = 0.85;
        assert_eq!(says(&rows), ["`balanced` → `fine`: the time falls, 1.000 → 0.850 ms"]);
    }

    #[test]
    fn a_true_error_that_rises_beyond_the_floor_is_named_and_alone_tells_runs_of_another_detail_apart() {
        let mut rows = ladder();
        for (row, truth) in rows.iter_mut().zip([0.020, 0.021, 0.018, 0.018, 0.004]) {
            row.found.floor = Some(0.001);
            row.found.accuracy.distance = Some(Distance { share: Some(truth), ..Distance::default() });
        }
        rows[4].error = 0.5;
        assert_eq!(says(&rows), [""; 0], "within the floor, and of another spacing");
        rows[4].found.accuracy.distance = Some(Distance { share: Some(0.05), ..Distance::default() });
        assert_eq!(says(&rows), ["`fine` → `reference`: the true error rises, 0.01800 → 0.05000"]);
    }

    #[test]
    fn without_all_steps_there_is_no_order() {
        let order = judge(&ladder()[..1], ErrorMeasure::Density, false);
        assert_eq!(
            order.to_string(),
            "Order: not judged. It takes all of `draft`, `fast`, `balanced`, `fine`, `reference`; not measured: `fast`, \
             `balanced`, `fine`, `reference`.\n"
        );
        assert!(order.complaint().unwrap().contains("not judged"));
        let classic = judge(&[row("classic", 1.4, 0.3)], ErrorMeasure::Density, false);
        assert_eq!(classic, Order::NotJudged(STEPS.to_vec()));
    }

    #[test]
    fn the_complaint_names_all_that_is_wrong_in_a_line() {
        let mut rows = ladder();
        assert_eq!(judge(&rows, ErrorMeasure::Density, false).complaint(), None);
        rows[1].error = 0.04;
        rows[0].faults.push("mean density 0.900".to_owned());
        assert_eq!(
            judge(&rows, ErrorMeasure::Density, false).complaint().unwrap(),
            "the presets are out of order: `draft` → `fast`: the error rises, 0.03000 → 0.04000, `draft` is not valid: mean \
             density 0.900"
        );
    }

    #[test]
    fn a_bad_buy_is_named_only_beyond_the_noise() {
        let mut rows = ladder();
        rows.push(row("2×3", 0.9, 0.01));
        assert_eq!(says(&rows), ["`balanced` is not on the front: 2×3 is faster and as exact"]);
        rows[2].ms_range = [0.85, 1.1];
        assert_eq!(says(&rows), [""; 0], "the runs overlap");
        rows[2].ms_range = [1.0, 1.0];
        (rows[5].ms, rows[5].ms_range, rows[5].error) = (0.97, [0.97, 0.97], 0.0095);
        assert_eq!(says(&rows), [""; 0], "neither by a margin");
        rows[5].error = 0.0085;
        assert_eq!(says(&rows).len(), 1, "more exact by a margin");
        (rows[5].ms, rows[5].ms_range) = (0.9, [0.9, 0.9]);
        let about_air = judge(&rows_with(&rows, [1.0, 1.0]), ErrorMeasure::Air, false);
        let ok = Order::Ok { alike: Vec::new(), front: false };
        assert_eq!(about_air, ok, "where the air counts, the liquid's knobs are no bad buy");
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
