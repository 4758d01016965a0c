//! What the picture costs: the ledger of its passes.

use bevy::prelude::Resource;
use std::{
    array,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU32, Ordering},
    },
    time::Duration,
};

/// A pass of the picture, in the order in which they are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PicturePass {
    /// The box with its air, over the whole window.
    Backdrop,
    /// Bodies of liquids and powders, or the coloured particles of a view, into their fields.
    Bodies,
    /// Gases into their field.
    Gases,
    /// Rock, baked as the window shows it.
    Bake,
    /// Streaks of wind.
    Streaks,
    /// Surfaces of bodies, tile by tile.
    Surface,
    /// Grains.
    Grains,
    /// Rock in the light of the frame, tile by tile.
    Rock,
    /// Clouds and flames, tile by tile.
    Clouds,
    /// The truth lens's picture, in its ring.
    Lens,
    /// A picture of fewer pixels than the window over all of it.
    Enlarged,
}

impl PicturePass {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Backdrop,
        Self::Bodies,
        Self::Gases,
        Self::Bake,
        Self::Streaks,
        Self::Surface,
        Self::Grains,
        Self::Rock,
        Self::Clouds,
        Self::Lens,
        Self::Enlarged,
    ];

    /// Name on the screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Backdrop => "backdrop",
            Self::Bodies => "bodies",
            Self::Gases => "gases",
            Self::Bake => "bake",
            Self::Streaks => "streaks",
            Self::Surface => "surface",
            Self::Grains => "grains",
            Self::Rock => "rock",
            Self::Clouds => "clouds",
            Self::Lens => "lens",
            Self::Enlarged => "enlarged",
        }
    }

    /// Whether it covers all that was drawn before.
    pub fn is_over_all(self) -> bool {
        matches!(self, Self::Backdrop | Self::Enlarged)
    }
}

/// A pass that is drawn more than once in each frame, or not at all, so that what it costs can be told; none in play.
#[derive(Resource, Clone, Copy, Debug, Default)]
pub struct Repeat(pub Option<(PicturePass, u32)>);

impl Repeat {
    /// How often a pass is drawn.
    pub(super) fn times(self, pass: PicturePass) -> u32 {
        self.0.filter(|(of, _)| *of == pass).map_or(1, |(_, times)| times)
    }
}

/// Processor time that the last frame's picture cost, µs, how much each pass drew, and whether it is all there: written by the
/// render world, shown in the details.
#[derive(Resource, Clone, Default)]
pub struct RenderCost {
    pub(super) extract: Arc<AtomicU32>,
    pub(super) pack: Arc<AtomicU32>,
    pub(super) upload: Arc<AtomicU32>,
    /// Instances that each pass drew; 0 if it was not called.
    drawn: Arc<[AtomicU32; PicturePass::ALL.len()]>,
    waits: Arc<AtomicBool>,
}

impl RenderCost {
    /// Time for copying the world out, for packing what was copied and for handing that to the graphics, ms.
    pub fn milliseconds(&self) -> [f32; 3] {
        [&self.extract, &self.pack, &self.upload].map(|micros| micros.load(Ordering::Relaxed) as f32 / 1000.0)
    }

    /// What each pass drew in the last frame.
    pub fn drawn(&self) -> [u32; PicturePass::ALL.len()] {
        array::from_fn(|k| self.drawn[k].load(Ordering::Relaxed))
    }

    /// Whether the last frame did without something that the graphics are still making.
    pub fn waits(&self) -> bool {
        self.waits.load(Ordering::Relaxed)
    }

    pub(super) fn note_wait(&self, waits: bool) {
        self.waits.store(waits, Ordering::Relaxed);
    }

    pub(super) fn begin(&self) {
        self.drawn.iter().for_each(|count| count.store(0, Ordering::Relaxed));
    }

    pub(super) fn note(&self, pass: PicturePass, instances: u32) {
        self.drawn[pass as usize].fetch_add(instances, Ordering::Relaxed);
    }

    pub(super) fn note_time(time: &AtomicU32, taken: Duration) {
        time.store(taken.as_micros() as u32, Ordering::Relaxed);
    }
}
