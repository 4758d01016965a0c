use super::{curve::along, *};
use crate::{element::ElementId, params::Domain, particles::Particles, random::Random, solids::Solids};
use glam::{DVec2, IVec2, Vec2};

/// A disordered block of liquid of two elements that moves, in a box with a slope of rock.
fn world() -> (Particles, Solids, Domain) {
    let domain = Domain { size: Vec2::new(60.0, 40.5), gravity: Vec2::ZERO };
    let (mut solids, mut particles, mut random) = (Solids::new(60, 41), Particles::default(), Random::new(5));
    for x in 0..20 {
        (0..20 - x).for_each(|y| assert!(solids.insert(IVec2::new(x, y), ElementId(0), 10_000 + (20 * y + x) as u32)));
    }
    for k in 0..1500 {
        let at = Vec2::new((k % 50) as f32 + 5.5, (k / 50) as f32 + 0.5);
        let at = domain.keep_inside(at + 0.35 * Vec2::new(random.offset(), random.offset()));
        if !solids.is_solid(Solids::cell_of(at)) {
            let velocity = 30.0 * Vec2::new(random.offset(), random.offset()) + Vec2::new(8.0, -3.0);
            particles.push(k, ElementId(1 + (k % 7 == 0) as u8), at, velocity);
            let last = particles.len() - 1;
            (particles.push_x[last], particles.push_y[last]) = (random.offset(), random.offset());
        }
    }
    (particles, solids, domain)
}

/// Number, momentum (of velocities and pushes) and centre of the particles of an element, in the d that `factor` of go
/// into one old d.
fn totals(particles: &Particles, element: u8, factor: f64) -> (f64, DVec2, DVec2, DVec2) {
    let of = (0..particles.len()).filter(|&i| particles.element[i] == ElementId(element));
    let (mut area, mut momentum, mut push, mut centre) = (0.0, DVec2::ZERO, DVec2::ZERO, DVec2::ZERO);
    for i in of {
        area += 1.0 / (factor * factor);
        momentum += particles.velocity(i).as_dvec2() / factor.powi(3);
        push += DVec2::new(f64::from(particles.push_x[i]), f64::from(particles.push_y[i])) / factor.powi(3);
        centre += particles.position(i).as_dvec2() / factor.powi(3);
    }
    (area, momentum, push, centre / area)
}

#[test]
fn mass_and_momentum_are_kept_and_nothing_is_in_rock() {
    let (old, solids, domain) = world();
    for factor in [0.25, 0.5, 0.7, 1.0, 1.3, 2.0, 2.5, 3.0] {
        let (mut next, finer) = (20_000, factor as f32);
        let rock = resample_rock(&solids, factor, domain.size * finer, &mut next);
        let domain = Domain { size: domain.size * finer, ..domain };
        let new = resample_particles(&old, factor, &rock, &domain, &mut next);
        assert_eq!(next as usize, 20_000 + new.len() + rock.count(), "every id is fresh");
        for element in [1, 2] {
            let (before, after) = (totals(&old, element, 1.0), totals(&new, element, factor));
            let particle = 1.0 / (factor * factor);
            assert!((after.0 - before.0).abs() <= 0.5 * particle + 1e-9, "{factor}: area {} → {}", before.0, after.0);
            // Each number is rounded to f32 once: at most 2⁻²⁴ of 40 d/s for each of 1500, far below this.
            assert!(after.1.distance(before.1) < 1e-3, "{factor}: momentum {} → {}", before.1, after.1);
            assert!(after.2.distance(before.2) < 1e-4, "{factor}: pushes {} → {}", before.2, after.2);
            // What a particle stands for moves by about a d of the coarser world, each way: the mean of n such moves
            // has a standard deviation of 1/√n of one, and is hardly ever more than three times that.
            let coarser = f64::max(1.0, 1.0 / factor);
            let count = f64::min(after.0 * factor * factor, before.0);
            assert!(
                after.3.distance(before.3) < 3.0 * coarser / count.sqrt(),
                "{factor}: centre {} → {}",
                before.3,
                after.3
            );
        }
        let energy = |particles: &Particles| -> f64 {
            (0..particles.len()).map(|i| particles.velocity(i).as_dvec2().length_squared()).sum()
        };
        let (before, after) = (energy(&old), energy(&new) / factor.powi(4));
        assert!(after <= before * (1.0 + 1e-6), "{factor}: kinetic energy {before} → {after}");
        for i in 0..new.len() {
            let at = new.position(i);
            assert!(!rock.is_solid(Solids::cell_of(at)) && domain.keep_inside(at) == at, "{factor}: {at}");
        }
    }
}

