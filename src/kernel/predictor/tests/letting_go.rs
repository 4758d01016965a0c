//! A wall pushes and does not pull, wherever it lies in its cells.

use super::{CELL, DT, LATTICE, lattice, size, solids};
use crate::{
    params::Domain,
    particles::Particles,
    predictor::{Predictor, PredictorParams},
    simd::InstructionSet,
    solids::Solids,
};
use glam::Vec2;

/// Gravity of a spacing of 0.1 m, d/s².
const GRAVITY: f32 = 98.1;
/// Substeps: the first finds what pulls, then the liquid is free.
const SUBSTEPS: u32 = 4;

/// Lets liquid fall for some substeps, none of which moves it: a predictor that goes on sees what a world's does.
fn falls(particles: &mut Particles, solids: &Solids) {
    let domain = Domain { size: size(solids), gravity: Vec2::ZERO };
    let params = PredictorParams {
        domain: &domain,
        cell: CELL,
        rest_density: LATTICE,
        instructions: InstructionSet::detect(),
        threads: 1,
        dt: DT,
    };
    let mut predictor = Predictor::default();
    let places: Vec<Vec2> = (0..particles.len()).map(|i| particles.position(i)).collect();
    for _ in 0..SUBSTEPS {
        particles.vy.iter_mut().for_each(|vy| *vy -= GRAVITY * DT);
        predictor.run(particles, solids, &params);
        for (i, place) in places.iter().enumerate() {
            (particles.x[i], particles.y[i]) = (place.x, place.y);
        }
    }
}

/// Mean speed downwards of what stands between two columns (d), as a share of that of a free fall.
fn share_of_free_fall(particles: &Particles, [from, to]: [f32; 2]) -> f32 {
    let speeds: Vec<f32> =
        (0..particles.len()).filter(|i| (from..to).contains(&particles.x[*i])).map(|i| -particles.vy[i]).collect();
    speeds.iter().sum::<f32>() / (speeds.len() as f32 * SUBSTEPS as f32 * GRAVITY * DT)
}

/// A film of 8 d under the lid of a box of 60 d that is so high, the outer 15 d on either side left free.
fn under_a_lid(height: u32, rock: impl Fn(Vec2) -> bool) -> (Particles, Solids) {
    let walls = solids(60, height, rock);
    let film = |at: Vec2| (15.0..45.0).contains(&at.x) && at.y > height as f32 - 8.0;
    (lattice(&walls, |at| film(at).then_some(Vec2::ZERO)), walls)
}

#[test]
fn a_film_falls_off_a_lid_wherever_it_cuts_the_cells() {
    for height in 40..45 {
        let (mut film, walls) = under_a_lid(height, |_| false);
        falls(&mut film, &walls);
        let share = share_of_free_fall(&film, [20.0, 40.0]);
        // Bound for the first substep at least, and free from then on.
        let free = (SUBSTEPS - 1) as f32 / SUBSTEPS as f32;
        assert!((free - 0.05..1.01).contains(&share), "a lid at {height} d: {share} of a free fall");
    }
}

#[test]
fn a_film_falls_off_rock_wherever_it_cuts_the_cells() {
    for bottom in 40..45 {
        let (walls, bottom) = (solids(60, 60, |at| at.y > bottom as f32), bottom as f32);
        let film = |at: Vec2| (15.0..45.0).contains(&at.x) && at.y > bottom - 8.0;
        let mut film = lattice(&walls, |at| film(at).then_some(Vec2::ZERO));
        falls(&mut film, &walls);
        let share = share_of_free_fall(&film, [20.0, 40.0]);
        let free = (SUBSTEPS - 1) as f32 / SUBSTEPS as f32;
        assert!((free - 0.05..1.01).contains(&share), "rock from {bottom} d on: {share} of a free fall");
    }
}

#[test]
fn a_pool_is_held_by_its_floor_wherever_it_cuts_the_cells() {
    for top in 6..11 {
        let walls = solids(60, 60, |at| at.y < top as f32);
        let mut pool = lattice(&walls, |at| (at.y < 30.0).then_some(Vec2::ZERO));
        falls(&mut pool, &walls);
        let share = share_of_free_fall(&pool, [0.0, 60.0]);
        assert!(share.abs() < 0.1, "rock up to {top} d: {share} of a free fall");
    }
}

#[test]
fn what_no_air_comes_to_stays() {
    // Full up to the lid, and taken down by all of its walls: no air is there to come between.
    let walls = solids(60, 40, |_| false);
    let mut full = lattice(&walls, |_| Some(Vec2::ZERO));
    falls(&mut full, &walls);
    let share = share_of_free_fall(&full, [0.0, 60.0]);
    assert!(share.abs() < 0.02, "a full box: {share} of a free fall");
}
