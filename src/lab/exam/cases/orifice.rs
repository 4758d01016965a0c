//! Outflow under a gate.

use super::vessels::CONTRACTION;
use crate::{
    lab::exam::{
        case::{ExamCase, Finding, Over, Setting, Size, Tolerance::Share},
        fit::falls_to,
        world::{CaseSimulation, GRAVITY, Stopwatch, own},
    },
    scene::SceneError,
};

pub(super) const ORIFICE: ExamCase = ExamCase {
    name: "orifice",
    title: "Outflow under a gate",
    setup: "A tank of 4 m × 4 m of water runs out under a gate that leaves 0.8 m open (assets/exam/orifice.ron), at d = 0.025 m: the opening is \
            32 particles high. (At d = 0.1 m, 8 particles, the edge of the gate is too coarse for the jet to contract: up \
            to 26 % too much runs out.) How long it takes from 3.6 m to 2.4 m, by the number of particles in the tank.",
    answer: "Torricelli with the contraction of a jet along a floor, π/(π + 2) = 0.611 (Kirchhoff): the discharge is \
             `q = 0.611 b √(2 g h/(1 + 0.611 b/h))`, hence `dh/dt = −q/4 m`.",
    tolerance: "10 %: measured contractions of sluice gates lie between 0.59 and 0.64, and the level is that of the whole \
                tank, also while the flow starts.",
    over: Over::Qualities,
    size: Size::Usual,
    run: |setting, stopwatch| Box::pin(orifice(setting, stopwatch)),
};

/// Width of the tank and height of the opening, m.
const WIDTH: f64 = 4.0;
const OPENING: f64 = 0.8;
/// Levels between which it is timed, m.
const FROM: f64 = 3.6;
const TO: f64 = 2.4;

async fn orifice(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/orifice.ron"));
    let mut simulation = CaseSimulation::new(own("orifice", text, &[], &setting)?, &stopwatch);
    let mut curve = Vec::new();
    while simulation.seconds() < 10.0 && curve.last().is_none_or(|(_, level)| *level > TO) {
        simulation.tick().await;
        let d = simulation.spacing();
        let left = simulation.particles().x.iter().filter(|x| f64::from(**x) * d < WIDTH).count();
        curve.push((simulation.seconds(), left as f64 * d * d / WIDTH));
    }
    let got = falls_to(&curve, TO).zip(falls_to(&curve, FROM)).map_or(f64::NAN, |(end, start)| end - start);
    Ok(vec![Finding {
        quantity: "time from 3.6 m to 2.4 m",
        unit: "s",
        expected: theory(),
        got,
        tolerance: Share(0.10),
    }])
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
