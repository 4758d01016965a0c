//! What the HUD costs.

use bevy::{
    platform::time::Instant,
    prelude::{ResMut, Resource},
};
use std::collections::VecDeque;

/// Frames of which the cost is kept for the median.
const HISTORY: usize = 64;

/// Processor time of a frame's HUD, without turning it into triangles.
#[derive(Resource, Clone, Debug, Default)]
pub struct HudCost {
    /// ms.
    recent: VecDeque<f32>,
    begun: Option<Instant>,
}

impl HudCost {
    /// Median over the last frames, ms.
    pub fn milliseconds(&self) -> f32 {
        let mut sorted: Vec<f32> = self.recent.iter().copied().collect();
        sorted.sort_unstable_by(f32::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }
}

/// The HUD begins.
pub fn begin(mut cost: ResMut<HudCost>) {
    cost.begun = Some(Instant::now());
}

/// It is done.
pub fn end(mut cost: ResMut<HudCost>) {
    if let Some(begun) = cost.begun.take() {
        cost.recent.truncate(HISTORY - 1);
        cost.recent.push_front(begun.elapsed().as_secs_f32() * 1000.0);
    }
}
