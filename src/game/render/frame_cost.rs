//! What a frame's picture costs: the time of whole frames while the world stands, and of each pass from frames that draw it
//! more than once, or not at all.

use crate::{
    game::{
        render::{cost::PicturePass, level::Level, offscreen::Offscreen},
        views::table::ELEMENTS,
    },
    kernel::params::Preset,
    scene::{self, SceneError, effects::EffectModes},
    sim::checkpoint::Checkpoint,
};
use glam::UVec2;
use serde::Serialize;
use std::{sync::Arc, time::Duration};

/// Size of the pictures, pixels: that of the game's window at its start.
pub const SIZE: UVec2 = UVec2::new(1280, 800);
/// Scenes, and the ticks after which they show what they have: water, grains, lava with steam, fire, two liquids.
pub const SCENES: [(&str, u64); 5] =
    [("waterfall", 300), ("hourglass", 300), ("volcano", 600), ("burning_house", 420), ("layers", 300)];
/// How often a pass is drawn to tell what it costs once: often, as a single one is lost in what frames differ by. One over all of
/// the screen is left out, as graphics that work tile by tile draw only the last of those.
fn times(pass: PicturePass) -> u32 {
    if pass.is_over_all() { 0 } else { 5 }
}

/// What the picture of a scene costs at a level.
#[derive(Clone, Debug, Serialize)]
pub struct FrameCost {
    /// The scene.
    pub scene: &'static str,
    /// Name of the level.
    pub level: &'static str,
    /// Median time of a frame, ms.
    pub frame: f64,
    /// Passes that draw something: name, instances, and what they take, ms.
    pub passes: Vec<(&'static str, u32, f64)>,
}

/// Measures a scene at each level, over so many frames each, and names the graphics. The outer error is the scene's, the inner one
/// says that there are no graphics.
pub fn measure(
    name: &'static str,
    ticks: u64,
    frames: usize,
) -> Result<Result<(String, Vec<FrameCost>), String>, SceneError> {
    let blueprint = scene::load(name)?.build(&[], Some(Preset::Balanced), &EffectModes::new())?;
    let checkpoint = Checkpoint::of_scene(Arc::new(blueprint));
    Ok(Offscreen::new(&checkpoint, SIZE).map(|mut picture| {
        picture.run(ticks);
        let costs = Level::ALL.into_iter().rev().map(|level| at_level(&mut picture, name, level, frames)).collect();
        (picture.adapter(), costs)
    }))
}

fn at_level(picture: &mut Offscreen, scene: &'static str, level: Level, frames: usize) -> FrameCost {
    picture.show(&ELEMENTS, level);
    // The first has the rock to bake.
    median(picture, 3);
    let drawn = picture.drawn();
    let frame = median(picture, frames);
    let passes = PicturePass::ALL.into_iter().zip(drawn).filter(|(_, drawn)| *drawn > 0);
    let passes = passes
        .map(|(pass, drawn)| {
            let times = times(pass);
            picture.repeat(pass, times);
            let more = median(picture, frames) - frame;
            picture.repeat(pass, 1);
            (pass.name(), drawn, more / (f64::from(times) - 1.0))
        })
        .collect();
    FrameCost { scene, level: level.name(), frame, passes }
}

/// Median time of some frames, ms.
fn median(picture: &mut Offscreen, frames: usize) -> f64 {
    let mut times: Vec<Duration> = (0..frames.max(1)).map(|_| picture.frame()).collect();
    times.sort_unstable();
    1000.0 * times[times.len() / 2].as_secs_f64()
}
