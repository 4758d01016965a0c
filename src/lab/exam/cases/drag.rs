//! Drops in a steady wind.

use super::falling::{drops, worst};
use crate::{
    lab::exam::{
        case::{
            ExamCase, Finding, Over, Setting, Size,
            Tolerance::{Share, Within},
        },
        world::{CaseSimulation, GRAVITY, Stopwatch, own},
    },
    scene::SceneError,
};

pub(super) const WIND: ExamCase = ExamCase {
    name: "wind",
    title: "A drop in a steady wind",
    setup: "Weightless single drops at rest are put into a wind of 10 m/s that fans keep everywhere \
            (assets/exam/wind.ron).",
    answer: "`dv/dt = k (u − v)²` has the solution `v = u − u/(1 + k u t)`, `x = u t − ln(1 + k u t)/k`, with \
             `k = C/(ρ d²)`: 0.045 /m for water at d = 0.1 m.",
    tolerance: "Speed: each step is the exact solution, so the error is that of the wind and of rounding: 10⁻³. Distance: \
                first order in the step as in free fall, 1.7 %.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(wind(setting, stopwatch)),
};

pub(super) const TERMINAL_SPEED: ExamCase = ExamCase {
    name: "terminal_speed",
    title: "Terminal speed",
    setup: "A single drop set free in a wind of 5 m/s that blows upwards, moving with it at first \
            (assets/exam/updraught.ron).",
    answer: "Seen from the air it falls at `v = v∞ tanh(g t/v∞)`, `v∞ = √(g/k)` = 14.76 m/s; seen from the ground 5 m/s \
             slower.",
    tolerance: "Gravity and drag act one after the other in a step. The fixed point of the two is \
                `√(v∞² + (g Δt/2)²) − g Δt/2`: slow by `g Δt/2`, 0.082 m/s at one step a tick. To that comes the wind \
                itself, which the fans keep to 10⁻³: 0.005 m/s.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(terminal_speed(setting, stopwatch)),
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

/// Runs until the taps have let their drops out. The drops have done one tick then.
async fn wait_for_drops(simulation: &mut CaseSimulation) {
    while simulation.particles().is_empty() && simulation.seconds() < 10.0 {
        simulation.tick().await;
    }
}

async fn wind(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/wind.ron"));
    let mut simulation = CaseSimulation::new(own("wind", text, &[], &setting)?, &stopwatch);
    wait_for_drops(&mut simulation).await;
    let (k, begun, start) = (drag(&simulation), simulation.ticks - 1, drops(&simulation));
    let from = start.iter().map(|(position, velocity)| position.x - velocity.x / 60.0).collect::<Vec<_>>();
    simulation.run(59.0 / 60.0).await;
    let t = f64::from(simulation.ticks - begun) / 60.0;
    let end = drops(&simulation);
    let speed = SPEED - SPEED / (1.0 + k * SPEED * t);
    let distance = SPEED * t - (k * SPEED * t).ln_1p() / k;
    Ok(vec![
        Finding {
            quantity: "speed after 1 s",
            unit: "m/s",
            expected: speed,
            got: worst(end.iter().map(|(_, velocity)| velocity.x), speed),
            tolerance: Share(1e-3),
        },
        Finding {
            quantity: "distance after 1 s",
            unit: "m",
            expected: distance,
            got: worst(end.iter().zip(&from).map(|((position, _), from)| position.x - from), distance),
            tolerance: Share(0.017),
        },
    ])
}

async fn terminal_speed(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/updraught.ron"));
    let mut simulation = CaseSimulation::new(own("updraught", text, &[], &setting)?, &stopwatch);
    wait_for_drops(&mut simulation).await;
    let (k, begun) = (drag(&simulation), simulation.ticks - 1);
    let terminal = (GRAVITY / k).sqrt();
    let mut look = async |seconds: u32, quantity| {
        while simulation.ticks - begun < 60 * seconds {
            simulation.tick().await;
        }
        let expected = terminal * (GRAVITY * f64::from(seconds) / terminal).tanh() - UPDRAUGHT;
        let got = worst(drops(&simulation).iter().map(|(_, velocity)| -velocity.y), expected);
        Finding { quantity, unit: "m/s", expected, got, tolerance: Within(0.5 * GRAVITY / 60.0 + 1e-3 * UPDRAUGHT) }
    };
    Ok(vec![look(1, "speed after 1 s").await, look(6, "speed after 6 s").await])
}
