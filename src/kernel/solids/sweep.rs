//! Collision with the cells of rock.

use super::{Solids, bit};
use crate::simd::{padded, truncated};
use glam::{IVec2, Vec2};

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
        self.slide(from, to)
    }

    /// [`Solids::sweep`] where rock may be on the way.
    fn slide(&self, from: Vec2, to: Vec2) -> Vec2 {
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
                let ([left, right], [bottom, top]) = (room(from.x, cell.x), room(from.y, cell.y));
                return Some(if vertical {
                    let point = Vec2::new(if step.x > 0 { right } else { left }, hit.y.clamp(bottom, top));
                    (point, Vec2::new(point.x, to.y))
                } else {
                    let point = Vec2::new(hit.x.clamp(left, right), if step.y > 0 { top } else { bottom });
                    (point, Vec2::new(to.x, point.y))
                });
            }
            cell = next;
        }
        None
    }

    /// [`Solids::sweep`] of many points at once: leaves in `to` where they end. Returns whether any was stopped or turned.
    #[inline(always)]
    pub(crate) fn sweep_all(&self, [from_x, from_y]: [&[f32]; 2], [to_x, to_y]: [&mut [f32]; 2]) -> bool {
        let mut is_turned = false;
        let from = from_x.chunks(BLOCK).zip(from_y.chunks(BLOCK));
        for ((from_x, from_y), (to_x, to_y)) in from.zip(to_x.chunks_mut(BLOCK).zip(to_y.chunks_mut(BLOCK))) {
            let (blocked, is_any) = self.blocked([from_x, from_y].map(padded), [&*to_x, to_y].map(padded));
            if !is_any {
                continue;
            }
            for k in (0..from_x.len()).filter(|k| blocked[*k] != 0) {
                let aim = Vec2::new(to_x[k], to_y[k]);
                let to = self.sweep(Vec2::new(from_x[k], from_y[k]), aim);
                is_turned |= to != aim;
                (to_x[k], to_y[k]) = (to.x, to.y);
            }
        }
        is_turned
    }

    /// Which ways of a block may meet rock or leave the box, not 0 for those, and whether there is any. They are looked at side by
    /// side; one from 0 to 0 goes nowhere.
    #[inline(always)]
    fn blocked(&self, [from_x, from_y]: [[f32; BLOCK]; 2], [to_x, to_y]: [[f32; BLOCK]; 2]) -> ([u16; BLOCK], bool) {
        let (mut places, mut ways, mut blocked) = ([0; BLOCK], [0; BLOCK], [0; BLOCK]);
        for k in 0..BLOCK {
            (places[k], ways[k]) = self.way([from_x[k], from_y[k]], [to_x[k], to_y[k]]);
        }
        let mut any = 0;
        for k in 0..BLOCK {
            blocked[k] =
                self.near.get(places[k] as usize).map_or(ANY, |near| near | OUT) & PASSED[ways[k] as usize & 15];
            any |= blocked[k];
        }
        (blocked, any != 0)
    }

    /// Where the cell that a way begins in is stored, and which of [`PASSED`] it takes.
    #[inline(always)]
    fn way(&self, from: [f32; 2], to: [f32; 2]) -> (u32, u32) {
        let is_inside = |[x, y]: [f32; 2]| (x >= 0.0) & (y >= 0.0) & (x < self.columns as f32) & (y < self.rows as f32);
        let ([column, row], [to_column, to_row]) = (from.map(truncated), to.map(truncated));
        let [x, y] = [to_column.wrapping_sub(column).wrapping_add(1), to_row.wrapping_sub(row).wrapping_add(1)];
        let is_short = is_inside(from) & is_inside(to) & (x < 3) & (y < 3);
        (self.place(from), if is_short { 3 * y + x } else { FAR })
    }
}

