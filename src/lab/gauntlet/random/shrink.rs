//! Makes what fails smaller: what is not needed for a rule to break is left out.

use super::{
    case::Case,
    examine::examine,
    scene::{Scene, smaller},
    world::World,
};
use crate::lab::gauntlet::{judged::Found, rule::Rule};

/// Runs that a failure may take to be made smaller. Which worlds these are depends on the world alone, so that its file is
/// the same whoever finds it.
const TRIES: usize = 24;

/// The first rule that is broken, and at which tick.
pub(super) fn first_broken(found: &Found) -> Option<(Rule, u64)> {
    found.broken().next().map(|(rule, measured)| (rule, measured.tick))
}

/// The case of a world that breaks `rule` at `tick`, smaller where that breaks it, too; `what` is said at its head.
pub(super) fn shrink(world: &World, (rule, tick): (Rule, u64), what: &str) -> Case {
    let mut smallest = world.clone();
    let mut tries = TRIES;
    let mut breaks = |world: &World| {
        tries = tries.saturating_sub(1);
        tries > 0 && first_broken(&examine(&world.case())).is_some_and(|(broken, _)| broken == rule)
    };
    // Rest is judged at the end of the time that it is given; a panic knows no tick.
    if rule != Rule::Rest && tick > 0 && (tick as u32) < world.ticks {
        let shorter = World { ticks: tick as u32, ..cut(world, tick) };
        if breaks(&shorter) {
            smallest = shorter;
        }
    }
    let untouched = World { input: Vec::new(), ..smallest.clone() };
    if !smallest.input.is_empty() && breaks(&untouched) {
        smallest = untouched;
    }
    for entry in (0..smallest.input.len()).rev() {
        let mut fewer = smallest.clone();
        fewer.input.remove(entry);
        if breaks(&fewer) {
            smallest = fewer;
        }
    }
    let breaks_as = |scene: &Scene, breaks: &mut dyn FnMut(&World) -> bool| {
        breaks(&World { scene: scene.clone(), ..smallest.clone() })
    };
    let mut scene = smallest.scene.clone();
    while let Some(smaller) = smaller(&scene).find(|scene| breaks_as(scene, &mut breaks)) {
        scene = smaller;
    }
    smallest.scene = scene;
    smallest.scene.head = Case::head(smallest.ticks, what);
    smallest.case()
}

/// Without what is done from `tick` on.
fn cut(world: &World, tick: u64) -> World {
    let input = world.input.iter().filter(|entry| entry.tick < tick).cloned().collect();
    World { input, ..world.clone() }
}
