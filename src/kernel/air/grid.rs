//! The state of the air and the way to read it.
//!
//! Rows are stored from the bottom up with a ring of one cell around the box, so that every cell has eight neighbours in
//! memory. The ring stands at pressure 1; behind an open side it carries the velocity of the air outside (`edges`),
//! behind a closed one it is solid.

use super::{
    band::Band,
    crowd::Crowd,
    ledger::Ledger,
    meetings::Feedback,
    report::AirReport,
    rooms::Room,
    shape::Shape,
    tiling::{Tiling, Watch},
};
use crate::{
    heat::units::{COLDEST, HOTTEST, ROOM},
    params::AirParams,
    solids::Solids,
};
use glam::Vec2;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Highest pressure that a tool or a scene can set, in pressures of the surroundings. Changing this affects how far
/// sums of pressure stay exact in f32.
pub const MAX_PRESSURE: f32 = 1.0e6;

/// Highest speed along an axis that a tool or a wind can set, d/s. Changing this affects nothing that a step can follow:
/// its own limit is lower.
pub const MAX_SPEED: f32 = 1.0e6;

/// The air of a box: pressure and velocity on square cells, and which of them are rock.
///
/// Air that nothing has ever moved needs no grid: it is [`Air::unbuilt`], and its fields hold one row, which stands for
/// all of them. [`Air::build`] makes the grid once something is about to move it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Air {
    pub(super) size: Vec2,
    pub(super) cell: f32,
    pub(super) params: AirParams,
    pub(super) columns: u32,
    pub(super) rows: u32,
    /// Pressure, with the ring. Rock has 0, the ring 1.
    pub(super) pressure: Vec<f32>,
    /// Velocity along x, d/s, with the ring. Rock has 0.
    pub(super) velocity_x: Vec<f32>,
    /// Velocity along y, d/s, with the ring. Rock has 0.
    pub(super) velocity_y: Vec<f32>,
    /// How much warmer than the surroundings the air is, T/293 K − 1, with the ring (`warmth`). Rock and the ring have 0. Empty
    /// while all is as warm as they.
    pub(super) warmth: Vec<f32>,
    /// Cells with rock in them, with the ring, which counts as solid.
    pub(super) solid: Vec<bool>,
    /// Velocity of the air outside along the outward normal, d/s: left and right by row, bottom and top by column.
    pub(super) outside: Vec<f32>,
    /// Shape of the rock that `solid` was made from.
    pub(super) solids_shape: Option<u64>,
    /// Whether the mass at hand must survive the first `set_solids` (air that was resampled), or pressure 1 (new air).
    pub(super) keep_mass: bool,
    pub(super) quiet: bool,
    /// Tiles that are awake (see `tiles`); none while the air is quiet.
    pub(super) awake: Vec<bool>,
    /// Pressure at which each room comes to rest; empty if it must be found anew.
    pub(super) rests: Vec<f32>,
    /// What tools had to clamp since the last step.
    pub(super) pending: AirReport,
    #[serde(skip)]
    pub(super) scratch: Scratch,
}

/// Buffers that a step needs and that follow from the state: neither copied, compared nor stored.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    pub(super) shape: Option<Shape>,
    pub(super) next_pressure: Vec<f32>,
    pub(super) next_x: Vec<f32>,
    pub(super) next_y: Vec<f32>,
    pub(super) next_warmth: Vec<f32>,
    pub(super) bands: Vec<Band>,
    pub(super) rooms: Vec<Room>,
    /// What lumps give each cell, and that times their warmth.
    pub(super) warmed: Vec<[f32; 2]>,
    /// Whether tiles may sleep: a wish, which a copy keeps.
    pub(super) sleeps: bool,
    /// What pulls at air, d/s², which a copy keeps.
    pub(super) gravity: Vec2,
    pub(super) watch: Watch,
    pub(super) ledger: Ledger,
    pub(super) feedback: Feedback,
    pub(super) crowd: Crowd,
}

impl Clone for Scratch {
    fn clone(&self) -> Self {
        Self { sleeps: self.sleeps, gravity: self.gravity, ..Self::default() }
    }
}

