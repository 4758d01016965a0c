//! Free fall, of single particles and of a drop; single particles in a steady wind, and light ones in still air.

use crate::{
    kernel::{diffusion::TURN, units::TICK_SECONDS},
    lab::exam::{
        finding::{Findings, Run, found},
        set_up::{CaseSimulation, GRAVITY, SetUp},
    },
};
use glam::DVec2;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("free_fall", |set_up| Box::pin(free_fall(set_up))),
    ("falling_drop", |set_up| Box::pin(falling_drop(set_up))),
    ("wind", |set_up| Box::pin(wind(set_up))),
    ("terminal_speed", |set_up| Box::pin(terminal_speed(set_up))),
    ("light_lumps", |set_up| Box::pin(light_lumps(set_up))),
    ("gas_spread", |set_up| Box::pin(gas_spread(set_up))),
];

async fn free_fall(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("free_fall", &[])?;
    let start = particles(&simulation);
    simulation.run(1.0).await;
    let (t, end) = (simulation.seconds(), particles(&simulation));
    let gained = worst(start.iter().zip(&end).map(|(start, end)| start.1.y - end.1.y), GRAVITY * t);
    let fallen =
        worst(start.iter().zip(&end).map(|(start, end)| start.0.y + start.1.y * t - end.0.y), 0.5 * GRAVITY * t * t);
    let sideways = worst(start.iter().zip(&end).map(|(start, end)| end.1.x - start.1.x), 0.0);
    Ok(vec![
        found("speed gained in 1 s", GRAVITY * t, gained),
        found("distance fallen in 1 s", 0.5 * GRAVITY * t * t, fallen),
        found("change of the speed to the side", 0.0, sideways),
    ])
}

async fn falling_drop(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("falling_drop", &[])?;
    let start = simulation.matter().balance();
    simulation.run(1.0).await;
    let end = simulation.matter().balance();
    let gained = (end.momentum - start.momentum) / end.mass;
    let centre = end.momentum / end.mass;
    let inner = 2.0 * end.kinetic / end.mass - centre.length_squared();
    Ok(vec![
        found("speed gained by the centre of mass", GRAVITY * simulation.seconds(), -gained.y),
        found("its speed to the side", start.momentum.x / start.mass, centre.x),
        found("rms speed seen from it", 0.0, inner.max(0.0).sqrt()),
    ])
}

/// Position (m) and velocity (m/s) of each particle, by id.
fn particles(simulation: &CaseSimulation) -> Vec<(DVec2, DVec2)> {
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

/// Wind, m/s.
const WIND_SPEED: f64 = 10.0;
/// The wind that blows upwards, m/s.
const UPDRAUGHT: f64 = 5.0;

/// k of `dv/dt = −k |v| v` for water, 1/m.
fn drag(simulation: &CaseSimulation) -> f64 {
    let matter = simulation.matter();
    let water = matter.elements.iter().find(|(_, element)| element.name == "water");
    let d = simulation.own_spacing();
    water.map_or(f64::NAN, |(_, water)| f64::from(water.drag) / (f64::from(water.density) * d * d))
}

/// Runs until the emitters have let their particles out. These have done one tick then.
async fn wait_for_particles(simulation: &mut CaseSimulation) {
    while simulation.particles().is_empty() && simulation.seconds() < 10.0 {
        simulation.tick().await;
    }
}

async fn wind(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("wind", &[])?;
    wait_for_particles(&mut simulation).await;
    let (k, begun, start) = (drag(&simulation), simulation.ticks - 1, particles(&simulation));
    let from = start.iter().map(|(position, velocity)| position.x - velocity.x / 60.0).collect::<Vec<_>>();
    simulation.run(59.0 / 60.0).await;
    let t = f64::from(simulation.ticks - begun) / 60.0;
    let end = particles(&simulation);
    let speed = WIND_SPEED - WIND_SPEED / (1.0 + k * WIND_SPEED * t);
    let distance = WIND_SPEED * t - (k * WIND_SPEED * t).ln_1p() / k;
    let moved = end.iter().zip(&from).map(|((position, _), from)| position.x - from);
    Ok(vec![
        found("speed after 1 s", speed, worst(end.iter().map(|(_, velocity)| velocity.x), speed)),
        found("distance after 1 s", distance, worst(moved, distance)),
    ])
}

async fn terminal_speed(set_up: SetUp) -> Findings {
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
        found(quantity, expected, got)
    };
    Ok(vec![look(1, "speed after 1 s").await, look(6, "speed after 6 s").await])
}

/// What falls slowly or rises, and the row of each.
const LIGHT: [(&str, &str); 6] = [
    ("dust", "speed of dust"),
    ("ash", "speed of ash"),
    ("snow", "speed of snow"),
    ("steam", "speed of steam"),
    ("smoke", "speed of smoke"),
    ("hydrogen", "speed of hydrogen"),
];

/// Density of the air, kg/m².
const AIR: f64 = 1.2;

async fn light_lumps(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("light_lumps", &[])?;
    simulation.run(5.0).await;
    let matter = simulation.matter();
    let (scale, d) = (matter.scale, f64::from(matter.scale.own_spacing()));
    let mut findings = Vec::new();
    for (name, quantity) in LIGHT {
        let Some(id) = matter.elements.find(name) else { continue };
        let element = matter.elements.get(id);
        let displaced = if element.is_gas() { AIR } else { 0.0 };
        let weight = (f64::from(element.density) - displaced) * d * d * GRAVITY;
        let expected = -weight.signum() * (weight.abs() / f64::from(element.drag)).sqrt();
        let own = (0..matter.particles.len()).filter(|i| matter.particles.element[*i] == id);
        let got = worst(own.map(|i| f64::from(matter.particles.vy[i]) * f64::from(scale.spacing)), expected);
        findings.push(found(quantity, expected, got));
    }
    Ok(findings)
}

/// By how much the block of smoke is drawn out, so that its lumps are 10 d apart.
const DRAWN_OUT: f32 = 10.0;

async fn gas_spread(set_up: SetUp) -> Findings {
    let turn = TURN as f64 * f64::from(TICK_SECONDS);
    let mut blueprint = set_up.blueprint("gas_spread", &[])?;
    let placed = &mut blueprint.particles;
    placed.x.iter_mut().chain(&mut placed.y).for_each(|at| *at *= DRAWN_OUT);
    let mut simulation = set_up.simulation(blueprint);
    let start = particles(&simulation);
    let mut findings = Vec::new();
    for (seconds, quantity) in [(2.0, "mean square of the way, 2 s"), (10.0, "mean square of the way, 10 s")] {
        simulation.run(seconds - simulation.seconds()).await;
        let end = particles(&simulation);
        let squares = start.iter().zip(&end).map(|(start, end)| (end.0 - start.0).length_squared());
        let mean = 0.5 * squares.sum::<f64>() / start.len() as f64;
        let matter = simulation.matter();
        let smoke = matter.elements.find("smoke").map(|id| f64::from(matter.elements.get(id).diffusion));
        let known = 2.0 * smoke.unwrap_or(f64::NAN) * (simulation.seconds() - 7.0 / 15.0 * turn);
        findings.push(found(quantity, known, mean));
    }
    Ok(findings)
}
