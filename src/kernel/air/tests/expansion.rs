//! Gas that matter gives off: where it comes in, how warm and how fast, and what is taken back.

use super::super::expansion::Release;
use super::*;
use crate::heat::units::ROOM;

/// A rounding of a pressure each time that one is added to.
const ROUNDING: f64 = 1e-6;

fn release(x: f32, y: f32, amount: f32) -> Release {
    Release { at: Vec2::new(x, y), amount, kelvin: 3.0 * ROOM }
}

/// A box of 8 × 6 cells of 4 d in which columns 3 and 4 are rock up to a height of three cells.
fn with_wall() -> (Air, Solids) {
    let mut solids = Solids::new(32, 24);
    for y in 0..12 {
        for x in 12..20 {
            solids.insert(IVec2::new(x, y), ElementId(0), 0);
        }
    }
    let mut air = closed(8, 6, 4.0);
    air.set_solids(&solids);
    (air, solids)
}

#[test]
fn gas_comes_into_the_nearest_open_cells_and_all_of_it() {
    // In the open; within the wall beside one side, in its foot's middle, under its top; beyond the box.
    for (place, cells) in [
        ([1.0, 1.0], &[[0, 0]][..]),
        ([13.0, 5.0], &[[2, 1]]),
        ([18.0, 5.0], &[[5, 1]]),
        ([13.0, 11.0], &[[2, 2], [3, 3]]),
        ([40.0, -3.0], &[[7, 0]]),
    ] {
        let (mut air, solids) = with_wall();
        let before = air.mass();
        let got = air.expand(&[release(place[0], place[1], 20.0)], true, &solids);
        assert!((got - 20.0).abs() < ROUNDING * 20.0 && (air.mass() - before - got).abs() < ROUNDING * before);
        for [column, row] in cells {
            let more = air.pressure_at_cell(*column, *row) - 1.0;
            assert!((more - 1.25 / cells.len() as f32).abs() < 1e-6, "{place:?}: {more} in {column}, {row}");
        }
        assert!(!air.is_quiet() && air.check().is_ok());
    }
}

#[test]
fn gas_that_finds_no_open_air_is_counted() {
    let mut solids = Solids::new(40, 40);
    for cell in (0..1600).map(|k| IVec2::new(k % 40, k / 40)) {
        solids.insert(cell, ElementId(0), 0);
    }
    let mut air = closed(10, 10, 4.0);
    air.set_solids(&solids);
    assert_eq!(air.expand(&[release(20.0, 20.0, 20.0), release(20.0, 20.0, -20.0)], true, &solids), 20.0);
    assert!((air.take_report().buried - 20.0).abs() < 1e-6);
}

#[test]
fn gas_comes_at_rest_and_as_warm_as_its_lump_where_that_is_wanted() {
    for warm in [true, false] {
        let mut air = closed(8, 6, 4.0);
        stir(&mut air, 0.3, 50.0, &mut Random::new(1));
        let (momentum, mass) = (air.momentum(), air.mass());
        air.expand(&[release(10.0, 10.0, 32.0)], warm, &Solids::new(32, 24));
        assert!((air.momentum() - momentum).length() < 1e-5 * mass * 50.0);
        let heat: f64 =
            air.cells().map(|k| f64::from(air.warmth_of(k) * air.pressure[k])).sum::<f64>() * air.cell_area();
        // Twice as warm above the room as the room is.
        assert!((heat - if warm { 64.0 } else { 0.0 }).abs() < 1e-4, "{heat}");
        assert_eq!(air.is_warm(), warm);
    }
}

#[test]
fn what_is_taken_leaves_air_and_its_speed_and_warmth() {
    let mut air = closed(8, 6, 4.0);
    stir(&mut air, 0.3, 50.0, &mut Random::new(2));
    warm(&mut air, &mut Random::new(3));
    let k = air.cell_at(Vec2::splat(10.0));
    let before = [air.velocity_x[k], air.velocity_y[k], air.warmth[k], air.pressure[k]];
    let got = air.expand(&[release(10.0, 10.0, -3.2)], true, &Solids::new(32, 24));
    assert!((got + 3.2).abs() < 1e-5, "{got}");
    assert_eq!([air.velocity_x[k], air.velocity_y[k], air.warmth[k]], before[..3]);
    // What the cell has not comes from those around it, from those on all sides alike.
    let (mut air, mass) = (closed(9, 9, 4.0), 9.0 * 9.0 * 16.0);
    let got = air.expand(&[release(18.0, 18.0, -24.0)], true, &Solids::new(36, 36));
    assert!((got + 24.0).abs() < 1e-5 && (air.mass() - mass + 24.0).abs() < 1e-4);
    let pressures = [[4, 4], [3, 4], [5, 4], [4, 3], [4, 5], [5, 5]].map(|[x, y]| air.pressure_at_cell(x, y));
    assert_eq!(pressures, [0.625, 0.71875, 0.71875, 0.71875, 0.71875, 1.0]);
    // Never more than three quarters of what was there, however much is asked for: that is counted.
    air.expand(&[release(18.0, 18.0, -1e4); 40], true, &Solids::new(36, 36));
    assert!(air.cells().all(|k| air.pressure[k] >= 0.25) && air.take_report().pressure_clamps == 40);
    assert!(air.check().is_ok());
}

#[test]
fn gas_in_a_sealed_room_stays_there() {
    let (mut air, mut solids) = (closed(16, 12, 4.0), Solids::new(64, 48));
    for y in 0..48 {
        solids.insert(IVec2::new(30, y), ElementId(0), 0);
    }
    air.set_solids(&solids);
    let begun = air.mass();
    let mut got = 0.0;
    for _ in 0..120 {
        got += air.expand(&[release(10.0, 10.0, 5.0), release(50.0, 20.0, -0.5)], false, &solids);
        air.step(&[], SCHEME, ALONE, DT);
    }
    // A share of 2⁻²⁰ of all for each time that gas came in (`balance`).
    let most = 120.0 / f64::from(1 << 20) * (begun + got);
    assert!((got - 540.0).abs() < 1e-3 && (air.mass() - begun - got).abs() < most);
    let right: f64 = (0..12).map(|row| f64::from(air.pressure_at_cell(12, row))).sum();
    assert!(right < 12.0, "{right}");
}
