//! The true error in the summary: how far settings, coarse and fine, are from a converged run, and where time buys most
//! of it.

use super::row::Row;
use crate::{
    lab::{markdown, reference::CONVERGED_DETAIL},
    sim::numbers::fixed,
};

/// A row with its true error.
type Known<'a> = (&'a Row, f64);

/// The section, with the truest setting for each of these times (ms a tick); nothing where there is no liquid to
/// compare.
pub(super) fn text(rows: &[&Row], times: &[f64]) -> String {
    let mut known: Vec<Known> = rows.iter().filter_map(|row| Some((*row, row.true_error()?))).collect();
    if known.is_empty() {
        return String::new();
    }
    known.sort_by(|a, b| a.0.ms.total_cmp(&b.0.ms));
    let floor = known.iter().find_map(|(row, _)| row.found.floor);
    let below = floor.map_or(String::new(), |floor| {
        format!(
            " That run may itself be off by {} of the liquid: what differs by less is not told apart.",
            fixed(Some(floor), 5)
        )
    });
    format!(
        "## True error\n\nShare of the liquid that stands elsewhere than in a converged run (`fine` at {CONVERGED_DETAIL} times the \
         detail and the substeps, the mean of two), on cells of 8 spacings of the scene's own.{below}\n\n{}\n{}\n{}",
        budgets(&known, times),
        details(&known),
        advice(&known, floor.unwrap_or(0.0))
    )
}

fn budgets(known: &[Known], times: &[f64]) -> String {
    let lines = times.iter().map(|budget| {
        let fitting = known.iter().filter(|(row, _)| row.is_valid() && row.ms <= *budget);
        let best = fitting.min_by(|a, b| a.1.total_cmp(&b.1));
        best.map_or_else(
            || format!("{budget} | none | – | –"),
            |(row, error)| format!("{budget} | {} | {:.2} | {error:.5}", row.title(), row.ms),
        )
    });
    markdown::rows(">at most, ms | truest setting | >ms | >true error", lines)
}

/// The presets at each detail.
fn details(known: &[Known]) -> String {
    let of_details = known.iter().filter(|(row, _)| row.setting.preset.is_some() || row.setting.asked_detail != 1.0);
    let lines = of_details.map(|(row, error)| {
        let front = if row.true_front { "yes" } else { "no" };
        format!(
            "{} | {} | {} | {:.3} | {error:.5} | {} | {front}",
            row.title(),
            row.setting.detail(),
            row.found.particles,
            row.ms,
            fixed(row.found.accuracy.density_error_mean, 5)
        )
    });
    let headings =
        "setting | >detail | >particles | >ms | >true error | >mean density error | on the front of the true error";
    markdown::rows(headings, lines)
}

/// From each step of the front the next one whose error is less by more than the floor.
fn advice(known: &[Known], floor: f64) -> String {
    let front: Vec<&Known> = known.iter().filter(|(row, _)| row.true_front).collect();
    let lines = front.iter().enumerate().filter_map(|(k, (from, error))| {
        let gain = |(row, truer): &&&Known| (error - truer) / (row.ms - from.ms);
        let truer = front[k + 1..].iter().filter(|(_, truer)| error - truer > floor);
        let (to, truer) = truer.max_by(|a, b| gain(a).total_cmp(&gain(b)))?;
        Some(format!("{} | {:.3} | {} | {:.3} | {:.2}", from.title(), from.ms, to.title(), to.ms, truer / error))
    });
    let table = markdown::rows("from | >ms | the next millisecond buys most at | >ms | >error left", lines);
    format!("Along the front of the true error:\n\n{table}")
}

#[cfg(test)]
mod tests {
    use super::{super::row::tests::row, *};
    use crate::lab::coarse::Distance;

    /// A row with this true error.
    fn known(name: &str, detail: f64, ms: f64, error: f64) -> Row {
        let mut row = row(name, ms, 0.01);
        (row.setting.asked_detail, row.true_front) = (detail, true);
        row.found.floor = Some(0.001);
        row.found.accuracy.distance = Some(Distance { share: Some(error), ..Distance::default() });
        row
    }

    #[test]
    fn the_truest_that_fits_is_named_and_the_step_that_buys_most() {
        let rows = [
            known("draft", 1.0, 0.5, 0.02),
            known("draft, detail 2", 2.0, 2.5, 0.004),
            known("fine", 1.0, 1.3, 0.0195),
            known("fine, detail 2", 2.0, 6.0, 0.0035),
        ];
        let text = text(&rows.iter().collect::<Vec<_>>(), &[1.0, 4.0]);
        let text: String = text
            .split_inclusive('\n')
            .map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ") + "\n")
            .collect();
        for line in [
            "| 1 | `draft` | 0.50 | 0.02000 |",
            "| 4 | draft, detail 2 | 2.50 | 0.00400 |",
            "| `draft` | 0.500 | draft, detail 2 | 2.500 | 0.20 |",
            "off by 0.00100 of the liquid",
        ] {
            assert!(text.contains(line), "no {line} in\n{text}");
        }
        assert!(!text.contains("| draft, detail 2 | 2.500 | fine"), "what the floor hides buys nothing:\n{text}");
        assert_eq!(super::text(&[&row("draft", 1.0, 0.1)], &[1.0]), "", "nothing to compare");
    }
}
