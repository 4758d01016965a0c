//! No air makes energy: at rest, in wind and in storms, up to the bounds and past them.
//!
//! The energy is that of one time. The velocity stands half a substep later than the pressure, because the push goes by
//! the new one, so that the kinetic energy at the pressure's time is that of the velocities before and after the push,
//! `½ p u₋·u₊`; and of the pressure's energy the face filter takes its own half (`pressure`, R):
//! ```text
//! R = Σ ½ p u·(u + g) + c² Σ e(p) − ¼ κ s c² Σ_faces p (Δh)²        g: the last push of a cell
//! ```
//! R falls in every substep but for rounding, and where differences are large, in storms, where the filter takes far more
//! than its half, the sum without its last term does. A new pressure is off by at most 8 ε of what is shared to it (`scheme`),
//! which is p on the average, and the velocity, a quotient of sums of nine terms each, by as much: so R is off by at most
//! `8 ε (c² Σ p h + 2 Σ ½ p u²)`, the part by which e(p) and u² follow their arguments.

use super::super::law::head;
use super::super::pressure::stable_courant;
use super::super::source::FACE_FILTER;
use super::super::{MAX_PRESSURE, MAX_SUBSTEPS, STABLE_COURANT};
use super::*;
use crate::{element::ElementParams, particles::Particles};
use std::f64::consts::SQRT_2;

/// R after substeps of `dt` s with sound at `sound` d/s in air at rest, with its last term or without, and the most by
/// which a substep may round it.
fn energy_at_one_time(air: &Air, sound: f64, filter: f32, dt: f64) -> (f64, f64) {
    let s = sound * dt / f64::from(air.cell);
    let gain = 0.5 * sound * s;
    let heads: Vec<f64> = air.pressure.iter().map(|p| f64::from(head(*p))).collect();
    let open = |a: usize, b: usize| !air.solid[a] && !air.solid[b];
    // What the face between two cells lets through.
    let through = |a: usize, b: usize| match (open(a, b), air.scratch.crowd.is_empty()) {
        (true, true) => 1.0,
        (true, false) => f64::from(air.scratch.crowd.through[a].min(air.scratch.crowd.through[b])),
        _ => 0.0,
    };
    let rise = |a: usize, b: usize| through(a, b) * (heads[b] - heads[a]);
    let (mut sum, mut rounding) = (0.0, 0.0);
    for k in air.cells().filter(|k| !air.solid[*k]) {
        let p = f64::from(air.pressure[k]);
        for (field, step) in [(&air.velocity_x, 1), (&air.velocity_y, air.stride())] {
            let u = f64::from(field[k]);
            let pushed = gain * (rise(k - step, k) + rise(k, k + step));
            let steep = if open(k, k + step) { heads[k + step] - heads[k] } else { 0.0 };
            let steep2 = through(k, k + step) * steep * steep;
            let filtered = 0.25 * f64::from(filter) * s * 0.5 * (p + f64::from(air.pressure[k + step]));
            sum += 0.5 * p * u * (u + pushed) - sound * sound * filtered * steep2;
            rounding += p * u * u;
        }
        rounding += sound * sound * p * heads[k];
    }
    let inner = air.pressure_energy() * (sound / f64::from(air.params.sound_speed)).powi(2);
    let area = air.cell_area();
    (sum * area + inner, 8.0 * f64::from(f32::EPSILON) * rounding * area)
}

/// Steps the air `substeps` times by dt(air) s, each a single substep, and demands that R falls in each.
fn assert_falling(
    air: &mut Air,
    scheme: AirScheme,
    filter: f32,
    substeps: u32,
    what: &str,
    dt: impl Fn(&Air) -> f32,
) -> f64 {
    // At first nothing has been pushed yet.
    let (start, _) = energy_at_one_time(air, f64::from(SOUND), filter, 0.0);
    let mut before = start;
    for substep in 0..substeps {
        air.quiet = false;
        let dt = dt(air);
        assert_eq!(air.step(&[], scheme, ALONE, dt).substeps, 1, "the step was cut");
        let (now, rounding) = energy_at_one_time(air, f64::from(SOUND), filter, f64::from(dt));
        assert!(now <= before + rounding, "{what}, substep {substep}: {before:e} to {now:e}, rounding {rounding:e}");
        before = now;
    }
    before / start
}

