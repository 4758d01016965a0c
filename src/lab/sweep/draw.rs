//! curve.svg and curve.png: error against time, both logarithmic.

use super::{error::ErrorMeasure, row::Row, summary::Subject};
use crate::lab::{
    chart::{Axis, Chart, Look, Point, Series},
    machine::processor,
};

/// Largest error that is shown: a world that is further off has little in common with the reference.
const MOST_ERROR: f64 = 1.0;

/// Least density error that is shown; what has less stands there, too.
const LEAST_ERROR: f64 = 1e-5;

/// The curve: the front, the presets by their names, all other settings faint. Density errors are shares of a run's own
/// spacing, and compared at the same detail only: of other details there are the presets alone, on no front, and say which.
pub fn chart(subject: &Subject, rows: &[Row]) -> Chart {
    let own = rows.iter().filter(|row| row.setting.threads == subject.threads);
    let is_compared = |row: &&Row| subject.measure == ErrorMeasure::Air || row.setting.detail() == 1.0;
    let points = |rows: &[&Row]| rows.iter().filter_map(|row| point(subject, row)).collect::<Vec<_>>();
    let compared: Vec<&Row> = own.clone().filter(is_compared).collect();
    let (presets, others): (Vec<&Row>, Vec<&Row>) = own.partition(|row| row.setting.preset.is_some());
    let others: Vec<&Row> = others.into_iter().filter(is_compared).collect();
    let mut series = vec![
        Series::new("front", Look::Front, points(&lower_edge(&compared))),
        Series::new("other settings", Look::Cloud, points(&others)),
    ];
    for row in presets {
        let not_compared =
            if is_compared(&row) { String::new() } else { format!(" (detail {})", row.setting.detail()) };
        let not_valid = if row.is_valid() { "" } else { " (not valid)" };
        let name = format!("{}{not_compared}{not_valid}", row.setting.name);
        series.push(Series::new(name, Look::Scatter, point(subject, row)));
    }
    series.retain(|series| !series.points.is_empty());
    let threads = if subject.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", subject.threads) };
    let errors = || series.iter().flat_map(|series| &series.points).map(|point| point.y);
    let (low, high) = (errors().fold(MOST_ERROR, f64::min), errors().fold(LEAST_ERROR, f64::max));
    Chart {
        title: format!("{}: what accuracy costs", subject.scene),
        subtitle: format!("{}, {threads}", processor()),
        x: Axis::logarithmic("ms a tick"),
        y: Axis::logarithmic(subject.measure.title()).within(0.7 * low, 1.4 * high),
        series,
    }
}

/// The true error against time: its front, and the presets at each detail.
pub fn chart_of_truth(subject: &Subject, rows: &[Row]) -> Chart {
    let mut own: Vec<&Row> = rows.iter().filter(|row| row.setting.threads == subject.threads).collect();
    own.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    let point = |row: &Row| {
        let error = row.true_error().filter(|error| *error > 0.0)?;
        let x_range = Some(row.ms_range).filter(|[low, high]| low < high);
        Some(Point { x_range, ..Point::new(row.ms, error) })
    };
    let points = |wanted: &dyn Fn(&Row) -> bool| {
        own.iter().filter(|row| wanted(row)).filter_map(|row| point(row)).collect::<Vec<_>>()
    };
    let named = |row: &Row| row.setting.preset.is_some() || row.setting.asked_detail != 1.0;
    let mut details: Vec<f64> = own.iter().filter(|row| named(row)).map(|row| row.setting.detail()).collect();
    details.sort_by(f64::total_cmp);
    details.dedup();
    let mut series = vec![
        Series::new("front", Look::Front, points(&|row| row.true_front)),
        Series::new("other settings", Look::Cloud, points(&|row| !named(row))),
    ];
    series.extend(details.into_iter().map(|detail| {
        let of_it = points(&|row| named(row) && row.setting.detail() == detail);
        Series::new(format!("presets at detail {detail}"), Look::Scatter, of_it)
    }));
    series.retain(|series| !series.points.is_empty());
    Chart {
        title: format!("{}: what truth costs", subject.scene),
        subtitle: processor().to_owned(),
        x: Axis::logarithmic("ms a tick"),
        y: Axis::logarithmic("share of the liquid elsewhere than in a converged run"),
        series,
    }
}

