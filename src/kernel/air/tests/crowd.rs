//! Matter in the way of the air: what holds gas back, and what that pushes it by.

use super::super::expansion::Release;
use super::*;
use crate::{element::ElementParams, particles::Particles};

/// Stone, and a gas.
fn elements() -> ElementParams {
    ElementParams { mass: vec![2700.0, 1.8], weight: vec![1.0, -0.5], ..ElementParams::default() }
}

/// Lumps of an element in the columns from `left` to `right` (d) of a box 40 d high, `step` d apart.
fn bed(element: u8, left: f32, right: f32, step: f32) -> Particles {
    let mut particles = Particles::default();
    let places = |from: f32, to: f32| (0..((to - from) / step) as u32).map(move |k| from + step * (k as f32 + 0.5));
    for (x, y) in places(left, right).flat_map(|x| places(0.0, 40.0).map(move |y| (x, y))) {
        particles.push(0, ElementId(element), Vec2::new(x, y), Vec2::ZERO);
    }
    particles
}

/// A duct of 40 × 10 cells of 4 d, with a pressure in its first ten columns.
fn duct(pressure: f32) -> Air {
    let mut air = closed(40, 10, 4.0);
    air.fill_pressure(Rect { min: Vec2::ZERO, max: Vec2::splat(40.0) }, pressure);
    air
}

/// Mean pressure of the first ten columns.
fn behind(air: &Air) -> f32 {
    (0..10).flat_map(|row| air.pressure_row(row)[..10].to_vec()).sum::<f32>() / 100.0
}

#[test]
fn a_bed_holds_gas_back_and_lone_lumps_and_gases_do_not() {
    let left = |particles: &Particles| {
        let mut air = duct(3.0);
        air.crowd(&elements(), particles);
        for _ in 0..10 {
            air.step(&[], SCHEME, ALONE, DT);
        }
        behind(&air)
    };
    let (none, bed_of_stone) = (left(&Particles::default()), left(&bed(0, 40.0, 80.0, 1.0)));
    assert!(bed_of_stone > 2.8 && none < 2.2, "{bed_of_stone} of 3 behind a bed, {none} behind nothing");
    // A lump to 4 d², a quarter of what there is room for.
    assert_eq!(left(&bed(0, 40.0, 80.0, 2.0)), none);
    assert_eq!(left(&bed(1, 40.0, 80.0, 1.0)), none);
}

#[test]
fn a_bed_is_pushed_by_the_difference_of_pressure_across_it() {
    for (pressure, theta, expected) in [(8.0, 1.0, 31.5), (100.0, 1.0, 127.5 + 16.0 * 84.0), (4.0, 3.0, 71.5 / 3.0)] {
        for thickness in [4.0, 20.0, 40.0] {
            let mut air = duct(pressure);
            if theta != 1.0 {
                air.warmth = vec![0.0; air.pressure.len()];
                for k in air.cells().filter(|k| air.pressure[*k] > 1.0).collect::<Vec<_>>() {
                    air.warmth[k] = theta - 1.0;
                }
            }
            let mut particles = bed(0, 40.0, 40.0 + thickness, 1.0);
            air.crowd(&elements(), &particles);
            air.press_matter();
            air.push_matter(&elements(), &mut particles, f32::INFINITY, DT);
            // P = ρ c² G on 40 d, by what faces hold back, 98 %.
            let force: f32 = particles.vx.iter().sum::<f32>() * 2700.0 / DT;
            let wanted = 0.98 * AIR_DENSITY * SOUND * SOUND * expected * 40.0;
            assert!((force / wanted - 1.0).abs() < 1e-4, "{pressure}, {theta}, {thickness} d: {force:e} of {wanted:e}");
            assert!(particles.vy.iter().all(|v| *v == 0.0));
        }
    }
}

#[test]
fn what_would_be_too_fast_is_cut_and_counted_and_what_is_faster_is_not_slowed() {
    let (mut air, mut particles) = (duct(100.0), bed(0, 40.0, 80.0, 1.0));
    air.crowd(&elements(), &particles);
    air.press_matter();
    particles.vx[7] = -20.0;
    let cuts = air.push_matter(&elements(), &mut particles, 5.0, DT);
    assert!(
        cuts > 0 && (0..particles.len()).all(|i| particles.velocity(i).length() <= if i == 7 { 20.0 } else { 5.001 })
    );
}

#[test]
fn even_air_pushes_nothing_and_air_at_rest_has_nothing_in_its_way() {
    let mut particles = bed(0, 40.0, 80.0, 1.0);
    for pressure in [1.0, 7.0] {
        let mut air = closed(40, 10, 4.0);
        air.crowd(&elements(), &particles);
        assert!(air.scratch.crowd.is_empty());
        air.fill_pressure(Rect { min: Vec2::ZERO, max: Vec2::splat(1e3) }, pressure);
        air.crowd(&elements(), &particles);
        air.press_matter();
        air.push_matter(&elements(), &mut particles, f32::INFINITY, DT);
        assert!(particles.vx.iter().chain(&particles.vy).all(|v| *v == 0.0));
    }
}

#[test]
fn gas_in_a_heap_throws_it_apart_evenly() {
    let mut particles = bed(0, 60.0, 100.0, 1.0);
    let mut air = closed(40, 10, 4.0);
    air.expand(&[Release { at: Vec2::new(80.0, 20.0), amount: 320.0, kelvin: 900.0 }], true, &Solids::new(160, 40));
    air.crowd(&elements(), &particles);
    air.press_matter();
    air.push_matter(&elements(), &mut particles, f32::INFINITY, DT);
    let momentum = |v: &[f32]| v.iter().sum::<f32>().abs() / v.iter().map(|v| v.abs()).sum::<f32>();
    assert!(momentum(&particles.vx) < 1e-5 && momentum(&particles.vy) < 1e-5);
    for i in 0..particles.len() {
        let away = particles.position(i) - Vec2::new(82.0, 22.0);
        assert!(particles.velocity(i).dot(away) >= 0.0, "{} at {away} of it", particles.velocity(i));
    }
}
