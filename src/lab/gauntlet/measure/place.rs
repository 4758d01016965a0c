//! Whether every particle is where one may be, and no faster than the limiters leave.

use crate::{
    kernel::{predict::longest_move, solids::Solids},
    sim::{
        stages::TickPlan,
        state::{ParticleStore, Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

/// Particles outside the box or in rock: how many, and where the first of them is, d.
pub(in crate::lab::gauntlet) fn astray(world: &World) -> Option<(usize, Vec2)> {
    let (particles, rock) = (&world.resource::<ParticleStore>().0, world.resource::<Rock>());
    let size = world.resource::<Setup>().blueprint.domain.size;
    let strays = |at: &Vec2| {
        let inside = at.cmpge(Vec2::ZERO).all() && at.cmple(size).all();
        !inside || rock.is_solid(Solids::cell_of(*at))
    };
    let mut astray = (0..particles.len()).map(|i| particles.position(i)).filter(strays);
    let first = astray.next()?;
    Some((1 + astray.count(), first))
}

/// The fastest particle's speed and what the limiters leave, d/s.
///
/// A substep of `dt` moves nothing further than the longest move; then a correction along both axes, and what the air,
/// viscosity and confinement make of the speeds around, which confinement may raise by a tenth of the longest move. The
/// second half of gravity comes after the cut. The next substep cuts it all again.
pub(in crate::lab::gauntlet) fn speeds(world: &World) -> (f64, f64) {
    let (plan, setup) = (world.resource::<TickPlan>(), world.resource::<Setup>());
    let dt = plan.substep_seconds();
    let correction = std::f32::consts::SQRT_2 * setup.quality.longest_correction();
    let gravity = 0.5 * setup.domain.gravity.length() * dt;
    let most = (1.1 * longest_move(&setup.quality) + correction) / dt + gravity;
    let particles = &world.resource::<ParticleStore>().0;
    let fastest = (0..particles.len()).map(|i| particles.velocity(i).length()).fold(0.0, f32::max);
    (f64::from(fastest), f64::from(most))
}
