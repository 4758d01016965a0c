//! Liquid without gravity: drops that turn, and a shear layer damped by XSPH viscosity.

use crate::{
    kernel::{
        element::{Element, ElementTable},
        units::{Scale, TICKS_PER_SECOND},
    },
    lab::{
        exam::{
            finding::{Findings, Run, found},
            set_up::{CaseSimulation, SetUp},
        },
        stats,
    },
    scene::effects::{Effect, Mode},
};
use glam::DVec2;
use std::{f64::consts::PI, sync::Arc};

pub(super) const RUNS: &[(&str, Run)] = &[
    ("rotating_drop", |set_up| Box::pin(rotating_drop(set_up))),
    ("collision", |set_up| Box::pin(collision(set_up))),
    ("shear_layer", |set_up| Box::pin(shear_layer(set_up))),
];

/// Angular speed, 1/s.
const TURN: f32 = 2.0;

async fn rotating_drop(set_up: SetUp) -> Findings {
    let mut blueprint = set_up.blueprint("rotating_drop", &[])?;
    let centre = blueprint.domain.size * 0.5;
    let particles = &mut blueprint.particles;
    for i in 0..particles.len() {
        let velocity = (particles.position(i) - centre).perp() * TURN;
        (particles.vx[i], particles.vy[i]) = (velocity.x, velocity.y);
    }
    let mut simulation = set_up.simulation(blueprint);
    let start = angular_momentum(&simulation);
    simulation.run(1.0).await;
    Ok(vec![found("angular momentum after 1 s", start, angular_momentum(&simulation))])
}

async fn collision(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("collision", &[])?;
    let (start, momentum_sum) = (angular_momentum(&simulation), simulation.matter().balance().momentum_sum);
    simulation.run(2.0).await;
    Ok(vec![
        found("angular momentum after 2 s", start, angular_momentum(&simulation)),
        found("momentum as a share of Σ m |v|", 0.0, simulation.matter().balance().momentum.length() / momentum_sum),
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

/// Speed at the start, d/s, and height of the channel, in the scene's own spacings.
const SHEAR_SPEED: f32 = 1.0;
const CHANNEL: f64 = 10.0;
/// Simulated time, s, of which the first part is left to the particles to find their places.
const SHEAR_SECONDS: f64 = 1.0;
const SHEAR_SETTLES: f64 = 0.1;
/// XSPH viscosity c at the spacing of the run: so thick that the particles finding their places does not matter beside
/// it.
const VISCOSITY: f32 = 0.5;

async fn shear_layer(set_up: SetUp) -> Findings {
    let mut rates = [0.0; 2];
    let mut expected = f64::NAN;
    for (rate, mode) in rates.iter_mut().zip([Mode::On, Mode::Off]) {
        let mut blueprint = set_up.blueprint("shear_layer", &[])?;
        blueprint.effects.insert(Effect::Viscosity, mode);
        // What is smoothed slips along the walls.
        let smoothing = VISCOSITY / blueprint.scale.particles_per_own();
        let thick = |(_, element): (_, &Element)| Element { smoothing, ..element.clone() };
        blueprint.elements = Arc::new(ElementTable::new(blueprint.elements.iter().map(thick).collect()));
        let (particles, height) = (&mut blueprint.particles, channel(blueprint.scale));
        for i in 0..particles.len() {
            particles.vx[i] = SHEAR_SPEED * (PI * f64::from(particles.y[i]) / height).cos() as f32;
        }
        let mut simulation = set_up.simulation(blueprint);
        let mut curve = Vec::new();
        while simulation.seconds() < SHEAR_SECONDS {
            simulation.tick().await;
            if simulation.seconds() >= SHEAR_SETTLES {
                curve.push((simulation.seconds(), amplitude(&simulation).ln()));
            }
        }
        *rate = stats::line(&curve).map_or(f64::NAN, |(slope, _)| -slope);
        expected = shear_theory(&simulation);
    }
    Ok(vec![found("rate at which XSPH damps it", expected, rates[0] - rates[1])])
}

/// Height of the channel, d.
fn channel(scale: Scale) -> f64 {
    CHANNEL * f64::from(scale.detail)
}

/// Amplitude of `cos(k y)` in the velocity along the channel, d/s.
fn amplitude(simulation: &CaseSimulation) -> f64 {
    let matter = simulation.matter();
    let (particles, width, height) = (matter.particles, matter.domain.size.x, channel(matter.scale));
    let (mut sum, mut norm) = (0.0, 0.0);
    for i in (0..particles.len()).filter(|&i| (width / 3.0..width * 2.0 / 3.0).contains(&particles.x[i])) {
        let wave = (PI * f64::from(particles.y[i]) / height).cos();
        sum += f64::from(particles.vx[i]) * wave;
        norm += wave * wave;
    }
    sum / norm
}

/// The rate by the kernel's integral, 1/s.
fn shear_theory(simulation: &CaseSimulation) -> f64 {
    let q = PI / channel(simulation.matter().scale) * f64::from(simulation.quality().kernel_radius);
    // `1 − Ŵ(q)`, term by term: each is the last times −(q/2)²/(m (m + 4)).
    let (mut term, mut loss) = (-1.0, 0.0);
    for m in 1..=10 {
        term *= -0.25 * q * q / f64::from(m * (m + 4));
        loss += term;
    }
    -(1.0 - f64::from(VISCOSITY) * loss).ln() * f64::from(TICKS_PER_SECOND)
}
