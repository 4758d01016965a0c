//! What the picture costs.

use bevy::prelude::Resource;
use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// Processor time that the last frame's picture cost, µs: written by the render world, shown in the details.
#[derive(Resource, Clone, Default)]
pub struct RenderCost {
    pub(super) extract: Arc<AtomicU32>,
    pub(super) upload: Arc<AtomicU32>,
}

impl RenderCost {
    /// Time for copying the world out and for handing it to the graphics, ms.
    pub fn milliseconds(&self) -> (f32, f32) {
        let ms = |micros: &AtomicU32| micros.load(Ordering::Relaxed) as f32 / 1000.0;
        (ms(&self.extract), ms(&self.upload))
    }
}
