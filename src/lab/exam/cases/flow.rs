//! Flows under gravity: a dam break, communicating vessels, outflow under a gate.

use crate::{
    lab::{
        exam::{
            case::{Findings, Run, share, within},
            cases::falling::worst,
            fit::{between, falls_to},
            set_up::{CaseSimulation, GRAVITY, SetUp},
        },
        stats,
    },
    scene::SceneError,
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("dam_break", |set_up| Box::pin(dam_break(set_up))),
    ("vessels", |set_up| Box::pin(vessels(set_up))),
    ("orifice", |set_up| Box::pin(orifice(set_up))),
];

/// Particles of the scene's own spacing along the base.
const DAM_COLUMNS: f64 = 71.0;

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
        share(
            "slope of the front, dZ/dT",
            "",
            slope(&between(&FRONT, from, to)),
            slope(&between(&front, from, to)),
            0.06,
        ),
        within("height at the wall H, largest error", "", 0.0, worst(apart, 0.0), 0.03),
    ])
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

/// Widths of the tanks, of the wall and of the slot, m.
const LEFT_TANK: f64 = 7.0;
const RIGHT_TANK: f64 = 4.4;
const WALL: f64 = 0.6;
const SLOT: f64 = 0.8;
/// Levels at the start, m.
const LEVELS: (f64, f64) = (5.0, 1.5);
/// Contraction of a jet out of a slot.
const CONTRACTION: f64 = PI / (PI + 2.0);

async fn vessels(set_up: SetUp) -> Findings {
    let blueprint = set_up.blueprint("communicating_vessels", &[("left", LEVELS.0), ("right", LEVELS.1)])?;
    let mut simulation = set_up.simulation(blueprint);
    simulation.run(13.0).await;
    let (mut left, mut right) = (0.0, 0.0);
    for look in 0..LOOKS {
        simulation.run(1.0 / 6.0).await;
        let tops = simulation.matter().column_tops();
        // The weights add up to 1.
        let weight = 2.0 / f64::from(LOOKS) * (PI * (f64::from(look) + 0.5) / f64::from(LOOKS)).sin().powi(2);
        left += weight * level(&tops, 0.0, LEFT_TANK, simulation.spacing());
        right += weight * level(&tops, LEFT_TANK + WALL, LEFT_TANK + WALL + RIGHT_TANK, simulation.spacing());
    }
    let volume = LEFT_TANK * LEVELS.0 + RIGHT_TANK * LEVELS.1;
    Ok(vec![
        within("difference of the levels", "m", 0.0, left - right, 0.5 * simulation.spacing()),
        share(
            "level",
            "m",
            volume / (LEFT_TANK + RIGHT_TANK),
            (LEFT_TANK * left + RIGHT_TANK * right) / (LEFT_TANK + RIGHT_TANK),
            0.02,
        ),
        share("time to half the difference", "s", levelling_theory(), time_to_half(&set_up).await?, 0.15),
    ])
}

/// Looks at the levels, a sixth of a second apart.
const LOOKS: u32 = 78;
/// Half of the difference at the start, m.
const HALF: f64 = 0.5 * (LEVELS.0 - LEVELS.1);

/// When half of the difference is gone in the finer tanks, s.
async fn time_to_half(set_up: &SetUp) -> Result<f64, SceneError> {
    let mut simulation = set_up.open("vessels", &[])?;
    let mut differences = vec![(0.0, LEVELS.0 - LEVELS.1)];
    while simulation.seconds() < 10.0 && differences.last().is_some_and(|(_, difference)| *difference > HALF) {
        simulation.tick().await;
        differences.push((simulation.seconds(), filled(&simulation)));
    }
    Ok(falls_to(&differences, HALF).unwrap_or(f64::NAN))
}

/// Difference of the levels by the number of particles in the tanks, m: what splashes does not matter.
fn filled(simulation: &CaseSimulation) -> f64 {
    let d = simulation.spacing();
    let count = |from: f64, to: f64| {
        let inside = |x: &&f32| (from..to).contains(&(f64::from(**x) * d));
        simulation.particles().x.iter().filter(inside).count() as f64 * d * d / (to - from)
    };
    count(0.0, LEFT_TANK) - count(LEFT_TANK + WALL, LEFT_TANK + WALL + RIGHT_TANK)
}

/// Median height of the columns between two places (m), m.
fn level(tops: &[f64], from: f64, to: f64, d: f64) -> f64 {
    let mut tops = tops[(from / d).round() as usize..(to / d).round() as usize].to_vec();
    stats::quantile(&mut tops, 0.5).map_or(f64::NAN, |y| (y + 0.5) * d)
}

/// Time to half the difference by the theory, s.
fn levelling_theory() -> f64 {
    let (step, mut t, mut speed, mut difference) = (1e-4, 0.0, 0.0_f64, LEVELS.0 - LEVELS.1);
    // The water on both sides of the slot that moves with it adds about its height to its length.
    let length = WALL + SLOT;
    while difference > HALF && t < 100.0 {
        let jet = speed / CONTRACTION;
        speed += step * (GRAVITY * difference - 0.5 * jet * jet) / length;
        difference -= step * speed * SLOT * (1.0 / LEFT_TANK + 1.0 / RIGHT_TANK);
        t += step;
    }
    t
}

/// Width of the tank and height of the opening, m.
const OUTFLOW_TANK: f64 = 4.0;
const OPENING: f64 = 0.8;
/// Levels between which it is timed, m.
const OUTFLOW_FROM: f64 = 3.6;
const OUTFLOW_TO: f64 = 2.4;

async fn orifice(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("orifice", &[])?;
    let mut curve = Vec::new();
    while simulation.seconds() < 10.0 && curve.last().is_none_or(|(_, level)| *level > OUTFLOW_TO) {
        simulation.tick().await;
        let d = simulation.spacing();
        let left = simulation.particles().x.iter().filter(|x| f64::from(**x) * d < OUTFLOW_TANK).count();
        curve.push((simulation.seconds(), left as f64 * d * d / OUTFLOW_TANK));
    }
    let got =
        falls_to(&curve, OUTFLOW_TO).zip(falls_to(&curve, OUTFLOW_FROM)).map_or(f64::NAN, |(end, start)| end - start);
    Ok(vec![share("time from 3.6 m to 2.4 m", "s", outflow_theory(), got, 0.10)])
}

/// The time by the theory, s.
fn outflow_theory() -> f64 {
    let steps = 10_000;
    let step = (OUTFLOW_FROM - OUTFLOW_TO) / f64::from(steps);
    let jet = CONTRACTION * OPENING;
    (0..steps)
        .map(|k| OUTFLOW_FROM - (f64::from(k) + 0.5) * step)
        .map(|h| step * OUTFLOW_TANK / (jet * (2.0 * GRAVITY * h / (1.0 + jet / h)).sqrt()))
        .sum()
}
