use super::{calm::LOOKS, *};
use crate::{
    air::Air,
    element::ElementId,
    params::{AIR_DENSITY, AirParams, OpenSides},
    particles::Particles,
};
use glam::Vec2;

const SIZE: Vec2 = Vec2::new(120.0, 40.0);

/// Two pools at rest, 20 d apart: 200 particles on the left, 100 on the right.
fn pools() -> Particles {
    let mut particles = Particles::default();
    for (first, columns) in [(0, 20), (40, 10)] {
        for k in 0..columns * 10 {
            let at = Vec2::new((first + k % columns) as f32 + 0.5, (k / columns) as f32 + 0.5);
            particles.push(particles.len() as u32, ElementId(1), at, Vec2::ZERO);
        }
    }
    particles
}

/// Looks as often as it takes to fall asleep at rest.
fn watch(sleep: &mut Sleep, particles: &mut Particles) -> usize {
    let mut density = vec![1.0; particles.len()];
    (0..LOOKS).map(|_| sleep.watch(particles, &mut density, (SIZE, 7), |_, _| 0.0)).sum()
}

fn asleep() -> (Sleep, Particles) {
    let (mut sleep, mut particles) = (Sleep::default(), pools());
    assert_eq!(watch(&mut sleep, &mut particles), 300);
    (sleep, particles)
}

#[test]
fn a_body_sleeps_when_all_of_it_was_calm_for_long_enough() {
    let (mut sleep, mut particles) = (Sleep::default(), pools());
    let mut density: Vec<f32> = (0..300).map(|k| k as f32).collect();
    // One of the left pool is too fast for the tile that it is in.
    particles.vx[0] = 60.0 * JITTER * 9.0;
    for look in 1..LOOKS {
        assert_eq!(sleep.watch(&mut particles, &mut density, (SIZE, 7), |_, _| 0.0), 0, "look {look}");
    }
    assert_eq!(sleep.watch(&mut particles, &mut density, (SIZE, 7), |_, _| 0.0), 100, "the right pool");
    assert_eq!(sleep.asleep(), 100);
    assert_eq!(particles.id[..100], (200..300).collect::<Vec<u32>>());
    assert_eq!(particles.id[100..], (0..200).collect::<Vec<u32>>());
    assert!(particles.id.iter().zip(&density).all(|(id, density)| *id as f32 == *density), "densities go with them");
    particles.vx.fill(0.0);
    // The drift of what was fast wears off, and then it takes as long as before.
    let looks = (0..60).take_while(|_| sleep.watch(&mut particles, &mut density, (SIZE, 7), |_, _| 0.0) == 0).count();
    assert!(looks + 1 >= usize::from(LOOKS) && looks < 60, "{looks} looks");
    assert_eq!(sleep.asleep(), 300);
}

#[test]
fn a_slow_common_drift_keeps_a_body_awake_and_jitter_does_not() {
    for (drift, jitter, sleeps) in [(0.5, 0.3, true), (1.5, 0.0, false), (0.0, 1.5, false)] {
        let (mut sleep, mut particles) = (Sleep::default(), pools());
        for (k, vx) in particles.vx.iter_mut().enumerate() {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            *vx = 60.0 * (drift * DRIFT + sign * jitter * JITTER);
        }
        // Long enough for the mean to be what it is.
        for _ in 0..5 {
            watch(&mut sleep, &mut particles);
        }
        assert_eq!(sleep.asleep() == 300, sleeps, "drift {drift}, jitter {jitter}");
        assert!(!sleeps || particles.vx.iter().all(|&vx| vx == 0.0));
    }
}

