//! Grains: what friction holds, and what it does not.

use super::{CELL, DT, LATTICE, lattice, noise, room, size, solids, team};
use crate::{
    element::ElementId,
    params::Domain,
    particles::Particles,
    predictor::{GrainParams, Predictor, PredictorParams},
    random::mix,
    solids::Solids,
};
use glam::{DVec2, Vec2};

/// Angle of friction, degrees.
const ANGLE: f32 = 30.0;

/// Sand is element 1, water element 2.
fn sines(angle: f32) -> [f32; 3] {
    [0.0, angle.to_radians().sin_cos().0, 0.0]
}

/// Gravity, d/s².
const GRAVITY: f32 = 98.1;

/// One substep of gravity (d/s²) and prediction, after which all stay where they are.
fn go_on(predictor: &mut Predictor, particles: &mut Particles, walls: &Solids, gravity: Vec2, angle: f32) {
    go_on_bound(predictor, particles, walls, (gravity, angle), [0.0; 3]);
}

/// The same with the cohesion of the elements.
fn go_on_bound(
    predictor: &mut Predictor,
    particles: &mut Particles,
    walls: &Solids,
    (gravity, angle): (Vec2, f32),
    cohesion: [f32; 3],
) {
    particles.vx.iter_mut().for_each(|vx| *vx += gravity.x * DT);
    particles.vy.iter_mut().for_each(|vy| *vy += gravity.y * DT);
    let (domain, sines) = (Domain { size: size(walls), gravity }, sines(angle));
    let is_sand = particles.element.contains(&ElementId(1));
    let params = PredictorParams {
        drawn: None,
        domain: &domain,
        cell: CELL,
        rest_density: LATTICE,
        masses: None,
        grains: is_sand.then_some(GrainParams { sines: &sines, cohesion: &cohesion }),
        instructions: team().instructions,
        threads: 1,
        dt: DT,
    };
    let at = (particles.x.clone(), particles.y.clone());
    predictor.run(particles, walls, &params, room().each_mut());
    (particles.x, particles.y) = at;
}

/// Gravity seen from a floor that is tilted by so many degrees.
fn tilted(degrees: f32) -> Vec2 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    GRAVITY * Vec2::new(sine, -cosine)
}

/// A slab 160 d long and 20 d deep on the floor of a wide box.
fn slab() -> (Solids, Particles) {
    let walls = solids(240, 30, |_| false);
    let slab = lattice(&walls, |at| ((20.0..180.0).contains(&at.x) && at.y < 20.0).then_some(Vec2::ZERO));
    (walls, slab)
}

/// Mean velocity along the floor of the middle 40 d, d/s.
fn speed_of_the_middle(slab: &Particles) -> f32 {
    let own: Vec<f32> = (0..slab.len()).filter(|i| (slab.x[*i] - 100.0).abs() < 20.0).map(|i| slab.vx[i]).collect();
    own.iter().sum::<f32>() / own.len() as f32
}

#[test]
fn a_slab_rests_below_its_angle_and_slides_above_it() {
    for below in [0.0, 10.0, 20.0, ANGLE - 5.0] {
        let ((walls, mut slab), mut predictor) = (slab(), Predictor::default());
        (0..60).for_each(|_| go_on(&mut predictor, &mut slab, &walls, tilted(below), ANGLE));
        let speed = speed_of_the_middle(&slab).abs();
        // A hundredth of a fall.
        assert!(speed < 0.01 * GRAVITY, "{speed} d/s after a second at {below}°");
    }
    for above in [ANGLE + 5.0, 45.0] {
        let ((walls, mut slab), mut predictor) = (slab(), Predictor::default());
        (0..30).for_each(|_| go_on(&mut predictor, &mut slab, &walls, tilted(above), ANGLE));
        let before = speed_of_the_middle(&slab);
        (0..30).for_each(|_| go_on(&mut predictor, &mut slab, &walls, tilted(above), ANGLE));
        let gained = (speed_of_the_middle(&slab) - before) / (30.0 * DT);
        // Sheared without a change of volume, sand bears sin φ of what presses on it (Davis 1968).
        let (sine, cosine) = above.to_radians().sin_cos();
        let expected = GRAVITY * (sine - sines(ANGLE)[1] * cosine);
        assert!((gained / expected - 1.0).abs() < 0.1, "{gained} d/s² at {above}°, {expected} expected");
    }
}

