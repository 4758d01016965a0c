//! Rock: fixed particles that stand on the sites of the square lattice of spacing d, one site a cell.
//!
//! A cell with rock is solid as a whole, `[i, i+1) × [j, j+1)` in d. Water collides with the cells (`sweep`), and
//! the solver reads the particles at their centres for density.

use crate::element::ElementId;
use glam::{IVec2, Vec2};

const EMPTY: u8 = u8::MAX;

/// Which cells of the box are rock. Cells outside the box count as solid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solids {
    columns: i32,
    rows: i32,
    element: Vec<u8>,
    /// Empty as long as there has been no rock.
    id: Vec<u32>,
    /// Heat, quanta; empty as long as there has been none.
    heat: Vec<i32>,
    count: usize,
    version: u64,
}

impl Solids {
    /// A box of `columns × rows` cells without rock.
    pub fn new(columns: u32, rows: u32) -> Self {
        let cells = columns as usize * rows as usize;
        Self {
            columns: columns as i32,
            rows: rows as i32,
            element: vec![EMPTY; cells],
            id: Vec::new(),
            heat: Vec::new(),
            count: 0,
            version: 0,
        }
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
        self.element.capacity() + 4 * (self.id.capacity() + self.heat.capacity())
    }

    /// Changes with every change of the rock, so that what is derived from it knows when to follow.
    pub fn version(&self) -> u64 {
        self.version
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

    /// Whether water and air can't be there: rock, or outside the box.
    pub fn is_solid(&self, cell: IVec2) -> bool {
        self.index(cell).is_none_or(|k| self.element[k] != EMPTY)
    }

    /// The rock in the cell: its element and id.
    pub fn get(&self, cell: IVec2) -> Option<(ElementId, u32)> {
        let k = self.index(cell)?;
        (self.element[k] != EMPTY).then(|| (ElementId(self.element[k]), self.id[k]))
    }

    /// Puts rock into a free cell of the box; `false` if the cell is taken or outside.
    pub fn insert(&mut self, cell: IVec2, element: ElementId, id: u32) -> bool {
        let Some(k) = self.index(cell) else { return false };
        if self.element[k] != EMPTY {
            return false;
        }
        if self.id.is_empty() {
            self.id = vec![0; self.element.len()];
        }
        self.element[k] = element.0;
        self.id[k] = id;
        self.count += 1;
        self.version += 1;
        true
    }

    /// Takes the rock out of the cell; `false` if there was none.
    pub fn remove(&mut self, cell: IVec2) -> bool {
        let Some(k) = self.index(cell) else { return false };
        if self.element[k] == EMPTY {
            return false;
        }
        self.element[k] = EMPTY;
        if let Some(heat) = self.heat.get_mut(k) {
            *heat = 0;
        }
        self.count -= 1;
        self.version += 1;
        true
    }

    /// Heat that the rock in the cell holds beyond what its element holds at the room's temperature, quanta; 0 where is none.
    pub fn heat(&self, cell: IVec2) -> i32 {
        self.index(cell).and_then(|k| self.heat.get(k)).copied().unwrap_or_default()
    }

    /// Gives the rock in the cell this heat, quanta. Nothing where is none.
    pub fn set_heat(&mut self, cell: IVec2, heat: i32) {
        let Some(k) = self.index(cell).filter(|k| self.element[*k] != EMPTY) else { return };
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

    /// All rock, row by row from the bottom: cell, element, id.
    pub fn iter(&self) -> impl Iterator<Item = (IVec2, ElementId, u32)> + '_ {
        self.element.iter().enumerate().filter(|(_, element)| **element != EMPTY).map(|(k, element)| {
            let cell = IVec2::new(k as i32 % self.columns, k as i32 / self.columns);
            (cell, ElementId(*element), self.id[k])
        })
    }
}

/// Distance to a face at which a swept point comes to rest, d: keeps it on the right side after rounding.
const FACE_GAP: f32 = 1.0 / 256.0;
/// Faces that one move can be turned at: a corner takes two, the third stops it.
const TURNS: usize = 3;

impl Solids {
    /// Where a point ends that sets out from `from` to `to` and slides along the faces of rock that it meets. Exact at
    /// any speed: every cell on the way is looked at, and a path between two cells that touch at a corner is closed. The
    /// box's own cells stop it too.
    pub fn sweep(&self, from: Vec2, to: Vec2) -> Vec2 {
        if Self::cell_of(from) == Self::cell_of(to) {
            return to;
        }
        let (mut at, mut target) = (from, to);
        for _ in 0..TURNS {
            let Some(turned) = self.first_face(at, target) else { return target };
            (at, target) = turned;
        }
        at
    }

