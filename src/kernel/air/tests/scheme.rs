//! The passes themselves: against a plain scatter, mirrored, turned, in parallel, at rest.

use super::super::MAX_PRESSURE;
use super::super::source::FACE_FILTER;
use super::super::step::WORTH_BANDS;
use super::super::warmth::LOSS_SECONDS;
use super::*;

/// The slope of a field in a cell along `step` by its definition: 0 at a peak, else of the three differences the least.
fn slope(air: &Air, field: &[f32], k: isize, step: isize) -> f64 {
    let difference = |a: isize, b: isize| {
        let solid = air.solid[a as usize] || air.solid[b as usize];
        if solid { 0.0 } else { f64::from(field[b as usize]) - f64::from(field[a as usize]) }
    };
    let (low, high) = (difference(k - step, k), difference(k, k + step));
    if low * high <= 0.0 {
        return 0.0;
    }
    low.signum() * (2.0 * low.abs()).min(2.0 * high.abs()).min(0.5 * (low + high).abs())
}

/// The head of a pressure by its definition.
fn head(p: f64) -> f64 {
    if p <= 16.0 { p } else { 16.0 + 16.0 * (p / 16.0).ln() }
}

/// What one substep does, written as a scatter in f64 cell by cell, with the rule for corners spelled out.
fn scatter(air: &Air, advection: AirAdvection, dt: f64) -> [Vec<f64>; 4] {
    let stride = air.stride() as isize;
    let crossing = dt / f64::from(air.cell);
    let s = f64::from(SOUND) * crossing;
    let at = |field: &[f32], k: isize| f64::from(field[k as usize]);
    let solid = |k: isize| air.solid[k as usize];
    let second_order = advection == AirAdvection::SecondOrder;
    let flow = |k: isize, step: isize, field: &[f32]| {
        if solid(k) || solid(k + step) {
            return 0.0;
        }
        let e = |k: isize| at(&air.pressure, k) * (1.0 + f64::from(air.warmth_of(k as usize)));
        let drop = head(e(k)) - head(e(k + step));
        let mut wind = 0.5 * (at(field, k) + at(field, k + step)) * crossing;
        if second_order {
            wind *= 1.0 - (at(field, k + step) - at(field, k)) * crossing;
        }
        (wind + f64::from(FACE_FILTER) * s * drop).clamp(-0.5, 0.5)
    };
    let n = air.pressure.len();
    let mut next = [vec![0.0; n], vec![0.0; n], vec![0.0; n], vec![0.0; n]];
    for k in (0..n as isize).filter(|k| !solid(*k)) {
        let [left, right] = [-flow(k - 1, 1, &air.velocity_x), flow(k, 1, &air.velocity_x)].map(|f| f.max(0.0));
        let [down, up] =
            [-flow(k - stride, stride, &air.velocity_y), flow(k, stride, &air.velocity_y)].map(|f| f.max(0.0));
        // Shares, and how far from the middle of the cell the middle of each is.
        let parts = |step: isize, low: f64, high: f64| {
            let stays = (0, 1.0 - low - high, 0.5 * (low - high));
            [(-step, low, -0.5 * (1.0 - low)), stays, (step, high, 0.5 * (1.0 - high))]
        };
        for (dx, x, ahead) in parts(1, left, right) {
            for (dy, y, above) in parts(stride, down, up) {
                let across = k + dx + dy;
                let turned = solid(across);
                let velocity = |field: &[f32]| {
                    // What goes round a corner has the cell's mean velocity.
                    let tilted = if second_order && !turned {
                        slope(air, field, k, 1) * ahead + slope(air, field, k, stride) * above
                    } else {
                        0.0
                    };
                    at(field, k) + tilted
                };
                let ends = if turned { [k + dx, k + dy] } else { [across; 2] };
                for end in ends {
                    let mass = 0.5 * at(&air.pressure, k) * x * y;
                    assert!(mass == 0.0 || !solid(end), "a share entered rock");
                    next[0][end as usize] += mass;
                    next[1][end as usize] += mass * velocity(&air.velocity_x);
                    next[2][end as usize] += mass * velocity(&air.velocity_y);
                    next[3][end as usize] += if air.is_warm() { mass * velocity(&air.warmth) } else { 0.0 };
                }
            }
        }
    }
    let [p, x, y, warmth] = &mut next;
    warmth.iter_mut().zip(&*p).filter(|(_, p)| **p > 0.0).for_each(|(warmth, p)| *warmth /= p);
    let e: Vec<f64> = p.iter().zip(&*warmth).map(|(p, warmth)| p * (1.0 + warmth)).collect();
    for k in (0..n as isize).filter(|k| !solid(*k)) {
        let here = k as usize;
        let push = |step: isize| {
            let pair = |a: isize, b: isize| {
                if solid(a) || solid(b) { 0.0 } else { head(e[b as usize]) - head(e[a as usize]) }
            };
            -0.5 * s * f64::from(SOUND) * (pair(k - step, k) + pair(k, k + step))
        };
        let settle = |velocity: f64, step: isize| {
            let wall = if velocity > 0.0 { solid(k + step) } else { solid(k - step) };
            velocity * (1.0 - if wall { (velocity.abs() * crossing).min(1.0) } else { 0.0 })
        };
        let pull = -2.0 * dt * warmth[here] / (2.0 + warmth[here]);
        let [lift_x, lift_y] = air.scratch.gravity.to_array().map(|g| pull * f64::from(g));
        x[here] = settle(x[here] / p[here] + lift_x + push(1), 1);
        y[here] = settle(y[here] / p[here] + lift_y + push(stride), stride);
    }
    next
}

