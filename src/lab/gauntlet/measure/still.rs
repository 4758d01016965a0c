//! Whether a world stands still by all that physics knows, and whether its liquid is one whose density means something.

use crate::{
    kernel::{params::FluidParams, solids::is_whole},
    scene::{
        blueprint::Blueprint,
        effects::{Effect, Mode},
    },
};
use glam::{IVec2, Vec2};

/// Relaxation of the constraint that the solver takes where the pressure predictor runs: a softer liquid gives way.
const STIFF: f32 = 0.2;
/// Strength of the tensile correction up to which it does no more than keep particles apart.
const SLIGHT_TENSION: f32 = 0.001;

/// Whether a liquid only pushes, is not soft, and does not stand under pressure where it fills the lattice. Any other
/// has energy of position that nobody counts.
pub(in crate::lab::gauntlet) fn is_plain(fluid: &FluidParams) -> bool {
    fluid.rest_density >= 1.0
        && fluid.constraint_floor == 0.0
        && fluid.tension_strength <= SLIGHT_TENSION
        && fluid.relaxation <= STIFF
}

/// Why a scene is not at rest from the start with sleep off, if it is not: in water that fills all that is free up to one
/// height, at rest, under a gravity that pulls straight down, and in still air as warm as itself, every force is held by another.
pub(in crate::lab::gauntlet) fn why_not_at_rest(blueprint: &Blueprint) -> Result<(), &'static str> {
    let Blueprint { particles, solids, domain, emitters, winds, drains, pressures, effects, .. } = blueprint;
    let moves = |i: usize| particles.velocity(i) != Vec2::ZERO;
    let is_off = |effect: Effect| effects.get(&effect) == Some(&Mode::Off);
    if particles.is_empty() {
        return Err("nothing that could move");
    }
    if !(emitters.is_empty() && winds.is_empty() && drains.is_empty() && pressures.is_empty()) {
        return Err("something flows or blows");
    }
    if effects.get(&Effect::Sleep) != Some(&Mode::Off) {
        return Err("sleep would hide motion");
    }
    if is_off(Effect::Predictor) || !blueprint.quality.predictor {
        return Err("no predictor");
    }
    if domain.gravity.x != 0.0 || domain.gravity.y > 0.0 || (0..particles.len()).any(moves) {
        return Err("it begins in motion");
    }
    if particles.element.iter().any(|element| blueprint.elements.get(*element).is_gas()) {
        return Err("a gas rises");
    }
    let is_hot = particles.has_heat() || !solids.heats().is_empty();
    if is_hot && ![Effect::Heat, Effect::Convection, Effect::Air].into_iter().any(is_off) {
        return Err("what is hot or cold stirs the air");
    }
    let top = particles.y.iter().fold(0.0_f32, |top, y| top.max(*y)) as i32;
    let cells = (0..=top).flat_map(|y| (0..solids.columns()).map(move |x| IVec2::new(x, y)));
    let free = cells.filter(|cell| is_whole(*cell, domain.size) && !solids.is_solid(*cell)).count();
    if free == particles.len() { Ok(()) } else { Err("it begins in motion") }
}
