//! Walls one particle thick: no flux through closed faces, no pressure through them.

use super::{
    CELL, LATTICE, lattice, noise, predict,
    rig::{Rig, cells},
    solids,
};
use crate::{
    element::ElementId,
    particles::Particles,
    predictor::grid::MacGrid,
    solids::{Solids, centre},
};
use glam::Vec2;
use std::ops::Range;

/// A wall, and the side of it a point is on.
struct Wall {
    name: &'static str,
    solids: Solids,
    is_left: fn(Vec2) -> bool,
}

/// Upright, level and diagonal walls, all one particle thick.
fn walls() -> Vec<Wall> {
    let wall = |name, is_rock: fn(Vec2) -> bool, is_left| Wall { name, solids: solids(60, 60, is_rock), is_left };
    vec![
        wall("upright on a cell's edge", |at| at.x as i32 == 30, |at| at.x < 30.0),
        wall("upright inside a cell", |at| at.x as i32 == 31, |at| at.x < 31.0),
        wall("level", |at| at.y as i32 == 28, |at| at.y < 28.0),
        // Its cells touch at corners only.
        wall("diagonal", |at| at.x as i32 == at.y as i32, |at| at.x < at.y),
        wall("steep", |at| at.x as i32 == 15 + at.y as i32 / 2, |at| at.x < 15.0 + (at.y as i32 / 2) as f32),
    ]
}

/// Which cells of the grid lie on the left: those whose centre and four corners do.
fn sides(grid: &MacGrid, is_left: fn(Vec2) -> bool) -> Vec<Option<bool>> {
    let mut sides = vec![None; grid.len()];
    for (column, row, k) in cells(grid) {
        let corner = |x: f32, y: f32| (Vec2::new(column as f32 + x, row as f32 + y)) * grid.cell;
        let points = [corner(0.5, 0.5), corner(0.05, 0.05), corner(0.95, 0.05), corner(0.05, 0.95), corner(0.95, 0.95)];
        let left = points.iter().filter(|at| is_left(**at)).count();
        sides[k] = match left {
            0 => Some(false),
            5 => Some(true),
            _ => None,
        };
    }
    sides
}

#[test]
fn no_path_through_open_faces_leads_from_one_side_to_the_other() {
    for wall in walls() {
        let rig = Rig::new(&lattice(&wall.solids, |_| Some(Vec2::ZERO)), &wall.solids, CELL);
        let (grid, sides) = (rig.grid, sides(&rig.grid, wall.is_left));
        let mut reached: Vec<bool> = sides.iter().map(|side| *side == Some(true)).collect();
        let mut next: Vec<usize> = (0..grid.len()).filter(|k| reached[*k]).collect();
        assert!(next.len() > 40, "{}", wall.name);
        while let Some(k) = next.pop() {
            assert_ne!(sides[k], Some(false), "{}: cell {k} is reached from the other side", wall.name);
            let ways = [
                (k + 1, rig.open.u[k + 1]),
                (k - 1, rig.open.u[k]),
                (k + grid.stride, rig.open.v[k + grid.stride]),
                (k - grid.stride, rig.open.v[k]),
            ];
            for (other, open) in ways {
                if open > 0.0 && !std::mem::replace(&mut reached[other], true) {
                    next.push(other);
                }
            }
        }
    }
}

#[test]
fn nothing_flows_through_a_closed_face() {
    let mut random = noise(4);
    for wall in walls() {
        let mut particles = lattice(&wall.solids, |_| Some(Vec2::ZERO));
        for i in 0..particles.len() {
            (particles.vx[i], particles.vy[i]) = (30.0 * random(), 30.0 * random());
        }
        let mut rig = Rig::new(&particles, &wall.solids, CELL);
        rig.project(LATTICE);
        for (.., k) in cells(&rig.grid) {
            let touches = |other: usize| rig.conjugate.liquid[k] + rig.conjugate.liquid[other] > 0.0;
            if rig.open.u[k] == 0.0 && touches(k - 1) {
                assert_eq!(rig.faces.u[k][1], 0.0, "{}: flow through a closed face", wall.name);
            }
            if rig.open.v[k] == 0.0 && touches(k - rig.grid.stride) {
                assert_eq!(rig.faces.v[k][1], 0.0, "{}: flow through a closed face", wall.name);
            }
        }
    }
}

#[test]
fn still_water_beside_a_tank_under_pressure_stays_still() {
    for wall in walls() {
        // Left: liquid that falls on. Right: liquid at rest, without weight.
        let (is_left, thrown) = (wall.is_left, 10.0);
        let velocity = |at: Vec2| if is_left(at) { Vec2::new(0.0, -thrown) } else { Vec2::ZERO };
        let mut particles = lattice(&wall.solids, |at| (at.y < 50.0).then(|| velocity(at)));
        predict(&mut particles, &wall.solids, LATTICE);
        let fastest = |near: Range<f32>| {
            let right = (0..particles.len()).filter(|i| !is_left(particles.position(*i)));
            let within = right.filter(|i| near.contains(&distance_to_rock(&wall.solids, particles.position(*i))));
            within.map(|i| particles.velocity(i).length()).fold(0.0, f32::max) / thrown
        };
        let (near, far) = (fastest(0.0..2.0 * CELL), fastest(2.0 * CELL..100.0));
        assert!(far < 0.06, "{}: still water moves with {far} of the other side's velocity", wall.name);
        // Within a cell of the wall, faces take the mean of the particles on both sides of it.
        assert!(near < 0.4, "{}: still water at the wall moves with {near} of the other side's velocity", wall.name);
    }
}

