//! What the moves of a substep imply for velocities.

use super::square;
use crate::{
    params::Preset,
    pbf::tests::Bench,
    predictor::{Predictor, PredictorParams},
    solids::Solids,
    units::TICK_SECONDS,
    velocity::follow::PRESSED,
};
use glam::Vec2;

#[test]
fn velocities_follow_from_the_moves_and_cut_corrections_are_counted() {
    let mut bench = square(0.0, |_| Vec2::ZERO);
    bench.predicted = true;
    bench.quality.correction_limit = 0.1;
    bench.solve(false);
    bench.solver.density.fill(1.0);
    bench.solver.x.clone_from(&bench.particles.x);
    bench.solver.y.clone_from(&bench.particles.y);
    let [usual, longest] = [bench.quality.correction_limit, bench.quality.longest_correction()];
    assert!(longest > usual);
    for i in 0..400 {
        bench.solver.x[i] += match i {
            0..7 => usual,
            // In a crowd there is further to go.
            7..12 => {
                bench.solver.density[i] = 2.5;
                if i < 9 { longest } else { usual }
            }
            _ => 0.01,
        };
    }
    let before = bench.particles.clone();
    let report = bench.update(None, 0.01);
    assert_eq!(report.position_clamps, 9, "corrections at their limit");
    let shares = |i| bench.solver.correction_share(i, bench.particles.position(i)).unwrap();
    assert!((shares(3) - 1.0).abs() < 1e-3 && (shares(8) - 1.0).abs() < 1e-3 && shares(10) < 0.6 && shares(20) < 0.2);
    assert_eq!(bench.solver.correction_share(20, Vec2::splat(5.0)), None, "another particle");
    for i in 0..400 {
        let moved = bench.particles.x[i] - before.x[i];
        assert!((bench.particles.vx[i] - moved / 0.01).abs() < 1e-3 && bench.particles.vy[i] == 0.0);
        assert!(moved > 0.009, "particle {i} did not go where it was sent");
    }
}

/// A substep, s.
const SUBSTEP: f32 = 2.0 / 3.0 * TICK_SECONDS;

/// Change of velocity of a particle inside a square that flows at (2, 0) d/s while it sinks through it at 3 d/s, and of
/// one that flows with it, where all have `density` and the pressure predictor ran before corrections of `way` d upwards.
fn after_a_correction(density: f32, way: f32) -> [Vec2; 2] {
    let mut bench = square(0.0, |_| Vec2::new(2.0, 0.0));
    bench.particles.vy[210] = -3.0;
    after_corrections(bench, [210, 205], density, way, true)
}

/// Change of velocity of two particles whose world is liquid or not: see [`after_a_correction`].
fn after_corrections(mut bench: Bench, ids: [usize; 2], density: f32, way: f32, is_liquid: bool) -> [Vec2; 2] {
    let mut predictor = Predictor::default();
    let params = PredictorParams {
        domain: &bench.domain,
        cell: bench.quality.kernel_radius,
        rest_density: 1.0,
        masses: None,
        grains: None,
        drawn: None,
        instructions: bench.solver.instructions,
        threads: 1,
        dt: SUBSTEP,
    };
    assert_eq!(predictor.run(&mut bench.particles, &bench.solids, &params, bench.solver.room()).liquid, is_liquid);
    bench.predicted = true;
    bench.particles.push_x.fill(0.0);
    bench.particles.push_y.fill(0.0);
    bench.solve(false);
    bench.solver.density.fill(density);
    bench.solver.x.clone_from(&bench.particles.x);
    bench.solver.y.clone_from(&bench.particles.y);
    bench.solver.y.iter_mut().for_each(|y| *y += way);
    let before = bench.particles.clone();
    let flow = Some(predictor.flow());
    bench.update(flow, SUBSTEP);
    ids.map(|id| {
        let i = before.id.iter().position(|own| *own == id as u32).unwrap();
        assert!((bench.particles.y[i] - before.y[i] - way).abs() < 1e-4, "the correction itself was lost");
        bench.particles.velocity(i) - before.velocity(i)
    })
}

#[test]
fn after_the_predictor_a_correction_ends_motion_beside_the_flow_and_makes_none() {
    let [from, to] = PRESSED.map(|share| 1.0 + share / Preset::Balanced.quality().substeps as f32);
    // What is not pressed together finds its place, and no more.
    assert_eq!(after_a_correction(from - 1e-4, 0.2), [Vec2::ZERO; 2]);
    // A tenth of a spacing in 0.011 s is 9 d/s, of which no more than the way back to the flow is taken.
    for way in [0.1, 0.4] {
        let [sinking, flowing] = after_a_correction(1.2, way);
        assert!((2.5..=3.0).contains(&sinking.y) && sinking.x == 0.0, "{sinking} of 3 d/s after {way} d");
        assert!(flowing.length() < 0.1, "{flowing} beyond the flow after {way} d");
    }
    // A short one takes its own speed, or the share of it by which the liquid is pressed.
    let way = 0.01;
    let [sinking, _] = after_a_correction(1.2, way);
    assert!((sinking.y - way / SUBSTEP).abs() < 1e-3, "{sinking}");
    let [sinking, _] = after_a_correction((from + to) / 2.0, way);
    assert!((sinking.y - 0.5 * way / SUBSTEP).abs() < 1e-3, "{sinking}");
    // And none that goes along with the motion adds to it.
    assert_eq!(after_a_correction(1.2, -0.1)[0], Vec2::ZERO);
}

#[test]
fn a_correction_holds_up_a_drop_at_a_wall_and_leaves_spray_alone() {
    let drops = || {
        let mut bench = Bench::new(60, 60, Preset::Balanced);
        for at in [Vec2::new(0.6, 0.4), Vec2::new(30.0, 30.0)] {
            bench.add(at, Vec2::new(0.0, -3.0));
        }
        bench
    };
    // However thin it is; 0.4 d are more than it takes.
    let [held, spray] = after_corrections(drops(), [0, 1], 0.1, 0.4, false);
    assert_eq!((held, spray), (Vec2::new(0.0, 3.0), Vec2::ZERO));
    // Not more than the correction's own speed, and nothing of one along with the motion.
    let [held, _] = after_corrections(drops(), [0, 1], 0.1, 0.01, false);
    assert!((held.y - 0.01 / SUBSTEP).abs() < 1e-3, "{held}");
    assert_eq!(after_corrections(drops(), [0, 1], 0.1, -0.1, false)[0], Vec2::ZERO);
}

#[test]
fn a_correction_into_rock_stops_at_its_face() {
    let mut bench = square(0.0, |_| Vec2::ZERO);
    bench.rock((40, 10), (41, 50));
    bench.bin();
    for i in 0..400 {
        bench.solver.x[i] += 0.6;
    }
    bench.update(None, 0.01);
    for i in 0..400 {
        let at = bench.particles.position(i);
        assert!(!bench.solids.is_solid(Solids::cell_of(at)), "particle {i} was moved into rock, to {at}");
    }
}
