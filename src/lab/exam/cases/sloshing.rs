//! Sloshing in a tank.

use crate::lab::exam::{
    case::{Findings, share},
    fit::half_period,
    set_up::{GRAVITY, SetUp},
};
use std::f64::consts::PI;

/// Length of the tank, m.
const LENGTH: f64 = 6.0;

pub(super) async fn sloshing(set_up: SetUp) -> Findings {
    let mut findings = Vec::new();
    for (quantity, depth, tilt) in
        [("period, 3 m deep", 3.0, 0.3), ("period, 1 m deep", 1.0, 0.15), ("period, 1.1 m deep", 1.1, 0.15)]
    {
        let wave = PI / LENGTH;
        let omega = (GRAVITY * wave * (wave * depth).tanh()).sqrt();
        let mut simulation = set_up.open("sloshing", &[("depth", depth), ("tilt", tilt)])?;
        let mut curve = Vec::new();
        for _ in 0..12 * 60 {
            simulation.tick().await;
            let x = &simulation.particles().x;
            let centre = x.iter().map(|x| f64::from(*x)).sum::<f64>() / x.len() as f64 * simulation.spacing();
            curve.push((simulation.seconds(), centre - 0.5 * LENGTH));
        }
        let period = half_period(&curve).map_or(f64::NAN, |half| 2.0 * half);
        findings.push(share(quantity, "s", 2.0 * PI / omega, period, 0.03));
    }
    Ok(findings)
}
