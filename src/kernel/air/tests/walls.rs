//! Rock: nothing leaks, nothing is lost.

use super::*;

#[test]
fn mass_is_kept_and_pressure_stays_positive_over_a_thousand_steps_with_rock() {
    for (cell, share) in [(1.0, 0.3), (4.0, 0.02), (2.5, 0.1)] {
        let mut noise = Random::new(21);
        let solids = rock(80, 60, |_, _| noise.offset() > 1.0 - 2.0 * share);
        let mut air = Air::new(Vec2::new(80.0, 60.0), cell, params(OpenSides::default()));
        air.set_solids(&solids);
        stir(&mut air, 0.99, 800.0, &mut noise);
        let mass = air.mass();
        for _ in 0..1000 {
            air.step(&[], SCHEME, ALONE, cell * 5e-4);
            // Keep it stirred, so that the thousandth step has as much to do as the first.
            for velocity in air.velocity_x.iter_mut().zip(&air.solid).filter(|(_, solid)| !**solid) {
                *velocity.0 += 20.0 * noise.offset();
            }
            assert_sane(&air);
        }
        let drift = air.mass() / mass - 1.0;
        assert!(drift.abs() < 1e-5, "cell {cell}: {drift}");
    }
}

#[test]
fn momentum_is_kept_until_a_wall_is_reached() {
    let mut air = closed(96, 96, 2.0);
    air.blow(Vec2::new(96.0, 96.0), 20.0, Vec2::new(200.0, -70.0));
    air.press(Vec2::new(90.0, 96.0), 10.0, 0.5);
    let start = air.momentum();
    run(&mut air, 3);
    assert!((air.momentum() - start).length() < 1e-4 * start.length(), "{} from {start}", air.momentum());
}

/// Storm on one side of a wall, and the bits of the other side.
fn assert_no_leak(wall: impl Fn(i32, i32) -> bool, far: impl Fn(i32, i32) -> bool) {
    let mut air = closed(40, 40, 1.0);
    air.set_solids(&rock(40, 40, wall));
    for row in 0..40 {
        for column in 0..40 {
            if !far(column, row) && !air.is_solid_cell(column as usize, row as usize) {
                let k = air.index(column as usize, row as usize);
                air.pressure[k] = 5.0;
                air.velocity_x[k] = 700.0 * ((column + row) % 3 - 1) as f32;
                air.velocity_y[k] = 700.0 * ((column - row) % 3 - 1) as f32;
            }
        }
    }
    air.quiet = false;
    for _ in 0..200 {
        air.step(&[], SCHEME, ALONE, 4e-3);
    }
    for row in 0..40 {
        for column in (0..40).filter(|column| far(*column, row)) {
            let (i, j) = (column as usize, row as usize);
            assert_eq!(air.pressure_at_cell(i, j), 1.0, "pressure leaked to {column}, {row}");
            assert_eq!(air.velocity_at_cell(i, j), Vec2::ZERO, "wind leaked to {column}, {row}");
        }
    }
}

#[test]
fn a_vertical_wall_one_particle_thick_does_not_leak() {
    assert_no_leak(|x, _| x == 20, |x, _| x > 20);
}

#[test]
fn a_horizontal_wall_one_particle_thick_does_not_leak() {
    assert_no_leak(|_, y| y == 13, |_, y| y < 13);
}

#[test]
fn a_diagonal_wall_one_particle_thick_does_not_leak() {
    assert_no_leak(|x, y| x == y, |x, y| x > y);
    assert_no_leak(|x, y| x + y == 39, |x, y| x + y < 39);
}

#[test]
fn a_cell_is_solid_when_any_rock_is_in_it() {
    let mut air = Air::new(Vec2::new(20.0, 20.0), 2.5, params(OpenSides::default()));
    air.set_solids(&rock(20, 20, |x, y| (x, y) == (7, 5)));
    // The site covers 7 … 8 by 5 … 6, and the cells part at 7.5 and at 5.
    let solid: Vec<_> = (0..8).flat_map(|row| (0..8).map(move |column| (column, row))).collect();
    let solid: Vec<_> = solid.into_iter().filter(|(column, row)| air.is_solid_cell(*column, *row)).collect();
    assert_eq!(solid, [(2, 2), (3, 2)]);
}

