//! Cells of which a thin wall leaves less than half: slivers, open to the cell that their room belongs to, their *host*.
//!
//! How full such a cell is says little of whether it is liquid: matter is smeared over one and a half cells, through a wall that is
//! thinner than that, and what is on one side of it is missed on the other. Of a column of them some were taken for air, and let the
//! water in them fall, for good: in still basins it sprang up along walls two or three particles thick at 1 to 3 m/s. So they go by
//! their hosts.

use crate::predictor::grid::MacGrid;
use glam::IVec2;
use std::ops::Range;

/// Where a sliver lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Beside an upright wall: it is as full as its host, as a surface is level.
    Wall,
    /// Beside a slanting one: it is liquid if its host is.
    Slope,
    /// On a floor: it carries what is above it, and alone it may be a puddle.
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
}

/// What a sliver may miss beyond walls and still go by how full it is itself: in still water that comes and goes by as much.
pub(super) const MOST_MISSING: f32 = 0.05;

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
            Place::Floor => liquid[own] = was.max(liquid[host]),
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
            let sliver = Sliver { cell: own as u32, host: host as u32, place };
            follow_hosts(&[sliver], &grid, (&(1..5), &(1..5)), [&mut filled, &mut liquid, &mut solution]);
            [filled[own], liquid[own], solution[own]]
        };
        assert_eq!(follow(Place::Wall, [0.25, 0.75], [0.0, 1.0]), [0.75, 1.0, 7.0]);
        assert_eq!(follow(Place::Wall, [0.75, 0.25], [1.0, 0.0]), [0.25, 0.0, 0.0]);
        assert_eq!(follow(Place::Slope, [0.25, 0.75], [0.0, 1.0]), [0.25, 1.0, 7.0]);
        // A puddle stays one.
        assert_eq!(follow(Place::Floor, [0.75, 0.25], [1.0, 0.0]), [0.75, 1.0, 0.0]);
        assert_eq!(follow(Place::Floor, [0.25, 1.0], [0.0, 1.0]), [0.25, 1.0, 7.0]);
    }
}
