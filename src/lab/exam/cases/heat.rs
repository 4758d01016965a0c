//! Heat: how it spreads and leaves, how much of it melting and boiling take, that none is made or lost, by burning neither, how
//! deep ice floats, and how fast wood burns.

use crate::{
    kernel::{
        heat::{
            chemical, held,
            units::{QUANTUM, ROOM},
        },
        solids::centre,
        units::TICKS_PER_SECOND,
    },
    lab::{
        exam::{
            finding::{Findings, Run, found},
            fit::falls_to,
            set_up::{CaseSimulation, SetUp},
        },
        stats,
    },
    sim::state::{Books, HeatCurves, ParticleStore, Rock, Setup},
};
use std::f64::consts::PI;

pub(super) const RUNS: &[(&str, Run)] = &[
    ("heat_bar", |set_up| Box::pin(heat_bar(set_up))),
    ("heat_plate", |set_up| Box::pin(heat_plate(set_up))),
    ("heat_front", |set_up| Box::pin(heat_front(set_up))),
    ("boiling", |set_up| Box::pin(boiling(set_up))),
    ("heat_kept", |set_up| Box::pin(heat_kept(set_up))),
    ("ice_floats", |set_up| Box::pin(ice_floats(set_up))),
    ("fire_kept", |set_up| Box::pin(fire_kept(set_up))),
    ("fire_front", |set_up| Box::pin(fire_front(set_up))),
];

/// Thickness of the beam that burns, m.
const BEAM: f64 = 0.6;

/// Capacity (J/m²K) and conductivity k′ (W/mK) of an element.
fn thermal(simulation: &CaseSimulation, name: &str) -> (f64, f64) {
    let elements = simulation.world().resource::<Setup>().elements();
    let of = |id| {
        (1e6 * f64::from(elements.get(id).capacity), 6e4 * (0.6 * f64::from(elements.get(id).conductivity)).sqrt())
    };
    elements.find(name).map_or((f64::NAN, f64::NAN), of)
}

/// Place along x (m) and temperature (K) of each cell of rock.
fn rock(simulation: &CaseSimulation) -> Vec<(f64, f64)> {
    let world = simulation.world();
    let (rock, curves) = (world.resource::<Rock>(), world.resource::<HeatCurves>());
    let of = |(cell, element, _)| {
        let kelvin = curves.curve(element).temperature(rock.heat(cell));
        (f64::from(centre(cell).x) * simulation.spacing(), f64::from(kelvin))
    };
    rock.iter().map(of).collect()
}

/// The error function, to 1.5·10⁻⁷ (Abramowitz & Stegun 1964, 7.1.26).
fn error_function(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x.abs());
    let terms = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    (1.0 - terms.into_iter().fold(0.0, |sum, term| (sum + term) * t) * (-x * x).exp()).copysign(x)
}

async fn heat_bar(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("heat_bar", &[])?;
    let (capacity, conductivity) = thermal(&simulation, "metal");
    simulation.run(2.0).await;
    let spread = 2.0 * (conductivity / capacity * simulation.seconds()).sqrt();
    let off = |(x, kelvin): (f64, f64)| kelvin - (350.0 - 50.0 * error_function((x - 4.0) / spread));
    let squares = rock(&simulation).into_iter().map(|point| off(point).powi(2));
    Ok(vec![found("rms difference after 2 s", 0.0, stats::mean(squares).unwrap_or(f64::NAN).sqrt())])
}

async fn heat_plate(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("heat_plate", &[])?;
    let (capacity, _) = thermal(&simulation, "metal");
    let room = f64::from(ROOM);
    let warmer = |simulation: &CaseSimulation| {
        stats::mean(rock(simulation).into_iter().map(|(_, kelvin)| kelvin)).unwrap_or(f64::NAN) - room
    };
    let start = warmer(&simulation);
    simulation.run(20.0).await;
    // C dT/dt = −2 h′ (T − 293 K), for a plate 1 m thick.
    let known = start * (-2.0 * 1e4 * simulation.seconds() / capacity).exp();
    Ok(vec![found("how much warmer after 20 s", known, warmer(&simulation))])
}