#[test]
fn without_friction_the_same_slab_flows() {
    let ((walls, mut slab), mut predictor) = (slab(), Predictor::default());
    slab.element.fill(ElementId(2));
    (0..30).for_each(|_| go_on(&mut predictor, &mut slab, &walls, tilted(20.0), ANGLE));
    assert!(speed_of_the_middle(&slab) > 0.5 * tilted(20.0).x * 30.0 * DT);
}

#[test]
fn friction_among_grains_keeps_their_momentum_and_takes_energy() {
    let walls = solids(80, 80, |_| false);
    let mut random = noise(7);
    // Far from all walls, pressed together from both sides and stirred.
    let mut lump =
        lattice(&walls, |at| ((20.0..60.0).contains(&at.x) && (20.0..60.0).contains(&at.y)).then_some(Vec2::ZERO));
    for i in 0..lump.len() {
        let from = lump.position(i) - Vec2::splat(40.0);
        let turn = Vec2::new(-from.y, 0.3 * from.x) + 4.0 * Vec2::new(random(), random());
        (lump.vx[i], lump.vy[i]) = (turn.x - 0.6 * from.x, turn.y - 0.6 * from.y);
    }
    let momentum = |lump: &Particles| -> DVec2 { (0..lump.len()).map(|i| lump.velocity(i).as_dvec2()).sum() };
    let energy =
        |lump: &Particles| -> f64 { (0..lump.len()).map(|i| lump.velocity(i).as_dvec2().length_squared()).sum() };
    let moved: f64 = (0..lump.len()).map(|i| f64::from(lump.velocity(i).length())).sum();
    let (mut grains, mut water) = (lump.clone(), lump.clone());
    water.element.fill(ElementId(2));
    let (mut own, mut other) = (Predictor::default(), Predictor::default());
    for _ in 0..10 {
        let before = energy(&grains);
        go_on(&mut own, &mut grains, &walls, Vec2::ZERO, ANGLE);
        go_on(&mut other, &mut water, &walls, Vec2::ZERO, ANGLE);
        assert!(energy(&grains) <= before, "friction made {before} to {}", energy(&grains));
    }
    let lost = (momentum(&grains) - momentum(&lump)).length() / moved;
    // What a liquid loses at its surface, where faces have matter on one side.
    assert!(lost < 0.01, "{lost} of what moved");
    assert!(energy(&grains) < 0.8 * energy(&water), "friction took nothing");
}

#[test]
fn friction_makes_no_motion_however_rock_cuts_up_the_grid() {
    for seed in 0..20 {
        // Every fourth place is rock.
        let walls = solids(20, 20, |at| mix(400 * seed + 20 * at.y as u32 + at.x as u32).is_multiple_of(4));
        let mut sand = lattice(&walls, |at| (at.y < 14.0).then_some(Vec2::ZERO));
        let mut predictor = Predictor::default();
        let mut fastest = 0.0_f32;
        for _ in 0..30 {
            go_on(&mut predictor, &mut sand, &walls, tilted(0.0), 45.0);
            fastest = (0..sand.len()).map(|i| sand.velocity(i).length()).fold(fastest, f32::max);
        }
        // Falling freely all the time it would be 49 d/s.
        assert!(fastest < 10.0, "seed {seed}: {fastest} d/s");
    }
}

