//! What a player looks at of gauges, and where their marks are.

use crate::{
    game::camera::WorldCamera,
    kernel::units::Scale,
    lab::gauges::{
        place::Place,
        quantity::{QUANTITIES, Quantity},
        set::Gauge,
    },
};
use bevy::prelude::Resource;
use glam::Vec2;
use std::fmt;

/// From a place to the middle of its mark, logical pixels.
const BESIDE: Vec2 = Vec2::new(15.0, -15.0);
/// Radius of a mark, logical pixels.
pub const MARK: f32 = 9.5;

/// What a player looks at, and has begun.
#[derive(Resource, Clone, Debug)]
pub struct GaugeDesk {
    /// What the plot shows.
    pub shown: Shown,
    /// The gauge that stands out.
    pub selected: Option<u32>,
    /// The scene (`Generation::scene`), and the first end of a line in it that waits for its second, m.
    begun: Option<(u64, Vec2)>,
}

/// A quantity that is shown.
#[derive(Clone, Copy, PartialEq)]
pub struct Shown(pub &'static Quantity);

impl fmt::Debug for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.name)
    }
}

impl Default for GaugeDesk {
    fn default() -> Self {
        Self { shown: Shown(&QUANTITIES[0]), selected: None, begun: None }
    }
}

impl GaugeDesk {
    /// The first end of a line that waits for its second in a scene, m.
    pub fn begun(&self, scene: u64) -> Option<Vec2> {
        self.begun.filter(|(of, _)| *of == scene).map(|(_, at)| at)
    }

    /// A line begins in a scene, m.
    pub fn begin(&mut self, scene: u64, at: Vec2) {
        self.begun = Some((scene, at));
    }

    /// No line waits for its second end any more; `false` if none did.
    pub fn lay_down(&mut self) -> bool {
        self.begun.take().is_some()
    }
}

/// Where the mark of a gauge is, logical pixels.
pub fn mark(gauge: &Gauge, camera: &WorldCamera, scale: Scale) -> Vec2 {
    let pixel = |at: Vec2| camera.to_pixel(scale.vec_to_kernel(at));
    match gauge.place {
        Place::Spot { at, .. } => pixel(at) + BESIDE,
        Place::Line { from, to } => {
            let along = pixel(to) - pixel(from);
            // To the left of the line, as the arrow is to its right. Pixels count down.
            let left = Vec2::new(along.y, -along.x).normalize_or(Vec2::NEG_Y);
            (pixel(from) + pixel(to)) / 2.0 + left * BESIDE.x
        }
    }
}
