//! What a calm tick of a case's world takes: the same box, rock, quality, effects and number of particles, with all of them at
//! rest on the lattice in air at rest.

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
    sim::ledger::PassLedger,
};
use glam::{IVec2, Vec2};

/// Ticks that it is measured in, after as many in which buffers grow.
const TICKS: usize = 9;

/// Time of a calm tick, ms: the median, with the particles of the start or, where more were added, `ended`. Yields after each
/// tick.
pub(super) async fn calm_ms(blueprint: &Blueprint, ended: &Particles) -> f64 {
    let mut calm = blueprint.clone();
    (calm.emitters, calm.winds, calm.drains, calm.pressures) = Default::default();
    // Water that lies on a floor; a gravity that points elsewhere would have it fall.
    calm.domain.gravity = Vec2::new(0.0, -calm.domain.gravity.length());
    let most = if ended.len() > blueprint.particles.len() { ended } else { &blueprint.particles };
    calm.particles = at_rest(most, &blueprint.solids);
    // The air rests and is simulated all the same: what an effect costs that a case calls for is not what is hard about the case.
    for effect in [Effect::Air, Effect::AirFeedback, Effect::Drag] {
        calm.effects.entry(effect).or_insert(Mode::On);
    }
    let mut simulation = CaseSimulation::new(calm, &Stopwatch::default());
    let mut ms = Vec::new();
    for tick in 0..2 * TICKS {
        simulation.tick().await;
        if tick >= TICKS {
            ms.push(simulation.world().resource::<PassLedger>().last_tick().as_secs_f64() * 1e3);
        }
    }
    stats::quantile(&mut ms, 0.5).unwrap_or(0.0)
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
