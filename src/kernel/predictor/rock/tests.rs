//! Closed faces against what they are of all rock, and against those that are made anew.

use super::*;
use crate::{
    element::ElementId,
    predictor::parts::{Parts, Room},
    random::Random,
    solids::centre,
};

#[test]
fn around_cells_with_an_open_face_no_rock_is_left_out() {
    // A hill, a ball and a thin wall in a box of cells that no cell of rock is a multiple of.
    let (size, mut solids) = (Vec2::new(101.0, 70.0), Solids::new(101, 70));
    let is_rock =
        |at: Vec2| at.y < 20.0 + 0.3 * at.x || at.distance(Vec2::new(30.0, 50.0)) < 14.0 || (at.x - 70.0).abs() < 1.0;
    let cells = (0..70).flat_map(|y| (0..101).map(move |x| IVec2::new(x, y)));
    for cell in cells.filter(|cell| is_rock(centre(*cell))) {
        solids.insert(cell, ElementId(0), 0);
    }
    let grid = MacGrid::new(size, 2.4);
    let parts = Parts::new(&grid, &solids, &grid.all());
    let [mut some, mut all] = [(); 2].map(|()| ClosedFaces::default());
    for field in some.fields_mut().into_iter().chain(all.fields_mut()) {
        field.resize(grid.len(), 0.0);
    }
    some.smear_rock(&grid, &solids, &parts, &grid.all());
    solids.iter().for_each(|(cell, ..)| all.add_rock(&grid, centre(cell)));
    // A cell is shut if neither it nor any of those around it has room.
    let has_room = |k: usize| parts.room(k) != Room::None;
    let is_shut: Vec<bool> = (0..grid.len())
        .map(|k| {
            let rows = [k.checked_sub(grid.stride), Some(k), Some(k + grid.stride)];
            let around = rows.into_iter().flatten().flat_map(|k| k.saturating_sub(1)..=k + 1);
            around.filter(|k| *k < grid.len()).all(|k| !has_room(k))
        })
        .collect();
    let mut shut = 0;
    for k in (1..=grid.rows).flat_map(|j| grid.row(j) + 1..=grid.row(j) + grid.columns) {
        if is_shut[k] {
            shut += 1;
            assert_eq!(some.rock[k], 1.0);
            continue;
        }
        assert_eq!(some.rock[k], all.rock[k].min(1.0));
        for (before, field) in
            [(k - 1, [&some.right_of_u, &all.right_of_u]), (k - grid.stride, [&some.above_v, &all.above_v])]
        {
            assert!(is_shut[before] || field[0][k] == field[1][k]);
        }
    }
    assert!(shut > 200, "{shut} cells are shut");
}

#[test]
fn what_is_made_anew_near_a_change_is_as_if_all_were() {
    let mut random = Random::new(11);
    let (mut near, mut steps, mut thin) = (0, 0, [0; 2]);
    for (cell, [width, height]) in [(2.4, [150, 120]), (1.5, [97, 61]), (2.0, [64, 90]), (4.3, [200, 150])] {
        let mut solids = Solids::new(width, height);
        let grid = MacGrid::new(Vec2::new(width as f32, height as f32), cell);
        // A hill, over it walls two and three rocks thick, and a level one.
        let is_rock = |IVec2 { x, y }: IVec2| y < 10 + x / 3 || x % 19 < 2 || x % 23 < 3 || (55..57).contains(&y);
        let cells = (0..height as i32).flat_map(|y| (0..width as i32).map(move |x| IVec2::new(x, y)));
        for at in cells.filter(|at| is_rock(*at)) {
            solids.insert(at, ElementId(0), 0);
        }
        let (mut follows, mut gravity) = (ClosedFaces::default(), Vec2::NEG_Y);
        for step in 0..60 {
            // Of rock or in it, level, upright or slanting, single cells among them.
            let corner = Vec2::new(random.share() * width as f32, random.share() * height as f32);
            let (is_rock, slope) = (random.below(2) > 0, [0.0, 0.5, 1.0, -1.0][random.below(4)]);
            let (long, thick) = (0.6 + 9.0 * random.share() * random.share(), 1.0 + 4.0 * random.share());
            let is_upright = random.below(2) == 0;
            let low = (corner - long - thick).as_ivec2().max(IVec2::ZERO);
            let high = (corner + long + thick).as_ivec2().min(IVec2::new(width as i32, height as i32));
            for at in (low.y..high.y).flat_map(|y| (low.x..high.x).map(move |x| IVec2::new(x, y))) {
                let from = centre(at) - corner;
                let from = if is_upright { Vec2::new(from.y, from.x) } else { from };
                let is_near = from.x.abs() < long && (from.y - slope * from.x).abs() < thick * 0.5;
                match is_rock {
                    true if is_near => drop(solids.insert(at, ElementId(0), 0)),
                    false if is_near => drop(solids.remove(at)),
                    _ => (),
                }
            }
            if step == 40 {
                gravity = Vec2::X;
            }
            let before = follows.outline.clone();
            follows.update(&grid, &solids, gravity);
            let sites = before.clone().follow(&solids);
            near += usize::from(sites.is_some_and(|sites| grid.window(sites).columns.len() < grid.columns / 4));
            let mut anew = ClosedFaces::default();
            anew.update(&grid, &solids, gravity);
            assert_eq!(follows.rows, anew.rows, "step {step}, cells of {cell}");
            assert!(follows.fields() == anew.fields(), "step {step}, cells of {cell}");
            assert_eq!(follows.beside_walls, anew.beside_walls);
            assert_eq!(follows.slivers, anew.slivers);
            assert_eq!(follows.behind, anew.behind);
            steps += 1;
            thin = [thin[0] + anew.slivers.len(), thin[1] + anew.behind.len()];
        }
    }
    assert!(near > steps / 4, "{near} of {steps} changes were small");
    assert!(thin.iter().all(|count| *count > 10 * steps), "{thin:?} slivers, and cells with something behind walls");
}
