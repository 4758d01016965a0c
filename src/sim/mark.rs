//! A mark of every tick: a few words over the exact bits of the world, cheap enough to be taken always, by which a replay
//! knows the first tick that differs.
//!
//! Each array is folded by multiplying neighbouring words, shifted by keys that belong to their place, as 32 × 32 → 64
//! bits (the inner product of the NH hash: Black, Halevi, Krawczyk, Krovetz, Rogaway, *UMAC*, CRYPTO 1999). Compilers turn
//! it into lanes on every processor, and wrapping sums are the same in any order. A change goes unseen once in about
//! four thousand million ticks; the next tick's mark sees it, too.

use crate::{
    kernel::{
        air::Air,
        columns::{Column, ColumnVisitor},
        particles::Particles,
        solids::Solids,
    },
    sim::state::Clock,
};
use serde::{Deserialize, Serialize};

/// Sums that are kept side by side: what a compiler turns into vector registers.
const LANES: usize = 8;
/// Distance of the keys of neighbouring places: 2³² over the golden ratio, odd.
const STRIDE: u32 = 0x9e37_79b1;
/// What tells the keys of columns apart.
const SALT: u32 = 0xc2b2_ae35;
/// The salt of the air: no column's.
const AIR: u32 = u32::MAX;
/// Odd factor that spreads a sum's bits: 2⁶⁴ over the golden ratio.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// The world after a tick, in three words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mark {
    /// Number of movable particles.
    pub particles: u32,
    /// Their state, in the order in which they are stored, and the counts of ids and edits.
    pub matter: u32,
    /// Air and rock.
    pub surroundings: u32,
}

/// Takes marks of the states of one world.
#[derive(Clone, Debug, Default)]
pub struct Marker {
    /// Version of the rock that was folded last, and what came out.
    rock: Option<(u64, u64)>,
    /// Edits that quiet air had seen when it was folded last, and what came out: only an edit changes it without waking it.
    quiet: Option<(u64, u64)>,
}

impl Marker {
    /// The mark of a state. The rock is looked at only where its version changed: a world that was put in the place of
    /// another needs a new marker.
    pub fn mark(&mut self, particles: &Particles, rock: &Solids, air: &Air, clock: &Clock) -> Mark {
        let folded = clock.edits.wrapping_mul(SPREAD) ^ u64::from(clock.next_id);
        let mut matter = Columns { count: 0, folded };
        particles.visit(&mut matter);
        if !rock.heats().is_empty() {
            matter.visit(rock.heats());
        }
        Mark {
            particles: particles.len() as u32,
            matter: narrow(matter.folded),
            surroundings: narrow(chain(self.rock(rock), self.air(air, clock.edits))),
        }
    }

    fn rock(&mut self, rock: &Solids) -> u64 {
        match self.rock {
            Some((version, folded)) if version == rock.version() => folded,
            _ => {
                let mut folded = 0_u64;
                rock.iter().for_each(|(cell, element, id)| {
                    let place = (cell.x as u64) << 32 | cell.y as u64;
                    let kind = u64::from(element.0) << 32 | u64::from(id);
                    folded = (folded ^ place).wrapping_mul(SPREAD).rotate_left(29).wrapping_add(kind);
                });
                self.rock = Some((rock.version(), folded));
                folded
            }
        }
    }

    fn air(&mut self, air: &Air, edits: u64) -> u64 {
        match self.quiet {
            Some((seen, folded)) if air.is_quiet() && seen == edits => folded,
            _ => {
                let folded = fold_air(air);
                self.quiet = air.is_quiet().then_some((edits, folded));
                folded
            }
        }
    }
}

fn fold_air(air: &Air) -> u64 {
    let mut sums = Sums::new(AIR);
    for row in 0..air.rows() {
        sums.fold(air.pressure_row(row), air.velocity_x_row(row));
        sums.fold_halves(air.velocity_y_row(row));
        sums.fold_halves(air.warmth_row(row));
    }
    sums.total()
}

/// The columns of particles, folded one after the other.
struct Columns {
    count: u32,
    folded: u64,
}

impl ColumnVisitor for Columns {
    fn visit<T: Column>(&mut self, column: &[T]) {
        self.count += 1;
        let mut sums = Sums::new(self.count);
        sums.fold_halves(column);
        self.folded = chain(self.folded, sums.total());
    }
}

/// Sums of products of keyed words.
struct Sums {
    keys: [u32; LANES],
    sums: [u64; LANES],
}

impl Sums {
    fn new(salt: u32) -> Self {
        let key = |lane| (lane as u32).wrapping_mul(STRIDE).wrapping_add(salt.wrapping_mul(SALT));
        Self { keys: std::array::from_fn(key), sums: [0; LANES] }
    }

