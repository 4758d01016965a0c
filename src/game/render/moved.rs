//! How far each particle went in the last tick, so that between two ticks it is drawn where it was: a speed says less, as what a
//! wall stops within a tick has none afterwards.

use crate::{
    kernel::{particles::Particles, units::TICK_SECONDS},
    sim::generation::Generation,
};
use glam::Vec2;

/// Most ids from the lowest to the highest that places are kept for; beyond, speeds have to do. 32 MB.
const MOST_IDS: usize = 4_000_000;
/// A way that is longer than this, d, and than three times what the speed tells, is none: it was elsewhere in between, as rock.
const JUMP: f32 = 3.0;

/// Ways of all particles, in the order of the store.
#[derive(Clone, Debug, Default)]
pub struct Moved {
    /// The world and the tick that was seen last.
    of: Option<(Generation, u64)>,
    /// Time that the ways took, s.
    span: f32,
    ways: Vec<Vec2>,
    /// Where each id was seen last, from the id `base` on; not a number if it never was.
    last: Vec<Vec2>,
    base: u32,
}

impl Moved {
    /// Sees the world after a tick; the same tick may be seen again.
    pub fn follow(&mut self, (generation, tick): (Generation, u64), particles: &Particles) {
        let before = self.of.filter(|(of, at)| *of == generation && *at <= tick).map(|(_, at)| at);
        if before == Some(tick) && self.ways.len() == particles.len() {
            return;
        }
        self.of = Some((generation, tick));
        self.span = TICK_SECONDS * (tick - before.unwrap_or(tick)).clamp(1, 60) as f32;
        if before.is_none() {
            self.last.clear();
        }
        self.ways.clear();
        if !self.make_room(&particles.id) {
            self.ways.extend((0..particles.len()).map(|i| particles.velocity(i) * self.span));
            return;
        }
        let Particles { id, x, y, vx, vy, .. } = particles;
        let (places, velocities) = (x.iter().zip(y), vx.iter().zip(vy));
        self.ways.extend(id.iter().zip(places.zip(velocities)).map(|(id, ((x, y), (vx, vy)))| {
            let (now, told) = (Vec2::new(*x, *y), Vec2::new(*vx, *vy) * self.span);
            let last = &mut self.last[(id - self.base) as usize];
            let way = now - *last;
            *last = now;
            // Not a number is not within any length.
            let is_way = way.length_squared() <= JUMP * JUMP || way.length() <= JUMP + 3.0 * told.length();
            if is_way { way } else { told }
        }));
    }

    /// Makes room for the last places of these ids; `false` if they are too far apart.
    fn make_room(&mut self, ids: &[u32]) -> bool {
        let (Some(&low), Some(&high)) = (ids.iter().min(), ids.iter().max()) else { return true };
        if (high - low) as usize >= MOST_IDS {
            self.last.clear();
            return false;
        }
        if self.last.is_empty() || low < self.base {
            self.last.clear();
            self.base = low;
        }
        let gone = (low - self.base) as usize;
        if 2 * gone > self.last.len() {
            self.last.drain(..gone.min(self.last.len()));
            self.base = low;
        }
        self.last.resize(((high - self.base) as usize + 1).max(self.last.len()), Vec2::NAN);
        true
    }

    /// The share of their ways that lies within so many seconds before the tick that was seen last.
    pub fn share(&self, back: f32) -> f32 {
        if back > 0.0 { (back / self.span).min(1.0) } else { 0.0 }
    }