#[test]
fn the_gather_is_the_scatter() {
    let cases = [(0.4, false), (0.9, false), (0.4, true), (0.9, true)];
    for (advection, (rocky, is_warm)) in AirAdvection::ALL.into_iter().flat_map(|one| cases.map(|case| (one, case))) {
        let mut noise = Random::new(42);
        let solids = rock(23, 19, |_, _| noise.offset() > rocky);
        let mut air = closed(23, 19, 1.0);
        air.set_solids(&solids);
        stir(&mut air, 0.2, 300.0, &mut noise);
        if is_warm {
            warm(&mut air, &mut noise);
        }
        let dt = 2e-4;
        let wanted = scatter(&air, advection, f64::from(dt));
        assert_eq!(air.step(&[], AirScheme { courant: 0.9, advection }, ALONE, dt).substeps, 1);
        // A velocity is a sum of momenta of 300 d/s.
        // What it lost after the substep.
        air.warmth.iter_mut().for_each(|warmth| *warmth *= 1.0 + dt / LOSS_SECONDS);
        let fields = [(&air.pressure, 1.0), (&air.velocity_x, 30.0), (&air.velocity_y, 30.0), (&air.warmth, 1.0)];
        for ((got, least), wanted) in fields.into_iter().zip(&wanted) {
            for k in (0..got.len()).filter(|k| !air.solid[*k]) {
                let error = (f64::from(got[k]) - wanted[k]).abs();
                assert!(
                    error < 1e-5 * wanted[k].abs().max(least),
                    "{advection:?}: {} for {} at {k}",
                    got[k],
                    wanted[k]
                );
            }
        }
    }
}

/// What a storm's air loses before it is given back (`balance`), it loses to the roundings of f32, a substep at a time: the same substep in f64 keeps the mass to the last digit, and in no cell is
/// f32 further from it than some roundings. They add up the faster the less the storm changes, because then they are the
/// same again and again.
#[test]
fn a_storm_of_a_million_atmospheres_loses_mass_to_rounding_alone() {
    let mut air = closed(20, 15, 4.0);
    air.set_solids(&rock(80, 60, |x, y| (60..72).contains(&x) && y < 24));
    air.fill_pressure(rect(60.0, 36.0, 64.0, 40.0), MAX_PRESSURE);
    let begun = air.mass();
    let (mut steps, mut rounded) = (0, 0.0);
    for _ in 0..3000 {
        let sound = SOUND * air.pressure.iter().copied().fold(1.0, f32::max).sqrt();
        let dt = 0.5 * COURANT * air.cell / (2.0 * air.max_speed() + sound);
        let (before, wanted) = (air.mass(), scatter(&air, SCHEME.advection, f64::from(dt)));
        let kept = wanted[0].iter().sum::<f64>() * air.cell_area();
        let pressures = air.pressure.clone();
        assert!((kept / before - 1.0).abs() < 1e-13, "the scheme itself makes {before} to {kept}");
        if air.step(&[], SCHEME, ALONE, dt).substeps != 1 {
            break;
        }
        steps += 1;
        rounded += air.mass() - kept;
        for k in (0..air.pressure.len()).filter(|k| !air.solid[*k]) {
            // What shares may be rounded by is measured by what is shared: the nine cells' pressures.
            let rows = [k - air.stride(), k, k + air.stride()];
            let around = rows.into_iter().flat_map(|k| &pressures[k - 1..=k + 1]).fold(0.0_f32, |most, p| most.max(*p));
            let error = (f64::from(air.pressure[k]) - wanted[0][k]).abs();
            let bound = 8.0 * f64::from(f32::EPSILON) * f64::from(around);
            assert!(error <= bound, "{} for {}, with {around} beside it", air.pressure[k], wanted[0][k]);
        }
    }
    assert!(steps > 1000, "it was at rest after {steps} substeps");
    let drift = air.mass() - begun;
    assert!((drift - rounded).abs() < 1e-9 * begun && drift != 0.0, "{drift} lost, {rounded} rounded");
}

