//! What is measured around a place.

use crate::{
    kernel::{
        air::Air,
        heat::units::{CELSIUS, ROOM},
        params::Domain,
        particles::Particles,
        solids::Solids,
        units::Scale,
    },
    lab::gauges::still::Still,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        stages::TickPlan,
        state::{AirGrid, Elements, HeatCurves, MassShares, ParticleStore, PredictorState, Rock, Setup, SleepState},
    },
};
use bevy::prelude::World;
use glam::{IVec2, Vec2};

/// Points along the radius at which the room for matter is looked for.
const SAMPLES: i32 = 16;

/// Share of the weight that has to be open: with less the gauge is in rock.
const OPEN: f64 = 0.02;

/// What a gauge at a place reads. A value is missing where there is nothing to measure.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpotReading {
    /// Particles within the radius.
    pub count: u32,
    /// Density of matter in the room that is open to it, kg/m²; none in rock.
    pub density: Option<f32>,
    /// Mean velocity, m/s.
    pub velocity: Option<Vec2>,
    /// Mean speed, m/s: of what whirls more than the mean velocity.
    pub speed: Option<f32>,
    /// Mean temperature, °C.
    pub temperature: Option<f32>,
    /// Pressure of the liquid over that of the surroundings, Pa; none without the pressure predictor.
    pub pressure: Option<f32>,
    /// The air; none in rock, and where the scene has none.
    pub air: Option<AirReading>,
}

/// What a gauge reads of the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirReading {
    /// Pressure over that of the surroundings, Pa.
    pub pressure: f32,
    /// Velocity, m/s.
    pub velocity: Vec2,
    /// Temperature, °C.
    pub temperature: f32,
}

/// What the particles within the radius add up to, each with its weight.
#[derive(Default)]
struct Sums {
    count: u32,
    weight: f64,
    mass: f64,
    velocity: [f64; 2],
    speed: f64,
    temperature: f64,
    /// Whether one of them sleeps.
    asleep: bool,
    /// The nearest, and the square of its distance, d².
    nearest: Option<(usize, f32)>,
}

/// Reads `world` within `radius` (m) around a place (m).
pub(super) fn read(world: &World, at: Vec2, radius: f32, still: &mut Still) -> SpotReading {
    let Setup { blueprint, domain, .. } = world.resource::<Setup>();
    let scale = blueprint.scale;
    let (at, radius) = (scale.vec_to_kernel(at), scale.to_kernel(radius));
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let asleep = world.resource::<SleepState>().asleep();
    let sums = add_up(world, particles, (at, radius), asleep);
    let open = open_weight(rock, domain, (at, radius));
    let mean = |sum: f64| (sums.count > 0).then(|| (sum / sums.weight) as f32);
    let velocity = mean(sums.velocity[0]).zip(mean(sums.velocity[1])).map(|(x, y)| Vec2::new(x, y));
    let pressure = sums.nearest.and_then(|(nearest, _)| match sums.asleep {
        true => still.pressure(world, at),
        false => flowing_pressure(world, particles, at, nearest),
    });
    let has_air = world.resource::<Effects>().get(Effect::Air).mode != Mode::Off && !rock.is_solid(Solids::cell_of(at));
    SpotReading {
        count: sums.count,
        density: open.map(|open| (sums.mass / open) as f32),
        velocity: velocity.map(|velocity| scale.vec_to_metres(velocity)),
        speed: mean(sums.speed).map(|speed| scale.to_metres(speed)),
        temperature: mean(sums.temperature).map(|kelvin| kelvin - CELSIUS),
        pressure,
        air: has_air.then(|| of_air(world.resource::<AirGrid>(), scale, at)),
    }
}

/// Pressure of matter at a place (m), Pa, as [`SpotReading::pressure`].
pub(in crate::lab) fn pressure(world: &World, at: Vec2) -> Option<f32> {
    let radius = world.resource::<Setup>().blueprint.scale.to_metres(3.0);
    read(world, at, radius, &mut Still::default()).pressure
}