#[test]
fn what_was_taken_or_pushed_wakes_its_body_alone() {
    let (mut sleep, mut particles) = asleep();
    particles.retain(|particles, i| particles.id[i] != 250);
    sleep.check(&mut particles, 7);
    assert_eq!((sleep.asleep(), particles.len()), (200, 299));
    assert_eq!(particles.id[..200], (0..200).collect::<Vec<u32>>());
    assert_eq!(sleep.watch(&mut particles, &mut [], (SIZE, 7), |_, _| 0.0), 0, "what woke sleeps at the next look");

    let (mut sleep, mut particles) = asleep();
    particles.vy[10] = 1.0;
    sleep.check(&mut particles, 7);
    assert_eq!(particles.id[..sleep.asleep()], (200..300).collect::<Vec<u32>>());
    assert_eq!(particles.vy[100 + 10], 1.0, "the push is not lost");

    let (mut sleep, mut particles) = asleep();
    sleep.check(&mut particles, 7);
    assert_eq!(sleep.asleep(), 300, "nothing happened");
    sleep.check(&mut particles, 8);
    assert_eq!(sleep.asleep(), 0, "the rock changed");
    assert_eq!(watch(&mut sleep, &mut particles), 300, "they fall asleep again");
    sleep.check(&mut particles, 7);
    assert_eq!(sleep.asleep(), 300);
}

#[test]
fn those_awake_are_alone_until_they_touch() {
    let (mut sleep, mut particles) = asleep();
    particles.push(300, ElementId(1), Vec2::new(80.0, 30.0), Vec2::ZERO);
    sleep.set_aside(&mut particles);
    sleep.wake_touched(&mut particles);
    assert_eq!(particles.id, [300]);
    particles.x[0] = 45.0;
    particles.y[0] = 20.0;
    sleep.wake_touched(&mut particles);
    assert_eq!(particles.len(), 101, "the right pool joins it");
    let mut density = vec![2.0; 101];
    sleep.put_back(&mut particles, &mut density);
    assert_eq!((sleep.asleep(), particles.len(), density.len()), (200, 301, 301));
    assert!(density[..200].iter().all(|&density| density == 1.0) && density[200..].iter().all(|&d| d == 2.0));
}

#[test]
fn wind_wakes_what_feels_it() {
    let gravity = Vec2::new(0.0, -100.0);
    // 0.1 d/s² is what a sleeper may be pushed by, at 0.4/d that of 0.5 d/s.
    for (drag, speed, left) in [(0.4, 0.45, 300), (0.4, 0.6, 100), (0.0, 0.6, 300)] {
        let (mut sleep, mut particles) = asleep();
        let mut air =
            Air::new(SIZE, 4.0, AirParams { sound_speed: 300.0, density: AIR_DENSITY, open: OpenSides::default() });
        air.blow(Vec2::new(6.0, 6.0), 4.0, Vec2::new(speed, 0.0));
        sleep.set_aside(&mut particles);
        // What would feel any breath is not there.
        sleep.wake_blown(&mut particles, &air, &[100.0, drag], gravity);
        assert_eq!((sleep.asleep(), particles.len()), (left, 300 - left), "{speed} d/s, {drag}/d");
    }
}

#[test]
fn a_record_fits_its_world_and_no_other() {
    let (sleep, mut particles) = asleep();
    let record = sleep.record().clone();
    assert!(record.fits(&particles, SIZE));
    assert!(!record.fits(&particles, 2.0 * SIZE));
    assert!(!record.fits(&Particles::default(), SIZE));
    let resumed = Sleep::resume(record.clone(), &particles, SIZE, 3);
    assert_eq!((resumed.asleep(), resumed.record(), resumed.tiles.len()), (300, &record, sleep.tiles.len()));
    particles.vx[299] = 1.0;
    assert!(!record.fits(&particles, SIZE), "a sleeper moves");
}

#[test]
fn nothing_is_kept_of_particles_while_none_sleeps() {
    let held = |count: u32| {
        let mut particles = Particles::default();
        for k in 0..count {
            particles.push(k, ElementId(1), Vec2::splat(0.5), Vec2::new(50.0, 0.0));
        }
        let mut sleep = Sleep::resume(SleepRecord::default(), &particles, SIZE, 0);
        assert_eq!(watch(&mut sleep, &mut particles), 0);
        sleep.memory()
    };
    assert_eq!(held(10), held(10_000));
}
