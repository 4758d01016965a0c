//! Rock: fixed particles that stand on the sites of the square lattice of spacing d, one site a cell.
//!
//! A cell with rock is solid as a whole, `[i, i+1) × [j, j+1)` in d. Water collides with the cells (`sweep`), and
//! the solver reads the particles at their centres for density.

mod strides;
mod sweep;

pub(crate) use strides::{STRIDE, Stride};

use crate::{element::ElementId, simd::truncated};
use glam::{IVec2, Vec2};
use std::ops::Range;

const EMPTY: u8 = u8::MAX;

/// What stands for a cell in the set of those around another, at a step of −1 … 1 in both coordinates.
const fn bit(x: i32, y: i32) -> u16 {
    1 << (3 * (y + 1) + x + 1)
}

/// Which cells of the box are rock. Cells outside the box count as solid. What is kept of cells is empty as long as there has been
/// no rock.
#[derive(Debug, Default, PartialEq)]
pub struct Solids {
    columns: i32,
    rows: i32,
    element: Vec<u8>,
    id: Vec<u32>,
    /// Heat, quanta; empty as long as there has been none.
    heat: Vec<i32>,
    /// For each cell which of those around it are rock ([`bit`]).
    near: Vec<u16>,
    count: usize,
    version: u64,
    shape: u64,
}

impl Clone for Solids {
    fn clone(&self) -> Self {
        let mut clone = Self::default();
        clone.clone_from(self);
        clone
    }

    /// Without new memory where the old is enough; a derived one would ask for it.
    fn clone_from(&mut self, other: &Self) {
        let Self { columns, rows, element, id, heat, near, count, version, shape } = self;
        (*columns, *rows, *count) = (other.columns, other.rows, other.count);
        (*version, *shape) = (other.version, other.shape);
        element.clone_from(&other.element);
        id.clone_from(&other.id);
        heat.clone_from(&other.heat);
        near.clone_from(&other.near);
    }
}

impl Solids {
    /// A box of `columns × rows` cells without rock.
    pub fn new(columns: u32, rows: u32) -> Self {
        Self { columns: columns as i32, rows: rows as i32, ..Self::default() }
    }

    /// Cells along x.
    pub fn columns(&self) -> i32 {
        self.columns
    }

    /// Cells along y.
    pub fn rows(&self) -> i32 {
        self.rows
    }