#[test]
fn what_nothing_presses_together_does_not_rub() {
    // Weightless and sheared, with nothing around it.
    let walls = solids(80, 80, |_| false);
    let is_lump = |at: Vec2| (at - Vec2::splat(40.0)).length() < 15.0;
    let mut sand = lattice(&walls, |at| is_lump(at).then(|| Vec2::new(0.0, 2.0 * (at.x - 40.0))));
    let mut water = sand.clone();
    water.element.fill(ElementId(2));
    let gained = |lump: &mut Particles| {
        let before = lump.clone();
        go_on(&mut Predictor::default(), lump, &walls, Vec2::ZERO, ANGLE);
        let changed = (0..lump.len()).map(|i| lump.velocity(i).distance(before.velocity(i)));
        changed.sum::<f32>() / lump.len() as f32
    };
    let (sand, water) = (gained(&mut sand), gained(&mut water));
    assert!(sand < water + 1.0, "sand changes by {sand} d/s, water by {water}");
}

#[test]
fn grains_go_on_to_the_bit_from_what_was_kept() {
    let ((walls, mut straight_on), mut predictor) = (slab(), Predictor::default());
    (0..10).for_each(|_| go_on(&mut predictor, &mut straight_on, &walls, tilted(35.0), ANGLE));
    let (mut again, mut forgetful) = (straight_on.clone(), straight_on.clone());
    let mut resumed = Predictor::resume(predictor.kept());
    assert_eq!(resumed.kept(), predictor.kept());
    go_on(&mut predictor, &mut straight_on, &walls, tilted(35.0), ANGLE);
    go_on(&mut resumed, &mut again, &walls, tilted(35.0), ANGLE);
    assert_eq!([&again.vx, &again.vy], [&straight_on.vx, &straight_on.vy]);
    go_on(&mut Predictor::default(), &mut forgetful, &walls, tilted(35.0), ANGLE);
    assert_ne!(forgetful.vx, straight_on.vx, "nothing was to be kept");
}

#[test]
fn what_sleeps_wakes_with_its_stress() {
    // Two slabs; one of them is not there for a while.
    let walls = solids(240, 30, |_| false);
    let place = |at: Vec2| ((10.0..110.0).contains(&at.x) || (130.0..230.0).contains(&at.x)) && at.y < 20.0;
    let mut slabs = lattice(&walls, |at| place(at).then_some(Vec2::ZERO));
    let mut predictor = Predictor::default();
    (0..60).for_each(|_| go_on(&mut predictor, &mut slabs, &walls, tilted(15.0), ANGLE));
    let all = slabs.clone();
    slabs.retain(|slabs, i| slabs.x[i] < 120.0);
    (0..30).for_each(|_| go_on(&mut predictor, &mut slabs, &walls, tilted(15.0), ANGLE));
    let fastest = |predictor: &mut Predictor| {
        let mut slabs = all.clone();
        go_on(predictor, &mut slabs, &walls, tilted(15.0), ANGLE);
        let inside = (0..slabs.len()).filter(|i| (170.0..190.0).contains(&slabs.x[*i]) && slabs.y[*i] < 15.0);
        inside.map(|i| slabs.velocity(i).length()).fold(0.0, f32::max)
    };
    let mut without_stress = predictor.kept();
    without_stress.grains.clear();
    let anew = fastest(&mut Predictor::resume(without_stress));
    let woken = fastest(&mut predictor);
    // The pressure has to be found anew; what friction bears is not.
    assert!(woken < 0.5 * anew, "{woken} d/s, {anew} d/s without it");
}

/// Heap of sand with slopes of 26.6° under water as heavy, or in air: its mean speed after a second.
fn speed_of_a_heap(angle: f32, is_wet: bool) -> f32 {
    let walls = solids(120, 60, |_| false);
    let height = |x: f32| 0.5 * (50.0 - (x - 60.0).abs());
    let mut heap = lattice(&walls, |at| (at.y < height(at.x) || is_wet && at.y < 50.0).then_some(Vec2::ZERO));
    for i in 0..heap.len() {
        heap.element[i] = ElementId(if heap.y[i] < height(heap.x[i]) { 1 } else { 2 });
    }
    let mut predictor = Predictor::default();
    (0..60).for_each(|_| go_on(&mut predictor, &mut heap, &walls, Vec2::new(0.0, -GRAVITY), angle));
    let speeds: Vec<f32> = (0..heap.len())
        .filter(|i| heap.element[*i] == ElementId(1) && heap.y[*i] < height(heap.x[*i]) - 4.0)
        .map(|i| heap.velocity(i).length())
        .collect();
    speeds.iter().sum::<f32>() / speeds.len() as f32
}

