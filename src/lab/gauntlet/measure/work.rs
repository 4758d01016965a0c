//! What a tick costs in work that is the same on every machine: candidate pairs of particles, in every pass over them.

use crate::{
    kernel::{
        bins::Bins,
        element::ElementId,
        params::{Domain, Quality},
        particles::Particles,
        pbf::Solver,
        solids::Solids,
    },
    scene::passes::Pass,
    sim::{
        ledger::PassLedger,
        state::{Setup, SolverState},
    },
};
use bevy::ecs::world::World;
use glam::Vec2;

/// Edge of the pool whose candidates are a calm tick's, d.
const POOL: u16 = 60;

/// Counts work. Remembers what a calm particle takes.
#[derive(Clone, Debug, Default)]
pub(in crate::lab::gauntlet) struct Work {
    calm: Option<(Quality, f64)>,
}

impl Work {
    /// Candidate pairs of the last tick: those of each particle in its last substep, in all passes over particles.
    pub(super) fn pairs(&self, world: &World) -> f64 {
        let solved = world.resource::<PassLedger>().record(Pass::Solve).last.touched;
        let passes = solved as f64 * f64::from(world.resource::<Setup>().quality.iterations);
        if solved == 0 { 0.0 } else { candidates(&world.resource::<SolverState>().bins) * passes }
    }

    /// Candidate pairs of a particle at rest, in one pass: on the lattice, or as dense as the liquid rests if that is denser.
    pub(super) fn calm(&mut self, world: &World) -> f64 {
        let setup = world.resource::<Setup>();
        let (quality, density) = (setup.quality, f64::from(setup.blueprint.fluid.rest_density.max(1.0)));
        density * self.on_the_lattice(world, quality)
    }

    fn on_the_lattice(&mut self, world: &World, quality: Quality) -> f64 {
        match self.calm {
            Some((of, candidates)) if of == quality => candidates,
            _ => self.calm.insert((quality, in_a_pool(world, &quality))).1,
        }
    }
}

/// Candidates of a particle of a full box, binned as the world's are.
fn in_a_pool(world: &World, quality: &Quality) -> f64 {
    let solver = world.resource::<SolverState>();
    let mut pool = Particles::default();
    for (id, k) in (0..POOL * POOL).enumerate() {
        let at = Vec2::new(f32::from(k % POOL), f32::from(k / POOL)) + 0.5;
        pool.push(id as u32, ElementId(0), at, Vec2::ZERO);
    }
    let (domain, rock) = (Domain { size: Vec2::splat(POOL.into()), gravity: Vec2::ZERO }, Solids::default());
    let mut binned = Solver::new(solver.instructions, solver.neighbours);
    binned.bin(&mut pool, &rock, &domain, quality, 1.0, 1);
    candidates(&binned.bins)
}

/// Candidates of a particle, on the mean.
fn candidates(bins: &Bins) -> f64 {
    let (mut pairs, mut particles) = (0, 0);
    for group in bins.groups() {
        let near: usize = group.movable.iter().map(|run| run.range().len()).sum();
        pairs += near * group.particles().len();
        particles += group.particles().len();
    }
    if particles > 0 { pairs as f64 / particles as f64 } else { 0.0 }
}
