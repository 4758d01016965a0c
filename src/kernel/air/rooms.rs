//! Rooms of air that rock shuts off from each other, and the pressures at which they come to rest.

use super::{ledger::MOST_DRIFT, shape::Shape};

/// Air is at rest when no velocity and no pressure difference in a room is above this part of the speed of sound and of
/// the pressure. The dynamic pressure of such wind, `½ Ma²`, is at f32's resolution of the pressure. Changing this
/// affects when a grid falls asleep.
pub const QUIET_MACH: f32 = 1.0e-3;

/// What is in a room of air that rock shuts off from others.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Room {
    mass: f64,
    cells: u32,
    lowest: f32,
    highest: f32,
    /// Whether it has an open side of the box.
    open: bool,
}

impl Room {
    fn count(&mut self, pressure: f32) {
        self.lowest = if self.cells == 0 { pressure } else { self.lowest.min(pressure) };
        self.highest = self.highest.max(pressure);
        self.mass += f64::from(pressure);
        self.cells += 1;
    }

    /// Pressure at which it comes to rest.
    pub(super) fn rest(&self) -> f32 {
        if self.open { 1.0 } else { (self.mass / f64::from(self.cells.max(1))) as f32 }
    }

    /// Pressure that all of it gets when it falls asleep, where it should come to rest at `rest`: its mean, unless its mass has
    /// drifted.
    pub(super) fn settled(&self, rest: f32) -> f32 {
        let mean = self.rest();
        let drift = (f64::from(mean) - f64::from(rest)).abs();
        if drift > MOST_DRIFT * f64::from(rest) { rest } else { mean }
    }

    /// Whether no pressure is further from that of rest than the bound.
    pub(super) fn is_even(&self) -> bool {
        let rest = f64::from(self.rest());
        let tolerance = f64::from(QUIET_MACH) * rest;
        rest - f64::from(self.lowest) <= tolerance && f64::from(self.highest) - rest <= tolerance
    }
}

/// Counts what is in each room.
pub(super) fn count_rooms(shape: &Shape, pressure: &[f32], rooms: &mut Vec<Room>) {
    rooms.clear();
    rooms.extend(shape.room_open.iter().map(|open| Room { open: *open, ..Room::default() }));
    for (room, p) in shape.room.iter().zip(pressure).filter(|(room, _)| **room != u32::MAX) {
        rooms[*room as usize].count(*p);
    }
}
