//! The winds of a scene and the player's air tools: wind, pressure, a fresh start.

use super::{
    grid::{Air, MAX_PRESSURE, MAX_SPEED},
    pressure::Peaks,
    report::AirReport,
};
use crate::{
    brush::soft_disc,
    heat::units::{COLDEST, HOTTEST, ROOM},
    sources::{Rect, Wind},
};
use glam::Vec2;
use std::ops::Range;

/// Both components within ±[`MAX_SPEED`], 0 for what is no number, and how many that changed.
fn bounded_velocity(velocity: Vec2) -> (Vec2, u64) {
    let bounded = velocity.map(|speed| if speed.is_nan() { 0.0 } else { speed.clamp(-MAX_SPEED, MAX_SPEED) });
    (bounded, bounded.cmpne(velocity).bitmask().count_ones().into())
}

impl Air {
    /// The wind tool: blends the velocity in a soft disc towards `velocity` (d/s, up to [`MAX_SPEED`] along an axis),
    /// wholly at `centre` (d), not at all from `radius` (d) on. The air must be built. A disc smaller than a cell is
    /// taken as large as one. Returns the velocity that it was within its bounds.
    pub fn blow(&mut self, centre: Vec2, radius: f32, velocity: Vec2) -> Vec2 {
        let (velocity, cuts) = bounded_velocity(velocity);
        self.pending.speed_clamps += cuts;
        self.for_each_in_disc(centre, radius, |air, k, weight| {
            let (u, v) = (&mut air.velocity_x[k], &mut air.velocity_y[k]);
            let before = (*u, *v);
            *u += (velocity.x - *u) * weight;
            *v += (velocity.y - *v) * weight;
            before != (*u, *v)
        });
        velocity
    }

    /// The pressure tool: adds `amount` to the pressure at `centre` (d), less around it, nothing from `radius` (d) on.
    /// The air must be built.
    /// The result is kept within 0 … [`MAX_PRESSURE`], and each cell where that changed it is counted.
    pub fn press(&mut self, centre: Vec2, radius: f32, amount: f32) {
        if amount.is_nan() {
            self.pending.pressure_clamps += 1;
            return;
        }
        let amount = amount.clamp(-2.0 * MAX_PRESSURE, 2.0 * MAX_PRESSURE);
        self.for_each_in_disc(centre, radius, |air, k, weight| {
            let before = air.pressure[k];
            let wanted = before + amount * weight;
            air.pressure[k] = wanted.clamp(0.0, MAX_PRESSURE);
            air.pending.pressure_clamps += u64::from(air.pressure[k] != wanted);
            air.rests.clear();
            air.pressure[k] != before
        });
    }

    /// Gives the air of the cells whose centre is in `area` (d) the surroundings' temperature and this pressure: 0 …
    /// [`MAX_PRESSURE`], 1 for what is no number. The air must be built.
    pub fn fill_pressure(&mut self, area: Rect, pressure: f32) {
        self.fill(area, pressure, ROOM);
    }

    /// The same with a temperature, [`COLDEST`] … [`HOTTEST`] K. The air pushes with `pressure` whatever that is, so that it stands
    /// where all around it does so, too: twice as warm it is half as dense. What is bounded is its density.
    pub fn fill(&mut self, area: Rect, pressure: f32, kelvin: f32) {
        if !self.is_built() {
            return;
        }
        let theta = if kelvin.is_nan() { 1.0 } else { kelvin.clamp(COLDEST, HOTTEST) / ROOM };
        let (wanted, warmth) = (pressure / theta, theta - 1.0);
        let bounded = if pressure.is_nan() { 1.0 / theta } else { wanted.clamp(0.0, MAX_PRESSURE) };
        let cut = bounded != wanted;
        let [columns, rows] = self.window(area);
        for row in rows {
            for column in columns.clone() {
                let k = self.index(column, row);
                if !self.solid[k] {
                    self.pending.pressure_clamps += u64::from(cut);
                    if (self.pressure[k], self.warmth_of(k)) != (bounded, warmth) {
                        self.pressure[k] = bounded;
                        if warmth != 0.0 && self.warmth.is_empty() {
                            self.warmth = vec![0.0; self.pressure.len()];
                        }
                        if let Some(own) = self.warmth.get_mut(k) {
                            *own = warmth;
                        }
                        self.touch(k);
                        self.rests.clear();
                    }
                }
            }
        }
    }

