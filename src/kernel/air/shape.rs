//! What follows from the rock: which faces let air through, where a diagonal share strikes a corner of rock, and which
//! cells belong to one room. Made anew when the rock changes.

use super::tiling::Tiling;
use crate::params::OpenSides;

/// A cell at which diagonal shares that strike rock turn aside: each goes in halves to the two cells beside the rock, the
/// one above or below its source and the one left or right of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner<const N: usize> {
    /// Column, counted with the ring.
    pub(super) column: u32,
    /// ½ for a share that strikes, else 0.
    pub(super) weights: [f32; N],
}

/// A list with the items of each row together, rows counted with the ring.
#[derive(Debug)]
pub(super) struct ByRow<T> {
    items: Vec<T>,
    start: Vec<u32>,
}

impl<T> ByRow<T> {
    fn new() -> Self {
        Self { items: Vec::new(), start: vec![0] }
    }

    fn row(&self, row: usize) -> &[T] {
        &self.items[self.start[row] as usize..self.start[row + 1] as usize]
    }

    /// Items of a row that are in the columns after `first`, `width − 2` of them; `column` tells an item's.
    #[inline(always)]
    fn within(&self, row: usize, first: usize, width: usize, column: impl Fn(&T) -> u32) -> &[T] {
        let items = self.row(row);
        let outside = |item: Option<&T>| {
            item.is_some_and(|item| column(item) as usize <= first || column(item) as usize > first + width - 2)
        };
        if !outside(items.first()) && !outside(items.last()) {
            return items;
        }
        let low = items.partition_point(|item| column(item) as usize <= first);
        let high = items.partition_point(|item| column(item) as usize <= first + width - 2);
        &items[low..high]
    }

    fn end_row(&mut self) {
        self.start.push(self.items.len() as u32);
    }

    fn memory_bytes(&self) -> usize {
        self.items.len() * size_of::<T>() + self.start.len() * 4
    }
}

/// A share that would enter a sleeping tile across its corner: half of it goes to the cell above or below its source,
/// half to the one beside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Row of the source, counted with the ring.
    row: u32,
    /// Its column, counted with the ring.
    pub(super) column: u32,
    /// Whether the share goes right or left.
    pub(super) right: bool,
    /// Whether it goes up or down.
    pub(super) up: bool,
}

impl<const N: usize> ByRow<Corner<N>> {
    /// Corners of a row in the columns after `first`, `width − 2` of them.
    pub(super) fn row_within(&self, row: usize, first: usize, width: usize) -> &[Corner<N>] {
        self.within(row, first, width, |corner| corner.column)
    }

    fn push(&mut self, column: usize, strikes: [bool; N]) {
        if strikes.contains(&true) {
            let weights = strikes.map(|strikes| if strikes { 0.5 } else { 0.0 });
            self.items.push(Corner { column: column as u32, weights });
        }
    }
}

/// Closes those of the faces that are open, and notes them.
fn close(faces: impl Iterator<Item = usize>, open: &mut [f32], fences: &mut Vec<u32>) {
    for k in faces {
        if open[k] != 0.0 {
            open[k] = 0.0;
            fences.push(k as u32);
        }
    }
}

/// Which of four it is that alone `holds`, if there is one.
fn the_only(holds: impl Fn(usize) -> bool) -> Option<usize> {
    let mut places = (0..4).filter(|place| holds(*place));
    places.next().filter(|_| places.next().is_none())
}

/// Faces, corners and rooms of a grid.
#[derive(Debug)]
pub(super) struct Shape {
    /// 1 where the left face of a cell lets air through, else 0, with the ring.
    pub(super) open_x: Vec<f32>,
    /// 1 where the lower face of a cell lets air through, else 0, with the ring.
    pub(super) open_y: Vec<f32>,
    /// Sources, for the shares up-left and up-right: half goes to the cell above.
    pub(super) above: ByRow<Corner<2>>,
    /// Sources, for the shares down-left and down-right: half goes to the cell below.
    pub(super) below: ByRow<Corner<2>>,
    /// Targets, for shares down and up from the left, down and up from the right: half comes here.
    pub(super) beside: ByRow<Corner<4>>,
    /// Columns, with the ring, of the solid cells that shares strike.
    struck: ByRow<u32>,
    /// Room of each cell, `u32::MAX` in rock and in the ring.
    pub(super) room: Vec<u32>,
    /// For each room: whether it has an open side of the box.
    pub(super) room_open: Vec<bool>,
    /// Open left faces of cells that are closed because a tile beside sleeps.
    fences_x: Vec<u32>,
    /// Open lower faces of cells that are closed for the same reason.
    fences_y: Vec<u32>,
    /// Corners of sleeping tiles between three that are not, by row.
    turns: Vec<Turn>,
}

