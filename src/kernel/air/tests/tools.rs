//! Winds, brushes and samples.

use super::*;
use crate::sources::Wind;

#[test]
fn samples_are_bilinear_between_centres_and_level_beyond_them() {
    let mut air = closed(6, 5, 2.0);
    for row in 0..5 {
        for (column, k) in air.row_range(row).enumerate() {
            air.velocity_x[k] = 3.0 * column as f32 + 7.0 * row as f32;
            air.velocity_y[k] = (column * row) as f32;
        }
    }
    let at = |x: f32, y: f32| air.sample_velocity(Vec2::new(x, y));
    assert_eq!(at(5.0, 3.0), air.velocity_at_cell(2, 1));
    assert_eq!(at(6.0, 4.0), Vec2::new(3.0 * 2.5 + 7.0 * 1.5, 2.5 * 1.5));
    assert_eq!(at(-50.0, 9.0), air.velocity_at_cell(0, 4));
    assert_eq!(at(1e9, -1e9), air.velocity_at_cell(5, 0));
    assert!(at(f32::NAN, 1.0).is_finite());
    let (x, y) = ([5.0, 6.3, -50.0, 11.9], [3.0, 4.7, 9.0, 0.1]);
    let (mut u, mut v) = ([0.0; 4], [0.0; 4]);
    air.sample_velocities(&x, &y, &mut u, &mut v);
    for k in 0..4 {
        assert_eq!(Vec2::new(u[k], v[k]), at(x[k], y[k]));
    }
}

#[test]
fn a_wind_drives_only_the_cells_whose_centre_it_covers() {
    let mut air = closed(8, 8, 2.0);
    let wind = Wind { area: rect(3.0, 4.9, 7.0, 9.0), velocity: Vec2::new(10.0, -20.0), rate: 60.0 };
    let dt = 1e-6;
    air.step(&[wind], SCHEME, ALONE, dt);
    let wanted = wind.velocity * (60.0 * dt / (1.0 + 60.0 * dt));
    for row in 0..8 {
        for column in 0..8 {
            let inside = (1..3).contains(&column) && (2..4).contains(&row);
            let wanted = if inside { wanted } else { Vec2::ZERO };
            assert!((air.velocity_at_cell(column, row) - wanted).length() < 1e-6, "{column}, {row}");
        }
    }
}

#[test]
fn a_violent_wind_does_not_overshoot() {
    let mut air = closed(8, 8, 2.0);
    let wind = Wind { area: rect(4.0, 4.0, 12.0, 12.0), velocity: Vec2::new(50.0, 0.0), rate: 1e30 };
    air.step(&[wind], SCHEME, ALONE, DT);
    assert_eq!(air.velocity_at_cell(3, 3), wind.velocity);
}

#[test]
fn brushes_fade_to_their_rim_and_spare_rock() {
    let mut air = closed(20, 20, 1.0);
    air.set_solids(&rock(20, 20, |x, y| (x, y) == (10, 8)));
    air.blow(Vec2::splat(10.5), 5.0, Vec2::new(8.0, 4.0));
    air.press(Vec2::splat(10.5), 5.0, 2.0);
    assert_eq!(air.velocity_at_cell(10, 10), Vec2::new(8.0, 4.0));
    assert_eq!(air.pressure_at_cell(10, 10), 3.0);
    assert!(air.velocity_at_cell(12, 10).x < 8.0 && air.velocity_at_cell(12, 10).x > air.velocity_at_cell(14, 10).x);
    assert_eq!((air.velocity_at_cell(15, 10), air.pressure_at_cell(15, 10)), (Vec2::ZERO, 1.0));
    assert_eq!((air.velocity_at_cell(10, 8), air.pressure_at_cell(10, 8)), (Vec2::ZERO, 0.0));
    assert!(!air.is_quiet());
    air.clear();
    assert!(air.is_quiet() && air.mass() == 399.0 && air.max_speed() == 0.0);
}

#[test]
fn the_smallest_brush_still_reaches_a_cell() {
    let mut air = closed(8, 8, 4.0);
    air.press(Vec2::new(4.0, 4.0), 0.0, 1.0);
    assert!(air.mass() > 8.0 * 8.0 * 16.0);
}

#[test]
fn warm_air_pushes_with_the_pressure_that_it_was_given() {
    let mut air = closed(8, 8, 2.0);
    air.set_solids(&rock(16, 16, |x, y| x < 2 && y < 2));
    air.fill(rect(0.0, 0.0, 2.0, 2.0), 1.0, 586.0);
    assert!(!air.is_warm() && air.is_quiet() && air.check().is_ok(), "rock is no air");
    air.fill(rect(0.0, 0.0, 8.0, 8.0), 3.0, 586.0);
    air.fill(rect(4.0, 0.0, 8.0, 8.0), 1.0, 586.0);
    let at = |air: &Air, column, row| {
        (air.pressure_at_cell(column, row), air.pressing_at_cell(column, row), air.warmth_of(air.index(column, row)))
    };
    assert_eq!([at(&air, 1, 1), at(&air, 2, 2), at(&air, 4, 4)], [(1.5, 3.0, 1.0), (0.5, 1.0, 1.0), (1.0, 1.0, 0.0)]);
    assert!(!air.is_quiet() && air.check().is_ok());
    // The last one counts, its temperature too.
    air.fill_pressure(rect(0.0, 0.0, 8.0, 8.0), 1.0);
    assert_eq!([at(&air, 1, 1), at(&air, 2, 2)], [(1.0, 1.0, 0.0); 2]);
    // At the ends of what is allowed, and beyond, it can be saved before a step and after it.
    for kelvin in [f32::NEG_INFINITY, 1.0, 4000.0, f32::INFINITY, f32::NAN] {
        air.fill(rect(0.0, 0.0, 8.0, 8.0), 1.0, kelvin);
        assert!(air.check().is_ok(), "{kelvin} K: {:?}", air.check());
        run(&mut air, 1);
        assert!(air.check().is_ok(), "{kelvin} K, a step later: {:?}", air.check());
        assert_sane(&air);
    }
}

#[test]
fn sums_are_those_of_the_cells() {
    let mut air = closed(2, 1, 2.0);
    air.fill_pressure(rect(0.0, 0.0, 2.0, 2.0), 3.0);
    let k = air.index(0, 0);
    air.velocity_x[k] = 5.0;
    air.velocity_y[k] = -1.0;
    assert_eq!(air.mass(), 16.0);
    assert_eq!(air.momentum(), glam::DVec2::new(60.0, -12.0));
    assert_eq!(air.kinetic_energy(), 0.5 * 3.0 * 26.0 * 4.0);
    assert_eq!(air.max_speed(), 5.0);
    // One face, 2.5 d/s through it, two cells of 2 d.
    assert_eq!(air.divergence_rms(), 1.25);
}
