//! Flow through openings: communicating vessels, outflow under a gate.

use crate::{
    lab::{
        exam::{
            finding::{Findings, Run, found},
            fit::falls_to,
            set_up::{CaseSimulation, GRAVITY, SetUp, Start},
        },
        stats,
    },
    scene::SceneError,
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] =
    &[("vessels", |set_up| Box::pin(vessels(set_up))), ("orifice", |set_up| Box::pin(orifice(set_up)))];

/// Widths of the tanks, of the wall and of the slot, m.
pub(in crate::lab::exam) const LEFT_TANK: f64 = 7.0;
pub(in crate::lab::exam) const RIGHT_TANK: f64 = 4.4;
pub(in crate::lab::exam) const WALL: f64 = 0.6;
const SLOT: f64 = 0.8;
/// Levels at the start, m.
const LEVELS: (f64, f64) = (5.0, 1.5);
/// Contraction of a jet out of a slot.
const CONTRACTION: f64 = PI / (PI + 2.0);
/// Spacing of the game's scenes, m.
const OWN_SPACING: f64 = 0.1;

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
    let tanks = |spacing: f64| Tanks { spacing, scale: 1.0, right: LEVELS.1, start: Start::Lattice };
    Ok(vec![
        found("difference of the levels", 0.0, left - right),
        found(
            "level",
            volume / (LEFT_TANK + RIGHT_TANK),
            (LEFT_TANK * left + RIGHT_TANK * right) / (LEFT_TANK + RIGHT_TANK),
        ),
        found("time to half the difference", levelling_theory(), time_to_half(&set_up, tanks(0.05)).await?),
        found(
            "time to half the difference, d = 0.1 m",
            levelling_theory(),
            time_to_half(&set_up, tanks(OWN_SPACING)).await?,
        ),
    ])
}

/// Looks at the levels, a sixth of a second apart.
const LOOKS: u32 = 78;

/// Communicating vessels of any size.
pub(super) struct Tanks {
    /// Particle spacing, m.
    pub spacing: f64,
    /// Size, of those in the game's scene.
    pub scale: f64,
    /// Level on the right at the start over the scale, m.
    pub right: f64,
    pub start: Start,
}

/// When half of the difference of the levels is gone, s.
pub(super) async fn time_to_half(set_up: &SetUp, tanks: Tanks) -> Result<f64, SceneError> {
    let Tanks { spacing, scale, right, start } = tanks;
    let mut blueprint = set_up.blueprint("vessels", &[("grain", spacing), ("scale", scale), ("right", right)])?;
    start.arrange(&mut blueprint);
    let mut simulation = set_up.simulation(blueprint);
    let mut differences = vec![(0.0, filled(&simulation, scale))];
    let half = 0.5 * differences[0].1;
    while simulation.seconds() < 10.0 * scale.max(1.0) && differences.last().is_some_and(|(_, now)| *now > half) {
        simulation.tick().await;
        differences.push((simulation.seconds(), filled(&simulation, scale)));
    }
    Ok(falls_to(&differences, half).unwrap_or(f64::NAN))
}

