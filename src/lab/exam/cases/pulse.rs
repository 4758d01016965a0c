//! A pulse of pressure.

use crate::lab::exam::{
    case::{Findings, share},
    set_up::{CaseSimulation, SetUp},
};

/// Speed of sound, m/s.
const SOUND: f64 = 40.0;

pub(super) async fn pulse(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("pulse", &[])?;
    let mass = simulation.air().mass();
    simulation.run(0.2).await;
    let (begun, from) = (simulation.seconds(), centre(&simulation));
    simulation.run(0.4).await;
    let speed = (centre(&simulation) - from) / (simulation.seconds() - begun);
    Ok(vec![
        share("speed", "m/s", SOUND, speed, 0.01),
        share("air that is left", "", 1.0, simulation.air().mass() / mass, 3e-6),
    ])
}

/// Centre of mass of what is above pressure 1 in the right half of the tube, m.
fn centre(simulation: &CaseSimulation) -> f64 {
    let air = simulation.air();
    let cell = f64::from(air.cell()) * simulation.spacing();
    let (mut sum, mut moment) = (0.0, 0.0);
    for row in 0..air.rows() {
        for (column, p) in air.pressure_row(row).iter().enumerate().skip(air.columns() / 2) {
            sum += f64::from(*p) - 1.0;
            moment += (f64::from(*p) - 1.0) * (column as f64 + 0.5) * cell;
        }
    }
    moment / sum
}
