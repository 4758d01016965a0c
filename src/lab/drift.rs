//! The momentum drift: by how much the liquid's momentum changes without a force from outside.

use crate::{
    kernel::{params::Quality, units::TICK_SECONDS},
    lab::balance::{Balance, floats_free, matter},
    scene::effects::Effect,
    sim::{
        effects::Effects,
        state::{Rock, Setup},
    },
};
use bevy::ecs::world::World;
use glam::DVec2;

/// Follows the momentum through the ticks in which only gravity acts from outside.
#[derive(Default)]
pub(super) struct Drift {
    before: Option<(Balance, usize)>,
    sum: DVec2,
    momentum_sum: f64,
    ticks: u64,
}

impl Drift {
    /// The world after a tick, or at the start.
    pub(super) fn follow(&mut self, world: &World) {
        let now = Self::undisturbed(world);
        if let (Some((before, was)), Some((after, is))) = (self.before, now)
            && was == is
        {
            let matter = matter(world);
            let gravity = matter.domain.gravity.as_dvec2() * f64::from(matter.scale.spacing);
            self.sum += after.momentum - before.momentum - after.mass * gravity * f64::from(TICK_SECONDS);
            self.momentum_sum = self.momentum_sum.max(after.momentum_sum);
            self.ticks += 1;
        }
        self.before = now;
    }

    /// Balance and number of the particles if no wall, rock or air can have touched them since the last tick.
    fn undisturbed(world: &World) -> Option<(Balance, usize)> {
        let matter = matter(world);
        let Quality { kernel_radius, .. } = world.resource::<Setup>().quality;
        let near = |reach| !floats_free(matter.particles, world.resource::<Rock>(), matter.domain.size, reach);
        if matter.particles.is_empty() || world.resource::<Effects>().get(Effect::Drag).running || near(kernel_radius) {
            return None;
        }
        let balance = matter.balance();
        let step = matter.scale.to_kernel(balance.max_speed as f32) * TICK_SECONDS;
        (!near(kernel_radius + step + 1.0)).then_some((balance, matter.particles.len()))
    }

    /// The drift as a share of the largest Σ m |v|; `None` without such a tick.
    pub(super) fn share(&self) -> Option<f64> {
        (self.ticks > 0 && self.momentum_sum > 0.0).then(|| self.sum.length() / self.momentum_sum)
    }
}
