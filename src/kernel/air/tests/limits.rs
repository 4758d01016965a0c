//! Hard cases: each stays finite, keeps its mass and says what it clamped.

use super::super::{MAX_PRESSURE, MAX_SPEED, MAX_SUBSTEPS};
use super::*;
use crate::sources::Wind;

fn assert_mass(air: &Air, mass: f64) {
    assert_sane(air);
    assert!((air.mass() / mass - 1.0).abs() < 1e-5, "mass {} of {mass}", air.mass());
}

#[test]
fn a_hurricane_is_clamped_and_counted() {
    // 1,000 m/s at d = 1 cm.
    let wind = Wind { area: rect(20.0, 20.0, 60.0, 60.0), velocity: Vec2::new(1e5, -1e5), rate: 100.0 };
    let mut air = closed(24, 24, 4.0);
    let mass = air.mass();
    let mut clamps = 0;
    for _ in 0..100 {
        let report = air.step(&[wind], SCHEME, ALONE, DT);
        clamps += report.speed_clamps;
        assert!(report.substeps <= MAX_SUBSTEPS);
        assert_mass(&air, mass);
    }
    assert!(clamps > 0, "nothing was counted");
    run(&mut air, 300);
    assert_mass(&air, mass);
}

#[test]
fn a_million_atmospheres_in_a_cell_stay_finite() {
    for side in [9, 64] {
        let mut air = closed(side, side, 2.0);
        air.fill_pressure(rect(4.0, 4.0, 6.0, 6.0), 1e6);
        let mass = air.mass();
        let mut clamps = 0;
        for _ in 0..200 {
            clamps += air.step(&[], SCHEME, ALONE, DT).slowed;
            assert_mass(&air, mass);
        }
        assert!(clamps > 0, "nothing was counted");
        let highest = air.pressure.iter().fold(0.0_f32, |highest, p| highest.max(*p));
        assert!(f64::from(highest) < 100.0 * mass / f64::from(side * side * 4), "it did not spread: {highest}");
    }
}

#[test]
fn air_flows_into_a_vacuum_and_out_of_nothing_comes_nothing() {
    let mut air = closed(40, 30, 2.0);
    air.fill_pressure(rect(0.0, 0.0, 40.0, 60.0), 0.0);
    let mass = air.mass();
    for _ in 0..300 {
        run(&mut air, 1);
        assert_mass(&air, mass);
    }
    let emptied = air.pressure.iter().zip(&air.solid).any(|(p, solid)| !*solid && *p < 0.2);
    assert!(!emptied, "the vacuum was not filled");
    let mut empty = closed(8, 8, 2.0);
    empty.fill_pressure(rect(0.0, 0.0, 16.0, 16.0), 0.0);
    run(&mut empty, 10);
    assert!(empty.mass() == 0.0 && empty.max_speed() == 0.0);
}

/// Arithmetic with denormals takes a hundred times as long, and what is swept empty or cools step by step comes down to them.
#[test]
fn neither_storms_nor_what_they_carry_leave_numbers_so_small_that_they_are_slow() {
    let wind = Wind { area: rect(0.0, 0.0, 96.0, 64.0), velocity: Vec2::new(3000.0, 0.0), rate: 1000.0 };
    let mut air = closed(48, 32, 2.0);
    air.set_solids(&rock(96, 64, |x, y| (y / 8 + x / 12) % 5 == 0));
    warm(&mut air, &mut Random::new(7));
    let far = air.index(2, 2)..air.warmth.len();
    air.warmth[far].fill(0.0);
    for _ in 0..40 {
        air.step(&[wind], SCHEME, ALONE, DT);
        let fields = [&air.pressure, &air.velocity_x, &air.velocity_y, &air.warmth];
        let tiny = fields.map(|field| field.iter().filter(|value| **value != 0.0 && value.abs() < 1e-28).count());
        assert_eq!(tiny, [0; 4], "pressures, velocities along x and y, warmth");
    }
    let emptied = air.cells().filter(|k| !air.solid[*k] && air.pressure[*k] == 0.0).count();
    assert!(emptied > 10, "nothing was swept empty: {emptied} cells");
}

#[test]
fn boxes_of_one_cell_and_one_row_work() {
    for (columns, rows) in [(1, 1), (1, 40), (40, 1), (2, 2)] {
        let mut air = closed(columns, rows, 4.0);
        air.press(Vec2::new(2.0, 2.0), 8.0, 3.0);
        air.blow(Vec2::new(2.0, 2.0), 8.0, Vec2::new(300.0, 200.0));
        let mass = air.mass();
        for _ in 0..100 {
            run(&mut air, 1);
            assert_mass(&air, mass);
            assert!(air.sample_velocity(Vec2::new(1.0, 3.0)).is_finite());
        }
        let all = OpenSides { left: true, right: true, bottom: true, top: true };
        let mut open = Air::new(Vec2::new(columns as f32, rows as f32), 1.0, params(all));
        open.press(Vec2::new(0.5, 0.5), 2.0, 3.0);
        run(&mut open, 100);
        assert_sane(&open);
        assert!((open.mass() / f64::from(columns * rows) - 1.0).abs() < 1e-3, "{}", open.mass());
    }
}

