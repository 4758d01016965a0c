//! The numbers of a random scene: quality, liquid, effects, gravity, sides, and what a world of these costs.

use super::dice::Dice;
use crate::{
    kernel::params::{Preset, Quality},
    scene::{KNOBS, Knob, Part, Range, Values, effects::Effect},
};

/// A value of a knob as a scene has it.
fn value(dice: &mut Dice, knob: &Knob) -> String {
    let Range { min, max, integer } = knob.values.range();
    match knob.values {
        Values::Words(words) => dice.one(words).to_owned(),
        Values::Number(_) if integer => dice.count(min as u32, max as u32).to_string(),
        Values::Number(_) => format!("{:?}", dice.number(min, max)),
    }
}

/// Values of knobs, each left out half the time.
fn knobs(dice: &mut Dice, knobs: impl Iterator<Item = &'static Knob>) -> Vec<String> {
    let chosen: Vec<_> = knobs.filter(|_| dice.comes(1, 2)).collect();
    chosen.into_iter().map(|knob| format!("{}: {}", knob.name, value(dice, knob))).collect()
}

/// A liquid. Half of them are the usual one, and of the others most have the density of the lattice.
pub(super) fn fluid(dice: &mut Dice) -> Vec<String> {
    let (usual, lattice) = (dice.comes(1, 2), dice.comes(2, 3));
    let liquid = |knob: &&Knob| knob.part == Part::Liquid && !(lattice && knob.name == "rest_density");
    if usual { Vec::new() } else { knobs(dice, KNOBS.iter().filter(liquid)) }
}

/// What a quality sets beside its preset, and the [`passes`] of a tick.
pub(super) fn quality(dice: &mut Dice, preset: Preset) -> (Vec<String>, f64) {
    let mut numbers = preset.quality();
    const COSTLY: [&str; 3] = ["substeps", "iterations", "air_cell"];
    let mut set = knobs(dice, Knob::of_quality().filter(|knob| !COSTLY.contains(&knob.name)));
    let range = |name: &str| Knob::find(name).map(|knob| knob.values.range());
    if dice.comes(1, 4)
        && let (Some(a), Some(b)) = (range(COSTLY[0]), range(COSTLY[1]))
    {
        let mut count = |range: Range| dice.count(range.min as u32, range.max as u32);
        (numbers.substeps, numbers.iterations) = (count(a), count(b));
        set.extend([format!("substeps: {}", numbers.substeps), format!("iterations: {}", numbers.iterations)]);
    }
    if dice.comes(1, 3)
        && let Some(range) = range(COSTLY[2])
    {
        let cell = dice.number(range.min, range.max);
        numbers.air_cell = cell as f32;
        set.push(format!("air_cell: {cell:?}"));
    }
    (set, passes(preset, numbers))
}

/// Passes over a particle or the air of its place that a tick takes at most, for each d² of the scene's own.
pub(super) fn passes(preset: Preset, Quality { substeps, iterations, air_cell, .. }: Quality) -> f64 {
    // A fast tick takes up to three times the substeps, at a finer detail so many times more.
    let detail = preset.detail();
    let most = 3.0 * f64::from(substeps) * detail * detail * detail;
    // A cell of air takes some twentieth of the neighbours of a pass, in each of up to 64 steps.
    most * (3.0 + f64::from(iterations) + 0.05 * 64.0 / f64::from(air_cell * air_cell))
}

/// Modes of the effects.
pub(super) fn effects(dice: &mut Dice) -> Vec<String> {
    let mut mode = |effect: Effect| {
        let mode = dice.one(&["auto", "auto", "auto", "on", "off"]);
        (mode != "auto").then(|| format!("{}: {mode}", effect.name()))
    };
    Effect::ALL.into_iter().filter_map(&mut mode).collect()
}

/// Gravity, sides and air: whole fields of the scene.
pub(super) fn fields(dice: &mut Dice) -> Vec<String> {
    let mut fields = Vec::new();
    let gravity = match dice.below(6) {
        0 | 1 => None,
        2 => Some((0.0, 0.0)),
        3 | 4 => Some((dice.within(-20.0, 20.0), dice.within(-20.0, 20.0))),
        _ => Some((dice.number(-1000.0, 1000.0), dice.number(-1000.0, 1000.0))),
    };
    fields.extend(gravity.map(|(x, y)| format!("gravity: ({x:?}, {y:?})")));
    fields.extend(sides(dice));
    if dice.comes(1, 2) {
        fields.push(format!("sound_speed: {:?}", dice.number(1.0, 400.0)));
    }
    if dice.comes(1, 3) {
        fields.push(format!("air_density: {:?}", dice.number(0.01, 1000.0)));
    }
    fields
}

/// Sides that are open, in half of the scenes.
pub(super) fn sides(dice: &mut Dice) -> Vec<String> {
    let is_open = dice.comes(1, 2);
    let open: Vec<&str> =
        ["left", "right", "bottom", "top"].into_iter().filter(|_| is_open && dice.comes(1, 2)).collect();
    let sides: Vec<String> = open.iter().map(|side| format!("{side}: true")).collect();
    if sides.is_empty() { Vec::new() } else { vec![format!("open: ({})", sides.join(", "))] }
}