    /// Number of rock particles.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.element.capacity() + 2 * self.near.capacity() + 4 * (self.id.capacity() + self.heat.capacity())
    }

    /// Changes with every change of the rock, so that what is derived from it knows when to follow.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Changes with every change of where rock is, and not with what it is.
    pub fn shape(&self) -> u64 {
        self.shape
    }

    /// The cell of a point in d.
    pub fn cell_of(position: Vec2) -> IVec2 {
        // Without a call of `floor`, which not every processor has in hardware.
        let floor = |at: f32| {
            let whole = at as i32;
            whole.saturating_sub(i32::from(at < whole as f32))
        };
        IVec2::new(floor(position.x), floor(position.y))
    }

    /// Whether the cell is in the box.
    pub fn contains(&self, cell: IVec2) -> bool {
        cell.x >= 0 && cell.y >= 0 && cell.x < self.columns && cell.y < self.rows
    }

    fn index(&self, cell: IVec2) -> Option<usize> {
        self.contains(cell).then(|| cell.y as usize * self.columns as usize + cell.x as usize)
    }

    /// Where the rock in the cell is stored.
    fn rock(&self, cell: IVec2) -> Option<usize> {
        self.index(cell).filter(|k| self.is_rock(*k))
    }

    #[inline(always)]
    fn is_rock(&self, k: usize) -> bool {
        self.element.get(k).is_some_and(|element| *element != EMPTY)
    }

    /// Whether water and air can't be there: rock, or outside the box.
    pub fn is_solid(&self, cell: IVec2) -> bool {
        self.index(cell).is_none_or(|k| self.is_rock(k))
    }

    /// Whether there is rock on all four sides of a cell. Beyond the box it is not known.
    #[inline(always)]
    pub(crate) fn is_enclosed(&self, cell: IVec2) -> bool {
        const SIDES: u16 = bit(-1, 0) | bit(1, 0) | bit(0, -1) | bit(0, 1);
        self.index(cell).and_then(|k| self.near.get(k)).is_some_and(|near| near & SIDES == SIDES)
    }

    /// Whether there is rock in a cell and in all that are up to two away from it along each side. Beyond the box it is not known.
    pub(crate) fn is_deep(&self, cell: IVec2) -> bool {
        const ALL: u16 = (1 << 9) - 1;
        let corners = [(-1, -1), (1, -1), (-1, 1), (1, 1)].map(|(x, y)| self.index(cell + IVec2::new(x, y)));
        corners.into_iter().all(|corner| corner.and_then(|k| self.near.get(k)).is_some_and(|near| *near == ALL))
    }

    /// How many of some cells are solid.
    pub(crate) fn count_solid(&self, columns: Range<i32>, rows: Range<i32>) -> usize {
        let inside =
            |range: &Range<i32>, all: i32| range.start.clamp(0, all) as usize..range.end.clamp(0, all) as usize;
        let (across, up) = (inside(&columns, self.columns), inside(&rows, self.rows));
        let outside = columns.len() * rows.len() - across.len() * up.len();
        let rock = |row: usize| {
            let first = row * self.columns as usize;
            let cells = self.element.get(first + across.start..first + across.end).unwrap_or_default();
            cells.iter().filter(|element| **element != EMPTY).count()
        };
        outside + up.map(rock).sum::<usize>()
    }

    /// The rock in the cell: its element and id.
    pub fn get(&self, cell: IVec2) -> Option<(ElementId, u32)> {
        self.rock(cell).map(|k| (ElementId(self.element[k]), self.id[k]))
    }

    /// Puts rock into a free cell of the box; `false` if the cell is taken or outside.
    pub fn insert(&mut self, cell: IVec2, element: ElementId, id: u32) -> bool {
        let Some(k) = self.index(cell) else { return false };
        if self.is_rock(k) {
            return false;
        }
        if self.element.is_empty() {
            let cells = self.columns as usize * self.rows as usize;
            (self.element, self.id, self.near) = (vec![EMPTY; cells], vec![0; cells], vec![0; cells]);
        }
        self.element[k] = element.0;
        self.id[k] = id;
        self.count += 1;
        (self.version, self.shape) = (self.version + 1, self.shape + 1);
        self.note_near(cell, true);
        true
    }

    /// Takes the rock out of the cell; `false` if there was none.
    pub fn remove(&mut self, cell: IVec2) -> bool {
        let Some(k) = self.rock(cell) else { return false };
        self.element[k] = EMPTY;
        if let Some(heat) = self.heat.get_mut(k) {
            *heat = 0;
        }
        self.count -= 1;
        (self.version, self.shape) = (self.version + 1, self.shape + 1);
        self.note_near(cell, false);
        true
    }

    /// Makes the rock in the cell another element's; it keeps its id and its heat. `false` if there is none.
    pub fn replace(&mut self, cell: IVec2, element: ElementId) -> bool {
        let Some(k) = self.rock(cell) else { return false };
        self.element[k] = element.0;
        self.version += 1;
        true
    }

    /// Whether there is rock at a point (d) in the box. Of others nothing is known.
    #[inline(always)]
    pub(crate) fn is_rock_at(&self, at: [f32; 2]) -> bool {
        self.near.get(self.place(at) as usize).is_some_and(|near| near & bit(0, 0) != 0)
    }

    /// Where the cell of a point (d) in the box is stored. Of others nothing is known.
    #[inline(always)]
    fn place(&self, [x, y]: [f32; 2]) -> u32 {
        truncated(y).wrapping_mul(self.columns as u32).wrapping_add(truncated(x))
    }

    /// Notes at the cells around one whether it is rock.
    fn note_near(&mut self, cell: IVec2, is_rock: bool) {
        for step in (-1..=1).flat_map(|y| (-1..=1).map(move |x| IVec2::new(x, y))) {
            let Some(k) = self.index(cell + step) else { continue };
            let bit = bit(-step.x, -step.y);
            self.near[k] = if is_rock { self.near[k] | bit } else { self.near[k] & !bit };
        }
    }

    /// Heat that the rock in the cell holds beyond what its element holds at the room's temperature, quanta; 0 where is none.
    pub fn heat(&self, cell: IVec2) -> i32 {
        self.index(cell).and_then(|k| self.heat.get(k)).copied().unwrap_or_default()
    }

    /// Gives the rock in the cell this heat, quanta. Nothing where is none.
    pub fn set_heat(&mut self, cell: IVec2, heat: i32) {
        let Some(k) = self.rock(cell) else { return };
        if self.heat.is_empty() && heat != 0 {
            self.heat = vec![0; self.element.len()];
        }
        if let Some(held) = self.heat.get_mut(k) {
            *held = heat;
        }
    }

    /// Heat of all cells, row by row from the bottom, quanta; empty if there has been none.
    pub fn heats(&self) -> &[i32] {
        &self.heat
    }

    /// All rock, row by row from the bottom: cell, element, id. Of this kind of iterator `for_each` is faster than a loop.
    pub fn iter(&self) -> impl Iterator<Item = (IVec2, ElementId, u32)> + '_ {
        self.strides().flat_map(move |stride| {
            let (first, sites) = (stride.first, stride.sites());
            sites.filter_map(move |(k, element)| {
                let cell = IVec2::new(first.x + k as i32, first.y);
                element.map(|element| (cell, element, self.id[stride.place + k]))
            })
        })
    }

    /// The cells with rock in some columns and rows, row by row from the bottom.
    pub(crate) fn iter_in(&self, [across, up]: [Range<i32>; 2]) -> impl Iterator<Item = IVec2> + '_ {
        let clamp = |range: Range<i32>, all: i32| range.start.clamp(0, all)..range.end.clamp(0, all);
        let (across, up) = (clamp(across, self.columns), clamp(up, self.rows));
        let rows = up.filter(|_| !self.element.is_empty());
        rows.flat_map(move |y| {
            let first = y as usize * self.columns as usize;
            let row = &self.element[first + across.start as usize..first + across.end as usize];
            let rock = across.clone().zip(row).filter(|(_, element)| **element != EMPTY);
            rock.map(move |(x, _)| IVec2::new(x, y))
        })
    }
}