/// The rows of the front of which none is faster and as exact, fastest first: what is left when only time and error
/// count.
fn lower_edge<'a>(rows: &[&'a Row]) -> Vec<&'a Row> {
    let mut front: Vec<&Row> = rows.iter().copied().filter(|row| row.front).collect();
    front.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    let mut least = f64::INFINITY;
    front.retain(|row| {
        let is_better = row.error < least;
        least = least.min(row.error);
        is_better
    });
    front
}

/// A row as a point with its spread; `None` where it has no place. A row without any distance
/// to the reference is the reference itself.
fn point(subject: &Subject, row: &Row) -> Option<Point> {
    let error = match subject.measure {
        ErrorMeasure::Density => row.error.max(LEAST_ERROR),
        ErrorMeasure::Air => Some(row.error).filter(|error| *error > 0.0)?,
    };
    let x_range = Some(row.ms_range).filter(|[low, high]| low < high);
    (row.error.is_finite() && error <= MOST_ERROR).then(|| Point { x_range, ..Point::new(row.ms, error) })
}

#[cfg(test)]
mod tests {
    use super::{
        super::row::tests::{row, subject},
        *,
    };

    #[test]
    fn every_sound_number_is_a_point_and_the_front_only_falls() {
        let mut rows = [
            row("draft", 0.5, 0.03),
            row("fine", 1.5, 0.0),
            row("2×1", 1.0, 0.05),
            row("wild", 0.4, 7.0),
            row("4×4", 3.0, f64::NAN),
        ];
        for k in [0, 1, 2] {
            rows[k].front = true;
        }
        rows[0].ms_range = [0.4, 0.6];
        let chart = chart(&subject(1), &rows);
        let of = |name: &str| {
            let found: Vec<&Point> =
                chart.series.iter().filter(|series| series.name == name).flat_map(|series| &series.points).collect();
            found.iter().map(|point| (point.x, point.y)).collect::<Vec<_>>()
        };
        assert_eq!(of("front"), [(0.5, 0.03), (1.5, 1e-5)], "2×1 is on the front only for its finer air");
        assert_eq!(of("other settings"), [(1.0, 0.05)]);
        assert_eq!(of("fine"), [(1.5, 1e-5)], "no error stands at the edge");
        let bars: usize =
            chart.series.iter().flat_map(|series| &series.points).filter(|point| point.x_range.is_some()).count();
        assert_eq!(bars, 2, "draft's own and the front's");
    }

    #[test]
    fn density_errors_of_other_details_stand_on_no_front() {
        let mut rows = [row("draft", 0.5, 0.03), row("draft, detail 0.5", 0.1, 0.01), row("reference", 9.0, 0.001)];
        rows[1].setting.asked_detail = 0.5;
        rows.iter_mut().for_each(|row| row.front = true);
        let chart = chart(&subject(1), &rows);
        let shown: Vec<(&str, usize)> =
            chart.series.iter().map(|series| (series.name.as_str(), series.points.len())).collect();
        assert_eq!(shown, [("front", 1), ("draft", 1), ("reference (detail 2)", 1)]);
    }

    #[test]
    fn the_reference_has_no_place_where_distance_to_it_counts() {
        let about_air = Subject { measure: ErrorMeasure::Air, ..subject(1) };
        let chart = chart(&about_air, &[row("reference", 9.0, 0.0), row("draft", 0.5, 0.4)]);
        assert_eq!(chart.series.iter().map(|series| series.points.len()).sum::<usize>(), 1);
    }
}