/// A basin of walls and a floor some spacings thick, whose room lies between two corners; air around it.
fn basin(thick: f32, [low, high]: [Vec2; 2]) -> Solids {
    solids(60, 60, |at| {
        let is_within = |margin: f32| at.cmpge(low - margin).all() && at.x < high.x + margin && at.y < high.y;
        is_within(thick) && !is_within(0.0)
    })
}

#[test]
fn still_water_in_a_basin_carries_its_weight_however_thick_the_walls_are() {
    // A pattern of cells repeats every five spacings. A wall one particle thick may cut cells in two, of which the equation has one
    // alone; the constraint carries the other.
    let fall = 98.1 * super::DT;
    for (thick, off, depth) in (2..=5).flat_map(|thick| (0..25).map(move |k| (thick, k % 5, k / 5))) {
        let (low, surface) = (Vec2::splat(10.0 + off as f32), 38.0 + depth as f32);
        let walls = basin(thick as f32, [low, low + Vec2::new(30.0, 45.0)]);
        let is_inside = |at: Vec2| at.cmpge(low).all() && at.x < low.x + 30.0 && at.y < surface;
        let mut particles = lattice(&walls, |at| is_inside(at).then_some(Vec2::new(0.0, -fall)));
        predict(&mut particles, &walls, LATTICE);
        let fastest = |below: f32| {
            let those = (0..particles.len()).filter(|i| particles.y[*i] < below);
            those.map(|i| particles.velocity(i).length()).fold(0.0, f32::max) / fall
        };
        let (deep, all) = (fastest(surface - 2.0 * CELL), fastest(surface));
        let aside = particles.vx.iter().fold(0.0_f32, |most, vx| most.max(vx.abs())) / fall;
        let basin = format!("walls {thick} d thick, {off} d off, the surface at {surface} d");
        assert!(deep < 0.1, "{basin}: water falls with {deep} of what gravity adds");
        assert!(all < 0.5, "{basin}: the surface falls with {all} of what gravity adds");
        // As beside any rock (`rock_over_a_pool_and_beside_it_does_not_move_its_surface`).
        assert!(aside < 0.1, "{basin}: still water is pushed aside with {aside} of what gravity adds");
    }
}

/// Distance of a point to the nearest rock, d.
fn distance_to_rock(solids: &Solids, at: Vec2) -> f32 {
    solids.iter().map(|(cell, ..)| centre(cell).distance(at)).fold(f32::MAX, f32::min)
}

#[test]
fn a_layer_along_any_wall_is_sped_up_alike() {
    // Two streams meet in the middle of a layer three spacings deep: what they gain along the wall must not depend on
    // which wall it is. The box is a square of whole cells, so that the grids are turned onto each other.
    let side = 40.0;
    let turn = |at: Vec2, quarters: u32| (0..quarters).fold(at - 0.5 * side, |at, _| at.perp()) + 0.5 * side;
    let way = |way: Vec2, quarters: u32| (0..quarters).fold(way, |way, _| way.perp());
    let run = |quarters: u32| -> Vec<Vec2> {
        let solids = solids(40, 40, |_| false);
        let mut particles = Particles::default();
        for y in 0..6 {
            for x in 8..32 {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let velocity = Vec2::new(if at.x < 20.0 { 30.0 } else { -30.0 }, 0.0);
                particles.push(particles.len() as u32, ElementId(1), turn(at, quarters), way(velocity, quarters));
            }
        }
        predict(&mut particles, &solids, LATTICE);
        (0..particles.len()).map(|i| way(particles.velocity(i), 4 - quarters)).collect()
    };
    let floor = run(0);
    assert!(floor.iter().any(|velocity| velocity.y > 5.0), "the streams do not meet");
    for quarters in 1..4 {
        let other = run(quarters);
        let apart = floor.iter().zip(&other).map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
        assert!(apart < 0.05, "{quarters} quarters: velocities are {apart} d/s apart");
    }
}

#[test]
fn water_beside_a_thin_wall_is_as_full_as_any_whatever_is_behind() {
    // Wherever in its cells a wall of one or two cells of rock stands, upright or level, and whether or not there is water on its other
    // side: to half of what the density feedback leaves in still water, a hundredth.
    for (at, thick) in (20..25).flat_map(|at| [(at as f32, 1.0), (at as f32, 2.0)]) {
        for (is_level, is_wet_behind) in [(false, false), (false, true), (true, false), (true, true)] {
            let along = |at: Vec2| if is_level { at.y } else { at.x };
            let walls = solids(45, 45, |place| along(place) > at && along(place) < at + thick);
            let is_wet = |place: Vec2| along(place) > at || is_wet_behind;
            let particles = lattice(&walls, |place| is_wet(place).then_some(Vec2::ZERO));
            let mut rig = Rig::new(&particles, &walls, CELL);
            rig.project(LATTICE);
            let middle = rig.grid.columns / 2;
            let cell = |i: usize| if is_level { rig.grid.row(i) + middle } else { rig.grid.row(middle) + i };
            for k in (1..=rig.grid.columns).map(cell).filter(|k| rig.conjugate.liquid[*k] > 0.0) {
                let fill = rig.faces.filled[k];
                assert!(
                    (fill - 1.0).abs() < 0.005,
                    "cell {k} is filled to {fill} beside a wall at {at}, {thick} d thick, level: {is_level}, wet behind: {is_wet_behind}"
                );
            }
        }
    }
}
