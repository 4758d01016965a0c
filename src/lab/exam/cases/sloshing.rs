//! Sloshing in a tank.

use crate::{
    lab::exam::{
        case::{ExamCase, Finding, Over, Setting, Size, Tolerance::Share},
        fit::half_period,
        world::{CaseSimulation, GRAVITY, Stopwatch, own},
    },
    scene::SceneError,
};
use std::f64::consts::PI;

pub(super) const SLOSHING: ExamCase = ExamCase {
    name: "sloshing",
    title: "Sloshing",
    setup: "A tank of 6 m with water whose surface is tilted at the start is let go (assets/exam/sloshing.ron): 3 m deep \
            tilted by ±0.3 m, and 1 m and 1.1 m deep tilted by ±0.15 m. The centre of mass swings from side to side; the time between \
            its zero crossings over 12 s is half a period.",
    answer: "Linear theory of water waves: `ω² = g k tanh(k H)`, k = π/6 m.",
    tolerance: "3 %. Waves of this height are slower than the theory's by `O((a k)²)`, up to 1 %; the surface is made of \
                particles of 0.1 m, which blurs the depth by half a spacing: 1 % deep, 2.5 % in the shallow tank.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(sloshing(setting, stopwatch)),
};

/// Length of the tank, m.
const LENGTH: f64 = 6.0;

async fn sloshing(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let mut findings = Vec::new();
    for (quantity, depth, tilt) in
        [("period, 3 m deep", 3.0, 0.3), ("period, 1 m deep", 1.0, 0.15), ("period, 1.1 m deep", 1.1, 0.15)]
    {
        let wave = PI / LENGTH;
        let omega = (GRAVITY * wave * (wave * depth).tanh()).sqrt();
        let expected = 2.0 * PI / omega;
        let got = 2.0 * swing(depth, tilt, &setting, &stopwatch).await?.unwrap_or(f64::NAN);
        findings.push(Finding { quantity, unit: "s", expected, got, tolerance: Share(0.03) });
    }
    Ok(findings)
}

async fn swing(depth: f64, tilt: f64, setting: &Setting, stopwatch: &Stopwatch) -> Result<Option<f64>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/sloshing.ron"));
    let blueprint = own("sloshing", text, &[("depth", depth), ("tilt", tilt)], setting)?;
    let mut simulation = CaseSimulation::new(blueprint, stopwatch);
    let mut curve = Vec::new();
    for _ in 0..12 * 60 {
        simulation.tick().await;
        let x = &simulation.particles().x;
        let centre = x.iter().map(|x| f64::from(*x)).sum::<f64>() / x.len() as f64 * simulation.spacing();
        curve.push((simulation.seconds(), centre - 0.5 * LENGTH));
    }
    Ok(half_period(&curve))
}
