//! How closed faces are made of rock.

use super::ClosedFaces;
use crate::{
    predictor::{
        behind::{Behind, MakeUp},
        fold::fold,
        grid::{MacGrid, Window},
        open_shares::{OpenShares, TO_CENTRES},
        parts::{Parts, Room, all_around},
        pockets::ROUNDING,
        slivers::{MOST_MISSING, Place, Sliver},
        stencil::{Axis, faces_around},
    },
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};

/// A cell is liquid from this share of its open room on.
const LIQUID_SHARE: f32 = 0.5;
/// A cell with more rock than this is not solved for.
const ROCK_SHARE: f32 = 0.9;
/// Share of what is smeared over a cell from beyond one of its faces, where it is the same all around.
const BEYOND_A_FACE: f32 = 3.0 / 16.0;
/// A cell that is open to less than this has nowhere to go.
const LEAST_ROOM: f32 = 0.05;

impl ClosedFaces {
    /// What rock closes in a window; near its edge, and beyond it, other than it is.
    pub(super) fn built(grid: &MacGrid, solids: &Solids, down: IVec2, window: &Window) -> Self {
        let mut built = Self::default();
        for field in built.fields_mut() {
            *field = vec![0.0; grid.len()];
        }
        let parts = Parts::new(grid, solids, window);
        let faces = OpenShares::new(grid, solids, &parts);
        for j in window.rows.start.max(1)..window.rows.end.min(grid.rows + 2) {
            for i in window.columns.start.max(1)..window.columns.end.min(grid.columns + 2) {
                let k = grid.row(j) + i;
                built.open_u[k] = if j <= grid.rows { faces.left(k, TO_CENTRES) } else { 0.0 };
                built.open_v[k] = if i <= grid.columns { faces.lower(k, TO_CENTRES) } else { 0.0 };
            }
        }
        built.smear_rock(grid, solids, &parts, window);
        let is_inside = |i: usize, j: usize| (1..=grid.columns).contains(&i) && (1..=grid.rows).contains(&j);
        for j in window.rows.clone() {
            for i in window.columns.clone().filter(|i| !is_inside(*i, j)) {
                built.rock[grid.row(j) + i] = 1.0;
            }
        }
        let behind = behind_walls(&faces, window);
        built.open_slivers(&faces, down, &behind, window);
        built.make_up(&behind);
        built.even_out_slivers(grid);
        for k in grid.cells_in(window) {
            let room = built.open_u[k] + built.open_u[k + 1] + built.open_v[k] + built.open_v[k + grid.stride];
            let solved = built.rock[k] < ROCK_SHARE && room >= LEAST_ROOM;
            let least = LIQUID_SHARE * (1.0 - built.rock[k]) + built.rock[k];
            built.liquid_from[k] = if solved { least } else { f32::INFINITY };
            if solved && room < 4.0 - ROUNDING {
                built.beside_walls.push(k as u32);
            }
        }
        built.behind.retain_mut(|one| one.follow(&built.rock, &built.liquid_from));
        built
    }

    /// Opens the cells of which a level or upright wall leaves less than half to the cells that their room belongs to: the
    /// lines between the centres are no measure of it, as they end in the wall. On its own such a cell would hold the
    /// liquid in it, and stop what passes. A cell that rock cuts in two stays closed: it stands for one of its parts, and what moved
    /// that would move the matter in the other, too.
    fn open_slivers(&mut self, faces: &OpenShares, down: IVec2, behind: &[Behind], window: &Window) {
        let (grid, stride, parts) = (faces.grid, faces.grid.stride, faces.parts);
        let missing = |k: usize| missing(behind, k as u32);
        let is_thin = |k: usize| parts.room(k) == Room::Sliver && missing(k) > MOST_MISSING;
        let is_sliver = |k: usize| self.rock[k] > 0.5 || is_thin(k);
        for k in grid.cells_in(window).filter(|k| is_sliver(*k) && !parts.is_cut(*k)) {
            let mut opened = None;
            if self.open_u[k] + self.open_u[k + 1] == 0.0 {
                for (face, host, way) in [(k, k - 1, IVec2::NEG_X), (k + 1, k + 1, IVec2::X)] {
                    if !is_sliver(host) {
                        self.open_u[face] = faces.left(face, 0.0);
                        opened = opened.or((self.open_u[face] > 0.0).then_some((host, way)));
                    }
                }
            }
            if self.open_v[k] + self.open_v[k + stride] == 0.0 {
                for (face, host, way) in [(k, k - stride, IVec2::NEG_Y), (k + stride, k + stride, IVec2::Y)] {
                    if !is_sliver(host) {
                        self.open_v[face] = faces.lower(face, 0.0);
                        opened = opened.or((self.open_v[face] > 0.0).then_some((host, way)));
                    }
                }
            }
            let Some((host, way)) = opened.filter(|_| is_thin(k)) else { continue };
            let place = Place::new(way, down, faces.leads_through(k, way));
            self.slivers.extend(place.map(|place| Sliver { cell: k as u32, host: host as u32, place }));
        }
    }