#[test]
fn a_box_full_of_rock_has_no_air() {
    let mut air = closed(6, 6, 1.0);
    air.set_solids(&rock(6, 6, |_, _| true));
    air.blow(Vec2::splat(3.0), 3.0, Vec2::splat(10.0));
    run(&mut air, 2);
    assert!(air.mass() == 0.0 && air.max_speed() == 0.0 && air.divergence_rms() == 0.0);
}

#[test]
fn paint_that_is_no_number_or_absurd_is_clamped_and_counted() {
    let mut air = closed(8, 8, 2.0);
    air.blow(Vec2::splat(8.0), 4.0, Vec2::new(f32::NAN, f32::INFINITY));
    air.press(Vec2::splat(8.0), 4.0, f32::NAN);
    air.press(Vec2::splat(8.0), 4.0, -5.0);
    air.press(Vec2::splat(8.0), 4.0, f32::INFINITY);
    air.fill_pressure(rect(0.0, 0.0, 2.0, 2.0), 1e30);
    air.blow(Vec2::splat(f32::NAN), f32::NAN, Vec2::splat(1.0));
    air.fill_pressure(Rect { min: Vec2::splat(f32::NAN), max: Vec2::splat(f32::NAN) }, 3.0);
    assert!(air.max_speed() <= MAX_SPEED && air.pressure.iter().all(|p| (0.0..=MAX_PRESSURE).contains(p)));
    let wind = Wind { area: rect(0.0, 0.0, 16.0, 16.0), velocity: Vec2::new(f32::NAN, 1.0), rate: f32::INFINITY };
    let report = air.step(&[wind], SCHEME, ALONE, DT);
    assert!(report.speed_clamps > 2 && report.pressure_clamps >= 3, "{report:?}");
    assert_sane(&air);
    let later = air.step(&[], SCHEME, ALONE, 1e-5);
    assert_eq!(later.pressure_clamps, 0, "a clamp was counted twice");
}

#[test]
fn quiet_air_is_not_stepped() {
    let mut air = closed(16, 16, 2.0);
    assert!(air.is_quiet());
    let before = air.clone();
    let still = Wind { area: rect(0.0, 0.0, 9.0, 9.0), velocity: Vec2::ZERO, rate: 5.0 };
    let outside = Wind { area: rect(90.0, 0.0, 99.0, 9.0), velocity: Vec2::ONE, rate: 5.0 };
    assert_eq!(air.step(&[still, outside], SCHEME, ALONE, DT).substeps, 0);
    assert_eq!(bits(&air), bits(&before));
    let wind = Wind { area: rect(0.0, 0.0, 9.0, 9.0), velocity: Vec2::ONE, rate: 5.0 };
    assert!(air.step(&[wind], SCHEME, ALONE, DT).substeps > 0);
    assert!(!air.is_quiet());
}

#[test]
fn rooms_with_different_pressures_fall_asleep_each_at_its_own() {
    let mut air = closed(20, 10, 2.0);
    air.set_solids(&rock(40, 20, |x, _| x == 20));
    air.fill_pressure(rect(0.0, 0.0, 20.0, 20.0), 2.5);
    assert!(!air.is_quiet());
    run(&mut air, 1);
    assert!(air.is_quiet());
    assert_eq!((air.pressure_at_cell(3, 3), air.pressure_at_cell(15, 3)), (2.5, 1.0));
}

#[test]
fn a_gap_in_the_wall_wakes_the_air() {
    let mut air = closed(20, 10, 2.0);
    let mut solids = rock(40, 20, |x, _| x == 20);
    air.set_solids(&solids);
    air.fill_pressure(rect(0.0, 0.0, 20.0, 20.0), 2.5);
    run(&mut air, 1);
    solids.remove(IVec2::new(20, 10));
    solids.remove(IVec2::new(20, 11));
    air.set_solids(&solids);
    assert!(!air.is_quiet());
    run(&mut air, 5);
    assert!(air.pressure_at_cell(15, 5) != 1.0);
}
/// What comes in through an open side brings no energy: a gust that is left alone blows out.
#[test]
fn open_sides_feed_no_wind() {
    for advection in AirAdvection::ALL {
        for (cells, is_open) in
            [(4, [true; 4]), (12, [true; 4]), (24, [true, true, false, false]), (24, [false, true, false, true])]
        {
            let [left, right, bottom, top] = is_open;
            let size = cells as f32;
            let mut air = Air::new(Vec2::splat(size), 1.0, params(OpenSides { left, right, bottom, top }));
            stir(&mut air, 0.1, 100.0, &mut Random::new(5));
            air.blow(Vec2::new(0.8, 0.5) * size, 0.3 * size, Vec2::new(60.0, 100.0));
            let mut left = Vec::new();
            for _ in 0..8 {
                for _ in 0..100 {
                    air.step(&[], AirScheme { advection, ..SCHEME }, ALONE, DT);
                }
                left.push(energy(&air));
            }
            assert!(left.is_sorted_by(|a, b| b <= a), "{advection:?}, {cells} cells, open {is_open:?}: {left:?}");
            assert!(left[7] < 0.25 * left[0], "{advection:?}, {cells} cells, open {is_open:?}: {left:?}");
        }
    }
}
