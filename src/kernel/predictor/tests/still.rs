//! Still water needs no correction but for the weight that it carries.

use super::{CELL, DT, LATTICE, lattice, predict, rig::Rig, solids};
use crate::{element::ElementId, particles::Particles};
use glam::Vec2;

/// Gravity of a spacing of 0.1 m, d/s².
const GRAVITY: f32 = 98.1;

/// Fastest particle outside of the uppermost `skin` d, d/s.
fn fastest(particles: &Particles, surface: f32, skin: f32) -> f32 {
    let below = (0..particles.len()).filter(|i| particles.y[*i] < surface - skin);
    below.map(|i| particles.velocity(i).length()).fold(0.0, f32::max)
}

#[test]
fn a_still_column_without_weight_is_not_touched() {
    let walls = solids(30, 80, |_| false);
    let mut particles = lattice(&walls, |at| (at.y < 50.0).then_some(Vec2::ZERO));
    let before = particles.clone();
    predict(&mut particles, &walls, LATTICE);
    let most = fastest(&particles, 50.0, 0.0);
    assert!(most < 1e-3, "still water without weight moves at {most} d/s");
    let moved = (0..particles.len()).map(|i| particles.position(i).distance(before.position(i))).fold(0.0, f32::max);
    assert!(moved < 1e-4, "what is as dense as it should be moves {moved} d");
}

#[test]
fn a_column_carries_its_own_weight() {
    // Whatever the part of a cell that the surface stands over a row's edge.
    for depth in [20.0, 40.0, 41.0, 42.0, 43.0, 44.0, 70.0] {
        let walls = solids(30, 100, |_| false);
        let fall = Vec2::new(0.0, -GRAVITY * DT);
        let mut particles = lattice(&walls, |at| (at.y < depth).then_some(fall));
        let report = predict(&mut particles, &walls, LATTICE);
        let (deep, all) = (fastest(&particles, depth, 2.0 * CELL), fastest(&particles, depth, 0.0));
        assert!(deep < 0.1 * -fall.y, "depth {depth}: the water under the surface still falls at {deep} d/s");
        // Where the surface lies just over the centres of its cells it is taken to be a quarter of a cell away.
        assert!(all < 0.5 * -fall.y, "depth {depth}: the surface still falls at {all} d/s");
        assert!(report.iterations <= 4, "depth {depth}: {report:?}");
    }
}

#[test]
fn the_pressure_under_a_pool_is_its_weight() {
    // p counts in d/s: a face gains the difference over one cell, so p = g Δt (D − y)/c.
    let walls = solids(40, 100, |_| false);
    for depth in [30.0, 31.0, 32.0, 33.0, 34.0, 60.0] {
        let particles = lattice(&walls, |at| (at.y < depth).then_some(Vec2::new(0.0, -GRAVITY * DT)));
        let mut rig = Rig::new(&particles, &walls, CELL);
        rig.project(LATTICE);
        let k = rig.grid.row(3) + 5;
        let y = 2.5 * f64::from(rig.grid.cell);
        let expected = f64::from(GRAVITY * DT) * (f64::from(depth) - y) / f64::from(rig.grid.cell);
        let found = f64::from(rig.conjugate.solution[k]);
        assert!((found / expected - 1.0).abs() < 0.05, "depth {depth}: {found} and not {expected}");
    }
}

#[test]
fn a_lattice_at_any_rest_density_is_as_still() {
    // Rest density counts particles in a d²: those of a lattice of spacing s weigh 1/s² of it.
    let walls = solids(60, 60, |_| false);
    for spacing in [0.5_f32, 0.75, 1.0, 1.25] {
        let mut particles = Particles::default();
        let (columns, rows) = ((60.0 / spacing) as usize, (30.0 / spacing) as usize);
        for k in 0..columns * rows {
            let at = Vec2::new((k % columns) as f32 + 0.5, (k / columns) as f32 + 0.5) * spacing;
            particles.push(k as u32, ElementId(1), at, Vec2::new(0.0, -GRAVITY * DT));
        }
        predict(&mut particles, &walls, LATTICE / (spacing * spacing));
        let (deep, all) = (fastest(&particles, 30.0, 2.0 * CELL), fastest(&particles, 30.0, 0.0));
        assert!(
            deep < 0.1 * GRAVITY * DT && all < 0.1 * GRAVITY * DT,
            "spacing {spacing}: {deep} and {all} d/s are left"
        );
    }
}

#[test]
fn rock_over_a_pool_and_beside_it_does_not_move_its_surface() {
    // A ledge that ends over the pool, up to a cell above the water, and a pillar that stands in it, wherever they are within
    // their cells. What pressure gives along the surface shows where it is taken to be.
    let rock = [
        ("a ledge", (|at, gap| at.x > 20.0 && at.y > 21.0 + gap && at.y < 30.0 + gap) as fn(Vec2, f32) -> bool),
        ("a pillar", |at, gap| at.x > 20.0 + gap && at.x < 24.0 + gap && at.y > 5.0),
    ];
    for (name, is_rock) in rock {
        for gap in [0.0, 1.0, 2.0] {
            let walls = solids(50, 60, |at| is_rock(at, gap));
            let fall = Vec2::new(0.0, -GRAVITY * DT);
            let mut particles = lattice(&walls, |at| (at.y < 20.0).then_some(fall));
            predict(&mut particles, &walls, LATTICE);
            let aside = particles.vx.iter().fold(0.0_f32, |most, vx| most.max(vx.abs())) / -fall.y;
            assert!(aside < 0.1, "{name}, {gap} d off: still water is pushed aside with {aside} of what gravity adds");
        }
    }
}
