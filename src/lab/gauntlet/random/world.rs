//! A random world: a scene and what hands do to it.

use super::{
    case::Case,
    contents::{drain, emitter, placement, pool, pressure, rock, some, wind},
    dice::Dice,
    hands::{self, Hands},
    scene::{Entries, Scene},
    tuning,
};
use crate::{
    kernel::params::Preset,
    scene::{self, effects::EffectModes},
    sim::recording::Entry,
};
use glam::Vec2;

/// Work of a world, passes over a particle: what its ticks are as many for.
const WORK: f64 = 1.2e7;
/// Ticks of a world: at least, at most.
const TICKS: (f64, f64) = (3.0, 120.0);
/// Ticks of a world that stands still: 3 s.
const STILL_TICKS: u32 = 180;
/// Share of a world's ticks in which hands act: what they do has the rest to come to its end.
const HANDS: f64 = 2.0 / 3.0;

/// A world of the random gauntlet.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The quality that it begins at.
    pub preset: Preset,
    /// Its scene.
    pub(super) scene: Scene,
    /// What is done, oldest first.
    pub(super) input: Vec<Entry>,
    /// Ticks to run.
    pub ticks: u32,
}

impl World {
    /// The world of a seed and an index, at one of these qualities.
    pub fn new(seed: u64, index: u64, presets: &[Preset]) -> Self {
        let mut dice = Dice::new(seed, index);
        let preset = dice.one(presets);
        // One in six stands still, which no other would by chance.
        let is_still = dice.comes(1, 6) && preset.quality().predictor;
        let make = match is_still {
            true => still,
            false if dice.comes(1, 3) => usual,
            false => lively,
        };
        let (scene, size, passes) = make(&mut dice, preset);
        let most = if is_still { f64::from(STILL_TICKS) } else { TICKS.1 };
        let work = f64::from(size.x * size.y) * passes;
        let ticks = (WORK / work).clamp(TICKS.0, most) as u32;
        let acting = ((f64::from(ticks) * HANDS) as u32).max(1);
        let input = match is_still {
            true => hands::idle(&mut dice, preset, acting),
            false => act(&mut dice, &scene, acting),
        };
        Self { preset, scene, input, ticks }
    }

    /// It as a case.
    pub fn case(&self) -> Case {
        Case { scene: self.scene.text(), input: self.input.clone(), ticks: self.ticks }
    }
}

/// What hands do to the world of a scene; nothing where the scene is none.
fn act(dice: &mut Dice, scene: &Scene, ticks: u32) -> Vec<Entry> {
    let built = scene::from_text("random", scene.text()).and_then(|file| file.build(&[], None, &EffectModes::new()));
    let Ok(blueprint) = built else { return Vec::new() };
    Hands { size: blueprint.domain.size, elements: &blueprint.elements }.act(dice, ticks)
}

fn size_of(size: Vec2) -> String {
    format!("(\"{} * d\", \"{} * d\")", size.x, size.y)
}

/// Anything: the scene, its size in its own spacings, and passes of a tick for each d².
fn lively(dice: &mut Dice, preset: Preset) -> (Scene, Vec2, f64) {
    let mut side = || match dice.below(6) {
        0 => 4.0,
        1 => dice.within(4.0, 40.0) as f32,
        _ => dice.whole(4, 47) as f32,
    };
    let size = Vec2::new(side(), side());
    let (quality, passes) = tuning::quality(dice, preset);
    let spacing = if dice.comes(1, 2) { 0.1 } else { dice.number(0.001, 10.0) };
    let scene = Scene {
        head: String::new(),
        spacing: format!("{spacing:?}"),
        size: size_of(size),
        preset: preset.name(),
        lists: lists(
            [
                some(dice, 5, size, placement),
                some(dice, 2, size, emitter),
                some(dice, 2, size, wind),
                some(dice, 1, size, drain),
                some(dice, 2, size, pressure),
            ],
            [tuning::fields(dice), tuning::fluid(dice), tuning::effects(dice), quality],
        ),
    };
    (scene, size, passes)
}

