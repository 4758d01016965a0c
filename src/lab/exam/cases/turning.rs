//! Blobs that turn, without gravity.

use crate::{
    lab::exam::{
        case::{
            ExamCase, Finding, Over, Setting, Size,
            Tolerance::{Share, Within},
        },
        world::{CaseSimulation, Stopwatch, own},
    },
    scene::SceneError,
};
use glam::DVec2;

pub(super) const ROTATING_BLOB: ExamCase = ExamCase {
    name: "rotating_blob",
    title: "Rotating blob",
    setup: "A disc of water of 6 m across turns as a whole at 2 /s, free of gravity and air, for 1 s \
            (assets/exam/rotating_blob.ron). Nothing holds it together, so it spreads.",
    answer: "Nothing acts from outside: its angular momentum stays.",
    tolerance: "1 %: pushes along the line between two particles keep it exactly. The predictor draws each particle towards \
                the mean of those within a cell c, 1.2 times a second; at the rim R that mean is slow by about `ω c/6`, \
                which takes `0.8 (c/R)²` of the whole a second: 0.6 % at R = 30 d.",
    over: Over::Qualities,
    size: Size::Quick,
    run: |setting, stopwatch| Box::pin(rotating_blob(setting, stopwatch)),
};

pub(super) const COLLISION: ExamCase = ExamCase {
    name: "collision",
    title: "Collision of two blobs",
    setup: "Two discs of water of 4 m across meet at 6 m/s, the one 2.4 m off the other's line, free of gravity and air, and \
            splash for 2 s (assets/exam/collision.ron).",
    answer: "Momentum and angular momentum stay.",
    tolerance: "Angular momentum: 7 %. Where the discs meet, a face of the predictor's grid that is half in the air hands its \
                push to particles on one side of it, whose middle is up to a third of a cell away, 0.83 d; the arm is 12 d. \
                Momentum: 1 % of `Σ m |v|`.",
    over: Over::Qualities,
    size: Size::Usual,
    run: |setting, stopwatch| Box::pin(collision(setting, stopwatch)),
};

/// Angular speed, 1/s.
const TURN: f32 = 2.0;

async fn rotating_blob(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/rotating_blob.ron"));
    let mut blueprint = own("rotating_blob", text, &[], &setting)?;
    let centre = blueprint.domain.size * 0.5;
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        let velocity = (particles.position(i) - centre).perp() * TURN;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
    }
    let mut simulation = CaseSimulation::new(blueprint, &stopwatch);
    let start = angular_momentum(&simulation);
    simulation.run(1.0).await;
    Ok(vec![Finding {
        quantity: "angular momentum after 1 s",
        unit: "t m²/s",
        expected: start,
        got: angular_momentum(&simulation),
        tolerance: Share(0.01),
    }])
}

async fn collision(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/collision.ron"));
    let mut simulation = CaseSimulation::new(own("collision", text, &[], &setting)?, &stopwatch);
    let (start, impetus) = (angular_momentum(&simulation), simulation.matter().balance().impetus);
    simulation.run(2.0).await;
    Ok(vec![
        Finding {
            quantity: "angular momentum after 2 s",
            unit: "t m²/s",
            expected: start,
            got: angular_momentum(&simulation),
            tolerance: Share(0.07),
        },
        Finding {
            quantity: "momentum as a share of Σ m |v|",
            unit: "",
            expected: 0.0,
            got: simulation.matter().balance().momentum.length() / impetus,
            tolerance: Within(0.01),
        },
    ])
}

/// Angular momentum of the particles about the middle of the box, t m²/s for each metre of depth.
fn angular_momentum(simulation: &CaseSimulation) -> f64 {
    let (matter, d) = (simulation.matter(), simulation.spacing());
    let (particles, mass) = (matter.particles, f64::from(matter.scale.particle_mass()) / 1000.0);
    let centre = matter.domain.size.as_dvec2() * 0.5;
    let of = |i: usize| -> f64 {
        let arm: DVec2 = particles.position(i).as_dvec2() - centre;
        arm.perp_dot(particles.velocity(i).as_dvec2())
    };
    (0..particles.len()).map(of).sum::<f64>() * mass * d * d
}
