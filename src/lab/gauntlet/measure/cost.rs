//! What a tick costs against a calm one, the air included.

use super::work::Work;
use crate::{
    kernel::units::TICK_SECONDS,
    scene::passes::Pass,
    sim::{
        ledger::PassLedger,
        state::{AirGrid, ParticleStore, Setup},
    },
};
use bevy::ecs::world::World;

/// Candidate pairs that take the time of a cell in a step of the air: 7.7 ns (docs/performance.md) against half a nanosecond.
/// An iteration is two passes of 11 ns over a particle with 81 candidates, and what stands around it takes as much again.
const PAIRS_A_CELL: f64 = 15.0;

/// The work of the last tick, of particles and air together, as a multiple of a calm tick's of the same world: all
/// particles in a pool at rest at the quality's substeps, all cells of air in as many steps as air at rest takes.
pub(in crate::lab::gauntlet) fn of_tick(pairs: &mut Work, world: &World) -> f64 {
    let (setup, air) = (world.resource::<Setup>(), world.resource::<AirGrid>());
    let pass = world.resource::<PassLedger>().record(Pass::Air).last;
    let steps = PAIRS_A_CELL * pass.touched as f64;
    let substeps = setup.quality.substeps;
    let calm_steps = air.substeps_at_rest(setup.quality.air_courant, TICK_SECONDS / substeps as f32) * substeps;
    let calm_air = PAIRS_A_CELL * (air.columns() * air.rows()) as f64 * f64::from(calm_steps);
    let calm_passes = f64::from(substeps * setup.quality.iterations);
    let calm = pairs.calm(world) * world.resource::<ParticleStore>().len() as f64 * calm_passes + calm_air;
    (pairs.pairs(world) + steps) / calm
}
