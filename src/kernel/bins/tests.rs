//! No particle within reach is missed, and each is in one group.

use super::{Bins, Group, Neighbours, Strip, cells::CellGrid, search::MARGIN_ROUNDING};
use crate::{
    element::ElementId,
    parallel::{Team, in_pool},
    particles::Particles,
    pbf::tests::random_numbers,
    simd::InstructionSet,
    solids::Solids,
};
use glam::Vec2;
use std::collections::BTreeSet;

fn scattered(n: usize, size: Vec2) -> Particles {
    let mut random = random_numbers(12345);
    let mut particles = Particles::default();
    for id in 0..n as u32 {
        let velocity = Vec2::new(random(), random());
        particles.push(id, ElementId((id % 3) as u8), Vec2::new(random(), random()) * size, velocity);
    }
    particles
}

/// Sorts, without touching positions.
fn sort(bins: &mut Bins, particles: &mut Particles, threads: usize) {
    let [mut spare, mut order] = [Vec::new(), Vec::new()];
    let instructions = InstructionSet::Baseline;
    bins.bin(particles, [&mut spare, &mut order], Neighbours::Binned, instructions, threads, &|_| ());
}

fn sorted(n: usize, size: Vec2, width: usize) -> (Bins, Particles) {
    let mut particles = scattered(n, size);
    let mut bins = Bins::default();
    let mut solids = Solids::new(size.x.ceil() as u32, size.y.ceil() as u32);
    for k in 0..10 {
        solids.insert(glam::IVec2::new(k, k / 2), ElementId(0), k as u32);
    }
    bins.resize(size, 2.5, 0.1, &solids);
    sort(&mut bins, &mut particles, 1);
    bins.group(&particles.x, width, 1);
    (bins, particles)
}

#[test]
fn every_particle_is_in_exactly_one_group() {
    for (n, width) in [(0, 16), (1, 16), (5, 1), (1000, 16), (777, 8)] {
        let (bins, ..) = sorted(n, Vec2::new(50.0, 30.0), width);
        let mut next = 0;
        for group in bins.groups() {
            assert_eq!(group.first as usize, next);
            assert!(group.len as usize <= width && group.len > 0);
            next += group.len as usize;
        }
        assert_eq!(next, n);
    }
}

#[test]
fn no_pair_within_reach_is_missed() {
    for size in [Vec2::new(50.0, 30.0), Vec2::new(3.0, 200.0), Vec2::new(200.0, 1.5), Vec2::new(1.0, 1.0)] {
        let (bins, Particles { x, y, .. }) = sorted(600, size, 16);
        for group in bins.groups() {
            for i in group.particles() {
                for j in 0..x.len() {
                    let near = (Vec2::new(x[i], y[i]) - Vec2::new(x[j], y[j])).length() < 2.7;
                    let candidate = group.movable.iter().any(|run| run.range().contains(&j));
                    assert!(candidate || !near, "{i} misses {j} in a box of {size}");
                }
                for j in 0..bins.rock().x.len() {
                    let rock = Vec2::new(bins.rock().x[j], bins.rock().y[j]);
                    let near = (Vec2::new(x[i], y[i]) - rock).length() < 2.7;
                    assert!(
                        !near || bins.rock().around(group).iter().any(|run| run.range().contains(&j)),
                        "{i} misses rock {j}"
                    );
                }
            }
        }
    }
}

#[test]
fn candidates_are_few() {
    let size = Vec2::new(100.0, 100.0);
    let (bins, Particles { x, .. }) = sorted(10_000, size, 16);
    let candidates: usize =
        bins.groups().iter().map(|g| g.len as usize * g.movable.iter().map(|r| r.range().len()).sum::<usize>()).sum();
    assert!(candidates / x.len() < 130, "{} candidates a particle", candidates / x.len());
}

/// Cells in the order of the particles.
fn cells(bins: &Bins, particles: &Particles) -> Vec<u32> {
    particles.x.iter().zip(&particles.y).map(|(&x, &y)| bins.grid.cell(x, y)).collect()
}

#[test]
fn the_sort_is_stable_and_takes_everything_along() {
    for (n, threads) in [(0, 1), (1, 1), (5000, 1), (20_000, 3)] {
        let size = Vec2::new(60.0, 40.0);
        let before = scattered(n, size);
        let (mut bins, mut after) = (Bins::default(), before.clone());
        bins.resize(size, 2.5, 0.1, &Solids::new(60, 40));
        sort(&mut bins, &mut after, threads);
        let keys: Vec<_> = cells(&bins, &after).into_iter().zip(after.id.iter().copied()).collect();
        // Ids count up in the order from before.
        assert!(keys.is_sorted(), "{n} particles are out of order");
        for i in 0..n {
            let from = after.id[i] as usize;
            assert_eq!((after.position(i), after.velocity(i)), (before.position(from), before.velocity(from)));
            assert_eq!(after.element[i], before.element[from]);
        }
    }
}

#[test]
fn the_sort_does_not_depend_on_how_it_is_cut() {
    let size = Vec2::new(90.0, 70.0);
    let run = |threads: usize| {
        let (mut bins, mut particles) = (Bins::default(), scattered(9000, size));
        bins.resize(size, 2.5, 0.1, &Solids::new(90, 70));
        let mut random = random_numbers(77);
        for step in 0..6 {
            for y in &mut particles.y {
                // In the end everything comes down.
                *y = ((*y + 4.0 * random() - 2.0) * if step == 4 { 0.2 } else { 1.0 }).clamp(0.0, size.y);
            }
            // A few are poured in, at the end of the order.
            for k in 0..300 {
                particles.push(
                    10_000 + step * 1000 + k,
                    ElementId(0),
                    Vec2::new(random(), random()) * size,
                    Vec2::ZERO,
                );
            }
            sort(&mut bins, &mut particles, threads);
            assert!(cells(&bins, &particles).is_sorted());
        }
        let groups: Vec<_> = bins.groups().iter().map(|group| format!("{group:?}")).collect();
        (particles, groups)
    };
    let one = run(1);
    assert!([2, 3, 8].into_iter().all(|threads| run(threads) == one));
}