    /// Notes what makes up for what is behind walls, but for slivers that are as full as their hosts.
    fn make_up(&mut self, behind: &[Behind]) {
        let Self { rock, slivers, behind: make_up, .. } = self;
        let goes_by_host = |cell: u32| {
            let at = slivers.binary_search_by_key(&cell, |sliver| sliver.cell);
            at.is_ok_and(|at| slivers[at].place == Place::Wall)
        };
        let others = behind.iter().filter(|one| !goes_by_host(one.cell));
        make_up.extend(others.filter_map(|one| MakeUp::new(*one, rock, missing(behind, one.other))));
    }

    /// Gives slivers beside walls the rock of their hosts, so that a surface is found at the same height in both.
    fn even_out_slivers(&mut self, grid: &MacGrid) {
        let Self { rock, above_v, right_of_u, slivers, .. } = self;
        let beside_walls = || {
            let those = slivers.iter().filter(|sliver| sliver.place == Place::Wall);
            those.map(|sliver| [sliver.cell, sliver.host].map(|cell| cell as usize))
        };
        for [own, host] in beside_walls() {
            rock[own] = rock[host];
        }
        for [own, host] in beside_walls() {
            let (after, step) =
                if own.abs_diff(host) == 1 { (&mut *above_v, grid.stride) } else { (&mut *right_of_u, 1) };
            for (face, other) in [(own, host), (own + step, host + step)] {
                // Where only one of both cells has its host's rock.
                let more = |own: usize, host: usize| rock[own] - rock[host];
                after[face] = after[other]
                    + (1.0 - BEYOND_A_FACE) * more(face, other)
                    + BEYOND_A_FACE * more(face - step, other - step);
            }
        }
    }

    /// Rock particles share out their volume as liquid particles do, so that rock and liquid side by side add up to 1. Those that
    /// reach only cells without any open face are left out, as nobody asks for what is around them.
    pub(super) fn smear_rock(&mut self, grid: &MacGrid, solids: &Solids, parts: &Parts, window: &Window) {
        let is_shut = parts.shut(grid, window);
        let reaches_shut_only = all_around(grid, &is_shut, window);
        solids.iter_in(grid.sites_in(window)).map(centre).for_each(|at| {
            let home = grid.row(Axis::V.row(grid, at.y).0 as usize) + Axis::U.column(grid, at.x).0 as usize;
            if !reaches_shut_only[home] {
                self.add_rock(grid, at);
            }
        });
        for k in grid.indices(window) {
            self.rock[k] = if is_shut[k] { 1.0 } else { self.rock[k].min(1.0) };
        }
    }

    /// Adds a rock particle to the cells that it reaches and, where it stands beyond one of their faces, to that.
    pub(super) fn add_rock(&mut self, grid: &MacGrid, at: Vec2) {
        let share = 0.25 * grid.per_cell * grid.per_cell;
        // It reaches three columns and three rows of cells.
        let (left, lower) = (Axis::U.column(grid, at.x).0 as usize - 1, Axis::V.row(grid, at.y).0 as usize - 1);
        let beyond = |at: f32, first: usize| {
            std::array::from_fn::<_, 4, _>(|line| (at + 0.5 - grid.edge(first + line)).clamp(0.0, 1.0))
        };
        let (right_of, above) = (beyond(at.x, left), beyond(at.y, lower));
        for axis in [Axis::U, Axis::V] {
            faces_around(grid, at.x, at.y, axis, |column, row, weight| {
                let (column, row, weight) = fold(grid, axis, (column, row), weight);
                let share = share * weight;
                let before = if axis == Axis::U { (column - 1, row) } else { (column, row - 1) };
                for (column, row) in [before, (column, row)] {
                    let k = grid.row(row) + column;
                    self.rock[k] += share;
                    for side in 0..2 {
                        self.right_of_u[k + side] += share * right_of[column - left + side];
                        self.above_v[k + side * grid.stride] += share * above[row - lower + side];
                    }
                }
            });
        }
    }
}

/// What is behind walls for cells of the grid in a window, in their order.
fn behind_walls(faces: &OpenShares, window: &Window) -> Vec<Behind> {
    let OpenShares { grid, solids, parts, .. } = *faces;
    let is_near_rock = |k: usize| {
        let rows = [k - grid.stride, k, k + grid.stride];
        rows.into_iter().flat_map(|k| k - 1..=k + 1).any(|k| !matches!(parts.room(k), Room::All | Room::None))
    };
    let with_room = grid.cells_in(window).filter(|k| parts.room(*k) != Room::None);
    with_room.filter(|k| is_near_rock(*k)).filter_map(|k| Behind::new(grid, solids, parts, k)).collect()
}

/// What a cell misses behind walls.
fn missing(behind: &[Behind], cell: u32) -> f32 {
    behind.binary_search_by_key(&cell, |one| one.cell).map_or(0.0, |at| behind[at].missing)
}
