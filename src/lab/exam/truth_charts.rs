//! The pictures of what truth costs: true error against particles, beside others, and against time, with the front.

use super::truth::{Beside, Outcome, particles};
use crate::{
    kernel::params::Preset,
    lab::{
        chart::{Axis, Chart, Look, Point, Series},
        machine::processor,
    },
};

const ERROR: &str = "share of the liquid elsewhere than in a converged run";

/// Error against particles, and error against time.
pub fn charts(outcomes: &[Outcome], beside: &[Beside]) -> [Chart; 2] {
    let chart = |title: &str, subtitle: String, x: &str, series: Vec<Series>| Chart {
        title: title.to_owned(),
        subtitle,
        x: Axis::logarithmic(x),
        y: Axis::logarithmic(ERROR),
        series,
    };
    let others = beside.iter().map(|program| {
        let points = program.figures.iter();
        let points = points.map(|figure| Point::new(f64::from(particles(figure.columns)), figure.error()));
        Series::new(program.name.as_str(), Look::Faint, points)
    });
    // A quality of a detail of its own has more particles than the scene asks for.
    let count = |outcome: &Outcome| f64::from(particles(outcome.columns)) * outcome.preset.detail().powi(2);
    let by_count = others.chain(of_presets(outcomes, count)).collect();
    let front = Series::new("front", Look::Front, front(outcomes));
    let by_time = [front].into_iter().chain(of_presets(outcomes, |outcome| outcome.ms)).collect();
    [
        chart("dam_break: true error against particles", "the same on every machine".to_owned(), "particles", by_count),
        chart("dam_break: what truth costs", format!("{}, 1 thread", processor()), "ms up to T = 2.5", by_time),
    ]
}

/// A series for each quality, from the coarsest to the finest.
fn of_presets(outcomes: &[Outcome], x: impl Fn(&Outcome) -> f64 + Copy) -> impl Iterator<Item = Series> {
    Preset::ALL.into_iter().map(move |preset| {
        let own = outcomes.iter().filter(move |outcome| outcome.preset == preset);
        Series::new(preset.name(), Look::Line, own.map(|outcome| Point::new(x(outcome), outcome.error)))
    })
}

/// What nothing else beats in time and error, fastest first.
fn front(outcomes: &[Outcome]) -> Vec<Point> {
    let mut sorted: Vec<&Outcome> = outcomes.iter().collect();
    sorted.sort_by(|a, b| a.ms.total_cmp(&b.ms));
    let mut least = f64::INFINITY;
    sorted.retain(|outcome| {
        let is_better = outcome.error < least;
        least = least.min(outcome.error);
        is_better
    });
    sorted.into_iter().map(|outcome| Point::new(outcome.ms, outcome.error)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::exam::truth::Figure;

    #[test]
    fn the_front_only_falls_and_others_stand_beside() {
        let outcome = |preset, columns, error, ms| Outcome { preset, columns, error, floor: 0.0, ms };
        let outcomes = [
            outcome(Preset::Draft, 18, 0.02, 3.0),
            outcome(Preset::Fine, 18, 0.03, 6.0),
            outcome(Preset::Reference, 18, 0.01, 30.0),
        ];
        let figures = vec![Figure { columns: 71, percent: [1.0, 2.0, 3.0] }];
        let other = Beside { name: "another".into(), source: "somebody".into(), figures };
        let [by_count, by_time] = charts(&outcomes, &[other]);
        assert_eq!(by_count.series[0].name, "another");
        assert_eq!(by_count.series[0].points, [Point::new(10_082.0, 0.02)]);
        assert_eq!(by_count.series.last().unwrap().points, [Point::new(4.0 * 648.0, 0.01)], "four times the particles");
        assert_eq!(
            by_time.series[0].points,
            [Point::new(3.0, 0.02), Point::new(30.0, 0.01)],
            "fine is slower and worse"
        );
    }
}
