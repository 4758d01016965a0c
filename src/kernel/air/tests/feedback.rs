//! Momentum both ways.

use super::super::Rousing;
use super::*;
use crate::{
    element::ElementParams,
    forces::{LaterDrag, apply_drag},
    particles::Particles,
};
use glam::DVec2;

fn elements(drag: [f32; 2], mass: [f32; 2]) -> ElementParams {
    ElementParams { drag: drag.to_vec(), mass: mass.to_vec(), ..ElementParams::default() }
}

/// Water of 0.1 m, and something that is light and mostly drag.
fn water_and_fluff() -> ElementParams {
    elements([0.0045, 1.0e5], [1000.0, 1.0e-3])
}

/// `count` particles in `area` at up to `speed` d/s, of both kinds in turn.
fn swarm(area: Rect, count: usize, speed: f32, noise: &mut Random) -> Particles {
    let mut particles = Particles::default();
    for id in 0..count {
        let part = Vec2::new(noise.offset(), noise.offset()) * 0.5 + Vec2::splat(0.5);
        let velocity = Vec2::new(noise.offset(), noise.offset()) * speed;
        particles.push(id as u32, ElementId((id % 2) as u8), area.min + (area.max - area.min) * part, velocity);
    }
    particles
}

fn drag_along(air: &mut Air, particles: &mut Particles, mut later: LaterDrag, team: Team) {
    air.drag_along(particles, &mut later, team);
    later.end(particles, 1, f32::INFINITY);
}

/// What drag does where the air does not yield.
fn drag(air: &Air, elements: &ElementParams, particles: &mut Particles) {
    let mut later = LaterDrag::default();
    apply_drag(air, elements, particles, &mut later, 1, DT);
    later.end(particles, 1, f32::INFINITY);
}

fn exchange(air: &mut Air, elements: &ElementParams, particles: &mut Particles, team: Team) {
    let mut later = LaterDrag::default();
    air.meet(elements, particles, &mut later, Rousing::Breaths, team, DT);
    drag_along(air, particles, later, team);
}

/// Momentum and energy of motion of both.
fn sums(air: &Air, elements: &ElementParams, particles: &Particles) -> (DVec2, f64) {
    let density = f64::from(air.params.density);
    let (mut momentum, mut energy) = (air.momentum() * density, air.kinetic_energy() * density);
    for i in 0..particles.len() {
        let (mass, v) = (f64::from(elements.mass[particles.element[i].index()]), particles.velocity(i).as_dvec2());
        momentum += v * mass;
        energy += 0.5 * mass * v.length_squared();
    }
    (momentum, energy)
}

#[test]
fn momentum_is_kept_and_energy_only_falls_at_any_load() {
    let mut noise = Random::new(5);
    let tables = [
        water_and_fluff(),
        // Heavy and rough, weightless and smooth.
        elements([1.0e5, 1.0e-6], [1.0e5, 1.0e-3]),
        elements([0.0, 0.3], [1000.0, 1000.0]),
    ];
    for (area, count) in [(rect(0.0, 0.0, 160.0, 96.0), 3000), (rect(40.5, 40.5, 43.5, 43.5), 10_000)] {
        for drag in &tables {
            let mut air = closed(40, 24, 4.0);
            stir(&mut air, 0.3, 60.0, &mut noise);
            let mut particles = swarm(area, count, 150.0, &mut noise);
            let (momentum, mut energy) = sums(&air, drag, &particles);
            let scale = (2.0 * energy * particles.len() as f64 * f64::from(drag.mass[0].max(drag.mass[1]))).sqrt();
            let fastest = 160.0_f32.hypot(160.0);
            for _ in 0..60 {
                exchange(&mut air, drag, &mut particles, ALONE);
                let (now, left) = sums(&air, drag, &particles);
                assert!((now - momentum).length() < 1e-5 * scale, "{now} instead of {momentum} of {scale}");
                assert!(left <= energy * (1.0 + 1e-6), "energy grew from {energy} to {left}");
                energy = left;
            }
            assert_sane(&air);
            assert!(air.max_speed() <= fastest && particles.vx.iter().chain(&particles.vy).all(|v| v.abs() <= fastest));
        }
    }
}

