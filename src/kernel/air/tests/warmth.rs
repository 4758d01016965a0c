//! Warm air: how fast it rises, how hard it presses, what it gets and loses.

use super::super::warmth::{Contact, LOSS_SECONDS};
use super::*;
use crate::heat::units::ROOM;

/// Gravity, and the speed of sound of the scenes, in d/s² and d/s.
const DOWN: Vec2 = Vec2::new(0.0, -98.1);
const SLOW_SOUND: f32 = 80.0;

/// A box of cells of 2 d, in which all that is in `warm` has a temperature and the pressure of what is around it.
fn box_with(columns: u32, rows: u32, theta: f32, warm: impl Fn(Vec2) -> bool) -> Air {
    let sound = AirParams { sound_speed: SLOW_SOUND, ..params(OpenSides::default()) };
    let mut air = Air::new(Vec2::new(columns as f32, rows as f32) * 2.0, 2.0, sound);
    air.set_gravity(DOWN);
    air.warmth = vec![0.0; air.pressure.len()];
    for row in 0..air.rows() {
        for column in 0..air.columns() {
            if warm(air.centre(column, row)) {
                let k = air.index(column, row);
                (air.warmth[k], air.pressure[k]) = (theta - 1.0, 1.0 / theta);
            }
        }
    }
    air.quiet = false;
    air
}

/// What it holds of heat beyond that of its surroundings: the sum of mass times warmth, d² at pressure 1 and 293 K.
fn heat(air: &Air) -> f64 {
    air.cells().map(|k| f64::from(air.warmth_of(k)) * f64::from(air.pressure[k])).sum::<f64>() * air.cell_area()
}

/// Height of the middle of what is warm, weighed by what it lacks, d.
fn middle(air: &Air) -> f64 {
    let (mut sum, mut moment) = (0.0, 0.0);
    for row in 0..air.rows() {
        for warmth in air.warmth_row(row) {
            let lacks = f64::from(warmth / (1.0 + warmth));
            sum += lacks;
            moment += lacks * f64::from(air.centre(0, row).y);
        }
    }
    moment / sum
}

/// A cylinder of warm air of radius 20 d in a box ten times as wide. Bound: 15 % (the issue's), for the walls, which add to its
/// inertia some R²/L² of it, and for what smears.
#[test]
fn a_warm_cylinder_rises_as_batchelor_has_it() {
    for theta in [1.05, 2.0, 4.0, 0.5] {
        let at = Vec2::new(200.0, 160.0);
        let mut air = box_with(200, 160, theta, |place| place.distance(at) < 20.0);
        let begun = middle(&air);
        let atwood = f64::from((theta - 1.0) / (theta + 1.0));
        // Until it has risen by a quarter of its radius: later it rolls up.
        let (mut ticks, mut expected) = (0_u32, 0.0);
        while f64::abs(expected) < 5.0 {
            air.step(&[], SCHEME, ALONE, DT);
            ticks += 1;
            expected = 0.5 * atwood * 98.1 * (f64::from(ticks) * f64::from(DT)).powi(2);
        }
        let risen = middle(&air) - begun;
        assert!((risen / expected - 1.0).abs() < 0.15, "θ = {theta}: {risen} d of {expected} after {ticks} ticks");
    }
}

#[test]
fn sealed_air_presses_as_it_is_warm() {
    // Heated in one corner, so gently that it makes little sound, in a room of two parts with a gap between.
    let mut air = box_with(40, 30, 1.0, |_| true);
    air.set_solids(&rock(80, 60, |x, y| (38..42).contains(&x) && y > 10));
    air.set_gravity(Vec2::ZERO);
    let (mass, kept) = (air.mass(), f64::from(1.0 / (1.0 + DT / LOSS_SECONDS)));
    let mut given = 0.0;
    for tick in 0..600_u16 {
        let part = f32::from(tick) / 600.0;
        let swell = 0.16 * part * part * (1.0 - part) * (1.0 - part);
        let before = heat(&air);
        for cell in 0..100 {
            let k = air.index(cell % 10, cell / 10);
            air.warmth[k] += swell.max(2e-3);
        }
        given = (given + heat(&air) - before) * kept;
        run(&mut air, 1);
    }
    assert!((air.mass() / mass - 1.0).abs() < 1e-6);
    assert!((heat(&air) / given - 1.0).abs() < 1e-5, "{} of {given}", heat(&air));
    // T₂/T₁ wherever one asks, in the mean of five seconds, in which sound passes, to the pressure of the wind that is left: ρ u².
    let (mut off, mut wind) = (vec![0.0; air.pressure.len()], 0.0_f64);
    for _ in 0..300 {
        run(&mut air, 1);
        let expected = 1.0 + heat(&air) / air_area(&air);
        for k in air.cells().filter(|k| !air.solid[*k]) {
            off[k] += (f64::from(air.pushing(k)) - expected) / 300.0;
        }
        wind = wind.max(2.0 * f64::from(air.max_speed() / SLOW_SOUND).powi(2));
    }
    assert!(wind < 0.1 * given / air_area(&air), "a storm is left: {wind}");
    let most = off.iter().fold(0.0_f64, |most, off| most.max(off.abs()));
    assert!(most < wind, "off by {most}, with a wind of {wind}");
}