async fn heat_front(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("heat_front", &[])?;
    let (capacity, conductivity) = thermal(&simulation, "ice");
    let latent = 334e6;
    let mut points = Vec::new();
    for second in 1..=60 {
        for _ in 0..60 {
            simulation.tick().await;
            keep_cold(&mut simulation);
        }
        if second % 10 == 0 {
            points.push((simulation.seconds().sqrt(), frozen(&simulation)));
        }
    }
    let slope = stats::line(&points).map_or(f64::NAN, |(slope, _)| slope);
    // √π λ e^(λ²) erf λ = c ΔT/L, by halving.
    let (mut low, mut high) = (0.0, 3.0);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        let gives = PI.sqrt() * middle * (middle * middle).exp() * error_function(middle);
        (low, high) = if gives > capacity * 40.0 / latent { (low, middle) } else { (middle, high) };
    }
    Ok(vec![found("depth over √t", 2.0 * low * (conductivity / capacity).sqrt(), slope)])
}

/// Gives the metal of the ceiling the temperature that it had at the start.
fn keep_cold(simulation: &mut CaseSimulation) {
    let world = simulation.world_mut();
    let start = world.resource::<Setup>().blueprint.solids.clone();
    let mut rock = world.resource_mut::<Rock>();
    start.iter().for_each(|(cell, _, _)| rock.set_heat(cell, start.heat(cell)));
}

/// How much of what was water is ice, by its heat, as a depth, m.
fn frozen(simulation: &CaseSimulation) -> f64 {
    let world = simulation.world();
    let (particles, curves) = (simulation.particles(), world.resource::<HeatCurves>());
    let setup = world.resource::<Setup>();
    let ids = ["water", "ice"].map(|name| setup.elements().find(name));
    let [Some(water), Some(ice)] = ids else { return f64::NAN };
    let share = |i: usize| {
        let (element, heat) = (particles.element[i], particles.heat_of(i));
        match curves.curve(element).begun(heat) {
            Some((_, share)) if element == water => f64::from(share),
            Some((_, share)) => 1.0 - f64::from(share),
            None => f64::from(u8::from(element == ice)),
        }
    };
    (0..particles.len()).map(share).sum::<f64>() * simulation.spacing() / f64::from(setup.domain.size.x)
}

/// What water takes to be warmer by a kelvin (J/m²K), and to boil (J/m²): a fifth of what it takes in life.
const WATER_CAPACITY: f64 = 4.19e6;
const BOILING_HEAT: f64 = 0.2 * 2260e6;
/// By how much the water is to be warmed until it boils, K.
const BELOW_BOILING: f64 = 373.0 - 283.0;
/// What the heater gives, W for each metre of depth, and how much water it gives it to: that which lies lowest, m².
const POWER: f64 = 1e8;
const HEATED: f64 = 0.24;
/// Times the known time after which it is too late.
const LATEST: f64 = 1.2;

async fn boiling(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("boiling", &[])?;
    let particle = simulation.spacing().powi(2);
    let area = simulation.particles().len() as f64 * particle;
    let known = (WATER_CAPACITY * BELOW_BOILING + BOILING_HEAT) * area / POWER;
    let a_tick = POWER / f64::from(TICKS_PER_SECOND) / particle / f64::from(QUANTUM);
    // What is given is counted in whole quanta: the rest of one is for the next tick.
    let (mut owed, mut curve) = (0.0, Vec::new());
    while simulation.seconds() < LATEST * known {
        simulation.tick().await;
        let mut liquid = liquid(&simulation);
        curve.push((simulation.seconds(), liquid.iter().map(|(_, share)| share).sum()));
        if liquid.is_empty() {
            break;
        }
        liquid.truncate((HEATED / particle).round() as usize);
        owed += a_tick;
        let share = (owed / liquid.len() as f64) as i32;
        owed -= f64::from(share) * liquid.len() as f64;
        let mut particles = simulation.world_mut().resource_mut::<ParticleStore>();
        for (i, _) in liquid {
            let heat = particles.heat_of(i) + share;
            particles.set_heat(i, heat);
        }
    }
    Ok(vec![found("time until all has boiled", known, falls_to(&curve, 0.0).unwrap_or(f64::NAN))])
}

