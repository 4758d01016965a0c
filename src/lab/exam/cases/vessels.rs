//! Communicating vessels.

use crate::lab::{
    exam::{
        case::{Findings, share, within},
        fit::falls_to,
        set_up::{CaseSimulation, GRAVITY, SetUp},
    },
    stats,
};
use crate::scene::SceneError;
use std::f64::consts::PI;

/// Widths of the tanks, of the wall and of the slot, m.
const LEFT: f64 = 7.0;
const RIGHT: f64 = 4.4;
const WALL: f64 = 0.6;
const SLOT: f64 = 0.8;
/// Levels at the start, m.
const START: (f64, f64) = (5.0, 1.5);
/// Contraction of a jet out of a slot.
pub(super) const CONTRACTION: f64 = PI / (PI + 2.0);

pub(super) async fn vessels(set_up: SetUp) -> Findings {
    let blueprint = set_up.blueprint("communicating_vessels", &[("left", START.0), ("right", START.1)])?;
    let mut simulation = set_up.simulation(blueprint);
    simulation.run(13.0).await;
    let (mut left, mut right) = (0.0, 0.0);
    for look in 0..LOOKS {
        simulation.run(1.0 / 6.0).await;
        let tops = simulation.matter().column_tops();
        // The weights add up to 1.
        let weight = 2.0 / f64::from(LOOKS) * (PI * (f64::from(look) + 0.5) / f64::from(LOOKS)).sin().powi(2);
        left += weight * level(&tops, 0.0, LEFT, simulation.spacing());
        right += weight * level(&tops, LEFT + WALL, LEFT + WALL + RIGHT, simulation.spacing());
    }
    let volume = LEFT * START.0 + RIGHT * START.1;
    Ok(vec![
        within("difference of the levels", "m", 0.0, left - right, 0.5 * simulation.spacing()),
        share("level", "m", volume / (LEFT + RIGHT), (LEFT * left + RIGHT * right) / (LEFT + RIGHT), 0.02),
        share("time to half the difference", "s", theory(), time_to_half(&set_up).await?, 0.15),
    ])
}

/// Looks at the levels, a sixth of a second apart.
const LOOKS: u32 = 78;
/// Half of the difference at the start, m.
const HALF: f64 = 0.5 * (START.0 - START.1);

/// When half of the difference is gone in the finer tanks, s.
async fn time_to_half(set_up: &SetUp) -> Result<f64, SceneError> {
    let mut simulation = set_up.open("vessels", &[])?;
    let mut differences = vec![(0.0, START.0 - START.1)];
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
    count(0.0, LEFT) - count(LEFT + WALL, LEFT + WALL + RIGHT)
}

/// Median height of the columns between two places (m), m.
fn level(tops: &[f64], from: f64, to: f64, d: f64) -> f64 {
    let mut tops = tops[(from / d).round() as usize..(to / d).round() as usize].to_vec();
    stats::quantile(&mut tops, 0.5).map_or(f64::NAN, |y| (y + 0.5) * d)
}

/// Time to half the difference by the theory, s.
fn theory() -> f64 {
    let (step, mut t, mut speed, mut difference) = (1e-4, 0.0, 0.0_f64, START.0 - START.1);
    // The water on both sides of the slot that moves with it adds about its height to its length.
    let length = WALL + SLOT;
    while difference > HALF && t < 100.0 {
        let jet = speed / CONTRACTION;
        speed += step * (GRAVITY * difference - 0.5 * jet * jet) / length;
        difference -= step * speed * SLOT * (1.0 / LEFT + 1.0 / RIGHT);
        t += step;
    }
    t
}
