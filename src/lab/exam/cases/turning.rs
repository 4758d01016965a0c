//! Blobs that turn, without gravity.

use crate::{
    lab::exam::{
        case::{
            Case, Finding, Over, Setting,
            Tolerance::{Share, Within},
        },
        world::{Clockwork, Stage, own},
    },
    scene::SceneError,
};
use glam::DVec2;

pub(in crate::lab::exam) const ROTATING_BLOB: Case = Case {
    name: "rotating_blob",
    title: "Rotating blob",
    setup: "A disc of water of 3 m across turns as a whole at 2 /s, free of gravity and air, for 1 s \
            (assets/exam/rotating_blob.ron). Nothing holds it together, so it spreads.",
    answer: "Nothing acts from outside: its angular momentum stays.",
    tolerance: "1 %: pushes along the line between two particles keep it exactly, the grid of the predictor, viscosity \
                and confinement on average.",
    over: Over::Qualities,
    quick: true,
    run: |setting, clockwork| Box::pin(rotating_blob(setting, clockwork)),
};

pub(in crate::lab::exam) const COLLISION: Case = Case {
    name: "collision",
    title: "Collision of two blobs",
    setup: "Two discs of water of 2 m across meet at 6 m/s, the one 1.2 m off the other's line, free of gravity and air, and \
            splash for 1.5 s (assets/exam/collision.ron).",
    answer: "Momentum and angular momentum stay.",
    tolerance: "Angular momentum: 2 %, as for the rotating blob, under the pressure of a splash. Momentum: 1 % of `Σ m |v|`.",
    over: Over::Qualities,
    quick: false,
    run: |setting, clockwork| Box::pin(collision(setting, clockwork)),
};

/// Turns a second, as an angular speed, 1/s.
const TURN: f32 = 2.0;

async fn rotating_blob(setting: Setting, clockwork: Clockwork) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/rotating_blob.ron"));
    let mut blueprint = own("rotating_blob", text, &[], &setting)?;
    let centre = blueprint.domain.size * 0.5;
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        let velocity = (particles.position(i) - centre).perp() * TURN;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
    }
    let mut stage = Stage::new(blueprint, &clockwork);
    let start = angular_momentum(&stage);
    stage.run(1.0).await;
    Ok(vec![Finding {
        quantity: "angular momentum after 1 s",
        unit: "kg m²/s",
        expected: start,
        got: angular_momentum(&stage),
        tolerance: Share(0.01),
    }])
}

async fn collision(setting: Setting, clockwork: Clockwork) -> Result<Vec<Finding>, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/collision.ron"));
    let mut stage = Stage::new(own("collision", text, &[], &setting)?, &clockwork);
    let (start, impetus) = (angular_momentum(&stage), stage.matter().balance().impetus);
    stage.run(1.5).await;
    Ok(vec![
        Finding {
            quantity: "angular momentum after 1.5 s",
            unit: "kg m²/s",
            expected: start,
            got: angular_momentum(&stage),
            tolerance: Share(0.02),
        },
        Finding {
            quantity: "momentum as a share of Σ m |v|",
            unit: "",
            expected: 0.0,
            got: stage.matter().balance().momentum.length() / impetus,
            tolerance: Within(0.01),
        },
    ])
}

/// Angular momentum of the particles about the middle of the box, kg m²/s for each metre of depth.
fn angular_momentum(stage: &Stage) -> f64 {
    let (matter, d) = (stage.matter(), stage.spacing());
    let (particles, mass) = (matter.particles, f64::from(matter.scale.particle_mass()));
    let centre = matter.domain.size.as_dvec2() * 0.5;
    let of = |i: usize| -> f64 {
        let arm: DVec2 = particles.position(i).as_dvec2() - centre;
        arm.perp_dot(particles.velocity(i).as_dvec2())
    };
    (0..particles.len()).map(of).sum::<f64>() * mass * d * d
}