impl Shape {
    /// Of a grid with rock in the cells that are `solid`, as all of the ring counts.
    pub(super) fn new(tiling: Tiling, solid: &[bool], open: OpenSides) -> Self {
        let (stride, [columns, rows]) = (tiling.stride(), tiling.cells());
        let mut shape = Self {
            open_x: vec![0.0; solid.len()],
            open_y: vec![0.0; solid.len()],
            above: ByRow::new(),
            below: ByRow::new(),
            beside: ByRow::new(),
            struck: ByRow::new(),
            room: vec![u32::MAX; solid.len()],
            room_open: Vec::new(),
            fences_x: Vec::new(),
            fences_y: Vec::new(),
            turns: Vec::new(),
        };
        // Whether air passes a face between two places, of which either may be beyond a side that is open.
        let share = |[low, high]: [usize; 2], [open_low, open_high]: [bool; 2]| {
            f32::from(u8::from((open_low || !solid[low]) && (open_high || !solid[high])))
        };
        for row in 1..=rows {
            for column in 1..=columns + 1 {
                let (k, sides) = (row * stride + column, [column == 1 && open.left, column > columns && open.right]);
                shape.open_x[k] = share([k - 1, k], sides);
            }
        }
        for row in 1..=rows + 1 {
            for column in 1..=columns {
                let (k, sides) = (row * stride + column, [row == 1 && open.bottom, row > rows && open.top]);
                shape.open_y[k] = share([k - stride, k], sides);
            }
        }
        shape.find_corners(tiling, solid);
        shape.find_rooms(stride, solid);
        shape
    }

    /// Columns, with the ring, of the solid cells of a row that shares strike.
    pub(super) fn struck_within(&self, row: usize, first: usize, width: usize) -> &[u32] {
        self.struck.within(row, first, width, |column| *column)
    }

    /// Turns of the sources of a row.
    #[inline(always)]
    pub(super) fn turns_of(&self, row: usize) -> &[Turn] {
        if self.turns.is_empty() {
            return &[];
        }
        let low = self.turns.partition_point(|turn| (turn.row as usize) < row);
        let high = self.turns.partition_point(|turn| turn.row as usize <= row);
        &self.turns[low..high]
    }

    /// Closes the faces between active tiles and sleeping ones, and opens those that were closed before for that.
    pub(super) fn fence(&mut self, tiling: Tiling, solid: &[bool], active: &[bool]) {
        for (fences, open) in [(&mut self.fences_x, &mut self.open_x), (&mut self.fences_y, &mut self.open_y)] {
            fences.drain(..).for_each(|k| open[k as usize] = 1.0);
        }
        self.find_turns(tiling, solid, active);
        let (stride, width) = (tiling.stride(), tiling.size()[0]);
        for tile in 0..tiling.count() {
            let (columns, rows) = (tiling.columns(tile), tiling.rows(tile));
            let first = (rows.start + 1) * stride;
            if tile % width > 0 && active[tile] != active[tile - 1] {
                let faces = rows.map(|row| (row + 1) * stride + columns.start + 1);
                close(faces, &mut self.open_x, &mut self.fences_x);
            }
            if tile >= width && active[tile] != active[tile - width] {
                close(columns.map(|column| first + column + 1), &mut self.open_y, &mut self.fences_y);
            }
        }
        // Where one of the four tiles that meet is active, the sleeping cell across from its own must not send it
        // anything, for it would give nothing away: no share goes both ways if it can't go sideways.
        for around in tiling.meeting() {
            if let Some(place) = the_only(|place| active[around[place]]) {
                let row = tiling.rows(around[3]).start + usize::from(place / 2 == 0);
                let face = row * stride + tiling.columns(around[3]).start + 1;
                close(std::iter::once(face), &mut self.open_x, &mut self.fences_x);
            }
        }
    }

