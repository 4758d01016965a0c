//! The player's try at a challenge: how it begins, what ends it, and what it earns. A recording that is shown is judged, too,
//! but earns nothing.

use super::{earned::Earned, referee::refusal};
use crate::{
    game::{
        actions::{Action, Take},
        history,
        orders::Order,
        playback::Playback,
        stamps::act,
        toasts::Toasts,
    },
    scene::{challenges, effects::EffectModes},
    sim::{
        checkpoint::Checkpoint,
        generation::Generation,
        intent::{Intent, IntentQueue},
        judge::{Judge, Verdict},
        pace::Pace,
        state::Setup,
    },
};
use bevy::prelude::{Res, ResMut, Resource, World};
use std::sync::Arc;
use tr::tr;

/// Whether the try that is judged is the player's own, and waits for its end.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Attempt {
    is_own: bool,
}

/// Begins a challenge: its scene, at the quality that is in force. Undo leads back to the world before, but to no state of an
/// earlier try.
pub fn begin(world: &mut World, name: &str) {
    let preset = world.get_resource::<Setup>().map(|setup| setup.preset);
    let built = challenges::find(name).and_then(|challenge| challenge.scene.build(&[], preset, &EffectModes::new()));
    let blueprint = match built {
        Ok(blueprint) => blueprint,
        Err(error) => return world.resource_mut::<Toasts>().warn(error.to_string()),
    };
    if world.contains_resource::<Setup>() {
        history::checkpoint(world);
    }
    history::forget_challenges(world);
    act::lay_down(world);
    Checkpoint::of_scene(Arc::new(blueprint)).restore(world);
    world.resource_mut::<IntentQueue>().push(Intent::Begin { challenge: name.to_owned() });
    let pace = *world.resource::<Pace>();
    *world.resource_mut::<Pace>() = Pace { paused: false, steps_due: 0, ..pace };
    world.resource_mut::<Attempt>().is_own = true;
}

/// Begins the one again that is tried; `false` if none is.
pub fn again(world: &mut World) -> bool {
    let name = world.resource::<Judge>().trial().map(|trial| trial.challenge.name.clone());
    let is_own = world.resource::<Attempt>().is_own;
    match name.filter(|_| is_own) {
        Some(name) => {
            begin(world, &name);
            true
        }
        None => false,
    }
}

/// Leaves it: the world goes on as any other.
pub fn leave(world: &mut World) {
    world.resource_mut::<Attempt>().is_own = false;
    if world.resource::<Judge>().trial().is_some() {
        world.resource_mut::<IntentQueue>().push(Intent::GiveUp);
    }
}

/// Whether an order may put another world in the place of this one, which then is no longer that of a challenge.
pub fn opens(order: &Order) -> bool {
    matches!(
        order,
        Order::Load(_)
            | Order::LoadBytes { .. }
            | Order::Scene { .. }
            | Order::Open { .. }
            | Order::Watch(_)
            | Order::Visit(_)
    )
}

/// Refuses what no challenge allows, and says so; whether it did.
pub fn refuses(world: &mut World, order: &Order) -> bool {
    let Some(trial) = world.resource::<Judge>().running() else { return false };
    let detail = world.get_resource::<Setup>().map_or(1.0, Setup::asked_detail);
    let lacking = match order {
        Order::Paste(_) | Order::TakePiece(_, _, Take::Cut) => "stamps",
        Order::Detail(_) => "another detail",
        Order::Accuracy(step) if (step.detail / detail - 1.0).abs() > 1e-6 => "another detail",
        Order::Effect(..) => "switching effects",
        Order::Throw(_) => "throwing",
        Order::Mix(_) => "mixing",
        Order::SetSource(..) => "springs and drains",
        Order::Act(Action::ClearAir) => "clearing the air",
        Order::Act(Action::Rewind) => "going back in time",
        _ => return false,
    };
    let told = refusal(trial, lacking);
    world.resource_mut::<Toasts>().say(told);
    true
}

/// A try ends where undo has led out of its scene.
pub fn leave_with_the_scene(setup: Res<Setup>, mut judge: ResMut<Judge>, mut attempt: ResMut<Attempt>) {
    let is_elsewhere = judge.trial().is_some_and(|trial| trial.challenge.scene.name() != setup.blueprint.name);
    if is_elsewhere {
        judge.leave();
        attempt.is_own = false;
    }
}

/// Keeps the stars of a try that is won.
pub fn see_the_end(judge: Res<Judge>, attempt: Res<Attempt>, mut earned: ResMut<Earned>, mut toasts: ResMut<Toasts>) {
    let Some(trial) = judge.trial().filter(|_| attempt.is_own) else { return };
    let Verdict::Won(stars) = trial.verdict else { return };
    let name = &trial.challenge.name;
    if earned.of(name).with(stars) != earned.of(name)
        && let Err(error) = earned.add(name, stars)
    {
        toasts.warn(tr!("The stars are not kept for the next session: {}", error));
    }
}

/// The world that orders may have replaced: if it is another one than before, its challenge is left.
pub fn leave_if_replaced(world: &mut World, before: Generation) {
    if Generation::of(world) == before {
        return;
    }
    // A recording brings all its intents along, and begins its own.
    if world.contains_resource::<Playback>() {
        world.resource_mut::<Attempt>().is_own = false;
        world.resource_mut::<Judge>().leave();
    } else {
        leave(world);
    }
}
