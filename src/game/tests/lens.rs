//! The truth lens by key and button: what it begins, what ends it, and what is left of it.

use super::*;
use crate::{
    game::{actions::Action, lens::Lens, rewind::Rewind},
    kernel::{params::Preset, particles::Particles},
    lab::{
        difference::{Difference, Half},
        split::Split,
    },
};

fn turn(player: &mut Player, key: KeyCode, state: ButtonState) {
    let mut keys = player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>();
    if state == ButtonState::Pressed {
        keys.press(key);
    } else {
        keys.release(key);
    }
    player.key(key, state);
    player.frame();
}

fn is_on(player: &Player) -> bool {
    let (lens, split) = (player.world().resource::<Lens>().is_on(), player.world().resource::<Split>().is_on());
    assert_eq!(lens, split, "the second world is there as long as the lens, and no longer");
    lens
}

fn at(player: &mut Player, preset: Preset) {
    player.0.world_mut().resource_mut::<Orders>().push(Order::Quality(preset));
    player.frames(2);
}

/// What glows in the ring.
fn heat(player: &Player) -> f32 {
    let (world, camera) = (player.world(), player.world().resource::<WorldCamera>());
    let second = world.resource::<Split>().world().expect("it is taken up");
    let ring = world.resource::<Lens>().ring(camera).expect("it is taken up");
    let mut difference = Difference::default();
    difference.measure(&world.resource::<Setup>().blueprint, Half::of(world), Half::of(second));
    difference.within(camera.to_world(ring.centre), ring.radius / camera.pixels_per_d()).heat
}

fn pour(player: &mut Player, frames: usize) {
    player.point_at(player.middle());
    player.press();
    player.frames(frames);
    player.release();
    player.frame();
}

#[test]
fn it_is_there_as_long_as_its_key_is_held_and_then_costs_nothing() {
    let mut player = Player::new();
    at(&mut player, Preset::Draft);
    pour(&mut player, 30);
    turn(&mut player, KeyCode::KeyL, ButtonState::Pressed);
    player.frames(40);
    assert!(is_on(&player));
    let second = player.world().resource::<Split>().world().expect("it is there");
    let setup = second.resource::<Setup>();
    assert_eq!((setup.preset, second.resource::<Clock>().tick), (Preset::Reference, player.tick()), "the same moment");
    assert!(heat(&player) > 0.0, "draft falls otherwise");
    // It is of another detail, so its blueprint is its own, and goes with it.
    let blueprint = Arc::downgrade(&setup.blueprint);
    turn(&mut player, KeyCode::KeyL, ButtonState::Released);
    assert!(!is_on(&player) && player.world().resource::<Split>().tick_time() == Duration::ZERO);
    assert_eq!(blueprint.strong_count(), 0, "the second world is still somewhere");
}

#[test]
fn the_world_does_not_feel_it() {
    let play = |looks: bool| {
        let mut player = Player::new();
        at(&mut player, Preset::Draft);
        pour(&mut player, 20);
        if looks {
            player.act(Action::Lens);
        } else {
            player.frame();
        }
        pour(&mut player, 20);
        assert_eq!(is_on(&player), looks);
        player.hash()
    };
    assert_eq!(play(true), play(false));
}

#[test]
fn equal_qualities_have_no_glow_and_it_says_so() {
    let mut player = Player::new();
    at(&mut player, Preset::Reference);
    pour(&mut player, 20);
    player.act(Action::Lens);
    pour(&mut player, 20);
    assert!(player.particles() > 0 && is_on(&player));
    assert_eq!(heat(&player), 0.0);
    let told: Vec<&str> = player.world().resource::<Toasts>().texts().collect();
    assert!(told.contains(&"This world runs at reference itself: the lens shows no difference"), "{told:?}");
}

#[test]
fn a_tap_or_a_button_takes_it_up_until_the_next() {
    let mut player = Player::new();
    turn(&mut player, KeyCode::KeyL, ButtonState::Pressed);
    turn(&mut player, KeyCode::KeyL, ButtonState::Released);
    player.frames(40);
    assert!(is_on(&player));
    player.chord(&[KeyCode::KeyL]);
    assert!(!is_on(&player));
    player.act(Action::Lens);
    player.frames(40);
    assert!(is_on(&player));
    player.act(Action::Lens);
    assert!(!is_on(&player));
}

#[test]
fn the_ring_follows_the_pointer_and_the_wheel_is_its_own() {
    let mut player = Player::new();
    let ring = |player: &Player| player.world().resource::<Lens>().ring(player.world().resource());
    assert_eq!(ring(&player), None);
    player.act(Action::Lens);
    player.point_at(player.middle() + Vec2::new(20.0, 10.0));
    player.frame();
    let (first, reach) = (ring(&player).expect("it is taken up"), player.world().resource::<Toolbox>().reach());
    let at = player.world().resource::<WorldCamera>().to_world(first.centre);
    assert!(at.distance(player.middle() + Vec2::new(20.0, 10.0)) < 0.1, "{at}");
    player.act(Action::Brush(2));
    assert!(ring(&player).expect("it is taken up").radius > 1.2 * first.radius);
    assert_eq!(player.world().resource::<Toolbox>().reach(), reach, "the brush stays as it is");
    player.event(WindowEvent::CursorLeft(bevy::window::CursorLeft { window: Entity::PLACEHOLDER }));
    player.frame();
    assert_eq!(ring(&player).map(|ring| ring.centre), Some(first.centre), "it stays where it was");
    player.act(Action::Lens);
    player.act(Action::Brush(2));
    assert!(player.world().resource::<Toolbox>().reach() > reach);
}

#[test]
fn it_and_the_split_have_one_second_world_between_them() {
    let mut player = Player::new();
    player.act(Action::Lens);
    player.act(Action::Split);
    let (lens, split) = (player.world().resource::<Lens>().is_on(), player.world().resource::<Split>().is_on());
    assert!(!lens && split, "the split takes its place");
    player.act(Action::Lens);
    assert!(!player.world().resource::<Lens>().is_on() && player.world().resource::<Split>().is_on());
    player.act(Action::Split);
    assert!(!is_on(&player));
}

#[test]
fn an_undo_begins_it_again_and_rewinding_ends_it() {
    let mut player = Player::new();
    pour(&mut player, 20);
    player.act(Action::Lens);
    player.frames(5);
    player.act(Action::Undo);
    player.frames(2);
    assert!(is_on(&player));
    let age = player.world().resource::<Split>().age(player.tick());
    assert!(age.is_some_and(|age| age <= 3), "{age:?}");
    player.act(Action::Rewind);
    assert!(player.world().resource::<Rewind>().progress().is_some() && !is_on(&player));
}

#[test]
fn only_a_difference_under_the_ring_glows() {
    let mut player = Player::new();
    player.act(Action::Lens);
    let begin = |world: &mut World| Split::begin(world, Preset::Balanced, Preset::Balanced.quality());
    begin(player.0.world_mut()).expect("it fits");
    player.chord(&[KeyCode::Space]);
    pour(&mut player, 4);
    {
        let mut split = player.0.world_mut().resource_mut::<Split>();
        let second = split.world_mut().expect("it is taken up");
        let store = &mut second.resource_mut::<ParticleStore>().0;
        assert!(store.len() > 10, "both are poured into");
        *store = Particles::default();
    }
    player.frame();
    assert!(heat(&player) > 0.1, "{}", heat(&player));
    player.point_at(Vec2::new(2.0, 2.0));
    player.frame();
    assert_eq!(heat(&player), 0.0, "nothing differs there");
}