#[test]
fn a_heap_less_steep_than_its_angle_stands_in_air_and_a_steeper_one_does_not() {
    let [gentle, steep] = [34.0, 15.0].map(|angle| speed_of_a_heap(angle, false));
    assert!(gentle < 0.05 && steep > 1.0, "{gentle} d/s at 34°, {steep} d/s at 15°");
}

#[test]
fn friction_works_where_grains_touch_and_not_for_such_that_drift_alone() {
    let walls = solids(640, 100, |_| false);
    let mut pool = lattice(&walls, |at| (at.y < 80.0).then_some(Vec2::ZERO));
    let cells_worked_on = |pool: &mut Particles, is_sand: fn(Vec2) -> bool| {
        for i in 0..pool.len() {
            pool.element[i] = ElementId(if is_sand(pool.position(i)) { 1 } else { 2 });
        }
        let mut predictor = Predictor::default();
        (0..3).for_each(|_| go_on(&mut predictor, pool, &walls, Vec2::new(0.0, -GRAVITY), ANGLE));
        predictor.cells_of_friction()
    };
    // One grain in each 10 × 10 d: a sixth of a cell.
    let alone = |at: Vec2| at.x.rem_euclid(10.0) < 1.0 && at.y.rem_euclid(10.0) < 1.0;
    assert_eq!(cells_worked_on(&mut pool, alone), 0);
    let heap = cells_worked_on(&mut pool, |at| at.y < 10.0 && (at.x - 320.0).abs() < 15.0);
    // A heap of 30 × 10 d is some 14 × 5 cells with their corners; four around it, in pieces of 16 columns.
    assert!((70..=(14 + 8 + 2 * 15) * (5 + 5)).contains(&heap), "{heap} cells");
    assert!(cells_worked_on(&mut pool, |at| at.y < 80.0) > 256 * 32);
}

#[test]
fn working_near_grains_alone_comes_to_what_working_on_all_of_the_liquid_does() {
    // A heap too steep for its angle, under water that streams over it.
    let walls = solids(320, 60, |_| false);
    let height = |x: f32| 0.8 * (30.0 - (x - 160.0).abs());
    let stream = |at: Vec2| (at.y < 45.0).then(|| Vec2::new(if at.y < height(at.x) { 0.0 } else { 20.0 }, 0.0));
    let mut pool = lattice(&walls, stream);
    for i in 0..pool.len() {
        pool.element[i] = ElementId(if pool.y[i] < height(pool.x[i]) { 1 } else { 2 });
    }
    let gravity = Vec2::new(0.0, -GRAVITY);
    let mut predictor = Predictor::default();
    for tick in 0..20 {
        go_on(&mut predictor, &mut pool, &walls, gravity, 15.0);
        // A trace of stress that was laid by in every cell is taken up wherever there is liquid, and is lost in what rounding takes.
        let mut kept = predictor.kept();
        let [stress, _, laid_by, ..] = &mut kept.grains[..] else { panic!("no grains") };
        for (laid_by, _) in laid_by.iter_mut().zip(stress).filter(|(_, stress)| **stress == 0.0) {
            *laid_by = 1e-30;
        }
        let ([mut near, mut all], mut everywhere) = ([pool.clone(), pool.clone()], Predictor::resume(kept));
        let mut alone = predictor.clone();
        go_on(&mut alone, &mut near, &walls, gravity, 15.0);
        go_on(&mut everywhere, &mut all, &walls, gravity, 15.0);
        assert_eq!([&near.vx, &near.vy], [&all.vx, &all.vy], "tick {tick}");
        // What is strained in cells, and in corners, counts where grains may be in the next substep: up to a cell away.
        let [alone_kept, all_kept] = [&alone, &everywhere].map(|predictor| predictor.kept().grains);
        let stride = ((size(&walls).x / CELL + 0.5) as usize).max(1) + 2;
        let [stress, ..] = &alone_kept[..] else { panic!("no grains") };
        for k in (0..stress.len()).filter(|k| stress[*k] != 0.0) {
            for near in [k - stride, k, k + stride].iter().flat_map(|k| k - 1..=k + 1) {
                for strain in [4, 5] {
                    assert_eq!(alone_kept[strain][near], all_kept[strain][near], "tick {tick}, cell {near} by {k}");
                }
            }
        }
        assert!(everywhere.cells_of_friction() > 2 * alone.cells_of_friction());
    }
}