#[test]
fn rock_that_was_followed_is_not_followed_again() {
    let mut air = closed(8, 8, 1.0);
    let solids = rock(8, 8, |x, y| x == y);
    air.set_solids(&solids);
    air.press(Vec2::new(1.0, 6.0), 2.0, 1.0);
    let before = bits(&air);
    air.set_solids(&solids);
    assert_eq!(bits(&air), before);
}

#[test]
fn first_rock_leaves_the_air_at_rest() {
    let mut air = closed(8, 8, 2.0);
    air.set_solids(&rock(16, 16, |x, y| x * y % 7 == 3));
    assert!(air.is_quiet());
    assert!(air.pressure.iter().zip(&air.solid).all(|(p, solid)| *solid || *p == 1.0));
}

#[test]
fn rock_that_comes_and_goes_keeps_the_mass() {
    let mut air = closed(30, 30, 2.0);
    let mut solids = Solids::new(60, 60);
    air.set_solids(&solids);
    let mut noise = Random::new(31);
    stir(&mut air, 0.5, 100.0, &mut noise);
    let mass = air.mass();
    for round in 0..40 {
        let corner = IVec2::new((noise.offset() * 20.0) as i32 + 20, (noise.offset() * 20.0) as i32 + 20);
        for site in (0..144).map(|k| corner + IVec2::new(k % 12, k / 12)) {
            if round % 2 == 0 {
                solids.insert(site, ElementId(0), 0);
            } else {
                solids.remove(site);
            }
        }
        air.set_solids(&solids);
        let report = air.step(&[], SCHEME, ALONE, 1e-3);
        assert_eq!(report.buried, 0.0);
        assert!((air.mass() / mass - 1.0).abs() < 1e-5, "round {round}: {}", air.mass() / mass - 1.0);
        assert_sane(&air);
    }
}

#[test]
fn air_without_a_way_out_is_counted_as_buried() {
    let mut air = closed(3, 1, 1.0);
    air.set_solids(&rock(3, 1, |x, _| x == 1));
    air.set_solids(&rock(3, 1, |x, _| x < 2));
    // The version says nothing about where the rock is, so it must differ for the change to be followed.
    let report = air.step(&[], SCHEME, ALONE, DT);
    assert_eq!((report.buried, air.mass()), (1.0, 1.0));
}

#[test]
fn air_keeps_its_mass_on_cells_of_another_size() {
    for open in [false, true] {
        let mut noise = Random::new(17);
        let solids = rock(100, 70, |_, y| y == 30 || noise.offset() > 0.97);
        let mut air = Air::new(Vec2::new(100.0, 70.0), 3.0, params(OpenSides { left: open, ..OpenSides::default() }));
        air.set_solids(&solids);
        stir(&mut air, 0.5, 100.0, &mut noise);
        for cell in [4.0, 8.0, 2.0, 2.5] {
            let mut other = air.resized(cell);
            if !open {
                assert!((other.mass() / air.mass() - 1.0).abs() < 1e-5);
            }
            other.set_solids(&solids);
            if !open {
                assert!((other.mass() / air.mass() - 1.0).abs() < 1e-5);
            }
            run(&mut other, 1);
            assert_sane(&other);
            air = other;
        }
    }
}

#[test]
fn still_air_stays_still_on_cells_of_another_size() {
    let solids = rock(100, 70, |x, y| y == 30 && x > 20);
    let mut air = Air::new(Vec2::new(100.0, 70.0), 8.0, params(OpenSides::default()));
    air.set_solids(&solids);
    let mut other = air.resized(3.0);
    other.set_solids(&solids);
    other.step(&[], SCHEME, ALONE, DT);
    assert!(other.is_quiet() && other.max_speed() == 0.0);
}