/// A box with some rock in it.
fn rocky() -> Air {
    let mut noise = Random::new(11);
    let mut air = closed(48, 40, 4.0);
    air.set_solids(&rock(192, 160, |x, y| x / 4 == 20 && y / 4 > 9 || noise.offset() > 0.995));
    air
}

#[test]
fn noise_just_below_the_bound_of_sound_does_not_grow_at_any_pressure() {
    for rest in [1.0, 15.0, 1000.0, 0.99 * MAX_PRESSURE] {
        let mut air = rocky();
        stir(&mut air, 1e-4, 0.1, &mut Random::new(3));
        air.pressure.iter_mut().for_each(|p| *p *= rest);
        let highest = air.pressure.iter().copied().fold(1.0, f32::max);
        let courant = stable_courant(highest);
        // The highest sound, and 1 % less than the bound beside the noise's own winds.
        let dt = 0.99 * courant * air.cell / (SOUND * highest.clamp(1.0, 16.0).sqrt() + 2.0);
        let scheme = AirScheme { courant: STABLE_COURANT, ..SCHEME };
        let left = assert_falling(&mut air, scheme, FACE_FILTER, 2000, &format!("at rest at {rest}"), |_| dt);
        assert!(left < 1.0, "at {rest}: {left}");
    }
}

#[test]
fn storms_up_to_every_bound_lose_energy_in_each_substep() {
    // Pressures up to 10 to the power given, winds up to a share of what half a cell a substep of strong air is.
    let storms = [(0.0, 0.05), (0.0, 0.99), (0.5, 0.3), (1.0, 0.99), (3.0, 0.99), (6.0, 0.0), (6.0, 0.99)];
    for advection in AirAdvection::ALL {
        for ((power, share), courant) in storms.into_iter().flat_map(|storm| [0.7, 0.9].map(|courant| (storm, courant)))
        {
            let mut air = rocky();
            let mut noise = Random::new(8);
            let finest = courant * air.cell / SOUND / 8.0;
            let wind = share * 0.5 * air.cell / finest;
            for row in 0..air.rows() {
                for k in air.row_range(row).filter(|k| !air.solid[*k]) {
                    air.pressure[k] = 0.99 * 10.0_f64.powf(0.5 * power * f64::from(1.0 + noise.offset())) as f32;
                    (air.velocity_x[k], air.velocity_y[k]) = (wind * noise.offset(), wind * noise.offset());
                }
            }
            let what = format!("{advection:?}, 10^{power}, {share} of the wind, Courant number {courant}");
            let left = assert_falling(&mut air, AirScheme { courant, advection }, 0.0, 1000, &what, |air| {
                let highest = air.pressure.iter().copied().fold(1.0, f32::max);
                let [x, y] =
                    [&air.velocity_x, &air.velocity_y].map(|field| field.iter().fold(0.0_f32, |a, b| a.max(b.abs())));
                let crossing = (x + y + SOUND * highest.min(16.0).sqrt()) / courant;
                (0.999 * air.cell / crossing.max(2.0 * x.max(y))).max(finest)
            });
            assert!(left < 0.999, "{what}: {left} is left");
        }
    }
}

#[test]
fn matter_that_stands_in_its_way_makes_no_energy() {
    let elements = ElementParams { mass: vec![1000.0], weight: vec![1.0], ..ElementParams::default() };
    for (power, advection) in
        [(0.0, AirAdvection::FirstOrder), (0.0, AirAdvection::SecondOrder), (2.0, SCHEME.advection)]
    {
        let mut air = rocky();
        let mut noise = Random::new(5);
        stir(&mut air, 0.1, 20.0, &mut noise);
        for k in 0..air.pressure.len() {
            air.pressure[k] *= 10.0_f64.powf(power * f64::from(1.0 + noise.offset())) as f32;
        }
        // From next to nothing to more than there is room for, from cell to cell.
        let mut particles = Particles::default();
        for (column, row) in (0..48).flat_map(|column| (0..40).map(move |row| (column, row))) {
            let at = air.centre(column, row);
            (0..20 - ((column * 7 + row * 13) % 23).min(20))
                .for_each(|_| particles.push(0, ElementId(0), at, Vec2::ZERO));
        }
        air.crowd(&elements, &particles);
        let scheme = AirScheme { advection, ..SCHEME };
        let filter = if power > 0.0 { 0.0 } else { FACE_FILTER };
        let left = assert_falling(&mut air, scheme, filter, 1000, &format!("10^{power}, {advection:?}"), |air| {
            let highest = air.pressure.iter().copied().fold(1.0, f32::max);
            let fastest =
                air.velocity_x.iter().chain(&air.velocity_y).fold(0.0_f32, |most, speed| most.max(speed.abs()));
            COURANT * air.cell / (SOUND * highest.min(16.0).sqrt() + 2.0 * fastest)
        });
        assert!(left < 0.9, "{left} is left");
    }
}

