//! What the HUD costs.

use bevy::{
    platform::time::Instant,
    prelude::{ResMut, Resource},
};

/// Frames of which the cost is kept for the median.
const HISTORY: usize = 64;

/// Processor time of a frame's HUD, without turning it into triangles.
#[derive(Resource, Clone, Debug, Default)]
pub struct HudCost {
    recent: Vec<f32>,
    next: usize,
    begun: Option<Instant>,
}

impl HudCost {
    /// Median over the last frames, ms.
    pub fn milliseconds(&self) -> f32 {
        let mut sorted = self.recent.clone();
        sorted.sort_unstable_by(f32::total_cmp);
        sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
    }

    fn note(&mut self, milliseconds: f32) {
        match self.recent.get_mut(self.next) {
            Some(slot) => *slot = milliseconds,
            None => self.recent.push(milliseconds),
        }
        self.next = (self.next + 1) % HISTORY;
    }
}

/// The HUD begins.
pub fn begin(mut cost: ResMut<HudCost>) {
    cost.begun = Some(Instant::now());
}

/// It is done.
pub fn end(mut cost: ResMut<HudCost>) {
    if let Some(begun) = cost.begun.take() {
        cost.note(begun.elapsed().as_secs_f32() * 1000.0);
    }
}
