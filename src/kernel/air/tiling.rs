//! How the cells of a grid lie, how it is cut into tiles, and what follows from those that are awake (`tiles`).

use std::ops::Range;

/// Cells of a tile along x: lanes want long rows. Changing this affects which cells sleep together.
pub(super) const TILE_COLUMNS: usize = 32;

/// Cells of a tile along y. Changing this affects which cells sleep together.
pub(super) const TILE_ROWS: usize = 16;

/// Most substeps from one look after the tiles to the next.
pub(super) const WATCH: u32 = TILE_ROWS as u32 / 2;

/// How the cells of a grid lie, with a ring of one around them, and how they are cut into tiles, row by row. The last ones of a row and of a column take what is left over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiling {
    cells: [usize; 2],
    tiles: [usize; 2],
}

fn span(tile: usize, tiles: usize, size: usize, cells: usize) -> Range<usize> {
    tile * size..if tile + 1 == tiles { cells } else { (tile + 1) * size }
}

impl Tiling {
    pub(super) fn new(columns: usize, rows: usize) -> Self {
        Self { cells: [columns, rows], tiles: [(columns / TILE_COLUMNS).max(1), (rows / TILE_ROWS).max(1)] }
    }

    /// Values between a cell and the one above it.
    pub(super) fn stride(self) -> usize {
        self.cells[0] + 2
    }

    /// Whether place `k` of the fields is in the ring.
    pub(super) fn in_ring(self, k: usize) -> bool {
        let (i, j) = (k % self.stride(), k / self.stride());
        i == 0 || j == 0 || i > self.cells[0] || j > self.cells[1]
    }

    /// Number of tiles.
    pub(super) fn count(self) -> usize {
        self.tiles[0] * self.tiles[1]
    }

    /// Tiles along x and y.
    pub(super) fn size(self) -> [usize; 2] {
        self.tiles
    }

    /// Cells along x and y.
    pub(super) fn cells(self) -> [usize; 2] {
        self.cells
    }

    /// The four tiles around each point where four meet: the lower left one and that beside it, and those above them.
    pub(super) fn meeting(self) -> impl Iterator<Item = [usize; 4]> {
        let [width, height] = self.tiles;
        (1..height)
            .flat_map(move |j| (1..width).map(move |i| j * width + i))
            .map(move |k| [k - width - 1, k - width, k - 1, k])
    }

    /// The tile of a cell.
    pub(super) fn of(self, column: usize, row: usize) -> usize {
        let across = (column / TILE_COLUMNS).min(self.tiles[0] - 1);
        (row / TILE_ROWS).min(self.tiles[1] - 1) * self.tiles[0] + across
    }

    /// Columns of a tile.
    pub(super) fn columns(self, tile: usize) -> Range<usize> {
        span(tile % self.tiles[0], self.tiles[0], TILE_COLUMNS, self.cells[0])
    }

    /// Rows of a tile.
    pub(super) fn rows(self, tile: usize) -> Range<usize> {
        span(tile / self.tiles[0], self.tiles[1], TILE_ROWS, self.cells[1])
    }

    /// Where the rows of a tile's cells stand in the fields.
    pub(super) fn cells_of(self, tile: usize) -> impl Iterator<Item = Range<usize>> {
        let (columns, stride) = (self.columns(tile), self.stride());
        self.rows(tile)
            .map(move |row| (row + 1) * stride)
            .map(move |start| start + columns.start + 1..start + columns.end + 1)
    }

    /// The tiles with those around them.
    pub(super) fn widen(self, tiles: &[bool], wider: &mut Vec<bool>) {
        let [width, height] = self.tiles;
        wider.clear();
        wider.resize(self.count(), false);
        for tile in (0..self.count()).filter(|tile| tiles[*tile]) {
            let (i, j) = (tile % width, tile / width);
            for row in j.saturating_sub(1)..(j + 2).min(height) {
                wider[row * width + i.saturating_sub(1)..row * width + (i + 2).min(width)].fill(true);
            }
        }
    }
}

/// Cells that are stepped together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub(super) rows: Range<usize>,
    pub(super) columns: Range<usize>,
}

/// Covers the active tiles with blocks: runs of tiles along x, as high as the same run goes on.
pub(super) fn cover(tiling: Tiling, active: &[bool], blocks: &mut Vec<Block>) {
    blocks.clear();
    let width = tiling.size()[0];
    let mut above = 0;
    for (row, tiles) in active.chunks(width).enumerate() {
        let (before, first) = (above..blocks.len(), row * width);
        let rows = tiling.rows(first);
        let mut next = 0;
        while let Some(skipped) = tiles[next..].iter().position(|active| *active) {
            let start = next + skipped;
            let end = tiles[start..].iter().position(|active| !*active).map_or(width, |length| start + length);
            let columns = tiling.columns(first + start).start..tiling.columns(first + end - 1).end;
            blocks.push(Block { rows: rows.clone(), columns });
            next = end;
        }
        above = before.end;
        let same = before.len() == blocks.len() - before.end
            && before.clone().zip(before.end..).all(|(old, new)| blocks[old].columns == blocks[new].columns);
        if same {
            blocks.truncate(before.end);
            for block in &mut blocks[before.clone()] {
                block.rows.end = rows.end;
            }
            above = before.start;
        }
    }
}

/// What follows from the tiles that are awake. Kept from look to look.
#[derive(Debug, Default)]
pub(super) struct Watch {
    /// The tiles that are stepped.
    pub(super) active: Vec<bool>,
    /// The same as cells.
    pub(super) blocks: Vec<Block>,
    /// Pressure at which each cell comes to rest, with the ring; 0 in rock and in the ring.
    pub(super) rest: Vec<f32>,
    /// Tiles that are looked at.
    pub(super) looked_at: Vec<bool>,
    pub(super) next_active: Vec<bool>,
}

impl Watch {
    /// Forgets what followed from the rock.
    pub(super) fn forget(&mut self) {
        self.active.clear();
        self.rest.clear();
    }

    /// Cells that are stepped.
    pub(super) fn cells(&self) -> usize {
        self.blocks.iter().map(|block| block.rows.len() * block.columns.len()).sum()
    }

    /// Bytes held.
    pub(super) fn memory_bytes(&self) -> usize {
        self.rest.len() * 4 + self.active.len() * 3 + self.blocks.capacity() * size_of::<Block>()
    }
}