/// The particles that the focus works on.
fn focused(bins: &Bins) -> Vec<usize> {
    let of = |group: &Group| {
        let lanes = group.lanes;
        group.particles().enumerate().filter(move |(lane, _)| lanes >> lane & 1 != 0).map(|(_, i)| i)
    };
    bins.focused().iter().flat_map(of).collect()
}

#[test]
fn the_focus_is_on_what_is_in_or_beside_a_tile_with_something_too_dense() {
    let mut random = random_numbers(11);
    // The widest has rows of several words of marks.
    for (count, size) in [(0, 9.0), (1, 3.0), (6000, 60.0), (9000, 700.0)] {
        let size = Vec2::new(size, 40.0);
        for share_of_dense in [0.0, 0.002, 0.05, 1.0] {
            let (mut bins, particles) = sorted(count, size, 16);
            let density: Vec<f32> = (0..count).map(|_| if random() < share_of_dense { 1.2 } else { 1.0 }).collect();
            let Particles { x, y, .. } = &particles;
            let tile = |i: usize| (bins.grid.tile_column(x[i]), bins.grid.strip(y[i]));
            let dense: BTreeSet<_> = (0..count).filter(|&i| density[i] > 1.1).map(tile).collect();
            let beside = |at: usize| at - 1..=at + 1;
            let is_near = |&i: &usize| {
                let (column, row) = tile(i);
                beside(row).any(|row| beside(column).any(|column| dense.contains(&(column, row))))
            };
            let expected: Vec<_> = (0..count).filter(is_near).collect();
            for (threads, width) in [(1, 16), (3, 16), (2, 4), (1, 1)] {
                bins.group(x, width, threads);
                for instructions in InstructionSet::available() {
                    in_pool(threads, || bins.focus([x, y], &density, 1.1, Team { instructions, threads }));
                    assert_eq!(focused(&bins), expected, "{count} particles, {threads} threads, {width} side by side");
                }
            }
            let [mut spare, mut order] = [Vec::new(), Vec::new()];
            let (instructions, brute) = (InstructionSet::Baseline, Neighbours::Brute);
            bins.bin(&mut particles.clone(), [&mut spare, &mut order], brute, instructions, 1, &|_| ());
            bins.focus([x, y], &density, 1.1, Team { instructions, threads: 1 });
            assert_eq!(focused(&bins), expected, "every particle with every other");
        }
    }
}

#[test]
fn what_is_turned_inwards_stays_in_its_cell() {
    let size = Vec2::new(40.0, 40.0);
    let (mut bins, mut particles) = (Bins::default(), scattered(3000, size));
    bins.resize(size, 2.5, 0.1, &Solids::new(40, 40));
    let [mut spare, mut order] = [Vec::new(), Vec::new()];
    let grid = CellGrid::new(size, 2.7 + MARGIN_ROUNDING);
    let settle = |strip: Strip| {
        for i in 0..strip.x.len() {
            for offset in [Vec2::new(0.05, 0.05), Vec2::new(-0.05, 0.04), Vec2::new(0.0, -0.05)] {
                let turned = strip.turn_inwards(i, offset, |_| true);
                let cell = grid.cell(strip.x[i], strip.y[i]);
                assert_eq!(grid.cell(strip.x[i] + turned.x, strip.y[i] + turned.y), cell);
                assert_eq!(turned.abs(), offset.abs());
            }
        }
    };
    bins.bin(&mut particles, [&mut spare, &mut order], Neighbours::Binned, InstructionSet::Baseline, 1, &settle);
}

#[test]
fn cells_and_tiles_stand_symmetrically_about_the_middle() {
    let mut random = random_numbers(5);
    for size in [Vec2::new(40.0, 40.0), Vec2::new(37.3, 11.9), Vec2::new(4.0, 200.5), Vec2::new(2.7, 2.7)] {
        let grid = CellGrid::new(size, 2.7 + MARGIN_ROUNDING);
        let (columns, rows, stride) = (grid.columns as u32, grid.rows as u32, grid.tile_columns());
        let mut tried = 0;
        while tried < 1000 {
            let at = Vec2::new(random(), random()) * size;
            let around = [at - 1e-4, at + 1e-4].map(|at| grid.cell(at.x, at.y));
            // At an edge rounding decides.
            if around[0] != around[1] {
                continue;
            }
            tried += 1;
            let image = size - at;
            let (cell, turned) = (grid.cell(at.x, at.y), grid.cell(image.x, image.y));
            assert_eq!(cell % columns + turned % columns, columns - 1, "{at} in {size}");
            assert_eq!(cell / columns + turned / columns, rows - 1, "{at} in {size}");
            let (tile, turned) = (grid.tile_column(at.x), grid.tile_column(image.x));
            assert_eq!(tile + turned, stride - 1, "{at} in {size}");
            // Square tiles in a square box: turned by a quarter they are the same.
            if size.x == size.y {
                assert_eq!(grid.strip(at.x), tile, "{at}");
            }
        }
    }
}
