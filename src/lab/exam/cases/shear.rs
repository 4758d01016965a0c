//! A shear layer damped by XSPH viscosity.

use crate::{
    kernel::{
        element::{Element, ElementTable},
        units::TICKS_PER_SECOND,
    },
    lab::{
        exam::{
            case::{Findings, share},
            set_up::{CaseSimulation, SetUp},
        },
        stats,
    },
    scene::effects::{Effect, Mode},
};
use std::{f64::consts::PI, sync::Arc};

/// Speed at the start, d/s, and height of the channel, d.
const SPEED: f32 = 1.0;
const HEIGHT: f64 = 10.0;
/// Simulated time, s, of which the first part is left to the particles to find their places.
const SECONDS: f64 = 1.0;
const SETTLE: f64 = 0.1;
/// XSPH viscosity c: so thick that the particles finding their places does not matter beside it.
const VISCOSITY: f32 = 0.5;

pub(super) async fn shear_layer(set_up: SetUp) -> Findings {
    let mut rates = [0.0; 2];
    let mut expected = f64::NAN;
    for (rate, mode) in rates.iter_mut().zip([Mode::On, Mode::Off]) {
        let mut blueprint = set_up.blueprint("shear_layer", &[])?;
        blueprint.effects.insert(Effect::Viscosity, mode);
        let thick = |(_, element): (_, &Element)| Element { viscosity: VISCOSITY, ..element.clone() };
        blueprint.elements = Arc::new(ElementTable::new(blueprint.elements.iter().map(thick).collect()));
        let particles = &mut blueprint.particles;
        for i in 0..particles.len() {
            particles.vx[i] = SPEED * (PI * f64::from(particles.y[i]) / HEIGHT).cos() as f32;
        }
        let mut simulation = set_up.simulation(blueprint);
        let mut curve = Vec::new();
        while simulation.seconds() < SECONDS {
            simulation.tick().await;
            if simulation.seconds() >= SETTLE {
                curve.push((simulation.seconds(), amplitude(&simulation).ln()));
            }
        }
        *rate = stats::line(&curve).map_or(f64::NAN, |(slope, _)| -slope);
        expected = theory(&simulation);
    }
    Ok(vec![share("rate at which XSPH damps it", "1/s", expected, rates[0] - rates[1], 0.10)])
}

/// Amplitude of `cos(k y)` in the velocity along the channel, d/s.
fn amplitude(simulation: &CaseSimulation) -> f64 {
    let matter = simulation.matter();
    let (particles, width) = (matter.particles, matter.domain.size.x);
    let (mut sum, mut norm) = (0.0, 0.0);
    for i in (0..particles.len()).filter(|&i| (width / 3.0..width * 2.0 / 3.0).contains(&particles.x[i])) {
        let wave = (PI * f64::from(particles.y[i]) / HEIGHT).cos();
        sum += f64::from(particles.vx[i]) * wave;
        norm += wave * wave;
    }
    sum / norm
}

/// The rate by the sum over the lattice, 1/s.
fn theory(simulation: &CaseSimulation) -> f64 {
    let h = f64::from(simulation.quality().kernel_radius);
    let (mut loss, mut norm) = (0.0, 0.0);
    for x in -4..=4 {
        for y in -4..=4 {
            let w = (h * h - f64::from(x * x + y * y)).max(0.0).powi(3);
            loss += w * (1.0 - (PI / HEIGHT * f64::from(y)).cos());
            norm += w;
        }
    }
    -(1.0 - f64::from(VISCOSITY) * loss / norm).ln() * f64::from(TICKS_PER_SECOND)
}
