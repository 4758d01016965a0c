//! The air grid.
use crate::kernel::{
    params::AirParams,
    solids::Solids,
    sources::{Rect, Wind},
};
use glam::{DVec2, Vec2};
use serde::{Deserialize, Serialize};

/// placeholder until the air branch lands
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Air {
    cell: f32,
    params: AirParams,
    columns: usize,
    rows: usize,
    zero: Vec<f32>,
}
#[derive(Clone, Copy, Debug, Default)]
#[allow(missing_docs)]
pub struct AirReport {
    pub substeps: u32,
    pub cells: usize,
    pub speed_clamps: u64,
    pub pressure_clamps: u64,
}
#[allow(missing_docs, unused_variables)]
impl Air {
    pub fn new(size: Vec2, cell: f32, params: AirParams) -> Self {
        let (columns, rows) = ((size.x / cell).ceil() as usize, (size.y / cell).ceil() as usize);
        Self { cell, params, columns, rows, zero: vec![0.0; columns * rows] }
    }
    pub fn columns(&self) -> usize {
        self.columns
    }
    pub fn rows(&self) -> usize {
        self.rows
    }
    pub fn cell(&self) -> f32 {
        self.cell
    }
    pub fn params(&self) -> &AirParams {
        &self.params
    }
    pub fn pressure(&self) -> &[f32] {
        &self.zero
    }
    pub fn velocity_x(&self) -> &[f32] {
        &self.zero
    }
    pub fn velocity_y(&self) -> &[f32] {
        &self.zero
    }
    pub fn is_solid_cell(&self, column: usize, row: usize) -> bool {
        false
    }
    pub fn set_solids(&mut self, solids: &Solids) {}
    pub fn step(&mut self, winds: &[Wind], courant: f32, dt: f32, parallel: bool) -> AirReport {
        AirReport::default()
    }
    pub fn is_quiet(&self) -> bool {
        true
    }
    pub fn sample_velocity(&self, p: Vec2) -> Vec2 {
        Vec2::ZERO
    }
    pub fn sample_velocities(&self, x: &[f32], y: &[f32], out_u: &mut [f32], out_v: &mut [f32]) {
        out_u.fill(0.0);
        out_v.fill(0.0);
    }
    pub fn sample_pressure(&self, p: Vec2) -> f32 {
        1.0
    }
    pub fn blow(&mut self, centre: Vec2, radius: f32, velocity: Vec2) {}
    pub fn press(&mut self, centre: Vec2, radius: f32, amount: f32) {}
    pub fn fill_pressure(&mut self, area: Rect, pressure: f32) {}
    pub fn clear(&mut self) {}
    pub fn mass(&self) -> f64 {
        0.0
    }
    pub fn momentum(&self) -> DVec2 {
        DVec2::ZERO
    }
    pub fn kinetic_energy(&self) -> f64 {
        0.0
    }
    pub fn divergence_rms(&self) -> f64 {
        0.0
    }
    pub fn max_speed(&self) -> f32 {
        0.0
    }
    pub fn resized(&self, cell: f32) -> Self {
        self.clone()
    }
}
