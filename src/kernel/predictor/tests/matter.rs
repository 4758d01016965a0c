//! Liquids of different densities.

use super::{CELL, DT, LATTICE, lattice, noise, room, size, solids, team};
use crate::{
    element::ElementId,
    params::Domain,
    particles::Particles,
    predictor::{Predictor, PredictorParams},
    sleep::DRIFT,
    solids::Solids,
};
use glam::{DVec2, Vec2};

/// One prediction, with elements of these masses.
fn predict(particles: &mut Particles, solids: &Solids, masses: Option<&[f32]>) -> Predictor {
    let domain = Domain { size: size(solids), gravity: Vec2::ZERO };
    let params = PredictorParams {
        domain: &domain,
        cell: CELL,
        rest_density: LATTICE,
        masses,
        grains: None,
        drawn: None,
        instructions: team().instructions,
        threads: 1,
        dt: DT,
    };
    let mut predictor = Predictor::default();
    for _ in 0..4 {
        let before = (particles.vx.clone(), particles.vy.clone());
        predictor.run(particles, solids, &params, room().each_mut());
        // Each prediction sets out from the same velocities with a better pressure.
        (particles.vx, particles.vy) = before;
    }
    predictor.run(particles, solids, &params, room().each_mut());
    predictor
}

/// A box of 40 × 30 with liquid up to 25, of the element that `element` says.
fn pool(mut element: impl FnMut(Vec2) -> u8, velocity: impl Fn(Vec2) -> Vec2) -> (Solids, Particles) {
    let walls = solids(40, 30, |_| false);
    let mut particles = lattice(&walls, |at| (at.y < 25.0).then(|| velocity(at)));
    for i in 0..particles.len() {
        particles.element[i] = ElementId(element(particles.position(i)));
    }
    (walls, particles)
}

/// d/s².
const GRAVITY: Vec2 = Vec2::new(0.0, -98.1);

/// What gravity adds in a tick.
fn fall(_: Vec2) -> Vec2 {
    Vec2::new(0.0, -98.1 * DT)
}

#[test]
fn equal_masses_give_the_same_bits_as_none() {
    let stir = |at: Vec2| Vec2::new(0.03 * (at.y - 12.0) * (at.y - 12.0), 0.1 * (at.x - 20.0));
    let (walls, pool) = pool(|at| (at.x > 20.0).into(), stir);
    let (mut with, mut without) = (pool.clone(), pool);
    predict(&mut with, &walls, Some(&[1.0, 1.0]));
    predict(&mut without, &walls, None);
    assert!(with == without, "a mass of 1 changes something");
}

#[test]
fn layers_of_any_density_are_held_at_every_height_of_the_grid() {
    for (light, heights) in [(0.9, 0..10), (0.07, 0..10), (0.001, 0..10)] {
        for height in heights {
            let level = 10.0 + height as f32;
            let (walls, mut pool) = pool(|at| (at.y > level).into(), fall);
            predict(&mut pool, &walls, Some(&[1.0, light]));
            let fastest = pool.vy.iter().fold(0.0_f32, |most, v| most.max(v.abs()));
            // The solver leaves a tenth of a tick's fall, and less where it sets out from what it had.
            assert!(fastest < 0.1 * 98.1 * DT, "{light} above {level}: {fastest} d/s are left of {}", 98.1 * DT);
        }
    }
}

#[test]
fn what_is_alone_rises_or_sinks_by_its_buoyancy() {
    // Heavier or lighter by so much that it is not drops that have grown which move, but the bound.
    for (own, around, gains) in [(1.0, 0.07, -1.0), (0.07, 1.0, 1.0)] {
        let masses = [around, own];
        let at = Vec2::new(20.5, 12.5);
        let (walls, mut pool) = pool(|place| (place.distance(at) < 0.1).into(), fall);
        let predictor = predict(&mut pool, &walls, Some(&masses));
        let alone = (0..pool.len()).find(|i| pool.element[*i] == ElementId(1)).unwrap();
        // The pressure holds the liquid against gravity. Beside that it falls or rises as much, less what the liquid around it
        // is made to give it; that is a cell's worth, and weighs no more than the body where it is a tenth as dense.
        let share = pool.vy[alone] / (gains * 98.1 * DT);
        assert!((0.5..1.15).contains(&share), "{own} in {around} gains {share} of what it should");
        let speed = predictor.buoyancy().unwrap().speed(at, own, GRAVITY);
        assert!(speed > 40.0, "{own} in {around} would move at {speed} d/s");
    }
}