    /// Finds where one of the four tiles that meet sleeps and the other three don't. Rock there has its own corners.
    fn find_turns(&mut self, tiling: Tiling, solid: &[bool], active: &[bool]) {
        let stride = tiling.stride();
        self.turns.clear();
        for around in tiling.meeting() {
            let Some(place) = the_only(|place| !active[around[place]]) else { continue };
            // Of the four cells that meet, the sleeping one, counted with the ring, and the one across.
            let (row, column) = (tiling.rows(around[3]).start + 1, tiling.columns(around[3]).start + 1);
            let (right, up) = (place % 2 == 1, place / 2 == 1);
            let asleep = (row - usize::from(!up)) * stride + column - usize::from(!right);
            let (source_row, source_column) = (row - usize::from(up), column - usize::from(right));
            // The faces of the source towards the two others.
            let open =
                self.open_x[source_row * stride + column] != 0.0 && self.open_y[row * stride + source_column] != 0.0;
            if open && !solid[asleep] {
                self.turns.push(Turn { row: source_row as u32, column: source_column as u32, right, up });
            }
        }
        self.turns.sort_unstable_by_key(|turn| (turn.row, turn.column));
    }

    pub(super) fn memory_bytes(&self) -> usize {
        let corners = self.above.memory_bytes() + self.below.memory_bytes() + self.beside.memory_bytes();
        self.open_x.len() * 12 + corners + self.struck.memory_bytes()
    }

    fn find_corners(&mut self, tiling: Tiling, solid: &[bool]) {
        let (stride, [columns, rows]) = (tiling.stride(), tiling.cells());
        for row in 0..=rows + 1 {
            let cells = if row == 0 || row > rows { 0 } else { columns };
            for column in 1..=cells {
                let k = row * stride + column;
                let strikes = |source, right, up| self.strikes(tiling, solid, source, right, up);
                let above = [strikes(k, false, true), strikes(k, true, true)];
                let below = [strikes(k, false, false), strikes(k, true, false)];
                let from_left = [strikes(k - 1, true, false), strikes(k - 1, true, true)];
                let from_right = [strikes(k + 1, false, false), strikes(k + 1, false, true)];
                let struck = strikes(k - stride - 1, true, true)
                    || strikes(k - stride + 1, false, true)
                    || strikes(k + stride - 1, true, false)
                    || strikes(k + stride + 1, false, false);
                self.above.push(column, above);
                self.below.push(column, below);
                self.beside.push(column, [from_left[0], from_left[1], from_right[0], from_right[1]]);
                if struck {
                    self.struck.items.push(column as u32);
                }
            }
            self.above.end_row();
            self.below.end_row();
            self.beside.end_row();
            self.struck.end_row();
        }
    }

    /// Whether a share of `source` to a diagonal neighbour finds rock there: both faces that it leaves by are open, and
    /// the neighbour is solid. (Outside the box a share is lost, by whichever face it left.)
    fn strikes(&self, tiling: Tiling, solid: &[bool], source: usize, right: bool, up: bool) -> bool {
        let stride = tiling.stride();
        let (x, across) = if right { (source + 1, source + 1) } else { (source, source - 1) };
        let (y, across) = if up { (source + stride, across + stride) } else { (source, across - stride) };
        // The rarest first: this is asked twelve times a cell.
        solid[across]
            && self.open_x[x] != 0.0
            && self.open_y[y] != 0.0
            && !tiling.in_ring(source)
            && !tiling.in_ring(across)
    }

    fn find_rooms(&mut self, stride: usize, solid: &[bool]) {
        let mut queue = Vec::new();
        for seed in 0..solid.len() {
            if solid[seed] || self.room[seed] != u32::MAX {
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
                    if solid[next] {
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
