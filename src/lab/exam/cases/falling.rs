//! Free fall, of single particles and of a drop.

use crate::lab::exam::{
    case::{Findings, share, within},
    set_up::{CaseSimulation, GRAVITY, SetUp},
};
use glam::DVec2;

pub(super) async fn free_fall(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("free_fall", &[])?;
    let start = particles(&simulation);
    simulation.run(1.0).await;
    let (t, end) = (simulation.seconds(), particles(&simulation));
    let gained = worst(start.iter().zip(&end).map(|(start, end)| start.1.y - end.1.y), GRAVITY * t);
    let fallen =
        worst(start.iter().zip(&end).map(|(start, end)| start.0.y + start.1.y * t - end.0.y), 0.5 * GRAVITY * t * t);
    let sideways = worst(start.iter().zip(&end).map(|(start, end)| end.1.x - start.1.x), 0.0);
    Ok(vec![
        share("speed gained in 1 s", "m/s", GRAVITY * t, gained, 1e-5),
        share("distance fallen in 1 s", "m", 0.5 * GRAVITY * t * t, fallen, 0.017),
        within("change of the speed to the side", "m/s", 0.0, sideways, 1e-5),
    ])
}

pub(super) async fn falling_drop(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("falling_drop", &[])?;
    let start = simulation.matter().balance();
    simulation.run(1.0).await;
    let end = simulation.matter().balance();
    let gained = (end.momentum - start.momentum) / end.mass;
    let centre = end.momentum / end.mass;
    let inner = 2.0 * end.kinetic / end.mass - centre.length_squared();
    Ok(vec![
        share("speed gained by the centre of mass", "m/s", GRAVITY * simulation.seconds(), -gained.y, 0.01),
        share("its speed to the side", "m/s", start.momentum.x / start.mass, centre.x, 0.01),
        within("rms speed seen from it", "m/s", 0.0, inner.max(0.0).sqrt(), 0.12),
    ])
}

/// Position (m) and velocity (m/s) of each particle, by id.
pub(super) fn particles(simulation: &CaseSimulation) -> Vec<(DVec2, DVec2)> {
    let (particles, d) = (simulation.particles(), simulation.spacing());
    let of = |i: u32| {
        let i = i as usize;
        (particles.position(i).as_dvec2() * d, particles.velocity(i).as_dvec2() * d)
    };
    particles.in_id_order().into_iter().map(of).collect()
}

/// The value that is furthest from what is expected; no number without any.
pub(super) fn worst(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    values.max_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs())).unwrap_or(f64::NAN)
}