    /// Where particle `i` was before the last `share` of its way, but never in rock.
    pub fn at(&self, particles: &Particles, is_rock: impl Fn(Vec2) -> bool, i: usize, share: f32) -> Vec2 {
        let now = particles.position(i);
        let then = now - share * self.ways.get(i).copied().unwrap_or_default();
        if is_rock(then) { now } else { then }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::state::{Clock, ParticleStore, Rock};
    use crate::{
        kernel::{element::ElementId, solids::Solids},
        scene,
        scene::effects::EffectModes,
        sim::{simulation::Simulation, workers::Workers},
    };
    use glam::IVec2;
    use std::{collections::HashMap, sync::Arc};

    /// Where a particle is drawn, `back` seconds before the tick.
    fn at(moved: &Moved, particles: &Particles, rock: &Solids, i: usize, back: f32) -> Vec2 {
        let is_rock = |at| rock.count() > 0 && rock.is_solid(Solids::cell_of(at));
        moved.at(particles, is_rock, i, moved.share(back))
    }

    fn one(id: u32, at: Vec2, velocity: Vec2) -> Particles {
        let mut particles = Particles::default();
        particles.push(id, ElementId(0), at, velocity);
        particles
    }

    #[test]
    fn a_tick_begins_where_the_one_before_ended_whatever_the_order_of_the_particles() {
        let blueprint = scene::load("waterfall").expect("it is built in").build(&[], None, &EffectModes::new());
        let mut simulation = Simulation::new(Arc::new(blueprint.expect("its defaults are sound")), Workers::single());
        simulation.run(40);
        let mut moved = Moved::default();
        let mut ends = HashMap::<u32, Vec2>::new();
        for _ in 0..8 {
            simulation.tick();
            let (particles, rock) = (&simulation.get::<ParticleStore>().0, &simulation.get::<Rock>().0);
            moved.follow((Generation::default(), simulation.get::<Clock>().tick), particles);
            let begun = (0..particles.len()).filter_map(|i| {
                let end = ends.get(&particles.id[i])?;
                Some((at(&moved, particles, rock, i, TICK_SECONDS) - *end).length())
            });
            let apart = begun.clone().fold(0.0, f32::max);
            assert!(apart < 0.001, "a tick begins {apart} d from where the one before ended");
            assert!(ends.is_empty() || begun.count() > 1000, "too few to say so");
            ends = (0..particles.len()).map(|i| (particles.id[i], at(&moved, particles, rock, i, 0.0))).collect();
        }
    }

    #[test]
    fn what_a_wall_stopped_is_not_drawn_where_it_never_was() {
        let (mut moved, rock) = (Moved::default(), Solids::new(64, 64));
        moved.follow((Generation::default(), 1), &one(7, Vec2::new(10.0, 5.0), Vec2::new(120.0, 0.0)));
        // It has come to rest after half of its way.
        let stopped = one(7, Vec2::new(11.0, 5.0), Vec2::ZERO);
        moved.follow((Generation::default(), 2), &stopped);
        assert_eq!(at(&moved, &stopped, &rock, 0, 0.5 * TICK_SECONDS), Vec2::new(10.5, 5.0));
        assert_eq!(at(&moved, &stopped, &rock, 0, 0.0), Vec2::new(11.0, 5.0));
    }

    #[test]
    fn frames_that_skip_ticks_and_ticks_that_are_seen_twice_change_nothing() {
        let (mut moved, rock) = (Moved::default(), Solids::new(64, 64));
        moved.follow((Generation::default(), 10), &one(0, Vec2::splat(10.0), Vec2::ZERO));
        let now = one(0, Vec2::new(14.0, 10.0), Vec2::new(60.0, 0.0));
        for _ in 0..2 {
            moved.follow((Generation::default(), 14), &now);
            assert_eq!(at(&moved, &now, &rock, 0, TICK_SECONDS), Vec2::new(13.0, 10.0), "a quarter of four ticks' way");
        }
    }

    #[test]
    fn what_is_new_or_was_elsewhere_goes_by_its_speed() {
        let (mut moved, rock) = (Moved::default(), Solids::new(64, 64));
        let new = one(5, Vec2::splat(20.0), Vec2::new(60.0, 0.0));
        moved.follow((Generation::default(), 1), &new);
        assert_eq!(at(&moved, &new, &rock, 0, TICK_SECONDS), Vec2::new(19.0, 20.0));
        let far = one(5, Vec2::splat(50.0), Vec2::new(60.0, 0.0));
        moved.follow((Generation::default(), 2), &far);
        assert_eq!(at(&moved, &far, &rock, 0, TICK_SECONDS), Vec2::new(49.0, 50.0));
        // Ids so far apart that no places are kept.
        let mut apart = one(0, Vec2::splat(30.0), Vec2::new(0.0, 60.0));
        apart.push(u32::MAX, ElementId(0), Vec2::splat(40.0), Vec2::ZERO);
        moved.follow((Generation::default(), 3), &apart);
        assert_eq!(at(&moved, &apart, &rock, 0, TICK_SECONDS), Vec2::new(30.0, 29.0));
    }

    #[test]
    fn nothing_is_drawn_in_rock_between_two_ticks() {
        let (mut moved, mut rock) = (Moved::default(), Solids::new(64, 64));
        rock.insert(IVec2::new(10, 10), ElementId(0), 0);
        moved.follow((Generation::default(), 1), &one(0, Vec2::new(9.5, 9.5), Vec2::ZERO));
        // Round the corner of a cell.
        let now = one(0, Vec2::new(11.5, 11.5), Vec2::new(60.0, 60.0));
        moved.follow((Generation::default(), 2), &now);
        assert_eq!(at(&moved, &now, &rock, 0, 0.5 * TICK_SECONDS), Vec2::new(11.5, 11.5));
        assert_eq!(at(&moved, &now, &rock, 0, TICK_SECONDS), Vec2::new(9.5, 9.5));
    }

    #[test]
    fn ids_that_run_away_take_no_more_room_than_those_that_are_there() {
        let mut moved = Moved::default();
        for tick in 0..5000u32 {
            let mut particles = one(10 * tick, Vec2::splat(1.0), Vec2::ZERO);
            particles.push(10 * tick + 9, ElementId(0), Vec2::splat(2.0), Vec2::ZERO);
            moved.follow((Generation::default(), u64::from(tick)), &particles);
        }
        assert!(moved.last.len() <= 40, "{}", moved.last.len());
    }
}