impl PartialEq for Scratch {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Air {
    /// Whether air that was read from a file is sound, or what is wrong with it. All that goes from cell to cell relies on it.
    pub fn check(&self) -> Result<(), String> {
        let (columns, rows) = (self.columns(), self.rows());
        let still =
            |field: &[f32], value: f32| field.len() == columns.saturating_add(2) && field.iter().all(|v| *v == value);
        let unbuilt = self.quiet
            && still(&self.pressure, 1.0)
            && still(&self.velocity_x, 0.0)
            && still(&self.velocity_y, 0.0)
            && self.solid == vec![false; self.pressure.len()]
            && self.outside.is_empty()
            && self.awake.is_empty()
            && self.warmth.is_empty()
            && self.solids_shape.is_none();
        let (tiling, cells) = (self.tiling(), (columns + 2).saturating_mul(rows + 2));
        let fields = [&self.pressure, &self.velocity_x, &self.velocity_y];
        let whole = self.solid.len() == cells && fields.iter().all(|field| field.len() == cells);
        if columns == 0 || rows == 0 || !(whole || unbuilt) {
            return Err(format!("air: {columns} × {rows} cells need {cells} values a field, with the ring"));
        }
        if !unbuilt && (0..cells).any(|k| tiling.in_ring(k) && !self.solid[k]) {
            return Err("air: the ring around its cells must be solid".to_owned());
        }
        if self.outside.len() != 2 * (columns + rows) && !unbuilt {
            return Err(format!("air: outside needs {} values", 2 * (columns + rows)));
        }
        if fields.into_iter().chain([&self.outside]).flatten().any(|value| !value.is_finite()) {
            return Err("air: every pressure and velocity must be finite".to_owned());
        }
        let is_warmth = |value: &f32| (COLDEST / ROOM - 1.0..=HOTTEST / ROOM - 1.0).contains(value);
        if !(self.warmth.is_empty() || self.warmth.len() == cells) || !self.warmth.iter().all(is_warmth) {
            return Err(format!(
                "air: it must be as warm as its surroundings, or have {cells} values of {COLDEST} to {HOTTEST} K"
            ));
        }
        if self.quiet && !self.warmth.is_empty() {
            return Err("air: warm air is never still".to_owned());
        }
        if self.pressure.iter().any(|p| *p < 0.0) {
            return Err("air: every pressure must be 0 or more".to_owned());
        }
        if self.awake.len() != tiling.count() && !unbuilt {
            return Err(format!("air: {} values tell which tiles are awake", self.awake.len()));
        }
        if self.rests.len() > cells || self.rests.iter().any(|rest| !rest.is_finite() || *rest < 0.0) {
            return Err("air: every pressure of rest must be finite and 0 or more".to_owned());
        }
        if !self.pending.is_of_tools() {
            return Err("air: what tools had to clamp is no count of a world's".to_owned());
        }
        let lengths = [self.cell, self.size.x, self.size.y, self.params.sound_speed, self.params.density];
        if lengths.iter().any(|length| !length.is_finite() || *length <= 0.0) {
            return Err("air: size, cell, sound_speed and density must be finite and positive".to_owned());
        }
        // The size is what a change of cells goes by.
        let expected = (self.size / self.cell).ceil().max(Vec2::ONE);
        if expected != Vec2::new(columns as f32, rows as f32) {
            return Err(format!("air: a box of {} d has no {columns} × {rows} cells of {} d", self.size, self.cell));
        }
        Ok(())
    }

    /// Air at rest at pressure 1 in a box of `size` (d) on cells of edge `cell` (d). The box is covered whole: the last
    /// column and row may reach beyond it.
    pub fn new(size: Vec2, cell: f32, params: AirParams) -> Self {
        let air = Self::unbuilt(size, cell, params);
        let (tiling, cells) = (air.tiling(), air.stride() * (air.rows() + 2));
        Self {
            pressure: vec![1.0; cells],
            velocity_x: vec![0.0; cells],
            velocity_y: vec![0.0; cells],
            solid: (0..cells).map(|k| tiling.in_ring(k)).collect(),
            outside: vec![0.0; 2 * (air.columns() + air.rows())],
            awake: vec![false; tiling.count()],
            ..air
        }
    }

    /// The same without a grid yet. It knows no rock and all of its rows read as air at rest; nothing but
    /// [`Air::build`] changes that.
    pub fn unbuilt(size: Vec2, cell: f32, params: AirParams) -> Self {
        debug_assert!(size.is_finite() && size.min_element() > 0.0 && cell.is_finite() && cell > 0.0);
        debug_assert!(params.sound_speed.is_finite() && params.sound_speed > 0.0);
        let [columns, rows] = (size / cell).to_array().map(|cells| (cells.ceil() as u32).max(1));
        let stride = columns as usize + 2;
        Self {
            size,
            cell,
            params,
            columns,
            rows,
            pressure: vec![1.0; stride],
            velocity_x: vec![0.0; stride],
            velocity_y: vec![0.0; stride],
            warmth: Vec::new(),
            solid: vec![false; stride],
            outside: Vec::new(),
            solids_shape: None,
            keep_mass: false,
            quiet: true,
            awake: Vec::new(),
            rests: Vec::new(),
            pending: AirReport::default(),
            scratch: Scratch::default(),
        }
    }

    /// Whether there is a grid.
    pub fn is_built(&self) -> bool {
        self.pressure.len() > self.stride()
    }

    /// Makes the grid if there is none: air at rest, with the rock that there is now.
    pub fn build(&mut self, solids: &Solids) {
        if !self.is_built() {
            let mut built = Self::new(self.size, self.cell, self.params);
            built.set_solids(solids);
            built.pending = self.pending;
            built.scratch.sleeps = self.scratch.sleeps;
            built.scratch.gravity = self.scratch.gravity;
            *self = built;
        }
    }

