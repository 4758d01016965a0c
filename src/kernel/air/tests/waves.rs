//! Sound, wind and the sides that let them out.

use super::super::QUIET_MACH;
use super::*;
use crate::sources::Wind;

/// Column of the highest pressure right of the middle of a row, to a part of a cell (parabola through three).
fn crest(air: &Air, row: usize) -> f32 {
    let p = air.pressure_row(row);
    let half = p.len() / 2;
    let k = (half + 1..p.len() - 1).max_by(|a, b| p[*a].total_cmp(&p[*b])).unwrap();
    k as f32 + 0.5 * (p[k - 1] - p[k + 1]) / (p[k - 1] - 2.0 * p[k] + p[k + 1])
}

/// A ridge of pressure across the middle of the box, smooth over some ten cells.
fn ridge(air: &mut Air, height: f32) {
    let (columns, middle) = (air.columns(), air.columns() as f32 * 0.5);
    for row in 0..air.rows() {
        let start = air.row_range(row).start;
        for column in 0..columns {
            let x = (column as f32 + 0.5 - middle) / 5.0;
            air.pressure[start + column] = 1.0 + height / (1.0 + x * x) / (1.0 + x * x);
        }
    }
    air.quiet = false;
}

#[test]
fn a_pulse_travels_at_the_speed_of_sound() {
    let mut air = closed(400, 3, 2.0);
    ridge(&mut air, 0.01);
    run(&mut air, 3);
    let early = crest(&air, 1);
    run(&mut air, 12);
    let speed = (crest(&air, 1) - early) * 2.0 / (12.0 * DT);
    assert!((speed / SOUND - 1.0).abs() < 0.02, "{speed} d/s");
}

#[test]
fn a_pulse_settles_to_even_pressure_and_falls_asleep() {
    let mut air = closed(32, 24, 4.0);
    air.press(Vec2::new(30.0, 40.0), 16.0, 1.0);
    let mass = air.mass();
    let mut ticks = 0;
    while !air.is_quiet() && ticks < 6000 {
        run(&mut air, 1);
        ticks += 1;
    }
    assert!(air.is_quiet(), "still {} d/s after {ticks} ticks", air.max_speed());
    let even = air.pressure_at_cell(0, 0);
    assert!((0..24).all(|row| air.pressure_row(row).iter().all(|p| *p == even)), "pressure is not even");
    assert!((air.mass() / mass - 1.0).abs() < 1e-5);
}

#[test]
fn alternating_pressure_dies_out() {
    let mut air = closed(32, 32, 4.0);
    for row in 0..32 {
        for (column, k) in air.row_range(row).enumerate() {
            air.pressure[k] = if (row + column) % 2 == 0 { 1.05 } else { 0.95 };
        }
    }
    air.quiet = false;
    run(&mut air, 20);
    let spread = (0..32).flat_map(|row| air.pressure_row(row)).fold(0.0_f32, |spread, p| spread.max((p - 1.0).abs()));
    assert!(spread < 5e-3, "{spread} is left of 0.05");
}

#[test]
fn faint_noise_does_not_grow_in_still_air_nor_in_wind() {
    for wind in [0.0, 20.0, 100.0] {
        let mut air = Air::new(Vec2::new(128.0, 64.0), 2.0, params(OpenSides::default()));
        stir(&mut air, 1e-3, 0.5, &mut Random::new(5));
        for velocity in &mut air.velocity_x {
            *velocity += wind;
        }
        let start = energy(&air);
        for _ in 0..120 {
            run(&mut air, 1);
            assert!(energy(&air) <= 1.02 * start, "wind {wind}: energy {} of {start}", energy(&air));
        }
    }
}

#[test]
fn energy_never_grows_in_a_closed_box_with_rock() {
    let mut noise = Random::new(11);
    let solids = rock(96, 96, |_, _| noise.offset() > 0.8);
    for (pressure, speed) in [(0.5, 0.0), (0.0, 300.0), (0.9, 2000.0)] {
        let mut air = closed(48, 48, 2.0);
        air.set_solids(&solids);
        stir(&mut air, pressure, speed, &mut Random::new(7));
        let start = energy(&air);
        for tick in 0..100 {
            run(&mut air, 1);
            assert!(energy(&air) <= 1.1 * start, "tick {tick}: {} of {start}", energy(&air));
        }
        assert!(energy(&air) < 0.9 * start);
    }
}