#[test]
fn a_level_surface_is_no_buoyancy() {
    for light in [0.9, 0.07, 0.001] {
        for height in 0..10 {
            let level = 10.0 + 0.5 * height as f32;
            let (walls, mut pool) = pool(|at| (at.y > level).into(), fall);
            let predictor = predict(&mut pool, &walls, Some(&[1.0, light]));
            let buoyancy = predictor.buoyancy().unwrap();
            let near: Vec<usize> = (0..pool.len()).filter(|i| (pool.position(*i).y - level).abs() < 4.0).collect();
            let mean = |gravity| {
                let mass = |i: usize| [1.0, light][pool.element[i].index()];
                let speed = |i: &usize| buoyancy.speed(pool.position(*i), mass(*i), gravity);
                near.iter().map(speed).sum::<f32>() / near.len() as f32
            };
            // What a tile of sleep may drift by.
            let still = DRIFT / DT;
            assert!(mean(GRAVITY) < still, "{light} over {level}: {} d/s", mean(GRAVITY));
            assert!(mean(-GRAVITY) > still, "{light} under {level}: {} d/s", mean(-GRAVITY));
        }
    }
}

#[test]
fn momentum_is_kept_between_masses() {
    // The pressure holds a suspension up, so what is left of the motion is that of heavy and light beside one another: what
    // some gain the others lose. At the surface, a tenth of all that is there, the pressure ends, and does not hold all.
    let (mut number, masses) = (noise(5), [1.0_f32, 0.1]);
    let (walls, mut pool) = pool(|_| (number() > 0.0).into(), fall);
    predict(&mut pool, &walls, Some(&masses));
    let momenta: Vec<_> =
        (0..pool.len()).map(|i| f64::from(masses[pool.element[i].index()]) * pool.velocity(i).as_dvec2()).collect();
    let all: f64 = momenta.iter().map(|momentum| momentum.length()).sum();
    let lost = momenta.iter().sum::<DVec2>().length() / all;
    assert!(all > 0.1 * pool.len() as f64 * f64::from(fall(Vec2::ZERO).length()), "nothing moves beside the other");
    assert!(lost < 0.1, "{lost} of what moves came or went");
}

#[test]
fn a_gas_that_is_stopped_does_not_push_drops_beside_it() {
    // It is shot down on the floor, and drops rest on top of it, of which the nearest lie on faces that touch no liquid cell.
    let masses = [1.0, 0.002];
    for height in 0..8 {
        let level = 6.0 + 0.5 * height as f32;
        let walls = solids(40, 30, |_| false);
        let mut particles = lattice(&walls, |at| match at.y - level {
            ..0.0 => Some(Vec2::new(0.0, -3000.0)),
            above if above < 3.0 && (at.x as u32).is_multiple_of(4) => Some(Vec2::ZERO),
            _ => None,
        });
        for i in 0..particles.len() {
            particles.element[i] = ElementId((particles.position(i).y < level).into());
        }
        let drops = |particles: &Particles| {
            let own = (0..particles.len()).filter(|i| particles.element[*i] == ElementId(0));
            own.map(|i| particles.velocity(i).length()).fold(0.0, f32::max)
        };
        predict(&mut particles, &walls, Some(&masses));
        // All that the gas under a drop has, 4 × 8 lumps at the most, would make it this fast.
        let most = 4.0 * 8.0 * masses[1] * 3000.0;
        assert!(drops(&particles) < most, "{} d/s of {most} above {level}", drops(&particles));
    }
}