/// Where in a cell a coordinate may come to rest that sets out at `from`: off its faces by the gap, or by as much as it was if
/// that is less. What lies nearer is not pushed back: over the time of a substep even that little is a speed.
fn room(from: f32, cell: i32) -> [f32; 2] {
    let [low, high] = [cell as f32 + FACE_GAP, (cell + 1) as f32 - FACE_GAP];
    if from.floor() == cell as f32 { [low.min(from), high.max(from)] } else { [low, high] }
}

/// Points that are looked at side by side.
const BLOCK: usize = 16;
/// In the set of what a way passes: more than the cells around.
const OUT: u16 = 1 << 15;
/// All of such a set.
const ANY: u16 = u16::MAX;
/// The way in [`PASSED`] that leads further than to a cell around.
const FAR: u32 = 9;

/// What may stop a way into each of the cells around, row by row: those between that and its own, which it leaves at any rate.
const PASSED: [u16; 16] = {
    let mut passed = [OUT; 16];
    let mut way = 0;
    while way < 9 {
        let (x, y) = (way % 3 - 1, way / 3 - 1);
        passed[way as usize] = (bit(x, 0) | bit(0, y) | bit(x, y)) & !bit(0, 0);
        way += 1;
    }
    passed
};

#[cfg(test)]
mod tests {
    use super::{super::tests::with_rock, *};
    use crate::{element::ElementId, random::Random};

    #[test]
    fn nothing_tunnels_through_a_wall_one_cell_thick() {
        let wall: Vec<(i32, i32)> = (0..100).map(|y| (50, y)).collect();
        let solids = with_rock(&wall);
        let mut random = Random::new(7);
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

    #[test]
    fn a_point_that_lies_close_to_a_face_is_not_pushed_back_from_it() {
        let solids = with_rock(&[(5, 5), (4, 6), (3, 5)]);
        let close = 0.1 * FACE_GAP;
        for (from, way, expected) in [
            (Vec2::new(5.0 - close, 5.5), Vec2::new(0.1, 0.2), Vec2::new(0.0, 0.2)),
            (Vec2::new(4.0 + close, 5.5), Vec2::new(-0.1, 0.2), Vec2::new(0.0, 0.2)),
            (Vec2::new(4.5, 6.0 - close), Vec2::new(0.2, 0.1), Vec2::new(0.2, 0.0)),
            // Into a corner, close to both its faces.
            (Vec2::new(5.0, 6.0) - close, Vec2::new(0.1, 0.2), Vec2::ZERO),
            (Vec2::new(4.0 + close, 6.0 - close), Vec2::new(-0.2, 0.1), Vec2::ZERO),
        ] {
            let moved = solids.sweep(from, from + way) - from;
            assert!((moved - expected).length() < 1e-6, "{from} was moved by {moved}, not {expected}");
        }
    }

    #[test]
    fn many_ways_at_once_end_where_each_would() {
        let mut random = Random::new(11);
        let mut solids = with_rock(&[]);
        for turn in 0..400 {
            // Rock comes and goes.
            let cell = IVec2::new(random.below(100) as i32, random.below(100) as i32);
            let _ = solids.insert(cell, ElementId(0), turn) || solids.remove(cell);
            let mut point = || Vec2::new(random.share(), random.share());
            let ways = [(); 50].map(|()| (100.0 * point(), 12.0 * (point() - 0.5)));
            let (from_x, from_y) = (ways.map(|(from, _)| from.x), ways.map(|(from, _)| from.y));
            let aims = ways.map(|(from, way)| from + way);
            let (mut to_x, mut to_y) = (aims.map(|to| to.x), aims.map(|to| to.y));
            let is_turned = solids.sweep_all([&from_x, &from_y], [&mut to_x, &mut to_y]);
            let ends = ways.map(|(from, way)| match Solids::cell_of(from) == Solids::cell_of(from + way) {
                true => from + way,
                false => solids.slide(from, from + way),
            });
            assert_eq!((to_x, to_y), (ends.map(|end| end.x), ends.map(|end| end.y)));
            assert_eq!(is_turned, ends != aims);
        }
    }
}
