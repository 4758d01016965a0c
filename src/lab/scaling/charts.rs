//! The pictures: time against particles, error against particles, error against time.

use crate::lab::{
    plot::{Axis, Chart, Look, Naming, Point, Series},
    scaling::{
        beside::{Beside, Figure},
        measure::Row,
    },
};

/// Names of all charts that there may be.
pub const CHARTS: [&str; 3] = ["scaling-time", "scaling-error", "scaling-threads"];

/// Names of the files and what they show. `subtitle` says where and when.
pub fn charts(rows: &[Row], beside: &[Beside], subtitle: &str) -> Vec<(&'static str, Chart)> {
    let particles = || Axis::logarithmic("particles");
    let chart = |title: &str, x: Axis, y: Axis, series| Chart {
        title: title.to_owned(),
        subtitle: subtitle.to_owned(),
        x,
        y,
        series,
    };
    let time = Axis::logarithmic("time of a tick of 1/60 s, ms");
    let error = Axis::logarithmic("density error, 99th percentile");
    let all = rows.iter().flat_map(|row| &row.threads).copied().max().unwrap_or(1);
    let mut charts = vec![
        (
            CHARTS[0],
            chart(
                "Time of a tick against particles, one thread",
                particles(),
                time.clone(),
                [
                    others(beside, |figure| Some((figure.particles as f64, figure.ms))),
                    ours(rows, |row| {
                        let [least, most] = row.ms_range[0];
                        Some(Point::new(row.particles as f64, row.ms[0]).between_y(least, most))
                    }),
                ]
                .concat(),
            ),
        ),
        (
            CHARTS[1],
            chart(
                "Density error against particles",
                particles(),
                error.clone(),
                [
                    others(beside, |figure| Some((figure.particles as f64, figure.error_p99?))),
                    ours(rows, |row| Some(Point::new(row.particles as f64, row.error_p99?))),
                ]
                .concat(),
            ),
        ),
    ];
    if all > 1 {
        let title = format!("Speed-up of {all} threads against particles");
        let series = ours(rows, |row| Some(Point::new(row.particles as f64, row.speedup?)));
        charts.push((
            "scaling-threads",
            chart(&title, particles(), Axis::linear("one thread's time over that of all"), series),
        ));
    }
    charts
}

/// A series for each setting, in the order of the rows.
fn ours(rows: &[Row], point: impl Fn(&Row) -> Option<Point>) -> Vec<Series> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.setting) {
            names.push(row.setting);
        }
    }
    let of = |name: &str| rows.iter().filter(|row| row.setting == name).filter_map(&point).collect::<Vec<_>>();
    let variant =
        |name: &str| names.iter().position(|other| name.strip_prefix(other).is_some_and(|rest| rest.starts_with(',')));
    let mut hue = 0;
    let mut hues: Vec<usize> = Vec::new();
    for name in &names {
        hues.push(variant(name).map_or(hue, |own| hues[own]));
        hue += usize::from(variant(name).is_none());
    }
    names
        .iter()
        .zip(hues)
        .map(|(name, hue)| {
            let look = if variant(name).is_some() { Look::Dashed } else { Look::Line };
            Series::new(*name, look, of(name)).coloured(hue).named(Naming::Legend)
        })
        .collect()
}

fn others(beside: &[Beside], point: impl Fn(&Figure) -> Option<(f64, f64)>) -> Vec<Series> {
    let series = |program: &Beside| {
        let points = program.figures.iter().filter_map(&point).map(|(x, y)| Point::new(x, y));
        Series::new(program.name.as_str(), Look::Faint, points)
    };
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
        let time = charts[0].1.svg();
        for name in ["\na\n", "\na, twice\n", "\nb\n", "\nanother\n", "\nhere and now\n"] {
            assert_eq!(time.matches(name).count(), 1, "{name}");
        }
        let series = &charts[0].1.series;
        assert_eq!((series[1].hue, series[2].hue, series[2].look), (Some(0), Some(0), Look::Dashed));
        assert!(charts[1].1.svg().contains("1 value has no place"), "an error of 0 has no logarithm");
    }
}