    /// The air with its grid, for callers that look at every cell.
    pub fn with_grid(&self, solids: &Solids) -> Cow<'_, Self> {
        if self.is_built() {
            return Cow::Borrowed(self);
        }
        let mut built = self.clone();
        built.build(solids);
        Cow::Owned(built)
    }

    /// Cells along x.
    pub fn columns(&self) -> usize {
        self.columns as usize
    }

    /// Cells along y.
    pub fn rows(&self) -> usize {
        self.rows as usize
    }

    /// Width and height of the box, d.
    pub fn size(&self) -> Vec2 {
        self.size
    }

    /// Every pressure and velocity that it holds, the surroundings' and those of rest included.
    pub fn values(&self) -> impl Iterator<Item = f32> + '_ {
        let fields = [&self.pressure, &self.velocity_x, &self.velocity_y, &self.warmth, &self.outside, &self.rests];
        fields.into_iter().flatten().copied()
    }

    /// Edge of a cell, d.
    pub fn cell(&self) -> f32 {
        self.cell
    }

    /// The air parameters it was made with.
    pub fn params(&self) -> &AirParams {
        &self.params
    }

    /// Whether nothing moves: a step would do nothing at all.
    pub fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Pressures of a row from left to right, `columns` values, row 0 at the bottom. Rock has 0.
    pub fn pressure_row(&self, row: usize) -> &[f32] {
        &self.pressure[self.row_range(row)]
    }

    /// Velocities along x of a row, d/s. Rock has 0.
    pub fn velocity_x_row(&self, row: usize) -> &[f32] {
        &self.velocity_x[self.row_range(row)]
    }

    /// Velocities along y of a row, d/s. Rock has 0.
    pub fn velocity_y_row(&self, row: usize) -> &[f32] {
        &self.velocity_y[self.row_range(row)]
    }

    /// How much warmer than the surroundings a row is, T/293 K − 1; empty if none of the air is.
    pub fn warmth_row(&self, row: usize) -> &[f32] {
        self.warmth.get(self.row_range(row)).unwrap_or_default()
    }

    /// Pressure of a cell; 0 in rock.
    pub fn pressure_at_cell(&self, column: usize, row: usize) -> f32 {
        self.pressure_row(row)[column]
    }

    /// Velocity of a cell, d/s; 0 in rock.
    pub fn velocity_at_cell(&self, column: usize, row: usize) -> Vec2 {
        Vec2::new(self.velocity_x_row(row)[column], self.velocity_y_row(row)[column])
    }

    /// Whether rock stands in the cell.
    pub fn is_solid_cell(&self, column: usize, row: usize) -> bool {
        self.solid[self.row_range(row)][column]
    }

    /// Bytes held, buffers included.
    pub fn memory_bytes(&self) -> usize {
        let cells = self.pressure.len();
        let buffers = self.scratch.next_pressure.len() * 3
            + self.warmth.len()
            + self.scratch.next_warmth.len()
            + 2 * self.scratch.warmed.len()
            + self.scratch.bands.iter().map(Band::values).sum::<usize>();
        let shape = self.scratch.shape.as_ref().map_or(0, Shape::memory_bytes);
        let state = cells * 13 + self.outside.len() * 4 + self.awake.len() + self.rests.len() * 4;
        let Scratch { watch, ledger, feedback, crowd, .. } = &self.scratch;
        state
            + buffers * 4
            + shape
            + watch.memory_bytes()
            + ledger.memory_bytes()
            + feedback.memory_bytes()
            + crowd.memory_bytes()
    }

    /// How the cells lie, and the tiles.
    pub(super) fn tiling(&self) -> Tiling {
        Tiling::new(self.columns(), self.rows())
    }

    /// Values between a cell and the one above it.
    pub(super) fn stride(&self) -> usize {
        self.columns as usize + 2
    }

    /// Where a cell stands in the fields.
    pub(super) fn index(&self, column: usize, row: usize) -> usize {
        (row + 1) * self.stride() + column + 1
    }

    /// Where the cells of a row stand in the fields.
    pub(super) fn row_range(&self, row: usize) -> std::ops::Range<usize> {
        assert!(row < self.rows(), "row {row} of {}", self.rows);
        let start = if self.is_built() { self.index(0, row) } else { 1 };
        start..start + self.columns()
    }

    /// Where all cells of the box stand in the fields, row by row.
    pub(super) fn cells(&self) -> impl Iterator<Item = usize> + use<> {
        let (first, step) = (self.row_range(0), if self.is_built() { self.stride() } else { 0 });
        (0..self.rows()).flat_map(move |row| first.start + row * step..first.end + row * step)
    }

    /// Centre of a cell, d.
    pub(super) fn centre(&self, column: usize, row: usize) -> Vec2 {
        Vec2::new(column as f32 + 0.5, row as f32 + 0.5) * self.cell
    }

    /// Whether any side lets air through.
    pub(super) fn is_open(&self) -> bool {
        let open = self.params.open;
        open.left || open.right || open.bottom || open.top
    }
}
