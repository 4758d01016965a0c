//! Tiles that sleep.

use super::super::QUIET_MACH;
use super::*;
use crate::sources::Wind;

fn sleeping(columns: u32, rows: u32, cell: f32) -> Air {
    let mut air = closed(columns, rows, cell);
    air.allow_sleep(true);
    air
}

/// Walls with gaps, and lone cells.
fn walls(columns: u32, rows: u32) -> Solids {
    rock(columns * 4, rows * 4, |x, y| {
        (x / 4 == 60 && y / 4 % 20 > 5) || (y / 4 == 37 && x / 4 % 30 > 9) || (x * 7 + y * 13) % 797 == 0
    })
}

/// Largest difference of two grids, as a part of the speed of sound and of pressure 1.
fn distance(a: &Air, b: &Air) -> f32 {
    let most = |a: &[f32], b: &[f32]| a.iter().zip(b).fold(0.0_f32, |most, (a, b)| most.max((a - b).abs()));
    let speed = most(&a.velocity_x, &b.velocity_x).max(most(&a.velocity_y, &b.velocity_y));
    (speed / SOUND).max(most(&a.pressure, &b.pressure))
}

#[test]
fn a_gust_in_a_corner_costs_by_its_size() {
    let mut air = sleeping(512, 512, 4.0);
    air.blow(Vec2::splat(100.0), 40.0, Vec2::new(60.0, 20.0));
    let report = air.step(&[], SCHEME, ALONE, DT);
    assert!(report.cells > 0 && report.cells * 20 < 512 * 512, "{} cells are stepped", report.cells);
    assert!(air.awake_tiles().0 > 0);
}

#[test]
fn air_that_sleeps_in_part_stays_within_the_bound() {
    // Gusts, pulses and a wind for two seconds, then none.
    let mut pair = [false, true].map(|sleeps| {
        let mut air = closed(160, 96, 4.0);
        air.set_solids(&walls(160, 96));
        air.allow_sleep(sleeps);
        air
    });
    let mass = pair[0].mass();
    let mut noise = Random::new(3);
    let (mut furthest, mut asleep, mut most_drift) = (0.0_f32, 0, (0.0_f64, 0.0_f64));
    for tick in 0..1800 {
        if tick % 60 == 0 && tick < 120 {
            let place = Vec2::new(noise.offset() * 40.0 + 80.0, noise.offset() * 100.0 + 200.0);
            for air in &mut pair {
                air.blow(place, 40.0, Vec2::new(20.0, 10.0));
            }
        }
        for air in &mut pair {
            air.step(&[], SCHEME, ALONE, DT);
        }
        furthest = furthest.max(distance(&pair[0], &pair[1]));
        let (awake, all) = pair[1].awake_tiles();
        asleep += usize::from(awake > 0 && awake < all);
        // What rounding loses is lost awake, too.
        let [drift, drift_asleep] = [0, 1].map(|k| (pair[k].mass() / mass - 1.0).abs());
        assert!(drift_asleep < 1e-5_f64.max(1.5 * drift), "tick {tick}: {drift_asleep} instead of {drift}");
        most_drift = (most_drift.0.max(drift), most_drift.1.max(drift_asleep));
    }
    assert!(asleep > 60, "hardly ever was a part asleep: {asleep} ticks");
    println!("furthest {} bounds, partly asleep for {asleep} ticks, drift {most_drift:?}", furthest / QUIET_MACH);
    assert!(furthest < 4.0 * QUIET_MACH, "{} bounds away", furthest / QUIET_MACH);
}

#[test]
fn a_wave_wakes_what_lies_ahead_in_time() {
    // A pulse far above the bound runs through 380 cells of sleeping air.
    let mut pair = [false, true].map(|sleeps| {
        let mut air = closed(400, 40, 4.0);
        air.allow_sleep(sleeps);
        air.press(Vec2::new(40.0, 80.0), 60.0, 1.0);
        air
    });
    for tick in 0..120 {
        for air in &mut pair {
            air.step(&[], SCHEME, ALONE, DT);
        }
        let apart = distance(&pair[0], &pair[1]);
        assert!(apart < 3.0 * QUIET_MACH, "{} bounds away at tick {tick}", apart / QUIET_MACH);
    }
    assert!(pair[0].max_speed() > 3.0 * QUIET_MACH * SOUND);
}