    /// The first face of a solid cell between two points (Amanatides & Woo 1987): the point just before it, and where a
    /// point goes on to along it.
    fn first_face(&self, from: Vec2, to: Vec2) -> Option<(Vec2, Vec2)> {
        let (mut cell, last) = (Self::cell_of(from), Self::cell_of(to));
        let way = to - from;
        let step = IVec2::new(if way.x > 0.0 { 1 } else { -1 }, if way.y > 0.0 { 1 } else { -1 });
        // Share of the way at which the next vertical and horizontal cell edges are crossed.
        let crossing = |from: f32, way: f32, cell: i32, step: i32| {
            if way == 0.0 { f32::INFINITY } else { ((cell + (step + 1) / 2) as f32 - from) / way }
        };
        let cells = (last - cell).abs().element_sum();
        for _ in 0..cells {
            let next_x = if cell.x == last.x { f32::INFINITY } else { crossing(from.x, way.x, cell.x, step.x) };
            let next_y = if cell.y == last.y { f32::INFINITY } else { crossing(from.y, way.y, cell.y, step.y) };
            let vertical = next_x <= next_y;
            let next = if vertical { cell + IVec2::new(step.x, 0) } else { cell + IVec2::new(0, step.y) };
            if self.is_solid(next) {
                let hit = from + way * if vertical { next_x } else { next_y };
                let inside = |at: f32, cell: i32| at.clamp(cell as f32 + FACE_GAP, (cell + 1) as f32 - FACE_GAP);
                let before = |cell: i32, step: i32| (cell + (step + 1) / 2) as f32 - step as f32 * FACE_GAP;
                return Some(if vertical {
                    let point = Vec2::new(before(cell.x, step.x), inside(hit.y, cell.y));
                    (point, Vec2::new(point.x, to.y))
                } else {
                    let point = Vec2::new(inside(hit.x, cell.x), before(cell.y, step.y));
                    (point, Vec2::new(to.x, point.y))
                });
            }
            cell = next;
        }
        None
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

    fn with_rock(cells: &[(i32, i32)]) -> Solids {
        let mut solids = Solids::new(100, 100);
        for (id, &(x, y)) in cells.iter().enumerate() {
            assert!(solids.insert(IVec2::new(x, y), ElementId(0), id as u32));
        }
        solids
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
    fn nothing_tunnels_through_a_wall_one_cell_thick() {
        let wall: Vec<(i32, i32)> = (0..100).map(|y| (50, y)).collect();
        let solids = with_rock(&wall);
        let mut random = crate::random::Random::new(7);
        let mut random = || random.share();
        for _ in 0..10_000 {
            let from = Vec2::new(50.0 * random() * 0.999, 1.0 + 98.0 * random());
            let to = Vec2::new(50.0 + 50.0 * random(), 100.0 * random());
            let end = solids.sweep(from, to);
            assert!(end.x < 50.0, "{from} → {to} ended at {end}");
            assert!(!solids.is_solid(Solids::cell_of(end)));
        }
    }

    #[test]
    fn nothing_slips_between_cells_that_touch_at_a_corner() {
        let wall: Vec<(i32, i32)> = (0..100).map(|k| (k, k)).collect();
        let solids = with_rock(&wall);
        for k in 0..1000 {
            let along = 1.0 + 98.0 * k as f32 / 1000.0;
            let from = Vec2::new(along - 0.9, along + 0.9).clamp(Vec2::splat(0.1), Vec2::splat(99.9));
            if solids.is_solid(Solids::cell_of(from)) {
                continue;
            }
            let end = solids.sweep(from, Vec2::new(along + 0.9, along - 0.9));
            assert!(end.x < end.y + 1.0, "{from} slipped to {end}");
            assert!(!solids.is_solid(Solids::cell_of(end)));
        }
    }

    #[test]
    fn a_point_slides_along_a_face_and_keeps_its_free_moves() {
        let solids = with_rock(&[(5, 5)]);
        assert_eq!(solids.sweep(Vec2::new(1.0, 1.0), Vec2::new(4.0, 9.0)), Vec2::new(4.0, 9.0));
        let end = solids.sweep(Vec2::new(4.5, 5.2), Vec2::new(5.5, 5.7));
        assert!((end.x - 5.0).abs() < 0.01 && (end.y - 5.7).abs() < 1e-6, "{end}");
        let out = solids.sweep(Vec2::new(0.5, 50.5), Vec2::new(-7.0, 51.5));
        assert!(out.x > 0.0 && out.x < 0.01 && out.y == 51.5, "left the box: {out}");
    }
}
