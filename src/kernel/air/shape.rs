//! What follows from the rock: which faces let air through, where a diagonal share strikes a corner of rock, and which
//! cells belong to one room. Made anew when the rock changes.

use super::grid::Air;

/// A cell beside a corner of rock, which takes half of each share that would go from one of its four neighbours
/// diagonally into that rock. (The other half goes to the cell on the other side.)
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) target: u32,
    /// Which shares: bit `2·SIDE + END`. SIDE is the neighbour that they come from, left 0, right 1, below 2, above 3;
    /// END is 0 for the share that goes to the smaller coordinate across (down or left), 1 for the other.
    pub(super) shares: u8,
}

/// Faces, corners and rooms of a grid.
#[derive(Debug)]
pub(super) struct Shape {
    /// 1 where the left face of a cell lets air through, else 0, with the ring.
    pub(super) open_x: Vec<f32>,
    /// 1 where the lower face of a cell lets air through, else 0, with the ring.
    pub(super) open_y: Vec<f32>,
    /// Corners in the order of their targets, at most one a cell.
    corners: Vec<Corner>,
    corner_start: Vec<u32>,
    /// Solid cells into which a corner's share would go.
    struck: Vec<u32>,
    struck_start: Vec<u32>,
    /// Room of each cell, `u32::MAX` in rock and in the ring.
    pub(super) room: Vec<u32>,
    /// For each room: whether it has an open side of the box.
    pub(super) room_open: Vec<bool>,
}

impl Shape {
    pub(super) fn new(air: &Air) -> Self {
        let stride = air.stride();
        let (columns, rows) = (air.columns(), air.rows());
        let cells = air.solid.len();
        let mut shape = Self {
            open_x: vec![0.0; cells],
            open_y: vec![0.0; cells],
            corners: Vec::new(),
            corner_start: vec![0; rows + 3],
            struck: Vec::new(),
            struck_start: vec![0; rows + 3],
            room: vec![u32::MAX; cells],
            room_open: Vec::new(),
        };
        let open = air.params.open;
        for row in 1..=rows {
            for column in 1..=columns + 1 {
                let k = row * stride + column;
                let free = match column {
                    1 => open.left && !air.solid[k],
                    _ if column == columns + 1 => open.right && !air.solid[k - 1],
                    _ => !air.solid[k] && !air.solid[k - 1],
                };
                shape.open_x[k] = f32::from(u8::from(free));
            }
        }
        for row in 1..=rows + 1 {
            for column in 1..=columns {
                let k = row * stride + column;
                let free = match row {
                    1 => open.bottom && !air.solid[k],
                    _ if row == rows + 1 => open.top && !air.solid[k - stride],
                    _ => !air.solid[k] && !air.solid[k - stride],
                };
                shape.open_y[k] = f32::from(u8::from(free));
            }
        }
        shape.find_corners(air);
        shape.find_rooms(air);
        shape
    }

    /// Corners whose target is in a row (counted with the ring).
    pub(super) fn corners(&self, row: usize) -> &[Corner] {
        &self.corners[self.corner_start[row] as usize..self.corner_start[row + 1] as usize]
    }

    /// Struck cells of a row (counted with the ring).
    pub(super) fn struck(&self, row: usize) -> &[u32] {
        &self.struck[self.struck_start[row] as usize..self.struck_start[row + 1] as usize]
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.open_x.len() * 12 + self.corners.len() * size_of::<Corner>() + self.struck.len() * 4
    }

    /// Looks at each open cell as a target: its neighbour on a side sends it half a share when the face between them is
    /// open, the cell across from the neighbour is rock, and the neighbour's own face on that side is open.
    fn find_corners(&mut self, air: &Air) {
        let (stride, columns, rows) = (air.stride(), air.columns(), air.rows());
        let face_x = |shape: &Self, k: usize, high: usize| shape.open_x[k + high] != 0.0;
        let face_y = |shape: &Self, k: usize, high: usize| shape.open_y[k + high * stride] != 0.0;
        for row in 1..=rows {
            for column in 1..=columns {
                let target = row * stride + column;
                let mut shares = 0_u8;
                for end in [0, 1] {
                    // Rock above or below the target: from the left and the right.
                    let struck = if end == 1 { target + stride } else { target - stride };
                    for (side, source) in [(0, target - 1), (1, target + 1)] {
                        let strikes = face_x(self, target, side) && face_y(self, source, end) && air.solid[struck];
                        shares |= u8::from(strikes) << (2 * side + end);
                    }
                    // Rock left or right of it: from below and above.
                    let struck = if end == 1 { target + 1 } else { target - 1 };
                    for (side, source) in [(2, target - stride), (3, target + stride)] {
                        let strikes = face_y(self, target, side - 2) && face_x(self, source, end) && air.solid[struck];
                        shares |= u8::from(strikes) << (2 * side + end);
                    }
                }
                if shares != 0 {
                    self.corners.push(Corner { target: target as u32, shares });
                }
                if air.solid[target] && self.is_struck(air, target) {
                    self.struck.push(target as u32);
                }
            }
        }
        for row in 0..rows + 3 {
            let first = |index: u32| (index as usize) / stride < row;
            self.corner_start[row] = self.corners.partition_point(|corner| first(corner.target)) as u32;
            self.struck_start[row] = self.struck.partition_point(|struck| first(*struck)) as u32;
        }
    }

    /// Whether a diagonal neighbour of a cell can send shares both ways around it.
    fn is_struck(&self, air: &Air, k: usize) -> bool {
        let stride = air.stride();
        [(false, false), (false, true), (true, false), (true, true)].into_iter().any(|(right, above)| {
            let row = if above { k + stride } else { k - stride };
            let source = if right { row + 1 } else { row - 1 };
            let sideways = if right { source } else { source + 1 };
            let upright = if above { source } else { source + stride };
            !air.solid[source] && self.open_x[sideways] != 0.0 && self.open_y[upright] != 0.0
        })
    }

    fn find_rooms(&mut self, air: &Air) {
        let stride = air.stride();
        let mut queue = Vec::new();
        for seed in 0..air.solid.len() {
            if air.solid[seed] || self.room[seed] != u32::MAX {
                continue;
            }
            let room = self.room_open.len() as u32;
            self.room[seed] = room;
            queue.push(seed);
            let mut open = false;
            while let Some(k) = queue.pop() {
                let faces = [
                    (self.open_x[k], k - 1),
                    (self.open_x[k + 1], k + 1),
                    (self.open_y[k], k - stride),
                    (self.open_y[k + stride], k + stride),
                ];
                for (_, next) in faces.into_iter().filter(|(free, _)| *free != 0.0) {
                    if air.solid[next] {
                        open = true;
                    } else if self.room[next] == u32::MAX {
                        self.room[next] = room;
                        queue.push(next);
                    }
                }
            }
            self.room_open.push(open);
        }
    }
}