#[test]
fn no_mass_goes_round_the_corner_of_a_sleeping_tile() {
    // Three tiles around the corner of a fourth: wind blows across the corner.
    let mut air = sleeping(160, 80, 4.0);
    let mut shape = super::super::shape::Shape::new(air.tiling(), &air.solid, air.params.open);
    let tiling = air.tiling();
    let active: Vec<bool> = (0..tiling.count()).map(|tile| tile % 5 < 2 && tile / 5 < 2 && tile != 6).collect();
    shape.fence(air.tiling(), &air.solid, &active);
    assert_eq!(shape.turns_of(16).len(), 1, "one corner");
    let all = vec![true; tiling.count()];
    shape.fence(air.tiling(), &air.solid, &all);
    let fresh = super::super::shape::Shape::new(air.tiling(), &air.solid, air.params.open);
    assert!(shape.open_x == fresh.open_x && shape.open_y == fresh.open_y && shape.turns_of(16).is_empty());
    // Gusts in an L, blown towards the corner, for as long as only part of the grid is awake.
    let mass = air.mass();
    for round in 0..40 {
        air.blow(Vec2::new(60.0, 180.0), 40.0, Vec2::new(100.0, -120.0));
        air.blow(Vec2::new(200.0, 30.0), 40.0, Vec2::new(-120.0, 100.0));
        air.blow(Vec2::new(40.0, 30.0), 40.0, Vec2::new(90.0, 90.0));
        run(&mut air, 1);
        assert!((air.mass() / mass - 1.0).abs() < 1e-6, "{} at round {round}", air.mass() / mass - 1.0);
    }
}

#[test]
fn sleep_shows_no_threads_lanes_or_copies() {
    let run = |team: Team, copies: bool| {
        let mut air = sleeping(300, 200, 4.0);
        air.set_solids(&walls(300, 200));
        let wind = Wind { area: rect(20.0, 20.0, 60.0, 60.0), velocity: Vec2::new(80.0, 40.0), rate: 5.0 };
        in_pool(team.threads, || {
            let mut partly = 0;
            for tick in 0..90 {
                if tick % 20 == 3 {
                    air.blow(Vec2::new(900.0, 500.0), 30.0, Vec2::new(-50.0, 20.0));
                }
                if tick == 50 {
                    air.press(Vec2::new(600.0, 60.0), 20.0, 0.3);
                }
                air.step(if tick < 30 { std::slice::from_ref(&wind) } else { &[] }, SCHEME, team, DT);
                if copies && tick % 7 == 0 {
                    air = air.clone();
                }
                let (awake, all) = air.awake_tiles();
                partly += u32::from(awake > 0 && awake < all);
            }
            assert!(partly > 20);
        });
        (bits(&air), air.awake.clone())
    };
    let expected = run(ALONE, false);
    assert!(run(ALONE, true) == expected, "a copy goes on otherwise");
    for threads in [2, 5] {
        assert!(run(Team { threads, ..ALONE }, false) == expected, "{threads} threads");
    }
    for instructions in InstructionSet::available() {
        assert!(run(Team { instructions, threads: 1 }, false) == expected, "{}", instructions.name());
    }
}

#[test]
fn where_nothing_sleeps_sleep_changes_nothing() {
    let run = |sleeps: bool| {
        let mut air = closed(100, 60, 4.0);
        air.allow_sleep(sleeps);
        stir(&mut air, 0.2, 60.0, &mut Random::new(9));
        air.wake_all();
        for _ in 0..5 {
            air.step(&[], SCHEME, ALONE, DT);
        }
        assert_eq!(air.awake_tiles().0, air.awake_tiles().1);
        bits(&air)
    };
    assert!(run(true) == run(false));
}

#[test]
fn an_open_side_is_left_alone_by_what_sleeps_beside_it() {
    let mut air =
        Air::new(Vec2::new(1280.0, 400.0), 4.0, params(OpenSides { left: true, right: true, ..OpenSides::default() }));
    air.allow_sleep(true);
    air.press(Vec2::new(60.0, 200.0), 50.0, 0.2);
    let mut ticks = 0;
    while !air.is_quiet() && ticks < 3000 {
        run(&mut air, 1);
        ticks += 1;
    }
    assert!(air.is_quiet(), "awake after {ticks} ticks: {:?} tiles, {} d/s", air.awake_tiles(), air.max_speed());
    assert!(bits(&air).iter().all(|bits| [0.0_f32, 1.0].map(f32::to_bits).contains(bits)));
}
