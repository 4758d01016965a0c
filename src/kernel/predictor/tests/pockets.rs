//! Sealed pockets: their right-hand side adds up to nothing, and nobody else's is touched.

use super::{
    LATTICE, lattice, noise, predict,
    rig::{Equation, cells},
    solids,
};
use crate::{predictor::pockets::Pockets, solids::Solids};
use glam::Vec2;

/// Connected liquid as a flood from each cell finds it: the cells of each part and whether it touches air.
fn parts(equation: &mut Equation) -> Vec<(Vec<usize>, bool)> {
    let (grid, stride) = (equation.grid, equation.grid.stride);
    let [diagonal, _, right, upper] = equation.hierarchy.finest().operator.fields();
    let mut seen = vec![false; grid.len()];
    let mut parts = Vec::new();
    for (.., start) in cells(&grid) {
        if seen[start] || diagonal[start] == 0.0 {
            continue;
        }
        let (mut part, mut open, mut next) = (Vec::new(), false, vec![start]);
        seen[start] = true;
        while let Some(k) = next.pop() {
            part.push(k);
            let around = [(k + 1, right[k]), (k - 1, right[k - 1])];
            let up_and_down = [(k + stride, upper[k]), (k - stride, upper[k - stride])];
            let mut coupled = 0.0;
            for (other, coupling) in around.into_iter().chain(up_and_down) {
                coupled += coupling;
                if coupling > 0.0 && !std::mem::replace(&mut seen[other], true) {
                    next.push(other);
                }
            }
            open |= diagonal[k] - coupled > 0.01;
        }
        parts.push((part, open));
    }
    parts
}

#[test]
fn each_sealed_part_of_a_maze_is_balanced_and_the_open_ones_are_left_alone() {
    let (mut sealed_parts, mut without) = (0, 0);
    // The less rock there is, the fewer are sealed.
    for (seed, rock_below) in (0..20).map(|seed| (seed, -0.1)).chain((20..60).map(|seed| (seed, -0.6))) {
        let mut random = noise(seed);
        // A cell of the grid is 4 d: rock fills whole cells of it, the rest is liquid or air.
        let kinds: Vec<f32> = (0..24 * 24).map(|_| random()).collect();
        let kind = move |column: usize, row: usize| kinds[row * 24 + column];
        let is_rock = |at: Vec2| kind((at.x / 4.0) as usize, (at.y / 4.0) as usize) < rock_below;
        let rock = solids(96, 96, is_rock);
        let filled = |column, row| if kind(column, row) < 0.9 { 1.0 } else { 0.0 };
        let mut equation = Equation::new(Vec2::splat(96.0), 4.0, &rock, |i, j| filled(i, j) > 0.0, filled);
        let before: Vec<f32> = (0..equation.grid.len()).map(|_| random()).collect();
        equation.hierarchy.finest().b.copy_from_slice(&before);
        let parts = parts(&mut equation);
        let (mut pockets, grid) = (Pockets::default(), equation.grid);
        let is_any_sealed = parts.iter().any(|(_, touches_air)| !touches_air);
        assert_eq!(pockets.are_there(&grid, equation.hierarchy.finest()), is_any_sealed, "seed {seed}");
        without += u32::from(!is_any_sealed);
        pockets.balance(&grid, equation.hierarchy.finest());
        let after = &equation.hierarchy.finest().b;
        for (part, touches_air) in &parts {
            if *touches_air {
                assert!(part.iter().all(|k| after[*k] == before[*k]), "seed {seed}: an open part was changed");
            } else {
                sealed_parts += 1;
                let sum: f64 = part.iter().map(|k| f64::from(after[*k])).sum();
                assert!(sum.abs() < 1e-5 * part.len() as f64, "seed {seed}: {sum} is left of {} cells", part.len());
                let shift = |k: usize| after[k] - before[k];
                assert!(part.iter().all(|k| (shift(*k) - shift(part[0])).abs() < 1e-5), "only the mean may go");
            }
        }
    }
    assert!(sealed_parts > 50, "only {sealed_parts} sealed parts in all mazes");
    assert!(without > 5, "only {without} mazes without sealed parts");
}

#[test]
fn what_is_full_to_bursting_stays_still() {
    // A box without air, and a chamber of rock. 15 % more liquid than fits: there is nowhere to go.
    let fastest = |rock: &Solids, rest_density: f32| {
        let mut particles = lattice(rock, |_| Some(Vec2::ZERO));
        let report = predict(&mut particles, rock, rest_density);
        assert!(report.liquid);
        (0..particles.len()).map(|i| particles.velocity(i).length()).fold(0.0, f32::max)
    };
    let walls = solids(40, 40, |_| false);
    assert!(fastest(&walls, LATTICE / 1.15) < 0.01, "the box bursts at {} d/s", fastest(&walls, LATTICE / 1.15));
    let chamber = solids(40, 40, |at| !(8.0..32.0).contains(&at.x) || !(8.0..32.0).contains(&at.y));
    assert!(fastest(&chamber, LATTICE) < 0.01, "a full chamber stirs at {} d/s", fastest(&chamber, LATTICE));
    // At its walls the rock takes part in the density, and the liquid there looks less crowded: it creeps outwards.
    let creep = fastest(&chamber, LATTICE / 1.15);
    assert!(creep < 2.0, "the chamber bursts at {creep} d/s");
}
