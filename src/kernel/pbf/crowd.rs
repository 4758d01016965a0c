//! Crowds are scattered.

use crate::{
    params::Domain,
    particles::Particles,
    random::{mix, unit},
    solids::Solids,
};
use glam::Vec2;
use std::ops::Range;

/// Half the edge of the square that a crowd of k particles is scattered over is √k times this, d: four to a d².
const SPREAD: f32 = 0.25;

/// Scatters the particles of crowded cells, each crowd evenly over a square around itself, in a direction and by a distance
/// that only depend on the id. Rock and walls stop it; velocities stay. Every particle of a crowd is every other's
/// neighbour: without this, ten thousand at one point cost a tick 10⁸ pairs in every pass, and part like an explosion.
/// Returns how many were moved.
pub(super) fn scatter(
    particles: &mut Particles,
    crowds: impl Iterator<Item = Range<usize>>,
    domain: &Domain,
    solids: &Solids,
) -> u64 {
    let mut moved = 0;
    for crowd in crowds {
        let reach = SPREAD * (crowd.len() as f32).sqrt();
        for i in crowd {
            let (word, other) = (mix(particles.id[i]), mix(!particles.id[i]));
            let from = particles.position(i);
            let offset = reach * Vec2::new(unit(word), unit(other));
            let to = solids.sweep(from, domain.keep_inside(from + offset));
            (particles.x[i], particles.y[i]) = (to.x, to.y);
            moved += 1;
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use crate::{
        element::ElementId,
        params::{Domain, Preset},
        particles::Particles,
        pbf::Solver,
        solids::Solids,
    };
    use glam::{IVec2, Vec2};

    /// Candidate pairs a particle after `count` particles at one point were binned; all must be where `inside` holds.
    fn pairs(count: u32, solids: &Solids, inside: impl Fn(Vec2) -> bool) -> (f64, u64) {
        let mut particles = Particles::default();
        (0..count).for_each(|id| particles.push(id, ElementId(0), Vec2::new(100.3, 100.4), Vec2::new(1.0, 2.0)));
        let (mut solver, domain) = (Solver::default(), Domain { size: Vec2::splat(200.0), gravity: Vec2::ZERO });
        let report = solver.bin(&mut particles, solids, &domain, &Preset::Fast.quality(), 1);
        assert!((0..particles.len()).all(|i| inside(particles.position(i))), "scattered through rock");
        assert!((0..particles.len()).all(|i| particles.velocity(i) == Vec2::new(1.0, 2.0)), "it moves no velocity");
        let candidates = |group: &crate::bins::Group| -> usize {
            group.movable.iter().map(|run| run.range().len()).sum::<usize>() * usize::from(group.len)
        };
        let sum: usize = solver.bins.groups().iter().map(candidates).sum();
        (sum as f64 / f64::from(count), report.set_apart)
    }

    #[test]
    fn a_crowd_is_scattered_so_that_a_tick_can_bear_it() {
        let (candidates, moved) = pairs(10_000, &Solids::new(200, 200), |_| true);
        assert!(candidates < 300.0, "{candidates} candidates a particle, of 10,000 at one point");
        assert!(moved >= 10_000);
    }

    #[test]
    fn what_is_no_crowd_stays_together() {
        let (candidates, _) = pairs(800, &Solids::new(200, 200), |_| true);
        assert_eq!(candidates, 800.0, "every one is every other's neighbour");
    }

    #[test]
    fn a_crowd_in_a_room_stays_in_it() {
        let mut solids = Solids::new(200, 200);
        for k in 0..21 {
            for stone in [(90 + k, 90), (90 + k, 110), (90, 90 + k), (110, 90 + k)] {
                solids.insert(IVec2::from(stone), ElementId(1), 20_000 + 4 * k as u32);
            }
        }
        let room = |at: Vec2| at.cmpge(Vec2::splat(91.0)).all() && at.cmple(Vec2::splat(110.0)).all();
        assert!(pairs(10_000, &solids, room).1 >= 10_000);
    }
}