#[test]
fn a_still_grid_stays_still_bit_for_bit() {
    let mut noise = Random::new(1);
    let mut air = closed(30, 20, 2.0);
    air.set_solids(&rock(60, 40, |x, _| x == 30 || noise.offset() > 0.95));
    for (k, p) in air.pressure.iter_mut().enumerate().filter(|(_, p)| **p > 0.0) {
        *p = if k % 32 <= 15 { 2.7 } else { 0.3 };
    }
    air.pressure.iter_mut().zip(&air.solid).filter(|(_, solid)| **solid).for_each(|(p, _)| *p = p.floor().min(1.0));
    let before = bits(&air);
    for _ in 0..50 {
        // Quiet air would not be stepped at all.
        air.quiet = false;
        let report = air.step(&[], SCHEME, ALONE, DT);
        assert!(report.substeps > 0 && report.speed_clamps == 0);
    }
    assert_eq!(bits(&air), before);
}

/// The same air seen in a mirror that turns left to right (`x`) or top to bottom.
fn mirrored(air: &Air, x: bool) -> Air {
    let mut mirror = air.clone();
    let gravity = air.scratch.gravity;
    mirror.set_gravity(if x { Vec2::new(-gravity.x, gravity.y) } else { Vec2::new(gravity.x, -gravity.y) });
    let (stride, n) = (air.stride(), air.pressure.len());
    for k in 0..n {
        let (i, j) = (k % stride, k / stride);
        let from = if x { j * stride + stride - 1 - i } else { (n / stride - 1 - j) * stride + i };
        mirror.pressure[k] = air.pressure[from];
        mirror.solid[k] = air.solid[from];
        if air.is_warm() {
            mirror.warmth[k] = air.warmth[from];
        }
        mirror.velocity_x[k] = if x { -air.velocity_x[from] } else { air.velocity_x[from] };
        mirror.velocity_y[k] = if x { air.velocity_y[from] } else { -air.velocity_y[from] };
    }
    mirror
}

#[test]
fn mirrored_air_runs_mirrored_bit_for_bit() {
    let mut noise = Random::new(9);
    for (x, advection) in [true, false].into_iter().flat_map(|x| AirAdvection::ALL.map(|advection| (x, advection))) {
        let mut air = closed(26, 17, 2.0);
        air.set_solids(&rock(52, 34, |_, _| noise.offset() > 0.9));
        stir(&mut air, 0.5, 500.0, &mut noise);
        warm(&mut air, &mut noise);
        let mut mirror = mirrored(&air, x);
        for _ in 0..20 {
            air.step(&[], AirScheme { advection, ..SCHEME }, ALONE, DT);
            mirror.step(&[], AirScheme { advection, ..SCHEME }, ALONE, DT);
        }
        let back = mirrored(&mirror, x);
        assert_eq!((&back.pressure, &back.warmth), (&air.pressure, &air.warmth));
        assert!(back.velocity_x == air.velocity_x && back.velocity_y == air.velocity_y);
    }
}