#[test]
fn wind_against_a_wall_loses_its_speed() {
    let mut air = closed(16, 16, 4.0);
    for row in 0..16 {
        let last = air.row_range(row).end - 1;
        air.velocity_x[last] = 400.0;
    }
    air.quiet = false;
    let start = energy(&air);
    run(&mut air, 60);
    let at_wall = air.velocity_at_cell(15, 8).x.abs();
    assert!(at_wall < 10.0 && energy(&air) < 0.1 * start, "{at_wall} d/s, {} of {start}", energy(&air));
}

#[test]
fn an_open_side_lets_a_pulse_out() {
    let sides = OpenSides { left: true, right: true, ..OpenSides::default() };
    let mut air = Air::new(Vec2::new(256.0, 16.0), 2.0, params(sides));
    ridge(&mut air, 0.01);
    let start = energy(&air);
    // Sound needs 0.13 s, eight ticks, from the middle to the side.
    run(&mut air, 14);
    assert!(energy(&air) < 0.01 * start, "{} of {start} came back", energy(&air));
}

#[test]
fn an_open_box_evens_out_with_the_surroundings() {
    let mut air = Air::new(Vec2::new(64.0, 64.0), 4.0, params(OpenSides { top: true, ..OpenSides::default() }));
    air.fill_pressure(rect(0.0, 0.0, 64.0, 64.0), 3.0);
    run(&mut air, 600);
    let mean = air.mass() / (64.0 * 64.0);
    assert!((mean - 1.0).abs() < f64::from(QUIET_MACH), "{mean}");
}

#[test]
fn a_wind_tunnel_reaches_a_steady_even_stream() {
    // So strong a wind that what it takes to bring air from rest to its speed within it, ½ u²/16 d, slows it by 1 d/s.
    let sides = OpenSides { left: true, right: true, ..OpenSides::default() };
    let mut air = Air::new(Vec2::new(160.0, 48.0), 4.0, params(sides));
    let wind = Wind { area: rect(0.0, 0.0, 16.0, 48.0), velocity: Vec2::new(100.0, 0.0), rate: 300.0 };
    let blow = |air: &mut Air, ticks: u32| {
        for _ in 0..ticks {
            air.step(&[wind], SCHEME, ALONE, DT);
        }
    };
    blow(&mut air, 600);
    let before = air.clone();
    blow(&mut air, 60);
    for row in 0..air.rows() {
        for column in 0..air.columns() {
            let (then, now) = (before.velocity_at_cell(column, row), air.velocity_at_cell(column, row));
            assert!((now - Vec2::new(100.0, 0.0)).length() < 2.0, "{now} at {column}, {row}");
            assert!((now - then).length() < 0.5, "{now} was {then} at {column}, {row}");
            assert!((air.pressure_at_cell(column, row) - 1.0).abs() < 0.02);
        }
    }
}

#[test]
fn a_vortex_lasts() {
    // Taylor–Green: kinetic energy after the time to cross a wavelength, ideal 1, 0.63 for forward advection by substeps
    // of half a cell; the smaller substeps that sound asks for here cost some of it.
    let n = 64;
    let mut air = closed(n, n, 2.0);
    for row in 0..n as usize {
        for (column, k) in air.row_range(row).enumerate() {
            let turn = std::f64::consts::PI / f64::from(n) * 2.0;
            let (x, y) = (turn * (column as f64 + 0.5), turn * (row as f64 + 0.5));
            air.velocity_x[k] = (100.0 * x.sin() * y.cos()) as f32;
            air.velocity_y[k] = (-100.0 * x.cos() * y.sin()) as f32;
        }
    }
    air.quiet = false;
    let start = air.kinetic_energy();
    run(&mut air, (128.0_f32 / 100.0 / DT) as u32);
    let kept = air.kinetic_energy() / start;
    assert!((0.4..=1.0).contains(&kept), "{kept}");
}
