//! Outflow under a gate.

use super::vessels::CONTRACTION;
use crate::lab::exam::{
    case::{Findings, share},
    fit::falls_to,
    set_up::{GRAVITY, SetUp},
};

/// Width of the tank and height of the opening, m.
const WIDTH: f64 = 4.0;
const OPENING: f64 = 0.8;
/// Levels between which it is timed, m.
const FROM: f64 = 3.6;
const TO: f64 = 2.4;

pub(super) async fn orifice(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("orifice", &[])?;
    let mut curve = Vec::new();
    while simulation.seconds() < 10.0 && curve.last().is_none_or(|(_, level)| *level > TO) {
        simulation.tick().await;
        let d = simulation.spacing();
        let left = simulation.particles().x.iter().filter(|x| f64::from(**x) * d < WIDTH).count();
        curve.push((simulation.seconds(), left as f64 * d * d / WIDTH));
    }
    let got = falls_to(&curve, TO).zip(falls_to(&curve, FROM)).map_or(f64::NAN, |(end, start)| end - start);
    Ok(vec![share("time from 3.6 m to 2.4 m", "s", theory(), got, 0.10)])
}

/// The time by the theory, s.
fn theory() -> f64 {
    let steps = 10_000;
    let step = (FROM - TO) / f64::from(steps);
    let jet = CONTRACTION * OPENING;
    (0..steps)
        .map(|k| FROM - (f64::from(k) + 0.5) * step)
        .map(|h| step * WIDTH / (jet * (2.0 * GRAVITY * h / (1.0 + jet / h)).sqrt()))
        .sum()
}