    /// Folds two arrays of the same length.
    fn fold<T: Column>(&mut self, a: &[T], b: &[T]) {
        let ((a, last_a), (b, last_b)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
        for (a, b) in a.iter().zip(b) {
            for k in 0..LANES {
                self.add(k, a[k].word(), b[k].word());
            }
        }
        for (k, (a, b)) in last_a.iter().zip(last_b).enumerate() {
            self.add(k, a.word(), b.word());
        }
    }

    /// Folds an array by itself: a product has two factors, so one half is multiplied with the other.
    fn fold_halves<T: Column>(&mut self, array: &[T]) {
        let half = array.len().div_ceil(2);
        self.fold(&array[..half], &array[array.len() - half..]);
    }

    #[inline(always)]
    fn add(&mut self, lane: usize, a: u32, b: u32) {
        let key = self.keys[lane];
        let product = u64::from(a.wrapping_add(key)) * u64::from(b.wrapping_sub(key));
        self.sums[lane] = self.sums[lane].wrapping_add(product);
        self.keys[lane] = key.wrapping_add(STRIDE.wrapping_mul(LANES as u32));
    }

    fn total(self) -> u64 {
        self.sums.into_iter().fold(0, u64::wrapping_add)
    }
}

/// Takes a sum up into those before it.
fn chain(before: u64, sum: u64) -> u64 {
    (before.rotate_left(32) ^ sum).wrapping_mul(SPREAD)
}

fn narrow(all: u64) -> u32 {
    (all ^ all >> 32) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{
        element::ElementId,
        params::{AIR_DENSITY, AirParams, OpenSides},
        sources::Rect,
    };
    use glam::{IVec2, Vec2};

    fn world() -> (Particles, Solids, Air, Clock) {
        let mut particles = Particles::default();
        for i in 0..300_u32 {
            let at = Vec2::new(0.37 * i as f32 % 19.0, 0.11 * i as f32);
            particles.push(i * 3, ElementId(1), at, Vec2::new(at.y - 3.0, 0.5 * at.x));
        }
        let mut rock = Solids::new(20, 40);
        (3..9).for_each(|x| assert!(rock.insert(IVec2::new(x, 2), ElementId(0), 1000 + x as u32)));
        let mut air = Air::new(
            Vec2::new(20.0, 40.0),
            2.0,
            AirParams { sound_speed: 30.0, density: AIR_DENSITY, open: OpenSides::default() },
        );
        air.fill_pressure(Rect { min: Vec2::splat(4.0), max: Vec2::splat(9.0) }, 2.0);
        (particles, rock, air, Clock { tick: 3, edits: 2, next_id: 2000 })
    }

    fn mark(world: &(Particles, Solids, Air, Clock)) -> Mark {
        Marker::default().mark(&world.0, &world.1, &world.2, &world.3)
    }

    #[test]
    fn every_bit_of_every_particle_counts() {
        let world = world();
        let before = mark(&world);
        assert_eq!(mark(&world), before);
        for i in [0, 1, 7, 150, 299] {
            for bit in 0..32 {
                for field in 0..5 {
                    let mut changed = world.clone();
                    let particles = &mut changed.0;
                    let value = [&mut particles.x, &mut particles.y, &mut particles.vx, &mut particles.vy];
                    match value.into_iter().nth(field) {
                        Some(value) => value[i] = f32::from_bits(value[i].to_bits() ^ 1 << bit),
                        None => particles.id[i] ^= 1 << bit,
                    }
                    let after = mark(&changed);
                    assert_ne!(after.matter, before.matter, "particle {i}, field {field}, bit {bit}");
                    assert_eq!(after.surroundings, before.surroundings);
                }
            }
        }
        let mut swapped = world.clone();
        swapped.0.id.swap(4, 5);
        assert_ne!(mark(&swapped).matter, before.matter, "two ids were swapped");
        let mut other = world.clone();
        other.0.element[8] = ElementId(2);
        assert_ne!(mark(&other).matter, before.matter);
        let mut later = world;
        later.3.edits += 1;
        assert_ne!(mark(&later).matter, before.matter, "edits choose the sites of pouring");
    }

    #[test]
    fn air_and_rock_count_and_the_rock_is_looked_at_again_when_it_changes() {
        let mut world = world();
        let mut marker = Marker::default();
        let mut take = |world: &(Particles, Solids, Air, Clock)| marker.mark(&world.0, &world.1, &world.2, &world.3);
        let before = take(&world);
        world.2.blow(Vec2::splat(12.0), 1.5, Vec2::new(0.0, 1e-3));
        let windy = take(&world);
        assert_ne!(windy.surroundings, before.surroundings);
        assert!(world.1.remove(IVec2::new(5, 2)));
        let holed = take(&world);
        assert_ne!(holed.surroundings, windy.surroundings);
        assert!(world.1.insert(IVec2::new(5, 2), ElementId(0), 7));
        assert_ne!(take(&world).surroundings, windy.surroundings, "another particle of rock at the same place");
        assert_eq!((windy.matter, holed.particles), (before.matter, 300));
        world.2.clear();
        let quiet = take(&world);
        assert!(world.2.is_quiet() && take(&world) == quiet && quiet.surroundings != windy.surroundings);
        world.2.press(Vec2::splat(12.0), 1.5, 1e-3);
        assert_ne!(take(&world).surroundings, quiet.surroundings, "air that was woken");
    }
}