#[test]
fn heavy_air_drags_as_air_that_nothing_moves() {
    let mut noise = Random::new(6);
    let mut air = closed(20, 20, 4.0);
    stir(&mut air, 0.1, 30.0, &mut noise);
    air.params.density = 1.0e7;
    let mut particles = swarm(rect(0.0, 0.0, 80.0, 80.0), 500, 100.0, &mut noise);
    let mut plain = particles.clone();
    exchange(&mut air, &water_and_fluff(), &mut particles, ALONE);
    drag(&air, &water_and_fluff(), &mut plain);
    for (got, expected) in particles.vx.iter().zip(&plain.vx) {
        assert!((got - expected).abs() < 2e-3, "{got} instead of {expected}");
    }
}

#[test]
fn one_drop_and_one_cell_meet_at_their_common_speed() {
    let mut air = closed(9, 9, 4.0);
    let mut particles = Particles::default();
    particles.push(0, ElementId(0), air.centre(4, 4), Vec2::new(50.0, 0.0));
    exchange(&mut air, &water_and_fluff(), &mut particles, ALONE);
    let slowing = 0.0045 * 50.0 * DT;
    let (share, mass) = (slowing / (1.0 + slowing), 1.2 * 16.0);
    let common = share * 1000.0 * 50.0 / (mass + share * 1000.0);
    assert!((air.velocity_at_cell(4, 4).x - common).abs() < 1e-4 * common);
    assert!((particles.vx[0] - (50.0 + share * (common - 50.0))).abs() < 1e-4);
    assert_eq!(air.velocity_at_cell(3, 4), Vec2::ZERO, "a cell that holds nothing of the drop moves");
}

#[test]
fn threads_and_instruction_sets_do_not_show() {
    let run = |team: Team| {
        let mut noise = Random::new(7);
        let mut air = closed(150, 220, 4.0);
        air.set_solids(&rock(600, 880, |x, y| x / 40 == 5 && y % 90 > 20));
        stir(&mut air, 0.1, 50.0, &mut noise);
        let mut particles = swarm(rect(0.0, 0.0, 600.0, 880.0), 30_000, 100.0, &mut noise);
        // Most in strips, as the bins sort them, the last poured anywhere.
        let mut order: Vec<usize> = (0..particles.len()).collect();
        order[..25_000].sort_by_key(|i| (particles.y[*i] / 3.0) as u32);
        particles.x = order.iter().map(|i| particles.x[*i]).collect();
        particles.y = order.iter().map(|i| particles.y[*i]).collect();
        in_pool(team.threads, || (0..3).for_each(|_| exchange(&mut air, &water_and_fluff(), &mut particles, team)));
        let speeds = particles.vx.iter().chain(&particles.vy).map(|v| v.to_bits());
        (bits(&air), speeds.collect::<Vec<_>>())
    };
    let expected = run(ALONE);
    for threads in [2, 3, 8] {
        assert!(run(Team { threads, ..ALONE }) == expected, "{threads} threads");
    }
    for instructions in InstructionSet::available() {
        assert!(run(Team { instructions, threads: 2 }) == expected, "{}", instructions.name());
    }
}

#[test]
fn only_gusts_wake_sleeping_air_and_what_sleeps_does_not_yield() {
    for (speed, wakes) in [(0.9, false), (60.0, true)] {
        let mut air = closed(96, 48, 4.0);
        let mut particles = Particles::default();
        for id in 0..64 {
            let place = Vec2::new(40.25 + 0.5 * (id % 8) as f32, 30.25 + 0.5 * (id / 8) as f32);
            particles.push(id, ElementId(0), place, Vec2::new(speed, 0.0));
        }
        let mut plain = particles.clone();
        drag(&air, &water_and_fluff(), &mut plain);
        let mut later = LaterDrag::default();
        air.meet(&water_and_fluff(), &particles, &mut later, Rousing::Gusts, ALONE, DT);
        drag_along(&mut air, &mut particles, later, ALONE);
        assert_eq!(!air.is_quiet(), wakes, "{speed} d/s");
        assert_eq!(air.awake_tiles().0, usize::from(wakes));
        let close = particles.vx.iter().zip(&plain.vx).all(|(got, plain)| (got - plain).abs() < 1e-5 * speed);
        assert_eq!(close, !wakes, "{speed} d/s: drag in air that yields is not drag in air that doesn't");
    }
}
