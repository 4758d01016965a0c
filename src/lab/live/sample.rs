//! The density error from a sample of the particles: cheap enough for every few ticks of a game.
//!
//! One particle of each of equal parts of the store is looked at (the store is sorted by place, so they are spread
//! over the liquid); one pass over the others finds their neighbours.

use crate::{
    kernel::{particles::Particles, random::Random, solids},
    lab::density::{DensityError, Grid, Lattice, Local, NEIGHBOUR, ROCK},
};
use bevy::prelude::Resource;
use glam::{IVec2, Vec2};

/// Particles in a sample.
const SIZE: usize = 320;
/// Edge of a cell of the lattice, d.
const CELL: i32 = crate::lab::density::SUPPORT as i32;

/// Memory that is used again.
#[derive(Resource, Clone, Debug, Default)]
pub struct Scratch {
    /// Cells of the lattice in which neighbours may be.
    wanted: Vec<bool>,
    /// Particles looked at, rising.
    chosen: Vec<u32>,
    points: Vec<(Vec2, u32)>,
    locals: Vec<Local>,
}

impl Scratch {
    /// The density error estimated from 320 particles (of all, if there are fewer); `seed` chooses them. `None` if none
    /// of them is interior. Otherwise as [`crate::lab::density::density_error`].
    pub fn density_error(
        &mut self,
        particles: &Particles,
        rock: &solids::Solids,
        size: Vec2,
        rest_density: f64,
        seed: u64,
    ) -> Option<DensityError> {
        let lattice = Lattice::new(size);
        self.choose(particles, &lattice, seed);
        self.want(particles, &lattice);
        self.gather(particles, rock, &lattice);
        let grid = Grid::new(&lattice, std::mem::take(&mut self.points));
        self.locals.clear();
        let looked_at = (0..grid.source.len()).filter(|&k| grid.source[k] < NEIGHBOUR);
        self.locals.extend(looked_at.map(|k| grid.look_around(k)));
        // In the order of the store, whatever cells they are in, so that the sums do not depend on the lattice.
        DensityError::of(&self.locals, rest_density)
    }

    fn choose(&mut self, particles: &Particles, lattice: &Lattice, seed: u64) {
        self.chosen.clear();
        let (count, parts) = (particles.len(), particles.len().min(SIZE));
        let mut random = Random::new(seed);
        for part in 0..parts {
            let (first, end) = (part * count / parts, (part + 1) * count / parts);
            let index = first + (random.number() >> 1) as usize % (end - first);
            if lattice.holds(particles.position(index)) {
                self.chosen.push(index as u32);
            }
        }
    }

    fn want(&mut self, particles: &Particles, lattice: &Lattice) {
        self.wanted.clear();
        self.wanted.resize(lattice.columns * lattice.rows, false);
        for &index in &self.chosen {
            let (column, row) = lattice.place(particles.position(index as usize));
            for row in row.saturating_sub(1)..=(row + 1).min(lattice.rows - 1) {
                let first = row * lattice.columns;
                self.wanted[first + column.saturating_sub(1)..=first + (column + 1).min(lattice.columns - 1)]
                    .fill(true);
            }
        }
    }

    fn gather(&mut self, particles: &Particles, rock: &solids::Solids, lattice: &Lattice) {
        self.points.clear();
        let mut chosen = self.chosen.iter().copied().peekable();
        for index in 0..particles.len() {
            let position = particles.position(index);
            if !lattice.holds(position) {
                continue;
            }
            let (column, row) = lattice.place(position);
            if self.wanted[row * lattice.columns + column] {
                let source = chosen.next_if_eq(&(index as u32)).unwrap_or(NEIGHBOUR);
                self.points.push((position, source));
            }
        }
        if rock.count() == 0 {
            return;
        }
        for (cell, _) in self.wanted.iter().enumerate().filter(|(_, wanted)| **wanted) {
            // Cells of the lattice begin d outside the box.
            let corner = IVec2::new((cell % lattice.columns) as i32, (cell / lattice.columns) as i32) * CELL - 1;
            for site in (0..CELL * CELL).map(|k| corner + IVec2::new(k % CELL, k / CELL)) {
                if rock.get(site).is_some() {
                    self.points.push((solids::centre(site), ROCK));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        kernel::element::ElementId,
        lab::{
            density::density_error,
            testing::{lattice, world},
        },
        scene::{self, effects::EffectModes},
        sim::{
            simulation::Simulation,
            state::{ParticleStore, Rock, Setup},
            workers::Workers,
        },
    };
    use std::sync::Arc;

    #[test]
    fn a_sample_of_few_is_all_of_them() {
        let size = Vec2::new(20.0, 18.0);
        let particles = world(lattice(15, 14, 0.9));
        let mut rock = solids::Solids::new(20, 18);
        for x in 0..20 {
            rock.insert(IVec2::new(x, 13), ElementId(1), 1_000 + x as u32);
        }
        let whole = density_error(&particles, &rock, size, 1.0).unwrap();
        let sample = Scratch::default().density_error(&particles, &rock, size, 1.0, 3).unwrap();
        assert!((whole.mean - sample.mean).abs() < 1e-12 && whole.max == sample.max, "{whole:?} is not {sample:?}");
    }

    #[test]
    fn a_sample_estimates_the_error_of_a_flowing_scene() {
        let settings = [("columns".to_owned(), "60".to_owned())];
        let blueprint = scene::load("dam_break").unwrap().build(&settings, None, &EffectModes::new()).unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::default());
        let (mut whole, mut sampled, mut scratch) = (Vec::new(), Vec::new(), Scratch::default());
        for tick in 0..120 {
            simulation.tick();
            let world = simulation.world();
            let (particles, rock) = (world.resource::<ParticleStore>(), world.resource::<Rock>());
            let size = world.resource::<Setup>().blueprint.domain.size;
            if tick >= 30 {
                whole.push(density_error(particles, rock, size, 1.0).unwrap().mean);
                // The few particles that err carry the mean: it takes many samples to meet it.
                for seed in 0..4 {
                    let sample = scratch.density_error(particles, rock, size, 1.0, 4 * tick + seed);
                    sampled.push(sample.unwrap().mean);
                }
            }
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        let ratio = mean(&sampled) / mean(&whole);
        assert!((ratio - 1.0).abs() < 0.15, "the samples see {ratio} of the error");
    }

    #[test]
    fn nothing_and_nonsense_have_no_error() {
        let (size, rock) = (Vec2::new(9.0, 9.0), solids::Solids::new(9, 9));
        let mut scratch = Scratch::default();
        assert_eq!(scratch.density_error(&Particles::default(), &rock, size, 1.0, 0), None);
        let absurd = world([Vec2::NAN, Vec2::splat(1e30), Vec2::splat(4.0)]);
        assert_eq!(scratch.density_error(&absurd, &rock, size, 1.0, 0), None, "a lone particle is not interior");
    }
}