#[test]
fn the_water_between_grains_bears_its_share() {
    // What weighs as much as the water is borne by it: nothing presses its grains together, and they are sheared as it is.
    let walls = solids(160, 60, |_| false);
    let is_sand = |at: Vec2| at.y < 20.0;
    let mut pool = lattice(&walls, |at| (at.y < 50.0).then(|| Vec2::new(if at.y < 10.0 { 0.0 } else { 5.0 }, 0.0)));
    for i in 0..pool.len() {
        pool.element[i] = ElementId(if is_sand(pool.position(i)) { 1 } else { 2 });
    }
    let mut dry = pool.clone();
    dry.retain(|dry, i| is_sand(dry.position(i)));
    let shear = |mut pool: Particles| {
        let before = pool.clone();
        let mut predictor = Predictor::default();
        // Water has come everywhere after some ticks.
        for _ in 0..60 {
            go_on(&mut predictor, &mut pool, &walls, Vec2::new(0.0, -GRAVITY), ANGLE);
            (pool.vx, pool.vy) = (before.vx.clone(), before.vy.clone());
        }
        (0..5).for_each(|_| go_on(&mut predictor, &mut pool, &walls, Vec2::new(0.0, -GRAVITY), ANGLE));
        let mean = |from: f32, to: f32| {
            let own: Vec<f32> = (0..pool.len())
                .filter(|i| (from..to).contains(&pool.y[*i]) && (pool.x[*i] - 80.0).abs() < 20.0)
                .map(|i| pool.vx[i])
                .collect();
            own.iter().sum::<f32>() / own.len() as f32
        };
        mean(11.0, 15.0) - mean(5.0, 9.0)
    };
    let (wet, dry) = (shear(pool), shear(dry));
    assert!(wet > 1.5 * dry, "sheared with {wet} d/s under water, with {dry} d/s in air");
}

#[test]
fn cohesion_holds_a_cliff_up_to_the_height_that_theory_has() {
    // A cliff stands up to 3.83 c/(ρ g) tan(45° + φ/2) (Chen 1975, "Limit analysis and soil plasticity").
    let (angle, high) = (35.0_f32, 24.0_f32);
    let (sine, cosine) = (45.0 + 0.5 * angle).to_radians().sin_cos();
    let critical = |cohesion: f32| 3.83 * cohesion / GRAVITY * sine / cosine;
    let sunk = |share: f32| {
        let walls = solids(160, 40, |_| false);
        let mut cliff = lattice(&walls, |at| (at.x < 70.0 && at.y < high).then_some(Vec2::ZERO));
        // By its density, and as Mohr's circle has it.
        let cohesion = share * high / critical(1.0) * angle.to_radians().sin_cos().1;
        let mut predictor = Predictor::default();
        let bound = [0.0, cohesion, 0.0];
        for _ in 0..30 {
            go_on_bound(&mut predictor, &mut cliff, &walls, (tilted(0.0), angle), bound);
        }
        let top = (0..cliff.len()).filter(|i| cliff.y[*i] > high - 4.0 && cliff.x[*i] > 55.0);
        let (sum, count) = top.fold((0.0, 0), |(sum, count), i| (sum - cliff.vy[i], count + 1));
        sum / count as f32
    };
    // In half a second what falls freely reaches 49 d/s.
    let (strong, weak, none) = (sunk(1.5), sunk(0.5), sunk(0.0));
    assert!(strong < 0.1, "a cliff of two thirds of the height sinks at {strong} d/s");
    assert!(weak > 5.0, "a cliff of twice the height sinks at {weak} d/s only");
    assert!(none > weak, "{none} without cohesion, {weak} with some");
}
