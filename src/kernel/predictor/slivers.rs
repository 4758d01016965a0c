//! Cells of which a thin wall leaves less than half: slivers, open to the cell that their room belongs to, their *host*.
//!
//! How full such a cell is says little of whether it is liquid: matter is smeared over one and a half cells, through a wall that is
//! thinner than that, and what is on one side of it is missed on the other. Of a column of them some were taken for air, and let the
//! water in them fall, for good: in still basins it sprang up along walls two or three particles thick at 1 to 3 m/s. So they go by
//! their hosts.

use crate::{
    predictor::{
        grid::MacGrid,
        stencil::{Axis, faces_around},
    },
    solids::{Solids, centre},
};
use glam::IVec2;
use std::ops::Range;

/// Where a sliver lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Beside an upright wall: it is as full as its host, as a surface is level.
    Wall,
    /// Beside a slanting one: it is liquid if its host is.
    Slope,
    /// On a floor: it carries what is above it, and alone it may be a puddle. What is missed below the floor counts as rock does, or
    /// the density feedback would take it for a gap and press the water above into it.
    Floor,
}

impl Place {
    /// Where a sliver lies from which it is `way` to its host. `down`: where gravity pulls along the axis on which it does most, or 0.
    /// `leads_through`: whether all its rock leads through it across `way`. None under a ceiling, where it goes by itself.
    pub fn new(way: IVec2, down: IVec2, leads_through: bool) -> Option<Self> {
        match way.dot(down) {
            0 if leads_through => Some(Self::Wall),
            0 => Some(Self::Slope),
            ..0 => Some(Self::Floor),
            _ => None,
        }
    }
}

/// A sliver and its host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sliver {
    pub cell: u32,
    pub host: u32,
    pub place: Place,
    /// See [`missing`].
    pub missing: f32,
}

/// What a sliver may miss beyond walls and still go by how full it is itself: in still water that comes and goes by as much.
pub(super) const MOST_MISSING: f32 = 0.05;

/// How much less than full a cell of the grid is where all is that its room leads to: what would be beyond walls.
pub(super) fn missing(grid: &MacGrid, solids: &Solids, k: usize) -> f32 {
    // All that adds to the cell lies within one and a half cells of its middle.
    let (column, row) = (k % grid.stride, k / grid.stride);
    let span = |column: usize, more: f32| {
        let left = (column as f32 - 1.0 - more) * grid.cell;
        left.floor() as i32..(left + (1.0 + 2.0 * more) * grid.cell).ceil() as i32
    };
    let places = |more: f32| {
        let across = span(column, more);
        span(row, more).flat_map(move |y| across.clone().map(move |x| IVec2::new(x, y)))
    };
    let (across, up) = (span(column, 1.0), span(row, 1.0));
    let index = |at: IVec2| ((at.y - up.start) * (across.end - across.start) + at.x - across.start) as usize;
    let mut is_seen: Vec<bool> = places(1.0).map(|at| solids.is_solid(at)).collect();
    let mut next: Vec<IVec2> = places(0.0).filter(|at| !solids.is_solid(*at)).collect();
    next.iter().for_each(|at| is_seen[index(*at)] = true);
    while let Some(at) = next.pop() {
        for other in [at + IVec2::X, at - IVec2::X, at + IVec2::Y, at - IVec2::Y] {
            let is_near = across.contains(&other.x) && up.contains(&other.y);
            if is_near && !std::mem::replace(&mut is_seen[index(other)], true) {
                next.push(other);
            }
        }
    }
    let share = 0.25 * grid.per_cell * grid.per_cell;
    let mut missing = 0.0;
    for at in places(1.0).filter(|at| !is_seen[index(*at)]).map(centre) {
        for axis in [Axis::U, Axis::V] {
            faces_around(grid, at.x, at.y, axis, |column, row, weight| {
                let face = grid.row(row) + column;
                if face == k || face == k + axis.step(grid) {
                    missing += share * weight;
                }
            });
        }
    }
    missing
}

/// Lets slivers in some rows and columns of cells go by their hosts: in how full they are, in whether they are liquid (1), and in the
/// last pressure if they were not. `slivers` stand in the order of their cells.
pub(super) fn follow_hosts(
    slivers: &[Sliver],
    grid: &MacGrid,
    (rows, columns): (&Range<usize>, &Range<usize>),
    [filled, liquid, solution]: [&mut [f32]; 3],
) {
    let place = |sliver: &Sliver| (sliver.cell as usize / grid.stride, sliver.cell as usize % grid.stride);
    let of_rows = slivers.partition_point(|sliver| place(sliver).0 < rows.start)
        ..slivers.partition_point(|sliver| place(sliver).0 < rows.end);
    for sliver in slivers[of_rows].iter().filter(|sliver| columns.contains(&place(sliver).1)) {
        let [own, host] = [sliver.cell, sliver.host].map(|cell| cell as usize);
        let was = liquid[own];
        match sliver.place {
            Place::Wall => (filled[own], liquid[own]) = (filled[host], liquid[host]),
            Place::Slope => liquid[own] = liquid[host],
            Place::Floor => {
                // Where something is below after all, the cell is no fuller for it.
                filled[own] = filled[own].max((filled[own] + sliver.missing).min(1.0));
                liquid[own] = was.max(liquid[host]);
            }
        }
        if liquid[own] != was {
            solution[own] = liquid[own] * solution[host];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn a_sliver_goes_by_its_host_as_far_as_its_place_has_it() {
        let grid = MacGrid::new(Vec2::splat(10.0), 2.5);
        let (own, host) = (grid.row(2) + 2, grid.row(2) + 3);
        // How full a sliver and its host are, and which of them are liquid; then what the sliver is.
        let follow = |place, [own_fill, host_fill]: [f32; 2], [own_liquid, host_liquid]: [f32; 2]| {
            let [mut filled, mut liquid, mut solution] = [(); 3].map(|()| vec![0.0; grid.len()]);
            (filled[own], filled[host]) = (own_fill, host_fill);
            (liquid[own], liquid[host]) = (own_liquid, host_liquid);
            solution[host] = 7.0;
            let sliver = Sliver { cell: own as u32, host: host as u32, place, missing: 0.125 };
            follow_hosts(&[sliver], &grid, (&(1..5), &(1..5)), [&mut filled, &mut liquid, &mut solution]);
            [filled[own], liquid[own], solution[own]]
        };
        assert_eq!(follow(Place::Wall, [0.25, 0.75], [0.0, 1.0]), [0.75, 1.0, 7.0]);
        assert_eq!(follow(Place::Wall, [0.75, 0.25], [1.0, 0.0]), [0.25, 0.0, 0.0]);
        assert_eq!(follow(Place::Slope, [0.25, 0.75], [0.0, 1.0]), [0.25, 1.0, 7.0]);
        // A puddle stays one, what is missed counts, and no more than fills the cell.
        assert_eq!(follow(Place::Floor, [0.75, 0.25], [1.0, 0.0]), [0.875, 1.0, 0.0]);
        assert_eq!(follow(Place::Floor, [0.9375, 1.0], [0.0, 1.0]), [1.0, 1.0, 7.0]);
        assert_eq!(follow(Place::Floor, [1.25, 1.0], [1.0, 1.0]), [1.25, 1.0, 0.0]);
    }
}
