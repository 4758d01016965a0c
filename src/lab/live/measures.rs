//! All measures of the running world besides its density error, about once a second while they are shown: what
//! `run --metrics` measures of a run, of the moment. Nothing here changes a world.

use crate::{
    lab::{
        balance::matter,
        sampler::{air_mass, residual},
        volume::volume_error,
    },
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        generation::Generation,
        state::{AirGrid, Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{Mut, Res, Resource, World},
};
use glam::DVec2;
use std::time::Duration;

/// Time from one measurement to the next.
const INTERVAL: Duration = Duration::from_secs(1);

/// One measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Ticks and edits of the world.
    pub seen: (u64, u64),
    /// Mean of ρ/ρ₀ − 1 over the particles where it is above 0, as the solver saw it in its last iteration; `None` before
    /// its first.
    pub residual: Option<f64>,
    /// Room that the liquid takes against what it stands for, a share; `None` without any.
    pub volume_error: Option<f64>,
    /// Kinetic energy of the particles, J for each metre of depth.
    pub kinetic: f64,
    /// Their potential energy over the floor of the box, J for each metre of depth.
    pub potential: f64,
    /// Their momentum, kg m/s for each metre of depth.
    pub momentum: DVec2,
    /// The air, unless it is switched off.
    pub air: Option<AirMeasured>,
    /// Time that measuring took.
    pub cost: Duration,
}

/// What is measured of the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AirMeasured {
    /// Mass, kg for each metre of depth.
    pub mass: f64,
    /// How much more or less it is than when measuring began or the world was put in place, a share.
    pub drift: f64,
    /// Root mean square of the divergence of its velocity, 1/s.
    pub divergence: f64,
}

/// The measurements: wanted or not, and the last one.
#[derive(Resource, Clone, Debug, Default)]
pub struct Measures {
    wanted: bool,
    last: Option<(Measured, Instant)>,
    start: Option<Start>,
}

/// What the drift is measured against.
#[derive(Clone, Debug)]
struct Start {
    generation: Generation,
    /// Mass of the air at the start, kg.
    air_mass: f64,
}

impl Measures {
    /// Whether they are shown: otherwise nothing is measured and costs nothing.
    pub fn wanted(&self) -> bool {
        self.wanted
    }

    /// Begins or ends measuring. What was measured before is forgotten.
    pub fn want(&mut self, wanted: bool) {
        *self = Self { wanted, ..Self::default() };
    }

    /// The last measurement.
    pub fn latest(&self) -> Option<&Measured> {
        self.last.as_ref().map(|(measured, _)| measured)
    }

    /// Whether it is time to measure a world that has seen so much: once a second, as long as it changes.
    fn is_due(&self, seen: (u64, u64)) -> bool {
        self.last.as_ref().is_none_or(|(last, at)| last.seen != seen && at.elapsed() >= INTERVAL)
    }

    /// Begins anew if `world` is not the one that measuring began with.
    fn follow(&mut self, world: &World) {
        let generation = Generation::of(world);
        if self.start.as_ref().is_none_or(|start| start.generation != generation) {
            self.start = Some(Start { generation, air_mass: air_kilograms(world) });
            self.last = None;
        }
    }

    /// How much more or less than at the start `air_mass` (kg) is, a share; 0 of none.
    fn drift(&self, air_mass: f64) -> f64 {
        let before = self.start.as_ref().map_or(air_mass, |start| start.air_mass);
        if before > 0.0 { (air_mass - before) / before } else { 0.0 }
    }
}

/// Run condition: the measures are shown.
pub fn is_wanted(measures: Res<Measures>) -> bool {
    measures.wanted()
}

/// Begins anew if the world was replaced since the last tick.
pub fn start(world: &mut World) {
    world.resource_scope(|world, mut measures: Mut<Measures>| measures.follow(world));
}

/// Measures when it is time.
pub fn measure(world: &mut World) {
    world.resource_scope(|world, mut measures: Mut<Measures>| {
        measures.follow(world);
        if measures.is_due(world.resource::<Clock>().seen()) {
            measures.last = Some((take(world, &measures), Instant::now()));
        }
    });
}

fn take(world: &World, measures: &Measures) -> Measured {
    let begun = Instant::now();
    let blueprint = &world.resource::<Setup>().blueprint;
    let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
    let balance = matter(world).balance();
    let there_is_air = world.resource::<Effects>().get(Effect::Air).mode != Mode::Off;
    let air = there_is_air.then(|| {
        let mass = air_kilograms(world);
        let divergence = world.resource::<AirGrid>().divergence_rms();
        AirMeasured { mass, drift: measures.drift(mass), divergence }
    });
    Measured {
        seen: world.resource::<Clock>().seen(),
        residual: residual(world).filter(|_| !particles.is_empty()),
        volume_error: volume_error(particles, rock, blueprint.domain.size, f64::from(blueprint.fluid.rest_density)),
        kinetic: balance.kinetic,
        potential: balance.potential,
        momentum: balance.momentum,
        air,
        cost: begun.elapsed(),
    }
}

/// Mass of the air for each metre of depth, kg.
fn air_kilograms(world: &World) -> f64 {
    let blueprint = &world.resource::<Setup>().blueprint;
    let spacing = f64::from(blueprint.scale.spacing);
    air_mass(world) * spacing * spacing * f64::from(blueprint.air.density)
}
