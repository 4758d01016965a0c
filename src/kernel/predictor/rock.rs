//! What rock closes: how much of each face is open, and how much of each cell's neighbourhood is rock.

use crate::{
    predictor::{
        behind::{Behind, MakeUp},
        grid::{MacGrid, Window},
        open_shares::{OpenShares, TO_CENTRES},
        outline::Outline,
        parts::{Parts, Room, all_around},
        pockets::ROUNDING,
        slivers::{MOST_MISSING, Place, Sliver},
        stencil::{Axis, faces_around},
    },
    solids::{Solids, centre},
};
use glam::{IVec2, Vec2};
use std::ops::Range;

/// A cell is liquid from this share of its open room on.
const LIQUID_SHARE: f32 = 0.5;
/// A cell with more rock than this is not solved for.
const ROCK_SHARE: f32 = 0.9;
/// Share of what is smeared over a cell from beyond one of its faces, where it is the same all around.
const BEYOND_A_FACE: f32 = 3.0 / 16.0;
/// A cell that is open to less than this has nowhere to go.
const LEAST_ROOM: f32 = 0.05;

/// How far a cell's fields go by what rock leaves of other cells: what is shut goes by those around it, rock is left out that
/// reaches what is shut only, its share is smeared over those around it, and slivers and what is behind walls go by the cells
/// beside them.
const GOES_BY: usize = 5;

/// Rock as the grid sees it; follows the rock's shape. Rows that are like the one below share its place in the fields
/// ([`ClosedFaces::row`]), so that a box without rock costs next to nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct ClosedFaces {
    /// The grid, the shape of the rock, and where gravity pulls most.
    built_for: Option<(MacGrid, u64, IVec2)>,
    /// Where the rock stands.
    outline: Outline,
    /// Where each row of the grid stands in the fields.
    rows: Vec<u32>,
    /// Open share of the left face of each cell.
    pub open_u: Vec<f32>,
    /// Open share of the lower face of each cell.
    pub open_v: Vec<f32>,
    /// Share of rock around each cell, smeared as the liquid's density is, 0 … 1; 1 in the padding.
    pub rock: Vec<f32>,
    /// Of the rock of the two cells beside each left face, what stands to its right.
    right_of_u: Vec<f32>,
    /// Of the rock of the two cells beside each lower face, what stands above it.
    above_v: Vec<f32>,
    /// Share of each cell from which it is liquid, its rock counted in; infinite where there is nothing to solve.
    pub liquid_from: Vec<f32>,
    /// Cells beside a wall, those of the grid's index in order: a face of theirs is closed, or a part of it.
    pub beside_walls: Vec<u32>,
    /// Those that go by other cells, in the order of the grid's index.
    pub slivers: Vec<Sliver>,
    /// Other cells with room behind a thin wall, likewise.
    pub behind: Vec<MakeUp>,
}

impl ClosedFaces {
    /// Follows the rock and gravity.
    pub fn update(&mut self, grid: &MacGrid, solids: &Solids, gravity: Vec2) {
        let is_across = gravity.x.abs() > gravity.y.abs();
        let most = if is_across { Vec2::new(gravity.x, 0.0) } else { Vec2::new(0.0, gravity.y) };
        let down = IVec2::new(sign(most.x), sign(most.y));
        let now = (*grid, solids.shape(), down);
        if self.built_for == Some(now) {
            return;
        }
        let changed = self.outline.follow(solids);
        let is_like = |(was, _, then): (MacGrid, u64, IVec2)| (was, then) == (*grid, down);
        let window = match changed {
            _ if !self.built_for.is_some_and(is_like) => Some(grid.all()),
            Some(sites) => Some(grid.widened(&grid.window(sites), GOES_BY)),
            None => None,
        };
        if let Some(window) = window {
            let fresh = Self::built(grid, solids, down, &grid.widened(&window, GOES_BY));
            self.take(grid, &window, fresh);
        }
        self.built_for = Some(now);
    }

    /// Index of cell (0, j) in the fields.
    #[inline(always)]
    pub fn row(&self, j: usize) -> usize {
        self.rows[j] as usize
    }

