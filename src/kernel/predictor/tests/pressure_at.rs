//! The pressure between the cells: in still water that is the weight of what lies above, up to the surface and down to the floor.

use super::{DT, LATTICE, go_on, lattice, solids};
use crate::predictor::Predictor;
use glam::Vec2;

/// Gravity of a spacing of 0.1 m, d/s².
const GRAVITY: f32 = 98.1;

#[test]
fn in_a_pool_it_is_the_weight_above_at_every_place() {
    // Whatever the part of a cell that the surface stands over a row's edge, and the floor under it.
    for (floor, depth) in [(0.0, 30.0), (0.0, 31.0), (0.0, 32.0), (3.0, 33.0), (4.0, 60.0), (0.0, 2.0), (0.0, 4.0)] {
        let walls = solids(40, 100, |at| at.y < floor);
        let particles = |at: Vec2| (at.y < floor + depth).then_some(Vec2::new(0.0, -GRAVITY * DT));
        let (mut particles, mut predictor) = (lattice(&walls, particles), Predictor::default());
        go_on(&mut predictor, &mut particles, &walls, (LATTICE, DT));
        for step in 0..(4.0 * depth) as u32 {
            for x in [0.3, 1.6, 19.9, 20.7, 39.6] {
                let y = floor + 0.25 * step as f32 + 0.1;
                let found = predictor.pressure_at(Vec2::new(x, y), DT).expect("it is in the liquid") / GRAVITY;
                let expected = floor + depth - y;
                let most = 0.5 + 0.04 * expected;
                assert!((found - expected).abs() < most, "{depth} on {floor}, {x}, {y}: {found} d and not {expected}");
            }
        }
        assert_eq!(predictor.pressure_at(Vec2::new(20.0, floor + depth + 8.0), DT), None, "there is none in the air");
    }
}

#[test]
fn there_is_none_before_the_first_solve_and_in_spray() {
    let (walls, at) = (solids(20, 20, |_| false), Vec2::splat(10.5));
    let mut predictor = Predictor::default();
    assert_eq!(predictor.pressure_at(at, DT), None);
    let mut drop = lattice(&walls, |site| (site == at).then_some(Vec2::ZERO));
    assert_eq!(drop.len(), 1);
    go_on(&mut predictor, &mut drop, &walls, (LATTICE, DT));
    assert_eq!(predictor.pressure_at(at, DT), None, "a drop falls freely");
}

#[test]
fn places_outside_of_the_box_are_those_at_its_edge() {
    let walls = solids(20, 30, |_| false);
    let fall = Vec2::new(0.0, -GRAVITY * DT);
    let (mut particles, mut predictor) = (lattice(&walls, |at| (at.y < 12.0).then_some(fall)), Predictor::default());
    go_on(&mut predictor, &mut particles, &walls, (LATTICE, DT));
    for at in [Vec2::ZERO, Vec2::new(20.0, 0.0), Vec2::new(-5.0, 3.0), Vec2::new(1e9, -1e9)] {
        assert!(predictor.pressure_at(at, DT).is_some_and(f32::is_finite), "{at}");
    }
}
