//! A dam break against an experiment.

use crate::lab::{
    exam::{
        cases::falling::worst,
        finding::{Findings, Run, found},
        fit::between,
        set_up::{CaseSimulation, GRAVITY, SetUp},
    },
    stats,
};

pub(super) const RUNS: &[(&str, Run)] = &[("dam_break", |set_up| Box::pin(dam_break(set_up)))];

/// Particles of the scene's own spacing along the base.
pub(in crate::lab::exam) const DAM_COLUMNS: f64 = 71.0;

/// Front Z over T.
const FRONT: [(f64, f64); 10] = [
    (0.849, 1.245),
    (1.212, 1.443),
    (1.602, 1.884),
    (2.283, 2.689),
    (2.950, 3.728),
    (3.598, 4.528),
    (3.905, 4.999),
    (4.592, 5.841),
    (4.961, 6.271),
    (5.316, 6.717),
];

/// Height H at the wall over τ. (Over T it would fall faster than a stone.)
const HEIGHT: [(f64, f64); 14] = [
    (0.56, 0.94),
    (0.77, 0.89),
    (0.93, 0.83),
    (1.08, 0.78),
    (1.28, 0.72),
    (1.46, 0.67),
    (1.66, 0.61),
    (1.84, 0.56),
    (2.00, 0.50),
    (2.21, 0.44),
    (2.45, 0.39),
    (2.70, 0.33),
    (3.06, 0.28),
    (3.44, 0.22),
];

/// Times T over which the slope of the front is taken.
const FRONT_OVER: (f64, f64) = (1.602, 2.950);

async fn dam_break(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("dam_break", &[("columns", DAM_COLUMNS)])?;
    let base = DAM_COLUMNS * simulation.own_spacing();
    let per_second = (GRAVITY / base).sqrt();
    let (mut front, mut height) = (Vec::new(), Vec::new());
    while height.last().is_none_or(|(time, _)| *time < HEIGHT[HEIGHT.len() - 1].0) {
        simulation.tick().await;
        let time = simulation.seconds() * per_second;
        front.push((time * std::f64::consts::SQRT_2, simulation.matter().front().unwrap_or(f64::NAN) / base));
        height.push((time, at_wall(&simulation) / (2.0 * base)));
    }
    let (from, to) = FRONT_OVER;
    let apart = HEIGHT.iter().map(|(time, known)| at(&height, *time) - known);
    Ok(vec![
        found("slope of the front, dZ/dT", slope(&between(&FRONT, from, to)), slope(&between(&front, from, to))),
        found("height at the wall H, largest error", 0.0, worst(apart, 0.0)),
    ])
}

/// Z of the experiment after a time T; no number before the first and after the last reading.
pub(in crate::lab::exam) fn front(time: f64) -> f64 {
    at(&FRONT, time)
}

/// H of the experiment after a time τ, likewise.
pub(in crate::lab::exam) fn height(time: f64) -> f64 {
    at(&HEIGHT, time)
}

/// The value of a curve between two of its points.
fn at(curve: &[(f64, f64)], time: f64) -> f64 {
    let pair = curve.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&time));
    pair.map_or(f64::NAN, |pair| pair[0].1 + (pair[1].1 - pair[0].1) * (time - pair[0].0) / (pair[1].0 - pair[0].0))
}

fn slope(points: &[(f64, f64)]) -> f64 {
    stats::line(points).map_or(f64::NAN, |(slope, _)| slope)
}

/// Height of the liquid at the left wall, m: how far up the particles within six spacings of it follow each other
/// without a gap of two. What was splashed higher does not count.
fn at_wall(simulation: &CaseSimulation) -> f64 {
    let particles = simulation.particles();
    let near = particles.x.iter().zip(&particles.y).filter(|(x, _)| **x < 6.0);
    let mut heights: Vec<f64> = near.map(|(_, y)| f64::from(*y)).collect();
    heights.sort_unstable_by(f64::total_cmp);
    let top = heights.iter().fold(0.0, |top, &y| if y - top < 2.0 { y } else { top });
    (top + 0.5) * simulation.spacing()
}
