//! A wall pushes and does not pull, wherever it lies in its cells.

use super::{DT, LATTICE, go_on, lattice, solids};
use crate::{particles::Particles, predictor::Predictor, solids::Solids};
use glam::Vec2;

/// Gravity of a spacing of 0.1 m, d/s².
const GRAVITY: f32 = 98.1;
/// Substeps of a fall: the first finds what pulls, then the liquid is free.
const SUBSTEPS: u32 = 4;
/// What share of a free fall that comes to.
const FREE: f32 = (SUBSTEPS - 1) as f32 / SUBSTEPS as f32;

/// Lets liquid fall for a substep that does not move it.
fn fall(predictor: &mut Predictor, particles: &mut Particles, solids: &Solids) {
    let places: Vec<Vec2> = (0..particles.len()).map(|i| particles.position(i)).collect();
    particles.vy.iter_mut().for_each(|vy| *vy -= GRAVITY * DT);
    go_on(predictor, particles, solids, (LATTICE, DT));
    for (i, place) in places.iter().enumerate() {
        (particles.x[i], particles.y[i]) = (place.x, place.y);
    }
}

/// Mean speed downwards after a fall of what stands at least 5 d inside of two columns (d), as a share of that of a free
/// fall.
fn share_of_free_fall(particles: &mut Particles, solids: &Solids, [from, to]: [f32; 2]) -> f32 {
    let mut predictor = Predictor::default();
    (0..SUBSTEPS).for_each(|_| fall(&mut predictor, particles, solids));
    let inside = (0..particles.len()).filter(|i| (from + 5.0..to - 5.0).contains(&particles.x[*i]));
    let (sum, count) = inside.fold((0.0, 0.0), |(sum, count), i| (sum - particles.vy[i], count + 1.0));
    sum / (count * SUBSTEPS as f32 * GRAVITY * DT)
}

/// Where a film under a ceiling stands, d along x: air is on both sides of it.
const FILM: [f32; 2] = [15.0, 45.0];

/// A film of 8 d under a ceiling that is so high.
fn film(solids: &Solids, ceiling: u32) -> Particles {
    let heights = ceiling as f32 - 8.0..ceiling as f32;
    let is_in = |at: Vec2| (FILM[0]..FILM[1]).contains(&at.x) && heights.contains(&at.y);
    lattice(solids, |at| is_in(at).then_some(Vec2::ZERO))
}

#[test]
fn a_film_falls_off_a_lid_and_off_rock_wherever_they_cut_the_cells() {
    for ceiling in 40..45 {
        let (lid, rock) = (solids(60, ceiling, |_| false), solids(60, 60, |at| at.y > ceiling as f32));
        for (name, walls) in [("lid", lid), ("rock", rock)] {
            let share = share_of_free_fall(&mut film(&walls, ceiling), &walls, FILM);
            assert!((FREE - 0.05..1.01).contains(&share), "{name} at {ceiling} d: {share} of a free fall");
        }
    }
}

#[test]
fn a_pool_is_held_by_its_floor_wherever_it_cuts_the_cells() {
    for floor in 6..11 {
        let walls = solids(60, 60, |at| at.y < floor as f32);
        let mut pool = lattice(&walls, |at| (at.y < 30.0).then_some(Vec2::ZERO));
        let share = share_of_free_fall(&mut pool, &walls, [0.0, 60.0]);
        assert!(share.abs() < 0.1, "rock up to {floor} d: {share} of a free fall");
    }
}

#[test]
fn what_no_air_comes_to_stays_in_a_glass_that_is_upside_down_in_a_pool() {
    // Up to 19 d above the pool, where the walls pull; they push again below its surface, before there is air.
    let glass = |at: Vec2| (24.0..36.0).contains(&at.x) && (10.0..40.0).contains(&at.y);
    let inside = |at: Vec2| (25.0..35.0).contains(&at.x) && at.y < 39.0;
    let walls = solids(60, 60, |at| glass(at) && !inside(at));
    let mut water = lattice(&walls, |at| (inside(at) || at.y < 20.0).then_some(Vec2::ZERO));
    let share = share_of_free_fall(&mut water, &walls, [20.0, 40.0]);
    assert!(share.abs() < 0.1, "{share} of a free fall");
}

#[test]
fn what_has_let_go_is_free_after_a_restart_too() {
    let walls = solids(60, 41, |_| false);
    let (mut predictor, mut straight_on) = (Predictor::default(), film(&walls, 41));
    (0..SUBSTEPS).for_each(|_| fall(&mut predictor, &mut straight_on, &walls));
    let mut again = straight_on.clone();
    let mut resumed = Predictor::resume(predictor.kept());
    fall(&mut predictor, &mut straight_on, &walls);
    fall(&mut resumed, &mut again, &walls);
    assert_eq!([&again.vx, &again.vy], [&straight_on.vx, &straight_on.vy]);
}
