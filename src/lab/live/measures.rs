//! All measures of the running world, about once a second while somebody looks: what `run --metrics` measures of a run,
//! of the moment.

use crate::{
    lab::{
        balance::matter,
        sampler::{air_mass, residual},
        volume::volume_error,
    },
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        measures::{AirMeasured, Measured, Measures},
        state::{AirGrid, Clock, ParticleStore, Rock, Setup},
    },
};
use bevy::{
    platform::time::Instant,
    prelude::{Mut, Res, World},
};

/// Run condition: somebody looks.
pub fn is_wanted(measures: Res<Measures>) -> bool {
    measures.wanted()
}

/// Begins anew where another world was put in place since the last tick.
pub fn start(world: &mut World) {
    world.resource_scope(|world, mut measures: Mut<Measures>| start_with(&mut measures, world));
}

fn start_with(measures: &mut Measures, world: &World) {
    if !measures.knows(world) {
        measures.start(world, air_kilograms(world));
    }
}

/// Measures when it is time.
pub fn measure(world: &mut World) {
    world.resource_scope(|world, mut measures: Mut<Measures>| {
        start_with(&mut measures, world);
        if measures.is_due(world.resource::<Clock>().seen()) {
            let measured = take(world, &measures);
            measures.note(measured);
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
