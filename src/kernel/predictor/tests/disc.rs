//! A disc of rock in a stream, against potential flow.

use super::{
    CELL, LATTICE, lattice, predict,
    rig::{Rig, cells},
    solids,
};
use crate::solids::Solids;
use glam::Vec2;
use std::f64::consts::PI;

const RADIUS: f32 = 20.0;
const HEIGHT: u32 = 200;
const WIDTH: u32 = 420;
/// Air at either end, which the stream comes out of and goes into.
const AIR: f32 = 10.0;

fn middle() -> Vec2 {
    Vec2::new(WIDTH as f32, HEIGHT as f32) / 2.0
}

fn rock() -> Solids {
    solids(WIDTH, HEIGHT, |at| at.distance(middle()) < RADIUS)
}

fn stream(at: Vec2) -> Option<Vec2> {
    (AIR..WIDTH as f32 - AIR).contains(&at.x).then_some(Vec2::new(10.0, 0.0))
}

/// The flow around a cylinder between two walls, as a multiple of the stream's velocity far off: a doublet and its
/// images, w = 1 − (sinh(πR/H)/sinh(πz/H))². At its sides it is 1 + (sinh(πR/H)/sin(πR/H))², 2.07 here, where it would
/// be 2 without walls.
fn exact(at: Vec2) -> [f64; 2] {
    let k = PI / f64::from(HEIGHT);
    let (x, y) = (k * f64::from(at.x - middle().x), k * f64::from(at.y - middle().y));
    // sinh z = sinh x cos y + i cosh x sin y.
    let (re, im) = (x.sinh() * y.cos(), x.cosh() * y.sin());
    let (re, im) = (re * re - im * im, 2.0 * re * im);
    let share = (k * f64::from(RADIUS)).sinh().powi(2) / (re * re + im * im);
    // w = u − iv.
    [1.0 - share * re, -share * im]
}

#[test]
fn the_stream_parts_around_a_disc_as_potential_flow_does() {
    let rock = rock();
    let mut rig = Rig::new(&lattice(&rock, stream), &rock, CELL);
    // So short that a move changes no volume.
    rig.dt = 1e-4;
    rig.project_exactly(LATTICE);
    let grid = rig.grid;
    // The stream far off, from what flows through a section far upstream.
    let section = (80.0 / grid.cell) as usize + 1;
    let far: f64 =
        (1..=grid.rows).map(|j| f64::from(rig.faces.u[grid.row(j) + section][1])).sum::<f64>() / grid.rows as f64;
    let (mut squares, mut scale) = (0.0, 0.0);
    // The largest differences beside the disc and before and behind it, on the faces next to it.
    let (mut at_sides, mut at_ends) = (0.0_f64, 0.0_f64);
    for (column, row, k) in cells(&grid) {
        let off = Vec2::new(column as f32, row as f32 + 0.5) * grid.cell - middle();
        if !(RADIUS + CELL..2.0 * RADIUS).contains(&off.length()) {
            continue;
        }
        let (found, expected) = (f64::from(rig.faces.u[k][1]) / far, exact(off + middle())[0]);
        squares += (found - expected) * (found - expected);
        scale += expected * expected;
        let is_next = off.length() < RADIUS + 2.0 * CELL;
        if is_next && off.x.abs() < CELL {
            at_sides = at_sides.max((found - expected).abs());
            assert!(found > 1.5, "beside the disc the stream flows at {found} of its velocity");
        }
        if is_next && off.y.abs() < CELL {
            at_ends = at_ends.max((found - expected).abs());
        }
    }
    let rms = (squares / scale).sqrt();
    assert!(rms < 0.06, "around the disc the flow is off by {rms}");
    assert!(at_sides < 0.12 && at_ends < 0.07, "off by {at_sides} beside it and by {at_ends} before and behind it");
}

#[test]
fn nothing_flows_through_the_disc() {
    let rock = rock();
    let mut rig = Rig::new(&lattice(&rock, stream), &rock, CELL);
    rig.dt = 1e-4;
    rig.project_exactly(LATTICE);
    // Out of the liquid cells that touch the disc comes what goes in: what is left is rounding.
    let (s, mut most) = (rig.grid.stride, 0.0_f32);
    let mut touching = 0;
    for (column, row, k) in cells(&rig.grid) {
        let at = Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * rig.grid.cell;
        if rig.conjugate.liquid[k] == 0.0 || at.distance(middle()) > RADIUS + CELL {
            continue;
        }
        touching += 1;
        let (u, v, open_u, open_v) = (&rig.faces.u, &rig.faces.v, &rig.open.u, &rig.open.v);
        let out = open_u[k + 1] * u[k + 1][1] - open_u[k] * u[k][1] + open_v[k + s] * v[k + s][1] - open_v[k] * v[k][1];
        most = most.max(out.abs());
        for (open, velocity) in [(open_u[k], u[k][1]), (open_v[k], v[k][1])] {
            assert!(open > 0.0 || velocity == 0.0, "{velocity} d/s through a closed face");
        }
    }
    assert!(touching > 40 && most < 1e-2, "a flux of {most} d/s has no end in {touching} cells");
}

#[test]
fn a_tick_of_it_is_within_a_few_percent() {
    let rock = rock();
    let mut particles = lattice(&rock, stream);
    predict(&mut particles, &rock, LATTICE);
    let far: Vec<usize> = (0..particles.len()).filter(|i| (75.0..85.0).contains(&particles.x[*i])).collect();
    let far = far.iter().map(|i| f64::from(particles.vx[*i])).sum::<f64>() / far.len() as f64;
    let (mut squares, mut scale) = (0.0, 0.0);
    for i in 0..particles.len() {
        let at = particles.position(i);
        if (RADIUS + CELL..2.0 * RADIUS).contains(&at.distance(middle())) {
            let [u, v] = exact(at);
            let (found_u, found_v) = (f64::from(particles.vx[i]) / far, f64::from(particles.vy[i]) / far);
            squares += (found_u - u) * (found_u - u) + (found_v - v) * (found_v - v);
            scale += u * u + v * v;
        }
    }
    let rms = (squares / scale).sqrt();
    assert!(rms < 0.08, "around the disc the flow is off by {rms}");
}
