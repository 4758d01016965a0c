//! What a calm tick of a case's world takes: the same box, rock, quality and number of particles, the effects that ran in most
//! of the case's ticks, with all particles at rest on the lattice in air at rest.

use crate::{
    kernel::{particles::Particles, solids::Solids},
    lab::{
        cases::{CaseSimulation, Stopwatch},
        stats,
    },
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
    sim::{
        effects::Effects,
        ledger::PassLedger,
        state::{Clock, ParticleStore},
    },
};
use bevy::ecs::world::World;
use glam::{IVec2, Vec2};

/// Ticks that it is measured in, after as many in which buffers grow.
const TICKS: usize = 9;

/// Time of a calm tick, ms: the median. The case ended as `ended`.
pub(super) async fn calm_ms(blueprint: &Blueprint, ended: &World) -> f64 {
    let mut simulation = CaseSimulation::new(calm_world(blueprint, ended), &Stopwatch::default());
    let mut ms = Vec::new();
    for tick in 0..2 * TICKS {
        simulation.tick().await;
        if tick >= TICKS {
            ms.push(simulation.world().resource::<PassLedger>().last_tick().as_secs_f64() * 1e3);
        }
    }
    stats::quantile(&mut ms, 0.5).unwrap_or(0.0)
}

/// The calm world, with the particles of the start or, where more were added, of the end.
fn calm_world(blueprint: &Blueprint, ended: &World) -> Blueprint {
    let mut calm = blueprint.clone();
    (calm.emitters, calm.winds, calm.drains, calm.pressures) = Default::default();
    // Water that lies on a floor; a gravity that points elsewhere would have it fall.
    calm.domain.gravity = Vec2::new(0.0, -calm.domain.gravity.length());
    let after = &ended.resource::<ParticleStore>().0;
    let most = if after.len() > blueprint.particles.len() { after } else { &blueprint.particles };
    calm.particles = at_rest(most, &blueprint.solids);
    // Nothing moves, is warm or burns here, so that what the case calls for would not run by itself.
    for effect in Effect::ALL.into_iter().filter(|effect| *effect != Effect::Sleep && is_called_for(*effect, ended)) {
        calm.effects.entry(effect).or_insert(Mode::On);
    }
    calm
}

/// Whether an effect belongs to the case: what it costs is not what is hard about it. Air at rest is simulated in any.
fn is_called_for(effect: Effect, ended: &World) -> bool {
    let ran = ended.resource::<Effects>().get(effect).active_ticks;
    matches!(effect, Effect::Air | Effect::AirFeedback | Effect::Drag) || 2 * ran > ended.resource::<Clock>().tick
}

/// Particles, put on the free cells row by row from the floor up.
fn at_rest(particles: &Particles, solids: &Solids) -> Particles {
    let sites = (0..solids.rows()).flat_map(|y| (0..solids.columns()).map(move |x| IVec2::new(x, y)));
    let mut free = sites.filter(|cell| !solids.is_solid(*cell));
    let mut calm = Particles::default();
    for i in 0..particles.len() {
        let Some(cell) = free.next() else { break };
        calm.push(particles.id[i], particles.element[i], cell.as_vec2() + 0.5, Vec2::ZERO);
    }
    calm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::params::Preset,
        lab::gauntlet::CASES,
        sim::{simulation::Simulation, workers::Workers},
    };
    use std::sync::Arc;

    /// Effects that are on in the calm world of a case after `ticks` of its ticks.
    fn on_after(name: &str, ticks: u64) -> Vec<Effect> {
        let case = CASES.iter().find(|case| case.name == name).unwrap();
        let blueprint = case.blueprint(Preset::Draft, 1.0).unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint.clone()), Workers::single());
        (0..ticks).for_each(|_| simulation.tick());
        let calm = calm_world(&blueprint, simulation.world());
        calm.effects.into_iter().filter(|(_, mode)| *mode == Mode::On).map(|(effect, _)| effect).collect()
    }

    /// Nothing in the calm world is hot, and it has the cost of heat all the same, if the case has.
    #[test]
    fn a_calm_tick_has_the_effects_of_its_case() {
        let hot = on_after("magazine", 3);
        assert!([Effect::Heat, Effect::Expansion, Effect::Air].iter().all(|effect| hot.contains(effect)), "{hot:?}");
        let cold = on_after("two_at_a_point", 3);
        assert!([Effect::Heat, Effect::Friction].iter().all(|effect| !cold.contains(effect)), "{cold:?}");
    }
}
