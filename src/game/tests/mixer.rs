//! Elements of the player's own.

use super::*;
use crate::{
    game::{hud::panels::mixer::PANEL, mixer::own::OwnElements},
    kernel::{
        element::{Element, ElementId},
        simd::InstructionSet,
    },
    sim::{
        generation::Generation,
        recorder::{Recorder, end_now},
        recording::Recording,
        replay::Replay,
        workers::Workers,
    },
};

fn tar() -> Element {
    Element { density: 1100.0, viscosity: 0.5, ..Element::plain("tar_2", false) }
}

fn tar_id(player: &Player) -> ElementId {
    player.world().resource::<Setup>().elements().find("tar_2").unwrap()
}

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

fn mix(player: &mut Player, element: Element) {
    order(player, Order::Mix(Box::new(element)));
}

fn knows(player: &Player, name: &str) -> bool {
    player.world().resource::<Setup>().elements().find(name).is_some()
}

fn in_hand(player: &Player) -> String {
    player.world().resource::<Toolbox>().tool.name(player.world().resource::<Setup>().elements()).to_owned()
}

#[test]
fn what_is_mixed_is_in_the_hand_and_pours() {
    let mut player = Player::new();
    mix(&mut player, tar());
    assert_eq!(in_hand(&player), "tar_2");
    player.pour_and_stop();
    let poured = player.particles();
    assert!(poured > 0);
    let id = tar_id(&player);
    assert!(player.world().resource::<ParticleStore>().element.iter().all(|element| *element == id));
    assert!(player.world().resource::<OwnElements>().find("tar_2").is_some(), "it is kept for other worlds");
    mix(&mut player, Element { density: 900.0, ..tar() });
    assert_eq!((player.particles(), knows(&player, "tar_2")), (poured, true), "what is there is changed");
    assert_eq!(player.world().resource::<Setup>().elements().get(id).density, 900.0);
}

#[test]
fn undo_takes_it_out_of_the_world_and_of_the_hand_and_redo_brings_it_back() {
    let mut player = Player::new();
    mix(&mut player, tar());
    player.act(Action::Undo);
    player.frames(2);
    assert!(!knows(&player, "tar_2"));
    assert_eq!(in_hand(&player), "water");
    player.pour_and_stop();
    player.act(Action::Undo);
    player.act(Action::Undo);
    assert!(player.world().resource::<OwnElements>().find("tar_2").is_some(), "it is still kept");
    let mut player = Player::new();
    mix(&mut player, tar());
    player.act(Action::Undo);
    player.act(Action::Redo);
    assert!(knows(&player, "tar_2"));
}

#[test]
fn the_world_stays_the_scene_that_it_is() {
    let mut player = Player::new();
    player.pour_and_stop();
    let before = (player.tick(), player.particles());
    let camera = player.world().resource::<WorldCamera>().to_pixel(player.middle());
    mix(&mut player, tar());
    assert_eq!((player.tick(), player.particles()), before);
    assert_eq!(player.world().resource::<WorldCamera>().to_pixel(player.middle()), camera);
}

#[test]
fn a_recording_across_it_comes_to_the_same_bits() {
    let mut player = Player::new();
    player.world().resource::<Recorder>().begin(player.world(), None);
    player.pour_and_stop();
    player.chord(&[KeyCode::Space]);
    mix(&mut player, tar());
    player.pour_and_stop();
    player.chord(&[KeyCode::Space]);
    player.frames(20);
    let end = end_now(player.world());
    let recording = Recording::decode(&player.world().resource::<Recorder>().recording(end).unwrap()).unwrap();
    assert!(recording.segments.len() >= 2, "a state that is put in the place of another begins a segment");
    let mut replay = Replay::new(&recording, Workers::single(), InstructionSet::detect()).unwrap();
    while replay.tick().unwrap() {}
    assert_eq!(replay.finish().unwrap(), player.hash());
}

#[test]
fn what_can_t_be_is_told_and_changes_nothing() {
    let mut player = Player::new();
    for element in [
        Element::plain("water", false),
        Element::plain("", false),
        Element { density: f32::INFINITY, ..tar() },
        Element { cohesion: 10.0, ..tar() },
    ] {
        let hash = player.hash();
        mix(&mut player, element);
        assert_eq!(player.hash(), hash);
        assert!(player.was_told("No such element"));
    }
    assert!(player.world().resource::<OwnElements>().iter().next().is_none());
}

#[test]
fn one_that_is_there_is_only_taken_up() {
    let mut player = Player::new();
    mix(&mut player, tar());
    player.chord(&[KeyCode::Digit1]);
    let before = Generation::of(player.world());
    mix(&mut player, tar());
    assert_eq!(in_hand(&player), "tar_2");
    assert!(Generation::of(player.world()) == before, "there is nothing to undo");
}

#[test]
fn one_that_is_forgotten_stays_where_it_is() {
    let mut player = Player::new();
    mix(&mut player, tar());
    order(&mut player, Order::ForgetElement("tar_2".to_owned()));
    assert!(player.world().resource::<OwnElements>().find("tar_2").is_none());
    assert!(knows(&player, "tar_2"));
}

#[test]
fn keys_open_the_panel_and_it_stays_beside_the_world() {
    let mut player = Player::new();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyE]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id));
    player.chord(&[KeyCode::Escape]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id), "it stays while one plays");
}
