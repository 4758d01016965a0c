//! Looks over all particles once a tick: what is no longer a number, what is where none may be, how fast the
//! fastest is, how many there are.

use crate::{
    element::ElementId,
    parallel::over,
    params::Domain,
    particles::{Particles, Value},
    solids::Solids,
};
use glam::IVec2;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};

/// Particles that are looked at together.
const BLOCK: usize = 256;
/// Greatest speeds that are kept side by side, so that the loop over them fills the lanes.
const FASTEST_OF: usize = 64;
/// Fewer particles than this a piece do not pay for another thread: a look is short.
const WORTH_A_LOOK: usize = 8192;

/// Removes particles with a value that is no number or beyond all bounds; returns how many.
pub fn remove_non_finite(particles: &mut Particles, threads: usize) -> usize {
    let all_sound = AtomicBool::new(true);
    let all = &*particles;
    over(all.len(), WORTH_A_LOOK, threads, &|range| {
        all_sound.fetch_and(all.are_sound(range), Ordering::Relaxed);
    });
    if all_sound.into_inner() {
        return 0;
    }
    particles.retain(|particles, i| particles.get(i).values().into_iter().all(Value::is_sound))
}

/// Particles outside the box or inside rock.
pub fn count_escaped(particles: &Particles, solids: &Solids, domain: &Domain, threads: usize) -> u64 {
    let Particles { x, y, .. } = particles;
    let size = domain.size.min(IVec2::new(solids.columns(), solids.rows()).as_vec2());
    let inside = |x: f32, y: f32| (x >= 0.0) & (y >= 0.0) & (x <= size.x) & (y <= size.y);
    let (has_rock, escaped) = (solids.count() > 0, AtomicU64::new(0));
    over(x.len(), WORTH_A_LOOK, threads, &|range| {
        let mut count = 0;
        for (x, y) in x[range.clone()].chunks(BLOCK).zip(y[range].chunks(BLOCK)) {
            let in_rock = |x: f32, y: f32| has_rock && solids.is_rock_at([x, y]);
            let escaped: u32 = x.iter().zip(y).map(|(&x, &y)| u32::from(!inside(x, y) | in_rock(x, y))).sum();
            count += u64::from(escaped);
        }
        escaped.fetch_add(count, Ordering::Relaxed);
    });
    escaped.into_inner()
}

/// Speed of the fastest, d/s.
pub fn fastest([vx, vy]: [&[f32]; 2], threads: usize) -> f32 {
    // Of numbers that are not negative, the bits are in the order of the numbers.
    let fastest = AtomicU32::new(0);
    over(vx.len(), WORTH_A_LOOK, threads, &|range| {
        let mut most = [0.0_f32; FASTEST_OF];
        for (vx, vy) in vx[range.clone()].chunks(FASTEST_OF).zip(vy[range].chunks(FASTEST_OF)) {
            for ((most, vx), vy) in most.iter_mut().zip(vx).zip(vy) {
                let speed2 = vx * vx + vy * vy;
                *most = if speed2 > *most { speed2 } else { *most };
            }
        }
        fastest.fetch_max(most.into_iter().fold(0.0, f32::max).to_bits(), Ordering::Relaxed);
    });
    f32::from_bits(fastest.into_inner()).sqrt()
}

/// Adds the number of particles of each element to its entry of `counts`.
pub fn count_elements(elements: &[ElementId], counts: &mut [u32]) {
    for block in elements.chunks(BLOCK) {
        // One element after the other in the same counter waits for itself; most blocks are of one element.
        if block.iter().fold(true, |same, element| same & (*element == block[0])) {
            counts[block[0].index()] += block.len() as u32;
        } else {
            block.iter().for_each(|element| counts[element.index()] += 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parallel::in_pool;
    use glam::Vec2;

    #[test]
    fn only_what_is_no_number_is_removed() {
        let mut particles = Particles::default();
        for id in 0..1000 {
            particles.push(id, ElementId(0), Vec2::splat(1.0), Vec2::ZERO);
        }
        assert_eq!(remove_non_finite(&mut particles, 1), 0);
        particles.x[3] = f32::NAN;
        particles.vy[999] = -1e30;
        assert_eq!(remove_non_finite(&mut particles, 2), 2);
        assert!(particles.len() == 998 && !particles.id.contains(&3) && !particles.id.contains(&999));
    }

    #[test]
    fn particles_outside_and_in_rock_have_escaped() {
        let (mut solids, domain) = (Solids::new(10, 8), Domain { size: Vec2::new(10.0, 7.5), gravity: Vec2::ZERO });
        let mut particles = Particles::default();
        let places = [(5.0, 5.0), (9.9, 7.5), (10.1, 3.0), (5.0, 7.6), (-0.1, 3.0), (f32::NAN, 1.0), (2.5, 2.5)];
        for (id, place) in (0..).zip(places) {
            particles.push(id, ElementId(0), place.into(), Vec2::ZERO);
        }
        assert_eq!(count_escaped(&particles, &solids, &domain, 1), 4);
        solids.insert(IVec2::new(2, 2), ElementId(1), 99);
        assert_eq!(count_escaped(&particles, &solids, &domain, 1), 5);
    }

    #[test]
    fn the_fastest_is_found_on_any_number_of_threads() {
        let mut velocities = [vec![0.0_f32; 100_000], vec![0.0; 100_000]];
        assert_eq!(fastest([&velocities[0], &velocities[1]], 1), 0.0);
        (velocities[0][70_001], velocities[1][70_001]) = (-3.0, 4.0);
        velocities[0][12] = 4.9;
        for threads in [1, 2, 5] {
            assert_eq!(in_pool(threads, || fastest([&velocities[0], &velocities[1]], threads)), 5.0);
        }
    }

    #[test]
    fn every_element_is_counted() {
        let elements: Vec<ElementId> = (0..1000).map(|k| ElementId(u8::from(k >= 700))).collect();
        let mut counts = [0, 5];
        count_elements(&elements, &mut counts);
        assert_eq!(counts, [700, 305]);
    }
}