#[test]
fn turned_air_runs_turned() {
    let mut noise = Random::new(10);
    let mut air = closed(20, 20, 2.0);
    air.set_solids(&rock(40, 40, |_, _| noise.offset() > 0.95));
    stir(&mut air, 0.3, 300.0, &mut noise);
    let turned = |air: &Air| {
        let mut turn = air.clone();
        let stride = air.stride();
        for k in 0..air.pressure.len() {
            let (i, j) = (k % stride, k / stride);
            let from = (stride - 1 - i) * stride + j;
            turn.pressure[k] = air.pressure[from];
            turn.solid[k] = air.solid[from];
            // A quarter turn to the left brings (u, v) to (−v, u).
            turn.velocity_x[k] = -air.velocity_y[from];
            turn.velocity_y[k] = air.velocity_x[from];
        }
        turn
    };
    let mut turn = turned(&air);
    run(&mut air, 3);
    run(&mut turn, 3);
    let wanted = turned(&air);
    for k in 0..wanted.pressure.len() {
        // To rounding only: the nine shares are summed by rows, not by columns.
        assert!((turn.pressure[k] - wanted.pressure[k]).abs() < 1e-4);
        assert!((turn.velocity_x[k] - wanted.velocity_x[k]).abs() < 0.1);
        assert!((turn.velocity_y[k] - wanted.velocity_y[k]).abs() < 0.1);
    }
}

