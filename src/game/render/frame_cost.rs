//! What a frame's picture costs: the time of whole frames while the world stands, of each pass from frames that draw it
//! more than once, or not at all, and processor time for what a frame needs of a world that runs.

use crate::{
    game::{
        render::{cost::PicturePass, level::Level, offscreen::Offscreen},
        views::table::ELEMENTS,
    },
    kernel::params::Preset,
    scene::{self, SceneError, effects::EffectModes},
    sim::{
        checkpoint::Checkpoint,
        state::{ParticleStore, Rock},
    },
};
use glam::UVec2;
use serde::Serialize;
use std::{array, sync::Arc};

/// Size of the pictures, pixels: that of the game's window at its start.
pub const SIZE: UVec2 = UVec2::new(1280, 800);
/// Scenes at a detail, and the ticks after which they show what they have: water, grains, lava with steam, fire, two liquids, a large
/// world whose rock changes, and a hundred thousand particles.
pub const SCENES: [(&str, f64, u64); 7] = [
    ("waterfall", 1.0, 300),
    ("hourglass", 1.0, 300),
    ("volcano", 1.0, 600),
    ("burning_house", 1.0, 420),
    ("layers", 1.0, 300),
    ("burning_house", 4.0, 420),
    ("dam_break", 3.15, 90),
];
/// How often a pass is drawn to tell what it costs once: often, as a single one is lost in what frames differ by. One over all of
/// the screen is left out, as graphics that work tile by tile draw only the last of those.
fn times(pass: PicturePass) -> u32 {
    if pass.is_over_all() { 0 } else { 5 }
}

/// What the picture of a scene costs.
#[derive(Clone, Debug, Serialize)]
pub struct SceneCost {
    /// The scene.
    pub scene: &'static str,
    /// Its detail.
    pub detail: f64,
    /// Movable particles.
    pub particles: usize,
    /// Cells of rock.
    pub rock: usize,
    /// Median processor time to copy out of the world what a frame needs, in frames with a tick each, ms.
    pub extract: f64,
    /// Likewise to pack that as the graphics read it, while the world may go on.
    pub pack: f64,
    /// Likewise to hand it to the graphics.
    pub upload: f64,
    /// At each level, the most first.
    pub levels: Vec<LevelCost>,
}

/// What it costs at a level.
#[derive(Clone, Debug, Serialize)]
pub struct LevelCost {
    /// Name of the level.
    pub level: &'static str,
    /// Median time of a frame, ms.
    pub frame: f64,
    /// Passes that draw something: name, instances, and what they take, ms.
    pub passes: Vec<(&'static str, u32, f64)>,
}

/// Measures a scene, over so many frames each time, and names the graphics. The outer error is the scene's, the inner one says that
/// there are no graphics.
pub fn measure(
    (scene, detail, ticks): (&'static str, f64, u64),
    frames: usize,
) -> Result<Result<(String, SceneCost), String>, SceneError> {
    let blueprint = scene::load(scene)?.at_detail(detail).build(&[], Some(Preset::Balanced), &EffectModes::new())?;
    let checkpoint = Checkpoint::of_scene(Arc::new(blueprint));
    Ok(Offscreen::new(&checkpoint, SIZE).map(|mut picture| {
        picture.show(&ELEMENTS, Level::Full);
        picture.run(ticks.saturating_sub(frames as u64));
        let times: Vec<[f64; 3]> = (0..frames)
            .map(|_| {
                picture.tick();
                picture.processor_time()
            })
            .collect();
        let [particles, rock] =
            [picture.world().resource::<ParticleStore>().len(), picture.world().resource::<Rock>().count()];
        let levels = Level::ALL.into_iter().rev().map(|level| at_level(&mut picture, level, frames)).collect();
        let [extract, pack, upload] = array::from_fn(|part| middle(times.iter().map(|times| times[part]).collect()));
        (picture.adapter(), SceneCost { scene, detail, particles, rock, extract, pack, upload, levels })
    }))
}

fn at_level(picture: &mut Offscreen, level: Level, frames: usize) -> LevelCost {
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
    LevelCost { level: level.name(), frame, passes }
}

/// Median time of some frames, ms.
fn median(picture: &mut Offscreen, frames: usize) -> f64 {
    middle((0..frames.max(1)).map(|_| 1000.0 * picture.frame().as_secs_f64()).collect())
}

/// The median, of an even number the upper one; of none it is 0.
fn middle(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or_default()
}
