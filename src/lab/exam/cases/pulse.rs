//! A pulse of pressure.

use crate::{
    lab::exam::{
        case::{ExamCase, Finding, Over, Setting, Size, Tolerance::Share},
        world::{CaseSimulation, Stopwatch, own},
    },
    scene::SceneError,
};

pub(super) const PULSE: ExamCase = ExamCase {
    name: "pulse",
    title: "Pulse of pressure",
    setup: "In a closed tube of 60 m the middle 4 m stand at pressure 1.01 (assets/exam/pulse.ron). Two pulses run off; the \
            centre of mass of the right one is timed from 0.2 s to 0.6 s.",
    answer: "Sound runs at c = 40 m/s, and a closed tube keeps its air.",
    tolerance: "Speed: 1 %; a pulse of height ε runs faster by up to 0.75 ε, 0.4 %. Mass: 3·10⁻⁶; every step rounds every cell \
                to 6·10⁻⁸, and some 500 steps add up to 1.3·10⁻⁶ at random, to 3·10⁻⁵ if all went one way.",
    over: Over::Air,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(pulse(setting, stopwatch)),
};

/// Speed of sound, m/s.
const SOUND: f64 = 40.0;

async fn pulse(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/pulse.ron"));
    let mut simulation = CaseSimulation::new(own("pulse", text, &[], &setting)?, &stopwatch);
    let mass = simulation.air().mass();
    simulation.run(0.2).await;
    let (begun, from) = (simulation.seconds(), centre(&simulation));
    simulation.run(0.4).await;
    let speed = (centre(&simulation) - from) / (simulation.seconds() - begun);
    Ok(vec![
        Finding { quantity: "speed", unit: "m/s", expected: SOUND, got: speed, tolerance: Share(0.01) },
        Finding {
            quantity: "air that is left",
            unit: "",
            expected: 1.0,
            got: simulation.air().mass() / mass,
            tolerance: Share(3e-6),
        },
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
