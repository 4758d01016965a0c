//! curve.svg and curve.png: error against time, both logarithmic.

use super::{
    design::Setting,
    row::{NEGLIGIBLE, Row},
    summary::Subject,
};
use crate::lab::{
    machine::processor,
    plot::{Axis, Chart, Look, Naming, Point, Series},
};

/// Largest error that is shown.
const MOST_ERROR: f64 = 1.0;

/// The curve: the front, the presets by their names, all other settings faint.
pub fn chart(subject: &Subject, rows: &[Row]) -> Chart {
    let own = |row: &&Row| row.setting.threads == subject.threads;
    let is_preset = |row: &&Row| row.setting.preset.is_some();
    let mut front: Vec<&Row> = rows.iter().filter(own).filter(|row| row.front).collect();
    front.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    let others = rows.iter().filter(own).filter(|row| !is_preset(row) && row.error.is_finite());
    let mut series = vec![
        Series::new("front", Look::Front, front.iter().map(|row| point(row))),
        // A point without a place between any two, so that no line joins them.
        Series::new("other settings", Look::Faint, others.flat_map(|row| [point(row), Point::new(f64::NAN, f64::NAN)]))
            .named(Naming::Legend),
    ];
    for row in rows.iter().filter(is_preset).filter(|row| row.error.is_finite()) {
        let Setting { name, .. } = &row.setting;
        let name = if row.is_valid() { name.clone() } else { format!("{name} (not valid)") };
        series.push(Series::new(name, Look::Scatter, [point(row)]).named(Naming::AtEnd));
    }
    let threads = if subject.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", subject.threads) };
    Chart {
        title: format!("{}: what accuracy costs", subject.scene),
        subtitle: format!("{}, {threads}", processor()),
        x: Axis::logarithmic("ms a tick"),
        y: y_axis(subject, rows),
        series,
    }
}

/// The errors that there are, but none beyond 1: a world that far off is not a little worse but another one.
fn y_axis(subject: &Subject, rows: &[Row]) -> Axis {
    let errors = || rows.iter().map(|row| row.error.max(NEGLIGIBLE)).filter(|error| error.is_finite());
    let low = errors().fold(MOST_ERROR, f64::min);
    let high = errors().fold(NEGLIGIBLE, f64::max).min(MOST_ERROR);
    Axis::logarithmic(subject.measure.title()).within(0.7 * low, 1.4 * high)
}

/// A row as a point; errors next to nothing stand at the lower edge.
fn point(row: &Row) -> Point {
    Point::new(row.ms, row.error.max(NEGLIGIBLE)).between_x(row.ms_range[0], row.ms_range[1])
}
