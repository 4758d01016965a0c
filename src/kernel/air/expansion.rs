//! Gas that matter gives off as it burns or boils: air of the surroundings' pressure that comes into the grid as warm as the
//! matter, and presses. What condenses takes as much back.

use super::grid::{Air, MAX_PRESSURE};
use crate::{
    heat::units::{QUANTUM, ROOM},
    solids::Solids,
};
use glam::Vec2;
use std::collections::BTreeSet;

/// Furthest that gas goes from rock to find open air, cells. Changing this affects how narrow a barrel may be.
const REACH: usize = 2;

/// Most cells within that reach that are as near as each other.
const MOST_NEAREST: usize = 8;

/// Mass of a cell, as a pressure, that is left to it: steam that was never water, as a player paints it, may ask for more air than
/// there is.
const LEFT: f32 = 0.25;
/// Part of what a cell has beyond that which it gives at most to one lump.
const MOST_TAKEN: f32 = 0.5;

/// Cells within which a lump that takes gas finds it, counted from it through open faces. What it does not find is counted, and
/// not taken.
const FURTHEST: usize = 12;

/// Heat of air of constant pressure, J/kgK.
pub(super) const CAPACITY: f32 = 1005.0;

/// Gas that a lump gave off, or took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Release {
    /// Where, d.
    pub at: Vec2,
    /// How much, d² at the surroundings' pressure; below 0 what it took.
    pub amount: f32,
    /// How warm the lump was, K.
    pub kelvin: f32,
}

impl Release {
    /// Heat that it took from its lump, quanta, in air of a density (kg/m²): what warms gas of the surroundings' temperature.
    pub fn heat(&self, density: f32) -> i32 {
        (self.amount.max(0.0) * density * (CAPACITY / QUANTUM) * (self.kelvin - ROOM)) as i32
    }
}

impl Air {
    /// Lets gas into the cells that it came up in, or the nearest that are open, and takes gas from them. `warm`: whether it is as
    /// warm as its lump, or as the air that is there. It comes at rest. Returns what the air got, d² at pressure 1, with what is
    /// buried as no air is near.
    pub fn expand(&mut self, releases: &[Release], warm: bool, solids: &Solids) -> f64 {
        self.build(solids);
        let mut got = 0.0;
        for Release { at, amount, kelvin } in releases {
            let (cells, count) = self.open_near(self.cell_at(*at));
            for k in &cells[..count] {
                let part = amount / count as f32;
                got += if part < 0.0 {
                    self.take(*k, -part)
                } else {
                    self.give(*k, part, if warm { *kelvin } else { ROOM })
                };
            }
            if count == 0 {
                let buried = f64::from(amount.max(0.0));
                self.pending.buried += buried;
                got += buried;
            }
        }
        got
    }

    /// Lets gas of a temperature (K) into a cell, d² at pressure 1. Returns what it got.
    fn give(&mut self, k: usize, amount: f32, kelvin: f32) -> f64 {
        let (before, asked) = (self.pressure[k], amount / (self.cell * self.cell));
        let after = (before + asked).min(MAX_PRESSURE.max(before));
        self.pending.pressure_clamps += u64::from(before + asked != after);
        let kept = before / after;
        self.velocity_x[k] *= kept;
        self.velocity_y[k] *= kept;
        if self.is_warm() || kelvin != ROOM {
            self.warmth.resize(self.pressure.len(), 0.0);
            self.warmth[k] = self.warmth[k] * kept + (kelvin / ROOM - 1.0) * (1.0 - kept);
        }
        self.set_mass(k, after)
    }

    /// Takes gas from a cell, and where it has too little from those around it, nearest first and from each alike. What is
    /// left keeps its speed and its warmth. Returns what it took, d² at pressure 1, below 0.
    fn take(&mut self, k: usize, amount: f32) -> f64 {
        let (mut left, mut got) = (f64::from(amount) / self.cell_area(), 0.0);
        let (mut layer, mut seen) = (vec![k], BTreeSet::from([k]));
        for _ in 0..FURTHEST {
            let spare = |air: &Self, k: usize| (air.pressure[k] - LEFT).max(0.0) * MOST_TAKEN;
            let there: f64 = layer.iter().map(|k| f64::from(spare(self, *k))).sum();
            let part = if left < there { left / there } else { 1.0 };
            for k in &layer {
                got += self.set_mass(*k, self.pressure[*k] - spare(self, *k) * part as f32);
            }
            left -= there * part;
            if part < 1.0 {
                return got;
            }
            let beside = |k: &usize| [k - 1, k + 1, k - self.stride(), k + self.stride()];
            layer = layer.iter().flat_map(beside).filter(|k| !self.solid[*k] && seen.insert(*k)).collect();
        }
        self.pending.pressure_clamps += 1;
        got
    }

    /// Sets the mass of a cell, as a pressure. Returns what it has more than before, d².
    fn set_mass(&mut self, k: usize, mass: f32) -> f64 {
        let before = std::mem::replace(&mut self.pressure[k], mass);
        self.touch(k);
        self.rests.clear();
        (f64::from(mass) - f64::from(before)) * self.cell_area()
    }

    /// The open cells that are nearest to a cell of the box, it itself first, and how many they are.
    pub(super) fn open_near(&self, k: usize) -> ([usize; MOST_NEAREST], usize) {
        let (mut cells, mut count) = ([k; MOST_NEAREST], usize::from(!self.solid[k]));
        if count > 0 {
            return (cells, count);
        }
        let stride = self.stride();
        let (column, row) = (k % stride, k / stride);
        let mut nearest = usize::MAX;
        for row_near in row.saturating_sub(REACH)..=(row + REACH).min(self.rows()) {
            for column_near in column.saturating_sub(REACH)..=(column + REACH).min(self.columns()) {
                let other = row_near * stride + column_near;
                let squared = column_near.abs_diff(column).pow(2) + row_near.abs_diff(row).pow(2);
                // The ring is solid.
                if self.solid[other] || squared > nearest {
                    continue;
                }
                count = if squared < nearest { 0 } else { count };
                (nearest, cells[count]) = (squared, other);
                count += 1;
            }
        }
        (cells, count)
    }
}
