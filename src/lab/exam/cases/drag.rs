//! Single particles in a steady wind.

use super::falling::{particles, worst};
use crate::lab::exam::{
    case::{Findings, share, within},
    set_up::{CaseSimulation, GRAVITY, SetUp},
};

/// Wind, m/s.
const SPEED: f64 = 10.0;
/// The wind that blows upwards, m/s.
const UPDRAUGHT: f64 = 5.0;

/// k of `dv/dt = −k |v| v` for water, 1/m.
fn drag(simulation: &CaseSimulation) -> f64 {
    let matter = simulation.matter();
    let water = matter.elements.iter().find(|(_, element)| element.name == "water");
    let d = simulation.spacing();
    water.map_or(f64::NAN, |(_, water)| f64::from(water.drag) / (f64::from(water.density) * d * d))
}

/// Runs until the emitters have let their particles out. These have done one tick then.
async fn wait_for_particles(simulation: &mut CaseSimulation) {
    while simulation.particles().is_empty() && simulation.seconds() < 10.0 {
        simulation.tick().await;
    }
}

pub(super) async fn wind(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("wind", &[])?;
    wait_for_particles(&mut simulation).await;
    let (k, begun, start) = (drag(&simulation), simulation.ticks - 1, particles(&simulation));
    let from = start.iter().map(|(position, velocity)| position.x - velocity.x / 60.0).collect::<Vec<_>>();
    simulation.run(59.0 / 60.0).await;
    let t = f64::from(simulation.ticks - begun) / 60.0;
    let end = particles(&simulation);
    let speed = SPEED - SPEED / (1.0 + k * SPEED * t);
    let distance = SPEED * t - (k * SPEED * t).ln_1p() / k;
    let moved = end.iter().zip(&from).map(|((position, _), from)| position.x - from);
    Ok(vec![
        share("speed after 1 s", "m/s", speed, worst(end.iter().map(|(_, velocity)| velocity.x), speed), 1e-3),
        share("distance after 1 s", "m", distance, worst(moved, distance), 0.017),
    ])
}

pub(super) async fn terminal_speed(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("updraught", &[])?;
    wait_for_particles(&mut simulation).await;
    let (k, begun) = (drag(&simulation), simulation.ticks - 1);
    let terminal = (GRAVITY / k).sqrt();
    let mut look = async |seconds: u32, quantity| {
        while simulation.ticks - begun < 60 * seconds {
            simulation.tick().await;
        }
        let expected = terminal * (GRAVITY * f64::from(seconds) / terminal).tanh() - UPDRAUGHT;
        let got = worst(particles(&simulation).iter().map(|(_, velocity)| -velocity.y), expected);
        within(quantity, "m/s", expected, got, 0.5 * GRAVITY / 60.0 + 1e-3 * UPDRAUGHT)
    };
    Ok(vec![look(1, "speed after 1 s").await, look(6, "speed after 6 s").await])
}