/// What players make: a larger box with much in it, and all numbers as they are by default.
fn usual(dice: &mut Dice, preset: Preset) -> (Scene, Vec2, f64) {
    let size = Vec2::new(dice.whole(24, 64) as f32, dice.whole(16, 40) as f32);
    let mut contents = some(dice, 4, size, placement);
    contents.push(pool(dice, 0.5 * size));
    let contents = [
        contents,
        some(dice, 1, size, emitter),
        some(dice, 1, size, wind),
        some(dice, 1, size, drain),
        some(dice, 1, size, pressure),
    ];
    untuned(preset, size, lists(contents, [tuning::sides(dice), Vec::new(), Vec::new(), Vec::new()]))
}

/// The parts of a scene: contents, emitters, winds, drains, pressures; fields, liquid, effects, quality.
fn lists([contents, emitters, winds, drains, pressures]: [Vec<String>; 5], numbers: [Vec<String>; 4]) -> [Entries; 9] {
    let [fields, fluid, effects, quality] = numbers;
    [
        Entries::list("contents", contents),
        Entries::list("emitters", emitters),
        Entries::list("winds", winds),
        Entries::list("drains", drains),
        Entries::list("pressures", pressures),
        Entries::fields("", fields),
        Entries::fields("fluid", fluid),
        Entries { brackets: ["{", "}"], ..Entries::fields("effects", effects) },
        Entries::fields("quality", quality),
    ]
}

/// Water that lies on the floor around rock, with nothing that could move it and nothing asleep.
fn still(dice: &mut Dice, preset: Preset) -> (Scene, Vec2, f64) {
    let size = Vec2::new(dice.whole(8, 40) as f32, dice.whole(8, 24) as f32);
    let mut contents = some(dice, 2, size, rock);
    contents.push(pool(dice, size));
    let gravity = format!("gravity: (0, {:?})", -dice.within(0.0, 20.0));
    let none = || Vec::new();
    let awake = vec!["sleep: off".to_owned()];
    untuned(preset, size, lists([contents, none(), none(), none(), none()], [vec![gravity], none(), awake, none()]))
}

/// A scene in spacings of 0.1 m, of which all numbers of the quality are the preset's.
fn untuned(preset: Preset, size: Vec2, lists: [Entries; 9]) -> (Scene, Vec2, f64) {
    let spacing = "0.1".to_owned();
    let scene = Scene { head: String::new(), spacing, size: size_of(size), preset: preset.name(), lists };
    (scene, size, tuning::passes(preset, preset.quality()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::gauntlet::{judged::Found, random::examine::examine};

    #[test]
    fn a_world_is_a_function_of_seed_and_index() {
        let world = |seed, index| World::new(seed, index, &Preset::ALL).case();
        assert_eq!(world(3, 7), world(3, 7));
        assert!(world(3, 7).scene != world(3, 8).scene && world(3, 7).scene != world(4, 7).scene);
    }

    #[test]
    fn worlds_are_valid_and_of_every_kind() {
        let worlds: Vec<World> = (0..400).map(|index| World::new(1, index, &Preset::ALL)).collect();
        let built = |world: &World| {
            let file = scene::from_text("random", world.scene.text());
            file.and_then(|file| file.build(&[], None, &EffectModes::new()))
        };
        let refused: Vec<String> = worlds.iter().filter_map(|world| Some(built(world).err()?.to_string())).collect();
        assert!(refused.len() < 100, "{} of 400 are refused, one: {}", refused.len(), refused[0]);
        for preset in Preset::ALL {
            assert!(worlds.iter().filter(|world| world.preset == preset).count() > 30, "{}", preset.name());
        }
        for field in ["emitters", "winds", "drains", "pressures", "open", "fluid", "effects", "gravity", "air_cell"] {
            let with = worlds.iter().filter(|world| world.case().scene.contains(&format!("{field}: "))).count();
            assert!(with > 40, "{field} in {with} of 400");
        }
        assert!(worlds.iter().filter(|world| world.input.is_empty()).count() < 200);
        let only = World::new(1, 5, &[Preset::Fine]);
        assert!(only.preset == Preset::Fine && only.case().scene.contains("preset: fine"));
    }

    #[test]
    fn a_world_comes_out_the_same_again() {
        for index in 0..6 {
            let case = World::new(2, index, &[Preset::Draft]).case();
            let found = examine(&case);
            assert_eq!(found, examine(&case));
            assert!(matches!(found, Found::Refused) || found.findings().len() > 1);
        }
    }
}
