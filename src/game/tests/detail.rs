//! The detail as a player has it: chosen live, undone, with brush and picture in their place.

use super::Player;
use crate::{
    game::{
        camera::WorldCamera,
        orders::{Order, Orders},
        toasts::Toasts,
        toolbox::Toolbox,
    },
    kernel::params::Preset,
    lab::{
        autopilot::{Autopilot, Goal},
        dial::{Accuracy, STEPS, Step},
        split::Split,
    },
    sim::{
        intent::Intent,
        state::{ParticleStore, Setup},
    },
};
use bevy::prelude::{KeyCode, World};
use glam::Vec2;

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

/// A player at a block of water that falls.
fn at_the_dam() -> Player {
    let mut player = Player::new();
    let settings = vec![("columns".to_owned(), "12".to_owned())];
    order(&mut player, Order::Scene { name: "dam_break".into(), settings, detail: 1.0 });
    player.frames(4);
    player
}

fn detail(world: &World) -> f32 {
    world.resource::<Setup>().blueprint.scale.detail
}

#[test]
fn a_detail_is_chosen_while_the_world_runs_and_undone() {
    let mut player = at_the_dam();
    player.chord(&[KeyCode::Space]);
    let (count, hash) = (player.particles(), player.hash());
    order(&mut player, Order::Detail(2.0));
    assert_eq!((player.particles(), detail(player.world())), (4 * count, 2.0));
    assert_eq!(player.world().resource::<Toasts>().last(), Some("Detail 2: 1,152 particles"));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!((player.hash(), detail(player.world())), (hash, 1.0), "the same bits");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.particles(), 4 * count);
    order(&mut player, Order::Detail(9.0));
    let told = player.world().resource::<Toasts>().last();
    assert!(told.is_some_and(|told| told.contains("allowed: 0.125 to 8")), "{told:?}");
    assert_eq!(detail(player.world()), 2.0);
}

#[test]
fn a_point_of_another_detail_is_chosen_and_undone_in_one_step() {
    let mut player = at_the_dam();
    player.chord(&[KeyCode::Space]);
    let at = |player: &Player| (player.hash(), player.world().resource::<Setup>().preset, detail(player.world()));
    let before = at(&player);
    assert_ne!(before.1, Preset::Draft);
    // What a mark on the accuracy panel's plot orders.
    player.0.world_mut().resource_mut::<Orders>().extend([Order::Detail(0.5), Order::Quality(Preset::Draft)]);
    player.frames(2);
    let (_, preset, detail) = at(&player);
    assert_eq!((preset, detail), (Preset::Draft, 0.5));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(at(&player), before);
}

#[test]
fn the_reference_quality_splits_and_a_lower_one_merges() {
    let mut player = at_the_dam();
    let count = player.particles();
    order(&mut player, Order::Quality(Preset::Reference));
    player.frames(3);
    assert_eq!((player.particles(), player.world().resource::<Setup>().preset), (4 * count, Preset::Reference));
    order(&mut player, Order::Quality(Preset::Balanced));
    player.frames(3);
    assert_eq!((player.particles(), player.world().resource::<Setup>().preset), (count, Preset::Balanced));
}

#[test]
fn picture_brush_and_drag_stay_in_their_place() {
    let mut player = Player::new();
    let middle = player.middle();
    let camera = |player: &Player| *player.world().resource::<WorldCamera>();
    order(&mut player, Order::Act(crate::game::actions::Action::Zoom(3)));
    let seen = |player: &Player| {
        let metres = player.world().resource::<Setup>().blueprint.scale.spacing;
        let (camera, tools) = (camera(player), player.world().resource::<Toolbox>());
        (camera.to_world(Vec2::new(300.0, 200.0)) * metres, tools.reach() * metres, camera.pixels_per_d() / metres)
    };
    player.point_at(middle);
    player.press();
    player.frames(2);
    let before = seen(&player);
    order(&mut player, Order::Detail(2.0));
    player.seen();
    player.frames(2);
    let after = seen(&player);
    assert!((after.0 - before.0).length() < 1e-4 && (after.1 - before.1).abs() < 1e-5, "{before:?} → {after:?}");
    assert!((after.2 / before.2 - 1.0).abs() < 1e-4, "{before:?} → {after:?}");
    // The button is still down: it goes on drawing where it points.
    let places: Vec<Vec2> = (player.seen().into_iter())
        .filter_map(|intent| match intent {
            Intent::Pour { stroke, .. } => Some(stroke.to),
            _ => None,
        })
        .collect();
    let wanted = 2.0 * middle;
    assert!(!places.is_empty() && places.iter().all(|place| place.distance(wanted) < 0.1), "{places:?}, not {wanted}");
}

#[test]
fn worlds_of_two_details_stand_side_by_side_and_take_the_same_input() {
    let mut player = at_the_dam();
    player.chord(&[KeyCode::KeyB]);
    order(&mut player, Order::SecondQuality(Preset::Reference));
    let second = |player: &Player| {
        let world = player.world().resource::<Split>().world().expect("the split is on");
        (world.resource::<ParticleStore>().len(), detail(world))
    };
    assert_eq!(second(&player), (4 * player.particles(), 2.0));
    let count = player.particles();
    order(&mut player, Order::Detail(0.5));
    player.frames(3);
    assert_eq!((player.particles(), second(&player)), (count / 4, (count, 1.0)), "both go to half of theirs");
}

#[test]
fn a_step_of_the_dial_changes_quality_and_detail_in_one_and_is_undone_in_one() {
    let mut player = at_the_dam();
    player.chord(&[KeyCode::Space]);
    let now = |player: &Player| (player.world().resource::<Setup>().preset, detail(player.world()), player.particles());
    let (start, hash, count) = (now(&player), player.hash(), player.particles());
    player.0.world_mut().resource_mut::<Autopilot>().hold(Some(Goal::Time(4.0)));
    for step in [STEPS[0], STEPS[5], STEPS[4]] {
        order(&mut player, Order::Accuracy(step));
        let particles = (count as f64 * step.particles()) as usize;
        assert_eq!(now(&player), (step.preset, step.own_detail() as f32, particles));
        assert_eq!(Accuracy::of(player.world().resource::<Setup>()).step().map(|found| STEPS[found]), Some(step));
    }
    assert_eq!(player.world().resource::<Autopilot>().goal(), None, "a choice by hand ends the autopilot");
    for _ in 0..3 {
        player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    }
    assert_eq!((now(&player), player.hash()), (start, hash), "three orders, three times undone");
}

#[test]
fn a_step_of_the_dial_of_the_same_detail_by_another_name_keeps_all_matter() {
    let mut player = at_the_dam();
    let count = player.particles();
    // The reference at half the detail has as many particles as any other quality at detail 1.
    order(&mut player, Order::Accuracy(Step { preset: Preset::Reference, detail: 0.5 }));
    assert_eq!(player.particles(), count);
    order(&mut player, Order::Accuracy(STEPS[2]));
    assert_eq!((player.particles(), player.world().resource::<Setup>().preset), (count, Preset::Fast));
    assert_eq!(detail(player.world()), 1.0);
}