/// Difference of the levels by the number of particles in the tanks, m: what splashes does not matter.
fn filled(simulation: &CaseSimulation, scale: f64) -> f64 {
    let d = simulation.spacing();
    let count = |from: f64, to: f64| {
        let inside = |x: &&f32| (from * scale..to * scale).contains(&(f64::from(**x) * d));
        simulation.particles().x.iter().filter(inside).count() as f64 * d * d / ((to - from) * scale)
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
    let (step, mut t, mut tanks) = (1e-4, 0.0, Levelling::default());
    let half = 0.5 * tanks.difference;
    while tanks.difference > half && t < 100.0 {
        tanks.step(step);
        t += step;
    }
    t
}

/// Tanks whose levels come together.
pub(in crate::lab::exam) struct Levelling {
    /// Speed of the water in the slot, m/s.
    speed: f64,
    /// Of the level on the left over that on the right, m.
    difference: f64,
}

impl Default for Levelling {
    fn default() -> Self {
        Self { speed: 0.0, difference: LEVELS.0 - LEVELS.1 }
    }
}

impl Levelling {
    fn step(&mut self, seconds: f64) {
        // The water on both sides of the slot that moves with it adds about its height to its length.
        let (length, jet) = (WALL + SLOT, self.speed / CONTRACTION);
        self.speed += seconds * (GRAVITY * self.difference - 0.5 * jet * jet.abs()) / length;
        self.difference -= seconds * self.speed * SLOT * (1.0 / LEFT_TANK + 1.0 / RIGHT_TANK);
    }

    /// Both levels after so many seconds, m.
    pub(in crate::lab::exam) fn after(seconds: f64) -> [f64; 2] {
        let (step, mut tanks) = (1e-3, Self::default());
        // In the end they stand still.
        (0..(seconds.min(60.0) / step) as u32).for_each(|_| tanks.step(step));
        let mean = (LEFT_TANK * LEVELS.0 + RIGHT_TANK * LEVELS.1) / (LEFT_TANK + RIGHT_TANK);
        let [left, right] = [RIGHT_TANK, -LEFT_TANK].map(|other| other / (LEFT_TANK + RIGHT_TANK));
        [mean + left * tanks.difference, mean + right * tanks.difference]
    }
}

/// Width of the tank and height of the opening, m.
pub(in crate::lab::exam) const OUTFLOW_TANK: f64 = 4.0;
const OPENING: f64 = 0.8;
/// Level of the full tank, m.
const OUTFLOW_FULL: f64 = 4.0;
/// Levels between which it is timed, m.
const OUTFLOW_FROM: f64 = 3.6;
const OUTFLOW_TO: f64 = 2.4;

async fn orifice(set_up: SetUp) -> Findings {
    let fine = outflow_time(&set_up, 0.025, 1.0, Start::Lattice).await?;
    let own = outflow_time(&set_up, OWN_SPACING, 1.0, Start::Lattice).await?;
    Ok(vec![
        found("time from 3.6 m to 2.4 m", outflow_theory(), fine),
        found("time from 3.6 m to 2.4 m, d = 0.1 m", outflow_theory(), own),
    ])
}

/// How long the outflow takes, s, in a tank of `scale` times the size.
pub(super) async fn outflow_time(set_up: &SetUp, spacing: f64, scale: f64, start: Start) -> Result<f64, SceneError> {
    let mut blueprint = set_up.blueprint("orifice", &[("grain", spacing), ("scale", scale)])?;
    start.arrange(&mut blueprint);
    let mut simulation = set_up.simulation(blueprint);
    let (from, to, tank) = (OUTFLOW_FROM * scale, OUTFLOW_TO * scale, OUTFLOW_TANK * scale);
    let mut curve: Vec<(f64, f64)> = Vec::new();
    while simulation.seconds() < 10.0 * scale.max(1.0) && curve.last().is_none_or(|(_, level)| *level > to) {
        simulation.tick().await;
        let d = simulation.spacing();
        let left = simulation.particles().x.iter().filter(|x| f64::from(**x) * d < tank).count();
        curve.push((simulation.seconds(), left as f64 * d * d / tank));
    }
    Ok(falls_to(&curve, to).zip(falls_to(&curve, from)).map_or(f64::NAN, |(end, start)| end - start))
}

/// The time by the theory, s.
fn outflow_theory() -> f64 {
    let steps = 10_000;
    let step = (OUTFLOW_FROM - OUTFLOW_TO) / f64::from(steps);
    (0..steps).map(|k| OUTFLOW_FROM - (f64::from(k) + 0.5) * step).map(|h| step / fall(h)).sum()
}

/// Speed at which the level of the tank falls at a height `h` m, m/s.
fn fall(h: f64) -> f64 {
    let jet = CONTRACTION * OPENING;
    jet * (2.0 * GRAVITY * h / (1.0 + jet / h)).sqrt() / OUTFLOW_TANK
}

/// Level of the full tank after so many seconds of outflow, m; down to the edge of the gate.
pub(in crate::lab::exam) fn fall_of_the_level(seconds: f64) -> f64 {
    let step = 1e-3;
    (0..(seconds.min(60.0) / step) as u32).fold(OUTFLOW_FULL, |h, _| (h - step * fall(h)).max(OPENING))
}
