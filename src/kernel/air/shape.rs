//! What follows from the rock: which faces let air through, where a diagonal share strikes a corner of rock, and which
//! cells belong to one room. Made anew when the rock changes.

use super::grid::Air;

/// A place in a row of sources where diagonal shares strike rock. Each goes in halves to the two cells beside the rock:
/// the one above or below its source, and the one left or right of it. All weights are ½ for a share that strikes, else 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Column, counted with the ring.
    pub(super) column: u32,
    /// Of the shares of the cell here, to the cell above and the cell below: `[up left, up right, down left, down right]`.
    pub(super) upright: [f32; 4],
    /// To the cell here: `[from the left down, from the left up, from the right down, from the right up]`.
    pub(super) sideways: [f32; 4],
}

/// Faces, corners and rooms of a grid.
#[derive(Debug)]
pub(super) struct Shape {
    /// 1 where the left face of a cell lets air through, else 0, with the ring.
    pub(super) open_x: Vec<f32>,
    /// 1 where the lower face of a cell lets air through, else 0, with the ring.
    pub(super) open_y: Vec<f32>,
    /// Corners in the order of the cells.
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

    /// Corners of a row of sources (counted with the ring).
    pub(super) fn corners(&self, row: usize) -> &[Corner] {
        &self.corners[self.corner_start[row] as usize..self.corner_start[row + 1] as usize]
    }

    /// Columns, with the ring, of the solid cells of a row that shares strike.
    pub(super) fn struck(&self, row: usize) -> &[u32] {
        &self.struck[self.struck_start[row] as usize..self.struck_start[row + 1] as usize]
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.open_x.len() * 12 + self.corners.len() * size_of::<Corner>() + self.struck.len() * 4
    }

    fn find_corners(&mut self, air: &Air) {
        let (stride, columns, rows) = (air.stride(), air.columns(), air.rows());
        for row in 0..=rows + 1 {
            self.corner_start[row] = self.corners.len() as u32;
            self.struck_start[row] = self.struck.len() as u32;
            if row == 0 || row > rows {
                continue;
            }
            for column in 1..=columns {
                let k = row * stride + column;
                let weight = |source: usize, right: bool, up: bool| {
                    if self.strikes(air, source, right, up) { 0.5 } else { 0.0 }
                };
                let upright = [(false, false), (true, false), (false, true), (true, true)];
                let [down_left, down_right, up_left, up_right] = upright.map(|(right, up)| weight(k, right, up));
                let upright = [up_left, up_right, down_left, down_right];
                let sideways = [
                    weight(k - 1, true, false),
                    weight(k - 1, true, true),
                    weight(k + 1, false, false),
                    weight(k + 1, false, true),
                ];
                if upright.iter().chain(&sideways).any(|weight| *weight > 0.0) {
                    self.corners.push(Corner { column: column as u32, upright, sideways });
                }
                let below = [(k - stride - 1, true, true), (k - stride + 1, false, true)];
                let above = [(k + stride - 1, true, false), (k + stride + 1, false, false)];
                if below.into_iter().chain(above).any(|(source, right, up)| self.strikes(air, source, right, up)) {
                    self.struck.push(column as u32);
                }
            }
        }
        self.corner_start[rows + 2] = self.corners.len() as u32;
        self.struck_start[rows + 2] = self.struck.len() as u32;
    }

    /// Whether a share of `source` to a diagonal neighbour finds rock there: both faces that it leaves by are open, and
    /// the neighbour is solid. (Outside the box a share is lost, by whichever face it left.)
    fn strikes(&self, air: &Air, source: usize, right: bool, up: bool) -> bool {
        let stride = air.stride();
        let (x, across) = if right { (source + 1, source + 1) } else { (source, source - 1) };
        let (y, across) = if up { (source + stride, across + stride) } else { (source, across - stride) };
        // The rarest first: this is asked twelve times a cell.
        air.solid[across]
            && self.open_x[x] != 0.0
            && self.open_y[y] != 0.0
            && !air.in_ring(source)
            && !air.in_ring(across)
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