/// The particles that are not all steam by the heat that they hold, the lowest first, and what share of each is water.
fn liquid(simulation: &CaseSimulation) -> Vec<(usize, f64)> {
    let (particles, curves) = (simulation.particles(), simulation.world().resource::<HeatCurves>());
    let water = simulation.matter().elements.find("water");
    let share = |i: usize| {
        let (element, heat) = (particles.element[i], particles.heat_of(i));
        match curves.curve(element).begun(heat) {
            Some((_, boiled)) if Some(element) == water => 1.0 - f64::from(boiled),
            Some((_, condensed)) => f64::from(condensed),
            None => f64::from(u8::from(Some(element) == water)),
        }
    };
    let shares = (0..particles.len()).map(|i| (i, share(i)));
    let mut liquid: Vec<_> = shares.filter(|(_, share)| *share > 0.0).collect();
    liquid.sort_by(|(a, _), (b, _)| particles.y[*a].total_cmp(&particles.y[*b]));
    liquid
}

async fn heat_kept(set_up: SetUp) -> Findings {
    kept(set_up, "heat_kept", "heat that came or went in 10 s").await
}

async fn fire_kept(set_up: SetUp) -> Findings {
    kept(set_up, "fire_kept", "energy that came or went in 10 s").await
}

/// By how much the energy of a scene changes in 10 s, J/m²: heat and chemical energy of all lumps, what the air got, less what
/// grew from light.
async fn kept(set_up: SetUp, scene: &str, quantity: &'static str) -> Findings {
    let mut simulation = set_up.open(scene, &[])?;
    let total = |simulation: &CaseSimulation| {
        let world = simulation.world();
        let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
        let matter = held(particles, rock) + chemical(particles, rock, world.resource::<HeatCurves>());
        (matter + world.resource::<Books>().outside()) as f64 * f64::from(QUANTUM)
    };
    let start = total(&simulation);
    simulation.run(10.0).await;
    Ok(vec![found(quantity, 0.0, total(&simulation) - start)])
}

async fn fire_front(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("fire_front", &[])?;
    // As a length of the beam, m.
    let wood = |simulation: &CaseSimulation| {
        let world = simulation.world();
        let wood = world.resource::<Setup>().elements().find("wood");
        let left = world.resource::<Rock>().iter().filter(|(_, element, _)| Some(*element) == wood).count();
        left as f64 * simulation.spacing().powi(2) / BEAM
    };
    simulation.run(10.0).await;
    let start = wood(&simulation);
    simulation.run(20.0).await;
    Ok(vec![found("speed of the front", 0.175, (start - wood(&simulation)) / 20.0)])
}

async fn ice_floats(set_up: SetUp) -> Findings {
    let mut simulation = set_up.open("ice_floats", &[])?;
    simulation.run(10.0).await;
    let (mut under, mut looks) = (0.0, 0.0);
    // It bobs a little: the mean over two seconds.
    for _ in 0..20 {
        simulation.run(0.1).await;
        under += share_under(&simulation);
        looks += 1.0;
    }
    Ok(vec![found("share under water", 0.917, under / looks)])
}

/// Share of the ice that lies below the water's surface beside it.
fn share_under(simulation: &CaseSimulation) -> f64 {
    let (particles, setup) = (simulation.particles(), simulation.world().resource::<Setup>());
    let Some(ice) = setup.elements().find("ice") else { return f64::NAN };
    let of_ice: Vec<usize> = (0..particles.len()).filter(|i| particles.element[*i] == ice).collect();
    let ends = of_ice
        .iter()
        .fold([f32::MAX, f32::MIN], |[low, high], i| [low.min(particles.x[*i]), high.max(particles.x[*i])]);
    // Columns of 1 d well beside the block, and their highest particles: half a spacing below the surface.
    let mut tops = vec![0.0_f32; setup.domain.size.x as usize + 1];
    for i in (0..particles.len()).filter(|i| particles.element[*i] != ice) {
        let top = &mut tops[particles.x[i] as usize];
        *top = top.max(particles.y[i]);
    }
    let beside = |column: usize| (column as f32) < ends[0] - 5.0 || (column as f32) > ends[1] + 5.0;
    let columns = (2..tops.len().saturating_sub(3)).filter(|column| beside(*column));
    let level = stats::mean(columns.map(|column| f64::from(tops[column]) + 0.5)).unwrap_or(f64::NAN);
    let under = of_ice.iter().filter(|i| f64::from(particles.y[**i]) < level).count();
    under as f64 / of_ice.len() as f64
}
