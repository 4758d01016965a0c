//! The pressure of water that sleeps, which no solver looks at. It is at rest, so every level of a body has one pressure: the
//! weight of what lies above it, of whatever density, up to the highest of the body's surfaces.

use crate::{
    kernel::solids::Solids,
    sim::state::{ParticleStore, Rock, Setup, SleepState},
};
use bevy::prelude::World;
use glam::{IVec2, Vec2};

/// Free cells that sleepers are near, and those that a body was found in.
const NEAR: u8 = 1;
const FOUND: u8 = 2;

/// Buffers, kept from one reading to the next.
#[derive(Clone, Debug, Default)]
pub(super) struct Still {
    /// A mark for each cell of rock or none, of d × d.
    marks: Vec<u8>,
    /// Cells to go on from.
    waiting: Vec<IVec2>,
    /// Mass (kg/m² d²) and particles of each level, of d, from the lowest height up.
    levels: Vec<(f64, u32)>,
}

impl Still {
    /// Bytes held.
    pub fn held(&self) -> usize {
        let Self { marks, waiting, levels } = self;
        marks.capacity() + waiting.capacity() * size_of::<IVec2>() + levels.capacity() * size_of::<(f64, u32)>()
    }

    /// Pressure at a place (d), Pa; `None` if no sleeper is near.
    pub fn pressure(&mut self, world: &World, at: Vec2) -> Option<f32> {
        let (setup, rock) = (world.resource::<Setup>(), world.resource::<Rock>());
        let (particles, scale) = (world.resource::<ParticleStore>(), setup.blueprint.scale);
        let sleepers = 0..world.resource::<SleepState>().asleep().min(particles.len());
        let gravity = setup.domain.gravity;
        let Some(down) = gravity.try_normalize() else { return Some(0.0) };
        self.mark_near(rock, sleepers.clone().map(|i| particles.position(i)));
        self.flood(rock, at)?;
        let mut levels = std::mem::take(&mut self.levels);
        levels.clear();
        let body = || sleepers.clone().filter(|i| self.is_found(rock, particles.position(*i)));
        let height = |at: Vec2| -at.dot(down);
        let top = body().map(|i| height(particles.position(i))).fold(f32::MIN, f32::max) + 0.5;
        let low = height(at);
        levels.resize((top - low).max(0.0).ceil() as usize, (0.0, 0));
        for (i, over) in body().map(|i| (i, height(particles.position(i)) - low)).filter(|(_, over)| *over >= 0.0) {
            if let Some((mass, count)) = levels.get_mut(over as usize) {
                *mass += f64::from(setup.elements().get(particles.element[i]).density);
                *count += 1;
            }
        }
        let weight = weigh(&levels, f64::from(top - low));
        self.levels = levels;
        let gravity = f64::from(scale.to_metres(gravity.length()));
        Some((weight * gravity * f64::from(scale.spacing)) as f32)
    }

    /// Marks the free cells of places (d) and those beside them.
    fn mark_near(&mut self, rock: &Solids, places: impl Iterator<Item = Vec2>) {
        self.marks.clear();
        self.marks.resize((rock.columns() * rock.rows()) as usize, 0);
        for cell in places.map(Solids::cell_of) {
            for beside in [IVec2::ZERO, IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y].map(|way| cell + way) {
                if !rock.is_solid(beside) {
                    self.marks[index(rock, beside)] = NEAR;
                }
            }
        }
    }

    /// Finds the marked cells that hang together with the one of a place (d), or with one beside it.
    fn flood(&mut self, rock: &Solids, at: Vec2) -> Option<()> {
        let cell = Solids::cell_of(at);
        let is_near = |marks: &[u8], cell: IVec2| rock.contains(cell) && marks[index(rock, cell)] == NEAR;
        let around = (-2..=2).flat_map(|y| (-2..=2).map(move |x| IVec2::new(x, y)));
        let start = around.map(|way| cell + way).filter(|cell| is_near(&self.marks, *cell));
        let start = start.min_by_key(|start| (*start - cell).length_squared())?;
        self.marks[index(rock, start)] = FOUND;
        self.waiting.clear();
        self.waiting.push(start);
        while let Some(cell) = self.waiting.pop() {
            for beside in [IVec2::X, IVec2::NEG_X, IVec2::Y, IVec2::NEG_Y].map(|way| cell + way) {
                if is_near(&self.marks, beside) {
                    self.marks[index(rock, beside)] = FOUND;
                    self.waiting.push(beside);
                }
            }
        }
        Some(())
    }

    fn is_found(&self, rock: &Solids, at: Vec2) -> bool {
        let cell = Solids::cell_of(at);
        rock.contains(cell) && self.marks[index(rock, cell)] == FOUND
    }
}

fn index(rock: &Solids, cell: IVec2) -> usize {
    (cell.y * rock.columns() + cell.x) as usize
}

/// What lies on a d of breadth up to a height (d) over the lowest level, kg/m² d: the mean density of each level times how much of it
/// that is. A level without a particle is as heavy as the one below, the lowest as the first that has one.
fn weigh(levels: &[(f64, u32)], height: f64) -> f64 {
    let mean = |(mass, count): &(f64, u32)| (*count > 0).then(|| mass / f64::from(*count));
    let (mut sum, mut density) = (0.0, levels.iter().find_map(mean).unwrap_or(0.0));
    for (k, level) in levels.iter().enumerate() {
        density = mean(level).unwrap_or(density);
        sum += density * (height - k as f64).clamp(0.0, 1.0);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_above_weighs_by_its_density() {
        // A d and a half of oil (two particles of 800) over two of water, of which one level has no particle.
        let levels = [(2000.0, 2), (0.0, 0), (1600.0, 2), (800.0, 1)];
        assert!((weigh(&levels, 3.5) - (2000.0 + 1200.0)).abs() < 1e-9);
        assert_eq!(weigh(&[(0.0, 0), (800.0, 1)], 2.0), 1600.0, "the lowest is as heavy as the first that has one");
        assert_eq!((weigh(&[], 0.4), weigh(&[(0.0, 0)], 0.4)), (0.0, 0.0));
    }
}