/// Adds up the particles within a radius, weighed with poly6: `(R² − r²)³`, the weight by which the solver finds densities.
fn add_up(world: &World, particles: &Particles, (at, radius): (Vec2, f32), asleep: usize) -> Sums {
    let (elements, curves) = (world.resource::<Setup>().elements(), world.resource::<HeatCurves>());
    let reach2 = radius * radius;
    let mut sums = Sums::default();
    for i in 0..particles.len() {
        let r2 = (particles.position(i) - at).length_squared();
        if r2 >= reach2 {
            continue;
        }
        let weight = f64::from(reach2 - r2);
        let weight = weight * weight * weight;
        let (element, velocity) = (particles.element[i], particles.velocity(i));
        sums.count += 1;
        sums.weight += weight;
        sums.mass += weight * f64::from(elements.get(element).density);
        sums.velocity[0] += weight * f64::from(velocity.x);
        sums.velocity[1] += weight * f64::from(velocity.y);
        sums.speed += weight * f64::from(velocity.length());
        sums.temperature += weight * f64::from(curves.curve(element).temperature(particles.heat_of(i)));
        sums.asleep |= i < asleep;
        if sums.nearest.is_none_or(|(_, nearest)| r2 < nearest) {
            sums.nearest = Some((i, r2));
        }
    }
    sums
}

/// The weight of a particle on each d² of the room within a radius that is open to matter, d² times that; none in rock.
fn open_weight(rock: &Solids, domain: &Domain, (at, radius): (Vec2, f32)) -> Option<f64> {
    let step = radius / SAMPLES as f32;
    let (mut all, mut open) = (0.0, 0.0);
    for j in -SAMPLES..SAMPLES {
        for i in -SAMPLES..SAMPLES {
            let offset = (IVec2::new(i, j).as_vec2() + 0.5) * step;
            let weight = f64::from((radius * radius - offset.length_squared()).max(0.0));
            let weight = weight * weight * weight;
            let place = at + offset;
            let inside = place.cmpge(Vec2::ZERO).all() && place.cmplt(domain.size).all();
            all += weight;
            open += if inside && !rock.is_solid(Solids::cell_of(place)) { weight } else { 0.0 };
        }
    }
    (open > OPEN * all).then_some(open * f64::from(step) * f64::from(step))
}

/// Pressure at a place (d) of matter that moves, Pa, by the predictor's last solve.
fn flowing_pressure(world: &World, particles: &Particles, at: Vec2, nearest: usize) -> Option<f32> {
    if !world.resource::<Effects>().get(Effect::Predictor).running {
        return None;
    }
    let scale = world.resource::<Setup>().blueprint.scale;
    let dt = world.resource::<TickPlan>().substep_seconds();
    // What is in no liquid, as spray is, has no pressure.
    let share = world.resource::<PredictorState>().pressure_at(at, dt).unwrap_or(0.0);
    let element = particles.element[nearest].index();
    let density = world.resource::<Elements>().mass[element];
    let heaviest = density / world.resource::<MassShares>().get().map_or(1.0, |shares| shares[element]);
    Some(heaviest * share * scale.spacing * scale.spacing)
}

fn of_air(air: &Air, scale: Scale, at: Vec2) -> AirReading {
    let cell = (at / air.cell()).as_uvec2();
    let cell = [cell.x as usize, cell.y as usize];
    let kelvin = match air.is_warm() {
        true => air.kelvin_at_cell(cell[0].min(air.columns() - 1), cell[1].min(air.rows() - 1)),
        false => ROOM,
    };
    AirReading {
        pressure: air.overpressure_at(at, IVec2::ZERO) * air.params().stiffness(scale),
        velocity: scale.vec_to_metres(air.sample_velocity(at)),
        temperature: kelvin - CELSIUS,
    }
}