#[test]
fn a_particle_becomes_four_around_it_and_a_lattice_stays_one() {
    let domain = Domain { size: Vec2::splat(10.0), gravity: Vec2::ZERO };
    let mut old = Particles::default();
    (0..9).for_each(|k| old.push(k, ElementId(1), Vec2::new((k % 3) as f32 + 3.5, (k / 3) as f32 + 3.5), Vec2::X));
    let fine = Domain { size: domain.size * 2.0, ..domain };
    let new = resample_particles(&old, 2.0, &Solids::new(20, 20), &fine, &mut 9);
    let mut sites: Vec<_> = (0..new.len()).map(|i| new.position(i).to_array().map(|at| at as i32)).collect();
    sites.sort_unstable();
    assert!(sites.iter().copied().eq((6..12).flat_map(|x| (6..12).map(move |y| [x, y]))), "{sites:?}");
    assert!((0..36).all(|i| new.position(i).fract() == Vec2::splat(0.5) && new.velocity(i) == Vec2::new(2.0, 0.0)));
    let back = resample_particles(&new, 0.5, &Solids::new(10, 10), &domain, &mut 100);
    let mut there: Vec<_> = (0..back.len()).map(|i| back.position(i)).collect();
    there.sort_by(|a, b| (a.y, a.x).partial_cmp(&(b.y, b.x)).unwrap());
    assert!((0..9).all(|k| there[k] == old.position(k) && back.velocity(k) == Vec2::X), "four become what they were");
}

#[test]
fn lone_drops_stay_where_drops_were() {
    let domain = Domain { size: Vec2::splat(100.0), gravity: Vec2::ZERO };
    let (mut old, mut random) = (Particles::default(), Random::new(3));
    let mut place = || Vec2::new(random.share(), random.share()) * 100.0;
    (0..40).for_each(|k| old.push(k, ElementId(1), domain.keep_inside(place()), Vec2::ZERO));
    let coarse = Domain { size: domain.size * 0.5, ..domain };
    let new = resample_particles(&old, 0.5, &Solids::new(50, 50), &coarse, &mut 40);
    assert_eq!(new.len(), 10);
    for i in 0..10 {
        let nearest = (0..40).map(|k| old.position(k).distance(2.0 * new.position(i))).fold(f32::MAX, f32::min);
        assert!(nearest < 2.0, "in the empty middle, {nearest} d from a drop");
    }
}

#[test]
fn rock_is_exact_on_whole_factors_and_half_covered_cells_are_rock() {
    let mut old = Solids::new(10, 10);
    for (x, y) in [(2, 2), (3, 2), (7, 0), (7, 1), (9, 9)] {
        old.insert(IVec2::new(x, y), ElementId(3), 0);
    }
    let fine = resample_rock(&old, 3.0, Vec2::splat(30.0), &mut 0);
    assert_eq!(fine.count(), 9 * old.count());
    assert!((0..30).all(|x| (0..30).all(|y| fine.is_solid(IVec2::new(x, y)) == old.is_solid(IVec2::new(x, y) / 3))));
    let again = resample_rock(&fine, 1.0 / 3.0, Vec2::splat(10.0), &mut 0);
    assert!((0..10).all(|x| (0..10).all(|y| again.is_solid(IVec2::new(x, y)) == old.is_solid(IVec2::new(x, y)))));
    let coarse = resample_rock(&old, 0.5, Vec2::splat(5.0), &mut 0);
    let solid: Vec<_> = coarse.iter().map(|(cell, element, _)| (cell.to_array(), element)).collect();
    assert_eq!(
        solid,
        [([3, 0], ElementId(3)), ([1, 1], ElementId(3))],
        "half of these were rock, a quarter of the last"
    );
}

#[test]
fn the_curve_goes_on_from_neighbour_to_neighbour() {
    let mut sites: Vec<IVec2> = (0..64 * 64).map(|k| IVec2::new(k % 64, k / 64)).collect();
    sites.sort_by_key(|site| along((site.as_vec2() + 0.5) / 32.0));
    assert!(sites.windows(2).all(|pair| (pair[1] - pair[0]).abs().element_sum() == 1), "a step goes to a neighbour");
}

#[test]
fn water_walled_in_by_rock_has_room_at_another_spacing() {
    let full = |particles: &Particles| {
        let mut solids = Solids::new(20, 20);
        for k in 0..400 {
            let cell = IVec2::new(k % 20, k / 20);
            if (0..particles.len()).all(|i| Solids::cell_of(particles.position(i)) != cell) {
                assert!(solids.insert(cell, ElementId(0), 1000 + k as u32));
            }
        }
        solids
    };
    let mut drops = Particles::default();
    drops.push(0, ElementId(1), Vec2::new(7.3, 12.6), Vec2::ZERO);
    drops.push(1, ElementId(1), Vec2::new(11.5, 3.5), Vec2::ZERO);
    let (old, mut id) = (full(&drops), 0);
    for factor in [0.5, 0.8, 2.0] {
        let domain = Domain { size: Vec2::splat(20.0 * factor as f32), gravity: Vec2::ZERO };
        let mut solids = resample_rock(&old, factor, domain.size, &mut id);
        make_room(&mut solids, &drops, factor, &domain);
        let mut particles = resample_particles(&drops, factor, &solids, &domain, &mut id);
        settle(&mut particles, &solids, &domain, &crate::params::FluidParams::default());
        let astray = (0..particles.len()).find(|i| solids.is_solid(Solids::cell_of(particles.position(*i))));
        assert!(!particles.is_empty() && astray.is_none(), "at a factor of {factor} {astray:?} is in rock");
    }
}