#[test]
fn noise_in_the_strongest_wind_stays_noise() {
    // Sound past what the substeps can follow, and wind up to it: sound is slowed to half a cell a substep. The plain
    // energy, which is measured here, differs by at most s/√2 of it from that at one time, either way.
    let s = 0.5;
    let most = (1.0 + s / SQRT_2) / (1.0 - s / SQRT_2);
    // So far below half a cell that noise has room to grow.
    let winds = [[0.45, 0.45], [0.4, 0.0], [0.45, 0.2]];
    for (advection, [x, y]) in AirAdvection::ALL.into_iter().flat_map(|a| winds.map(|wind| (a, wind))) {
        let mut air = closed(240, 240, 4.0);
        let dt = 1.2 * air.cell / SOUND;
        stir(&mut air, 1e-4, 0.05, &mut Random::new(21));
        let [wind_x, wind_y] = [x, y].map(|cells| cells * air.cell / dt);
        air.velocity_x.iter_mut().for_each(|u| *u += wind_x);
        air.velocity_y.iter_mut().for_each(|v| *v += wind_y);
        let noise_in = |air: &Air, left: usize, bottom: usize| {
            let cells = (bottom..bottom + 40).flat_map(|row| (left..left + 40).map(move |column| (column, row)));
            let square = |x: f32| f64::from(x) * f64::from(x);
            let sums = cells.map(|(column, row)| {
                let (p, u) = (air.pressure_at_cell(column, row), air.velocity_at_cell(column, row));
                square(u.x - wind_x) + square(u.y - wind_y) + square(SOUND * s as f32 / 1.2 * (p - 1.0))
            });
            sums.sum::<f64>()
        };
        let start = noise_in(&air, 100, 100);
        let report = air.step(&[], AirScheme { advection, ..SCHEME }, ALONE, MAX_SUBSTEPS as f32 * dt);
        assert_eq!((report.substeps, report.slowed), (MAX_SUBSTEPS, u64::from(MAX_SUBSTEPS)), "{report:?}");
        // It has drifted with the wind, and nothing has come to it from the walls.
        let [left, bottom] = [x, y].map(|cells| 100 + (MAX_SUBSTEPS as f32 * cells) as usize);
        let end = noise_in(&air, left, bottom);
        assert!(end <= most * start, "{advection:?}, wind {x}, {y}: {start:e} to {end:e}");
    }
}

#[test]
fn ten_times_past_the_bound_sound_is_slowed_and_nothing_grows() {
    for advection in AirAdvection::ALL {
        let mut air = rocky();
        // All substeps that there are would have to go ten times as far as is stable.
        let dt = 10.0 * STABLE_COURANT * air.cell / SOUND * MAX_SUBSTEPS as f32;
        // All of it a little below 1, so that sound is slowed by the same in every step.
        stir(&mut air, 1e-4, 0.1, &mut Random::new(3));
        air.pressure.iter_mut().for_each(|p| *p *= 0.999);
        let substep = f64::from(dt) / f64::from(MAX_SUBSTEPS);
        let slowed = 0.5 * f64::from(air.cell) / substep;
        let (mut before, _) = energy_at_one_time(&air, slowed, FACE_FILTER, 0.0);
        let start = before;
        for step in 0..50 {
            air.quiet = false;
            let report = air.step(&[], AirScheme { courant: STABLE_COURANT, advection }, ALONE, dt);
            assert_eq!((report.substeps, report.slowed), (MAX_SUBSTEPS, u64::from(MAX_SUBSTEPS)), "{report:?}");
            let (now, rounding) = energy_at_one_time(&air, slowed, FACE_FILTER, substep);
            let rounding = rounding * f64::from(MAX_SUBSTEPS);
            assert!(now <= before + rounding, "step {step}: {before:e} to {now:e}, rounding {rounding:e}");
            assert_sane(&air);
            before = now;
        }
        assert!(before < start, "{before:e} of {start:e}");
    }
}