/// A cell that sticks out of the box by no more than this is inside, d.
const SLACK: f32 = 1e-3;

/// Whether all of a cell is in a box of `size` d. Rock may stand in a cell that the box cuts; what moves would be pushed
/// out of it, and does not fit.
pub fn is_whole(cell: IVec2, size: Vec2) -> bool {
    (cell + 1).as_vec2().cmple(size + SLACK).all()
}

/// Centre of a cell, d: where its rock particle stands.
pub fn centre(cell: IVec2) -> Vec2 {
    cell.as_vec2() + Vec2::splat(0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    pub(super) fn with_rock(cells: &[(i32, i32)]) -> Solids {
        let mut solids = Solids::new(100, 100);
        for (id, &(x, y)) in cells.iter().enumerate() {
            assert!(solids.insert(IVec2::new(x, y), ElementId(0), id as u32));
        }
        solids
    }

    #[test]
    fn a_box_without_rock_holds_nothing_of_its_cells() {
        let mut solids = Solids::new(1000, 1000);
        let middle = IVec2::splat(500);
        assert!(!solids.is_solid(middle) && solids.is_solid(IVec2::new(-1, 3)) && solids.iter().next().is_none());
        assert!(solids.get(middle).is_none() && !solids.remove(middle) && !solids.is_rock_at([500.5; 2]));
        assert_eq!(solids.memory(), 0);
        assert!(solids.insert(middle, ElementId(1), 7) && solids.is_rock_at([500.5; 2]));
        assert!(solids.memory() >= 7_000_000, "an element, an id and what is near for each cell");
    }

    #[test]
    fn count_and_version_follow_the_rock() {
        let mut solids = with_rock(&[(3, 4)]);
        let version = solids.version();
        assert!(!solids.insert(IVec2::new(3, 4), ElementId(1), 9), "a taken cell was taken again");
        assert!(!solids.insert(IVec2::new(-1, 4), ElementId(1), 9), "rock was put outside the box");
        assert_eq!((solids.count(), solids.version()), (1, version));
        assert_eq!(solids.get(IVec2::new(3, 4)), Some((ElementId(0), 0)));
        assert!(solids.remove(IVec2::new(3, 4)) && !solids.remove(IVec2::new(3, 4)));
        assert_eq!(solids.count(), 0);
        assert_ne!(solids.version(), version);
    }

    #[test]
    fn rock_is_found_row_by_row_wherever_it_stands() {
        let mut solids = Solids::new(37, 3);
        let cells = [(0, 0), (15, 0), (16, 0), (36, 0), (31, 2), (32, 2), (36, 2)];
        for (id, (x, y)) in cells.iter().enumerate().rev() {
            assert!(solids.insert(IVec2::new(*x, *y), ElementId(id as u8), id as u32));
        }
        let found: Vec<_> = solids.iter().collect();
        let expected = cells.iter().enumerate();
        let expected = expected.map(|(id, (x, y))| (IVec2::new(*x, *y), ElementId(id as u8), id as u32));
        assert_eq!(found, expected.collect::<Vec<_>>());
        for columns in [-2..1, 14..17, 30..40, 5..5, 40..42] {
            for rows in [-1..1, 0..3, 2..5] {
                let counted = rows.clone().flat_map(|y| columns.clone().map(move |x| IVec2::new(x, y)));
                let counted = counted.filter(|cell| solids.is_solid(*cell)).count();
                assert_eq!(solids.count_solid(columns.clone(), rows), counted, "columns {columns:?}");
            }
        }
        assert_eq!(Solids::new(5, 5).count_solid(-1..3, 0..5), 5);
    }

    #[test]
    fn what_is_around_a_cell_is_known() {
        let mut random = Random::new(5);
        for share in [2, 4, 16] {
            let mut solids = Solids::new(37, 30);
            for y in 0..30 {
                for x in 0..37 {
                    if random.below(share * share) > 0 {
                        solids.insert(IVec2::new(x, y), ElementId(0), 0);
                    }
                }
            }
            let is_rock = |cell: IVec2| solids.get(cell).is_some();
            let (mut deep, mut enclosed) = (0, 0);
            for cell in (0..30).flat_map(|y| (0..37).map(move |x| IVec2::new(x, y))) {
                let square = (-2..=2).flat_map(|y| (-2..=2).map(move |x| IVec2::new(x, y)));
                assert_eq!(solids.is_deep(cell), square.clone().all(|step| is_rock(cell + step)), "{cell}");
                let sides = [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y];
                assert_eq!(solids.is_enclosed(cell), sides.into_iter().all(|side| is_rock(cell + side)), "{cell}");
                deep += i32::from(solids.is_deep(cell));
                enclosed += i32::from(solids.is_enclosed(cell));
            }
            assert!(enclosed > 10 && (share < 16 || deep > 10), "{enclosed} enclosed, {deep} deep");
            for ranges in [[-3..5, 2..40], [16..17, 0..30], [40..50, 0..30], [5..5, 0..30]] {
                let [across, up] = ranges.clone();
                let inside = up.flat_map(|y| across.clone().map(move |x| IVec2::new(x, y)));
                assert!(solids.iter_in(ranges).eq(inside.filter(|cell| is_rock(*cell))));
            }
        }
        assert_eq!(Solids::new(5, 5).iter_in([0..5, 0..5]).count(), 0);
    }

    #[test]
    fn rock_of_another_element_has_the_same_shape() {
        let (mut solids, cell) = (with_rock(&[(3, 4)]), IVec2::new(3, 4));
        solids.set_heat(cell, 5);
        let (version, shape) = (solids.version(), solids.shape());
        assert!(solids.replace(cell, ElementId(2)) && !solids.replace(IVec2::new(4, 4), ElementId(2)));
        assert_eq!((solids.get(cell), solids.heat(cell)), (Some((ElementId(2), 0)), 5));
        assert_eq!((solids.count(), solids.shape()), (1, shape));
        assert_ne!(solids.version(), version);
        solids.remove(cell);
        assert_ne!(solids.shape(), shape);
    }
}