/// Area of the open cells, d².
fn air_area(air: &Air) -> f64 {
    air.cells().filter(|k| !air.solid[*k]).count() as f64 * air.cell_area()
}

#[test]
fn evenly_warm_air_stands_and_is_no_slower() {
    let mut air = box_with(30, 20, 1.0, |_| true);
    air.set_gravity(Vec2::ZERO);
    air.warmth.iter_mut().zip(&air.solid).filter(|(_, solid)| !**solid).for_each(|(warmth, _)| *warmth = 1.0);
    air.step(&[], SCHEME, ALONE, DT);
    assert_eq!(air.max_speed(), 0.0);
}

#[test]
fn no_temperature_leaves_the_range_of_those_around_it() {
    let mut noise = Random::new(3);
    for advection in AirAdvection::ALL {
        let mut air = closed(40, 30, 2.0);
        air.set_solids(&rock(80, 60, |_, _| noise.offset() > 0.9));
        stir(&mut air, 0.3, 500.0, &mut noise);
        warm(&mut air, &mut noise);
        let ends = |air: &Air| air.warmth.iter().fold([f32::MAX, f32::MIN], |[a, b], t| [a.min(*t), b.max(*t)]);
        let [mut least, mut most] = ends(&air);
        for _ in 0..60 {
            air.step(&[], AirScheme { advection, ..SCHEME }, ALONE, DT);
            let [coldest, hottest] = ends(&air);
            // To the roundings of a substep.
            assert!(coldest >= least - 1e-4 && hottest <= most + 1e-4, "{advection:?}: {coldest} … {hottest}");
            (least, most) = (coldest.min(0.0), hottest.max(0.0));
            assert_sane(&air);
        }
    }
}

#[test]
fn air_takes_the_temperature_of_what_stands_in_it_and_loses_it() {
    let sound = AirParams { sound_speed: SLOW_SOUND, ..params(OpenSides::default()) };
    let mut air = Air::unbuilt(Vec2::new(80.0, 60.0), 4.0, sound);
    air.set_gravity(DOWN);
    air.allow_sleep(true);
    let solids = rock(80, 60, |x, y| (40..44).contains(&x) && (20..24).contains(&y));
    let contact = |kelvin: f32| [Contact { at: Vec2::new(42.0, 22.0), conductance: 1e6, kelvin }];
    air.warm_up(contact(ROOM + 5.0).into_iter(), &solids);
    assert!(!air.is_built(), "what is lukewarm builds air");
    air.warm_up(contact(800.0).into_iter(), &solids);
    // The rock fills its cell and warms the four beside it.
    let hot = air.warmth.iter().filter(|warmth| (**warmth - (800.0 / ROOM - 1.0)).abs() < 0.1).count();
    assert_eq!(hot, 4);
    // Within ln(1.7/0.001) times that in which it cools by e it is as the surroundings; then it is wind as any other.
    let mut ticks = 0;
    while air.is_warm() {
        run(&mut air, 1);
        ticks += 1;
        assert!(f64::from(ticks) < 60.0 * 7.5 * f64::from(LOSS_SECONDS), "it is still warm");
    }
    assert!(ticks > 60, "{ticks} ticks");
    assert!((air.mass() / (80.0 * 60.0 - 16.0) - 1.0).abs() < 1e-6);
}

#[test]
fn rock_that_comes_and_goes_keeps_the_heat_of_the_air() {
    let mut air = box_with(20, 20, 2.0, |place| place.x < 12.0);
    air.set_solids(&Solids::new(40, 40));
    let (mass, warm) = (air.mass(), heat(&air));
    air.set_solids(&rock(40, 40, |x, y| (8..16).contains(&x) && (8..16).contains(&y)));
    assert!((air.mass() / mass - 1.0).abs() < 1e-6 && (heat(&air) / warm - 1.0).abs() < 1e-6, "as it comes");
    air.set_solids(&Solids::new(40, 40));
    assert!((air.mass() / mass - 1.0).abs() < 1e-6 && (heat(&air) / warm - 1.0).abs() < 1e-6, "as it goes");
    let other = air.resized(1.25);
    assert!((heat(&other) / warm - 1.0).abs() < 1e-6, "{} of {warm} on other cells", heat(&other));
    assert!(other.check().is_ok());
}