#[test]
fn parallel_is_serial_bit_for_bit_for_any_number_of_threads() {
    // As many cells as are worth waking threads for, and as few as are cut into bands.
    for (columns, rows) in [(203, 190), (64, 33), (17, 125)] {
        assert!((columns * rows) as usize >= WORTH_BANDS, "what is not shared proves nothing");
        let mut noise = Random::new(12);
        let sides = OpenSides { right: true, ..OpenSides::default() };
        let mut start = Air::new(Vec2::new(columns as f32, rows as f32), 1.0, params(sides));
        start.set_solids(&rock(columns, rows, |_, _| noise.offset() > 0.9));
        stir(&mut start, 0.5, 500.0, &mut noise);
        warm(&mut start, &mut noise);
        let step = |threads: usize| {
            let mut air = start.clone();
            for _ in 0..3 {
                air.step(&[], SCHEME, Team { threads, ..ALONE }, 4e-3);
            }
            bits(&air)
        };
        let serial = step(1);
        for threads in [2, 3, 5, 40] {
            let shared = in_pool(threads.min(5), || step(threads));
            assert!(shared == serial, "{columns} × {rows} cells, {threads} threads");
        }
    }
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    // Widths that fill lanes, overlap them, and are too narrow for them.
    for (columns, rows) in [(64, 20), (37, 33), (17, 5), (16, 4), (15, 40), (9, 9), (7, 3), (2, 50), (1, 1)] {
        let mut noise = Random::new(14);
        let sides = OpenSides { left: true, top: true, ..OpenSides::default() };
        let mut start = Air::new(Vec2::new(columns as f32, rows as f32), 1.0, params(sides));
        start.set_solids(&rock(columns, rows, |_, _| noise.offset() > 0.8));
        stir(&mut start, 0.5, 500.0, &mut noise);
        warm(&mut start, &mut noise);
        for advection in AirAdvection::ALL {
            let step = |instructions| {
                let mut air = start.clone();
                for _ in 0..5 {
                    air.step(&[], AirScheme { advection, ..SCHEME }, Team { instructions, threads: 1 }, 4e-3);
                }
                (instructions, bits(&air))
            };
            let runs: Vec<_> = InstructionSet::available().into_iter().map(step).collect();
            assert!(runs.len() >= 2, "one instruction set alone proves nothing");
            for (set, bits) in &runs {
                assert!(*bits == runs[0].1, "{advection:?}, {columns} × {rows}: {set:?} is not {:?}", runs[0].0);
            }
        }
    }
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits() {
    let mut noise = Random::new(13);
    let sides = OpenSides { left: true, ..OpenSides::default() };
    let mut air = Air::new(Vec2::new(60.0, 50.0), 2.0, params(sides));
    air.set_solids(&rock(60, 50, |_, _| noise.offset() > 0.9));
    stir(&mut air, 0.5, 500.0, &mut noise);
    warm(&mut air, &mut noise);
    run(&mut air, 3);
    let stored = postcard::to_stdvec(&air).unwrap();
    let mut restored: Air = postcard::from_bytes(&stored).unwrap();
    assert_eq!(restored, air);
    run(&mut air, 3);
    restored.set_gravity(GRAVITY);
    run(&mut restored, 3);
    assert_eq!(bits(&restored), bits(&air));
}

#[test]
fn a_damaged_snapshot_is_refused() {
    let stored = |damage: fn(&mut Air)| {
        let mut air = closed(4, 4, 1.0);
        damage(&mut air);
        air.check()
    };
    assert!(stored(|_| ()).is_ok());
    assert!(stored(|air| air.velocity_y.truncate(5)).is_err());
    assert!(stored(|air| air.columns = 0).is_err());
    assert!(stored(|air| air.outside.clear()).is_err());
    assert!(stored(|air| air.pressure[9] = -1.0).is_err());
    assert!(stored(|air| air.velocity_x[9] = f32::NAN).is_err());
    assert!(stored(|air| air.cell = 0.0).is_err());
    assert!(stored(|air| air.warmth = vec![0.5; 36]).is_err(), "warm air is still");
    assert!(stored(|air| (air.warmth, air.quiet) = (vec![0.5; 36], false)).is_ok());
    for warmth in [vec![0.5; 35], vec![f32::NAN; 36], vec![-1.0; 36], vec![13.0; 36]] {
        let mut air = closed(4, 4, 1.0);
        (air.warmth, air.quiet) = (warmth, false);
        assert!(air.check().is_err());
    }
    assert!(stored(|air| (air.pending.speed_clamps, air.pending.buried) = (9, 0.5)).is_ok());
    assert!(stored(|air| air.pending.speed_clamps = u64::MAX).is_err());
    assert!(stored(|air| air.solid[3] = false).is_err(), "the ring has a hole");
    assert!(stored(|air| air.pending.substeps = u32::MAX).is_err());
    assert!(stored(|air| air.pending.buried = f64::NAN).is_err());
}

/// Momentum of the air, d³/s at pressure 1.
fn momentum(air: &Air) -> [f64; 2] {
    [&air.velocity_x, &air.velocity_y].map(|velocity| {
        let cells = air.pressure.iter().zip(velocity).filter(|(p, _)| **p > 0.0);
        cells.map(|(p, u)| f64::from(*p) * f64::from(*u)).sum::<f64>() * air.cell_area()
    })
}

#[test]
fn what_carries_slopes_keeps_momentum_and_makes_no_energy() {
    // In the middle of a box so large that nothing reaches its walls.
    let mut air = closed(96, 96, 1.0);
    let mut noise = Random::new(77);
    for row in 40..56 {
        for column in 40..56 {
            let k = row * air.stride() + column;
            (air.velocity_x[k], air.velocity_y[k]) = (200.0 + 300.0 * noise.offset(), 300.0 * noise.offset());
            air.pressure[k] = 1.0 + 0.5 * noise.offset();
        }
    }
    air.quiet = false;
    let (begun, mut before) = (momentum(&air), energy(&air));
    for tick in 0..20 {
        air.step(&[], SCHEME, ALONE, 1e-3);
        let now = energy(&air);
        assert!(now <= before * (1.0 + 1e-6), "tick {tick}: energy from {before} to {now}");
        before = now;
    }
    for (now, begun) in momentum(&air).into_iter().zip(begun) {
        assert!((now - begun).abs() < 1e-5 * begun.abs(), "momentum from {begun} to {now}");
    }
}

#[test]
fn a_jet_that_drifts_stays_sharp_and_overshoots_nothing() {
    // So slow a sound that walls aren't heard in the middle.
    let (sound_speed, drift, jet) = (250.0, 200.0, 100.0);
    let smeared = AirAdvection::ALL.map(|advection| {
        let mut air = Air::new(Vec2::new(96.0, 128.0), 1.0, AirParams { sound_speed, ..params(OpenSides::default()) });
        for row in 0..air.rows() {
            for k in air.row_range(row) {
                air.velocity_y[k] = drift;
                air.velocity_x[k] = if (50..60).contains(&row) { jet } else { 0.0 };
            }
        }
        air.quiet = false;
        air.step(&[], AirScheme { advection, ..SCHEME }, ALONE, 0.1);
        let profile: Vec<f32> = (60..90).map(|row| air.velocity_x[air.row_range(row).start + 48]).collect();
        assert!(profile.iter().all(|u| (-1e-3..=jet + 1e-3).contains(u)), "{profile:?}");
        let most = profile.iter().copied().fold(0.0, f32::max);
        let between = profile.iter().filter(|u| (0.1 * jet..0.9 * jet).contains(*u)).count();
        (between, most / jet)
    });
    let [first, second] = smeared;
    assert!(second.0 <= 8 && first.0 >= 16, "cells between jet and rest: {} and {}", first.0, second.0);
    assert!(second.1 > 0.99 && first.1 < 0.9, "highest: {} and {}", first.1, second.1);
}
