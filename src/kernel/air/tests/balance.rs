//! The mass of shut rooms.

use super::*;
use crate::sources::Wind;

/// What a room's mass may differ by after any step: 16 unit roundoffs of f32.
const MOST: f64 = 16.0 / (1 << 24) as f64;

/// Two rooms of other pressures, with a wind in each that never rests.
fn two_rooms(sleeps: bool) -> (Air, [Wind; 2]) {
    let mut air = closed(41, 30, 4.0);
    air.set_solids(&rock(164, 120, |x, y| x / 4 == 20 || (x > 100 && x < 120 && y < 40)));
    air.fill_pressure(rect(0.0, 0.0, 80.0, 120.0), 37.0);
    air.allow_sleep(sleeps);
    let wind = |x: f32, velocity: Vec2| Wind { area: rect(x, 20.0, x + 30.0, 50.0), velocity, rate: 50.0 };
    (air, [wind(10.0, Vec2::new(900.0, 1300.0)), wind(120.0, Vec2::new(-4000.0, 2500.0))])
}

/// Mass of each room.
fn masses(air: &Air) -> [f64; 2] {
    let left = |k: usize| k % air.stride() <= 20;
    [air.mass_where(|k| !air.solid[k] && left(k)), air.mass_where(|k| !air.solid[k] && !left(k))]
}

/// Furthest that the mass of a room is from what it was.
fn drift(air: &Air, start: [f64; 2]) -> f64 {
    let [left, right] = masses(air);
    (left / start[0] - 1.0).abs().max((right / start[1] - 1.0).abs())
}

#[test]
fn shut_rooms_keep_their_mass_through_any_number_of_steps() {
    let (mut air, winds) = two_rooms(false);
    let start = masses(&air);
    // The same air that forgets what it should have after each step: what rounding does alone.
    let mut adrift = air.clone();
    let (mut worst, mut worst_adrift) = (0.0_f64, 0.0_f64);
    for _ in 0..1500 {
        air.step(&winds, SCHEME, ALONE, DT);
        adrift.step(&winds, SCHEME, ALONE, DT);
        adrift.rests.clear();
        worst = worst.max(drift(&air, start));
        worst_adrift = worst_adrift.max(drift(&adrift, start));
    }
    assert!(worst <= MOST, "{worst:e}");
    assert!(worst_adrift > 2.0 * MOST, "rounding alone stays within {worst_adrift:e}: this proves nothing");
}

#[test]
fn mass_that_is_given_back_shows_no_copies() {
    for sleeps in [false, true] {
        let run = |copies: bool| {
            let (mut air, winds) = two_rooms(sleeps);
            for tick in 0..150 {
                air.step(&winds, SCHEME, ALONE, DT);
                if copies && tick % 3 == 0 {
                    air = air.clone();
                }
            }
            bits(&air)
        };
        assert!(run(true) == run(false), "sleep: {sleeps}: a copy goes on otherwise");
    }
}

#[test]
fn what_sleeps_and_wakes_again_keeps_its_mass() {
    let mut air = closed(20, 12, 4.0);
    air.set_solids(&rock(80, 48, |x, _| x / 4 == 14));
    air.allow_sleep(true);
    air.fill_pressure(rect(0.0, 0.0, 56.0, 48.0), 1.7);
    let left = |air: &Air| air.mass_where(|k| !air.solid[k] && k % air.stride() <= 14);
    let start = left(&air);
    let mut naps = 0;
    for _ in 0..12 {
        // Sound, which dies out, and no eddy, which hardly does.
        air.blow(Vec2::new(28.0, 24.0), 4000.0, Vec2::new(400.0, 0.0));
        for _ in 0..4000 {
            run(&mut air, 1);
            let drift = (left(&air) / start - 1.0).abs();
            assert!(drift <= MOST, "{drift:e} after {naps} naps");
            if air.is_quiet() {
                naps += 1;
                break;
            }
        }
    }
    assert!(naps > 10, "it hardly ever slept: {naps} times");
}

#[test]
fn a_drift_within_the_bound_is_left_alone() {
    // A still room off by 13 roundings keeps its bits, one off by 15 does not.
    for (roundings, kept) in [(13.0, true), (15.0, false)] {
        let mut air = closed(20, 20, 4.0);
        stir(&mut air, 0.0, 0.0, &mut Random::new(1));
        air.step(&[], SCHEME, ALONE, 1e-6);
        assert_eq!(air.rests.len(), 1, "it has fallen asleep and knows its mass");
        air.rests[0] = (1.0 - roundings / f64::from(1 << 24)) as f32;
        air.quiet = false;
        let before = bits(&air);
        air.step(&[], SCHEME, ALONE, 1e-6);
        assert_eq!(bits(&air) == before, kept, "{roundings} roundings");
    }
}
