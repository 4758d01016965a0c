//! Crowds are scattered.

use crate::{
    params::Domain,
    particles::Particles,
    random::{mix, unit},
    solids::Solids,
};
use glam::Vec2;
use std::ops::Range;

/// Particles in a cell that are a crowd, as a multiple of those that have room there. In the gauntlet, what only falls or is
/// pressed stays below half of that in 99 places of a hundred, but at `classic`.
pub(super) const FILL: f32 = 4.0;

/// Scatters the particles of crowded cells, each crowd evenly over the square that has room for it at `rest_density` (1 on
/// the lattice), in directions and by distances that only depend on the ids. Its centre stays where it is, but where rock
/// and walls stop particles; velocities stay. Returns how many were moved.
///
/// What lies inside other matter has not come there by motion: rock was painted, particles were spawned, a file says so. Every
/// particle of a crowd is every other's neighbour: without this, ten thousand at one point cost a tick 10⁸ pairs in every
/// pass; and a heap that is many times too dense falls to the floor before corrections have set it apart.
pub(super) fn scatter(
    particles: &mut Particles,
    crowds: impl Iterator<Item = Range<usize>>,
    rest_density: f32,
    domain: &Domain,
    solids: &Solids,
) -> u64 {
    let mut moved = 0;
    for crowd in crowds {
        let half_edge = 0.5 * (crowd.len() as f32 / rest_density).sqrt();
        let way = |id: u32| half_edge * Vec2::new(unit(mix(id)), unit(mix(!id)));
        let mean = crowd.clone().map(|i| way(particles.id[i])).sum::<Vec2>() / crowd.len() as f32;
        for i in crowd {
            let from = particles.position(i);
            let to = solids.sweep(from, domain.keep_inside(from + way(particles.id[i]) - mean));
            (particles.x[i], particles.y[i]) = (to.x, to.y);
            moved += 1;
        }
    }
    moved
}

#[cfg(test)]
mod tests {
    use super::scatter;
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
        let report = solver.bin(&mut particles, solids, &domain, &Preset::Draft.quality(), 1.0, 1);
        assert!((0..particles.len()).all(|i| inside(particles.position(i))), "scattered through rock");
        assert!((0..particles.len()).all(|i| particles.velocity(i) == Vec2::new(1.0, 2.0)), "it moves no velocity");
        let candidates = |group: &crate::bins::Group| -> usize {
            group.movable.iter().map(|run| run.range().len()).sum::<usize>() * usize::from(group.len)
        };
        let sum: usize = solver.bins.groups().iter().map(candidates).sum();
        (sum as f64 / f64::from(count), report.set_apart)
    }

    #[test]
    fn a_crowd_is_scattered_to_where_it_has_room() {
        let (candidates, moved) = pairs(10_000, &Solids::new(200, 200), |_| true);
        // On the lattice they are those in a square of three reaches, 2.9 d each, and a column.
        assert!(candidates < 120.0, "{candidates} candidates a particle, of 10,000 at one point");
        assert!(moved >= 10_000);
    }

    #[test]
    fn what_is_no_crowd_stays_together() {
        // A cell has room for 2.8 d², in which twelve are four times too many.
        let (candidates, _) = pairs(11, &Solids::new(200, 200), |_| true);
        assert_eq!(candidates, 11.0, "every one is every other's neighbour");
        assert!(pairs(12, &Solids::new(200, 200), |_| true).1 >= 12);
    }

    #[test]
    fn the_centre_of_a_crowd_stays_where_it_is() {
        let mut particles = Particles::default();
        let at = Vec2::new(100.3, 100.4);
        (0..64).for_each(|id| particles.push(id, ElementId(0), at, Vec2::ZERO));
        let domain = Domain { size: Vec2::splat(200.0), gravity: Vec2::ZERO };
        let moved = scatter(&mut particles, std::iter::once(0..64), 1.0, &domain, &Solids::new(200, 200));
        let mean = (0..64).map(|i| particles.position(i)).sum::<Vec2>() / 64.0;
        assert!(moved == 64 && mean.distance(at) < 1e-4, "{moved} about {mean}");
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