    /// The rock around the faces `first … first + n` of a row.
    #[inline(always)]
    pub fn beside(&self, grid: &MacGrid, axis: Axis, first: usize, n: usize) -> Beside<'_> {
        let (j, column) = (first / grid.stride, first % grid.stride);
        let own = self.row(j) + column;
        let (before, after) = match axis {
            Axis::U => (own - 1, &self.right_of_u),
            Axis::V => (self.row(j - 1) + column, &self.above_v),
        };
        let rock = [before, own].map(|at| &self.rock[at..at + n]);
        Beside { rock, after: &after[own..own + n] }
    }

    /// Whether any of a cell's faces is closed, or a part of it.
    #[inline(always)]
    pub fn has_wall(&self, grid: &MacGrid, k: usize) -> bool {
        let [own, above] = [k, k + grid.stride].map(|k| self.row(k / grid.stride) + k % grid.stride);
        let open = self.open_u[own] + self.open_u[own + 1] + self.open_v[own] + self.open_v[above];
        open < 4.0 - ROUNDING
    }

    /// Away from the closed faces of a cell: the difference of the open shares along x and along y.
    #[inline(always)]
    pub fn away(&self, grid: &MacGrid, k: usize) -> Vec2 {
        let [own, above] = [k, k + grid.stride].map(|k| self.row(k / grid.stride) + k % grid.stride);
        Vec2::new(self.open_u[own + 1] - self.open_u[own], self.open_v[above] - self.open_v[own])
    }

    fn fields(&self) -> [&Vec<f32>; 6] {
        let Self { open_u, open_v, rock, right_of_u, above_v, liquid_from, .. } = self;
        [open_u, open_v, rock, right_of_u, above_v, liquid_from]
    }

    fn fields_mut(&mut self) -> [&mut Vec<f32>; 6] {
        let Self { open_u, open_v, rock, right_of_u, above_v, liquid_from, .. } = self;
        [open_u, open_v, rock, right_of_u, above_v, liquid_from]
    }

    /// Takes what is in a window from others whose rows stand one by one. Rows that are like the one below them are stored only once.
    fn take(&mut self, grid: &MacGrid, window: &Window, fresh: Self) {
        if *window == grid.all() {
            // There may be nothing yet, or another grid's.
            *self = Self { outline: std::mem::take(&mut self.outline), ..Self::default() };
        }
        let mut merged: [Vec<f32>; 6] = Default::default();
        let mut rows = Vec::with_capacity(grid.rows + 3);
        let mut row = vec![0.0; grid.stride];
        let mut stored = 0;
        for j in 0..grid.rows + 3 {
            let own = self.rows.get(j).map(|own| *own as usize);
            for ((merged, old), new) in merged.iter_mut().zip(self.fields()).zip(fresh.fields()) {
                if let Some(own) = own {
                    row.copy_from_slice(&old[own..own + grid.stride]);
                }
                if window.rows.contains(&j) {
                    let columns = window.columns.clone();
                    row[columns.clone()].copy_from_slice(&new[grid.row(j)..][columns]);
                }
                merged.extend_from_slice(&row);
            }
            let next = stored + grid.stride;
            if j > 0 && merged.iter().all(|field| field[stored..next] == field[next..]) {
                merged.iter_mut().for_each(|field| field.truncate(next));
            } else if j > 0 {
                stored = next;
            }
            rows.push(stored as u32);
        }
        self.rows = rows;
        for (field, merged) in self.fields_mut().into_iter().zip(merged) {
            *field = merged;
            field.shrink_to_fit();
        }
        let is_old = |cell: u32| !window.has(grid, cell as usize);
        let Self { beside_walls, slivers, behind, .. } = self;
        beside_walls.retain(|cell| is_old(*cell));
        beside_walls.extend(fresh.beside_walls.iter().filter(|cell| !is_old(**cell)));
        beside_walls.sort_unstable();
        slivers.retain(|sliver| is_old(sliver.cell));
        slivers.extend(fresh.slivers.iter().filter(|sliver| !is_old(sliver.cell)));
        slivers.sort_unstable_by_key(|sliver| sliver.cell);
        behind.retain(|one| is_old(one.cell));
        behind.extend(fresh.behind.iter().filter(|one| !is_old(one.cell)));
        behind.sort_unstable_by_key(|one| one.cell);
    }

    /// What rock closes in a window; near its edge, and beyond it, other than it is.
    fn built(grid: &MacGrid, solids: &Solids, down: IVec2, window: &Window) -> Self {
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
    fn smear_rock(&mut self, grid: &MacGrid, solids: &Solids, parts: &Parts, window: &Window) {
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
    fn add_rock(&mut self, grid: &MacGrid, at: Vec2) {
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

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let fields = [&self.open_u, &self.open_v, &self.rock, &self.right_of_u, &self.above_v, &self.liquid_from];
        4 * (fields.map(Vec::capacity).iter().sum::<usize>() + self.rows.capacity() + self.beside_walls.capacity())
            + self.outline.memory()
            + size_of::<Sliver>() * self.slivers.capacity()
            + size_of::<MakeUp>() * self.behind.capacity()
    }
}

/// The rock around some faces of a row.
#[derive(Clone, Copy)]
pub(super) struct Beside<'a> {
    /// Share of rock of the cells before the faces, and of those after them.
    pub rock: [&'a [f32]; 2],
    /// Of both, what stands after the face.
    pub after: &'a [f32],
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

/// −1, 0 or 1.
fn sign(number: f32) -> i32 {
    i32::from(number > 0.0) - i32::from(number < 0.0)
}

/// The face that a share of matter at the face `(column, row)` belongs to, and the share: what was shared out beyond a wall of the box
/// belongs to this side of it, and a face on the wall sees only half of its surroundings.
fn fold(grid: &MacGrid, axis: Axis, (column, row): (usize, usize), share: f32) -> (usize, usize, f32) {
    let (column, row, on_wall) = match axis {
        Axis::U => (column, row.clamp(1, grid.rows), column == 1 || column == grid.columns + 1),
        Axis::V => (column.clamp(1, grid.columns), row, row == 1 || row == grid.rows + 1),
    };
    (column, row, if on_wall { 2.0 * share } else { share })
}

/// What was shared out beyond a wall belongs to this side of it; a face on the wall sees only half of its surroundings.
/// `reached` are the rows that were shared out to, `across` the columns, with the padding.
pub(super) fn fold_at_walls(
    grid: &MacGrid,
    reached: Range<usize>,
    across: Range<usize>,
    u: &mut [[f32; 2]],
    v: &mut [[f32; 2]],
) {
    let fold = |faces: &mut [[f32; 2]], beyond: usize, onto: usize| {
        let [weight, momentum] = faces[beyond];
        faces[onto][0] += weight;
        faces[onto][1] += momentum;
    };
    let double = |face: &mut [f32; 2]| *face = face.map(|deposit| 2.0 * deposit);
    let (s, columns, rows) = (grid.stride, grid.columns, grid.rows);
    for i in across.clone() {
        if reached.start == 0 {
            fold(u, i, s + i);
        }
        if reached.end > rows + 1 {
            fold(u, (rows + 1) * s + i, rows * s + i);
        }
    }
    for j in reached.clone() {
        if across.start == 0 {
            fold(v, j * s, j * s + 1);
            double(&mut u[j * s + 1]);
        }
        if across.end == s {
            fold(v, j * s + columns + 1, j * s + columns);
            double(&mut u[j * s + columns + 1]);
        }
    }
    for wall in [1, rows + 1].into_iter().filter(|wall| reached.contains(wall)) {
        let cells = across.start.max(1)..across.end.min(columns + 1);
        v[wall * s..][cells].iter_mut().for_each(double);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{element::ElementId, random::Random};

    #[test]
    fn around_cells_with_an_open_face_no_rock_is_left_out() {
        // A hill, a ball and a thin wall in a box of cells that no cell of rock is a multiple of.
        let (size, mut solids) = (Vec2::new(101.0, 70.0), Solids::new(101, 70));
        let is_rock = |at: Vec2| {
            at.y < 20.0 + 0.3 * at.x || at.distance(Vec2::new(30.0, 50.0)) < 14.0 || (at.x - 70.0).abs() < 1.0
        };
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
        assert!(
            thin.iter().all(|count| *count > 10 * steps),
            "{thin:?} slivers, and cells with something behind walls"
        );
    }
}
