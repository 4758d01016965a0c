//! The pictures: time against particles, error against particles, error against time.

use crate::lab::{
    chart::{Axis, Chart, Look, Point, Series},
    scaling::{
        beside::{Beside, Figure},
        measure::Row,
        table::settings,
    },
};

/// Names of the files and what they show. `subtitle` says where and when.
pub fn charts(rows: &[Row], beside: &[Beside], subtitle: &str) -> Vec<(&'static str, Chart)> {
    let chart = |title: &str, y: Axis, series: [Vec<Series>; 2]| Chart {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        x: Axis::logarithmic("particles"),
        y,
        series: series.concat(),
    };
    let times = [
        others(beside, |figure| Some(figure.ms)),
        ours(rows, |row| Some(Point { y_range: Some(row.ms_range[0]), ..Point::new(row.particles as f64, row.ms[0]) })),
    ];
    let time =
        chart("Time of a tick against particles, one thread", Axis::logarithmic("time of a tick of 1/60 s, ms"), times);
    let errors = [
        others(beside, |figure| figure.error_p99),
        ours(rows, |row| Some(Point::new(row.particles as f64, row.error_p99?))),
    ];
    let error = chart("Density error against particles", Axis::logarithmic("density error, 99th percentile"), errors);
    let mut charts = vec![("scaling-time", time), ("scaling-error", error)];
    let all = rows.iter().flat_map(|row| &row.threads).copied().max().unwrap_or(1);
    if all > 1 {
        let series = [Vec::new(), ours(rows, |row| Some(Point::new(row.particles as f64, row.speedup?)))];
        let axis = Axis::linear("one thread's time over that of all");
        charts.push(("scaling-threads", chart(&format!("Speed-up of {all} threads against particles"), axis, series)));
    }
    charts
}

/// A series for each setting, in the order of the rows.
fn ours(rows: &[Row], point: impl Fn(&Row) -> Option<Point>) -> Vec<Series> {
    let names = settings(rows);
    let points = |name: &str| rows.iter().filter(|row| row.setting == name).filter_map(&point).collect::<Vec<_>>();
    // "classic, 4 substeps" is a variant of "classic".
    let is_variant =
        |name: &str| names.iter().any(|other| name.strip_prefix(other).is_some_and(|rest| rest.starts_with(',')));
    let look = |name: &str| if is_variant(name) { Look::Dashed } else { Look::Line };
    names.iter().map(|name| Series::new(*name, look(name), points(name))).collect()
}

/// A series for each other program.
fn others(beside: &[Beside], value: impl Fn(&Figure) -> Option<f64>) -> Vec<Series> {
    let point = |figure: &Figure| Some(Point::new(figure.particles as f64, value(figure)?));
    let series =
        |program: &Beside| Series::new(program.name.as_str(), Look::Faint, program.figures.iter().filter_map(point));
    beside.iter().map(series).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::scaling::table::tests::row;

    #[test]
    fn charts_show_every_setting_and_every_program() {
        let rows =
            [row("a", 1000, [1.0, 0.6], 0.1), row("a, twice", 1000, [2.0, 1.1], 0.05), row("b", 1000, [3.0, 2.0], 0.0)];
        let figure = Figure { particles: 1000, ms: 9.0, error_mean: None, error_p99: None };
        let beside = [Beside { name: "another".to_owned(), figures: vec![figure] }];
        let charts = charts(&rows, &beside, "here and now");
        assert_eq!(
            charts.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
            ["scaling-time", "scaling-error", "scaling-threads"]
        );
        let series = &charts[0].1.series;
        let names: Vec<&str> = series.iter().map(|series| series.name.as_str()).collect();
        assert_eq!(names, ["another", "a", "a, twice", "b"]);
        let looks: Vec<Look> = series.iter().map(|series| series.look).collect();
        assert_eq!(looks, [Look::Faint, Look::Line, Look::Dashed, Look::Line]);
        assert_eq!(series[1].points[0].y_range, Some([0.9, 1.1]));
    }
}
