//! Buffers of the exchange of momentum between particles and air (`feedback`).

use crate::blocks::Blocks;
use std::ops::Range;

/// Of a cell: the momentum that it meets, x and y, the mass that brings it, kg/m² d²; then its new velocity, d/s.
pub(super) type Meeting = [f32; 4];

/// Buffers of the exchange, of which nothing is kept from one to the next.
#[derive(Debug, Default)]
pub(super) struct Feedback {
    pub(super) blocks: Blocks,
    /// Columns that any particle reaches, counted with the ring.
    pub(super) columns: Range<usize>,
    /// One entry a cell, with the ring. Beyond the rows and columns that are reached it is left from before.
    pub(super) meetings: Vec<Meeting>,
    /// Tiles that don't sleep.
    pub(super) active: Vec<bool>,
}

impl Feedback {
    /// Bytes held.
    pub(super) fn memory_bytes(&self) -> usize {
        self.blocks.memory() + self.meetings.capacity() * size_of::<Meeting>() + self.active.capacity()
    }
}