    /// Stops all wind and sets the pressure of all open cells to 1.
    pub fn clear(&mut self) {
        for k in self.cells() {
            self.pressure[k] = if self.solid[k] { 0.0 } else { 1.0 };
        }
        self.warmth = Vec::new();
        self.rests.clear();
        self.stop();
    }

    /// Takes what tools and new rock had to clamp since the last step: air that stays at rest makes no step that could tell.
    pub fn take_report(&mut self) -> AirReport {
        std::mem::take(&mut self.pending)
    }

    /// Whether a wind would change air at rest.
    pub(super) fn is_driven(&self, winds: &[Wind]) -> bool {
        debug_assert!(self.is_built());
        winds.iter().filter(|wind| wind.rate > 0.0 && bounded_velocity(wind.velocity).0 != Vec2::ZERO).any(|wind| {
            let [columns, rows] = self.window(wind.area);
            rows.into_iter().any(|row| columns.clone().any(|column| !self.solid[self.index(column, row)]))
        })
    }

    /// Wakes the tiles in which winds blow.
    pub(super) fn wake_winds(&mut self, winds: &[Wind]) {
        let tiling = self.tiling();
        for wind in winds {
            if !self.is_driven(std::slice::from_ref(wind)) {
                continue;
            }
            let [columns, rows] = self.window(wind.area);
            for tile in 0..tiling.count() {
                let overlaps = |a: &Range<usize>, b: Range<usize>| a.start.max(b.start) < a.end.min(b.end);
                if overlaps(&columns, tiling.columns(tile)) && overlaps(&rows, tiling.rows(tile)) {
                    self.wake(tile);
                }
            }
        }
    }

    /// Drives the air in the areas of the winds for a time dt (s): the implicit step of `du/dt = rate (target − u)`, which
    /// can't overshoot. Returns the largest speeds there.
    pub(super) fn blow_winds(&mut self, winds: &[Wind], dt: f32, report: &mut AirReport) -> Peaks {
        let mut peaks = Peaks::default();
        for wind in winds.iter().filter(|wind| wind.rate > 0.0) {
            let (target, cuts) = bounded_velocity(wind.velocity);
            report.speed_clamps += cuts;
            let pull = wind.rate.min(f32::MAX) * dt;
            // From here on 1/pull is lost in rounding, and pull/(1 + pull) may not be a number.
            let part = if pull < 1.0e9 { pull / (1.0 + pull) } else { 1.0 };
            let [columns, rows] = self.window(wind.area);
            for row in rows {
                for column in columns.clone() {
                    let k = self.index(column, row);
                    if self.solid[k] {
                        continue;
                    }
                    self.velocity_x[k] += (target.x - self.velocity_x[k]) * part;
                    self.velocity_y[k] += (target.y - self.velocity_y[k]) * part;
                    let here = Peaks { x: self.velocity_x[k].abs(), y: self.velocity_y[k].abs(), pressure: 0.0 };
                    peaks = peaks.max(here);
                }
            }
        }
        peaks
    }

    /// Columns and rows of the cells whose centre is in the area.
    fn window(&self, area: Rect) -> [Range<usize>; 2] {
        // The cell k has its centre at (k + ½)·cell, so the first at or after x is ceil(x/cell − ½). `as` keeps to the
        // range of the type and makes 0 of what is no number.
        let first = |x: f32, count: usize| ((x / self.cell - 0.5).ceil() as usize).min(count);
        [
            first(area.min.x, self.columns())..first(area.max.x, self.columns()),
            first(area.min.y, self.rows())..first(area.max.y, self.rows()),
        ]
    }

    /// Calls `act` for each open cell of a disc with its weight ([`soft_disc`]); it says whether it changed the cell.
    fn for_each_in_disc(&mut self, centre: Vec2, radius: f32, mut act: impl FnMut(&mut Self, usize, f32) -> bool) {
        if !(centre.is_finite() && radius.is_finite() && self.is_built()) {
            return;
        }
        let radius = radius.max(self.cell);
        let [columns, rows] =
            self.window(Rect { min: centre - Vec2::splat(radius), max: centre + Vec2::splat(radius) });
        for row in rows {
            for column in columns.clone() {
                let weight = soft_disc(self.centre(column, row), centre, radius);
                let k = self.index(column, row);
                if weight > 0.0 && !self.solid[k] && act(self, k, weight) {
                    self.touch(k);
                }
            }
        }
    }
}
