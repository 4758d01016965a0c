//! The museum.

use super::*;
use crate::{
    game::{hud::panels::museum::PANEL, museum::Museum},
    lab::exam::exhibits::EXHIBITS,
    sim::generation::Generation,
};

fn visit(player: &mut Player, name: &'static str) {
    player.0.world_mut().resource_mut::<Orders>().push(Order::Visit(name));
    player.frame();
}

fn shown(player: &Player) -> Option<&'static str> {
    let generation = *player.world().resource::<Generation>();
    player.world().resource::<Museum>().shown(generation).map(|exhibit| exhibit.name)
}

#[test]
fn every_exhibit_opens_runs_and_is_left_by_undo() {
    let mut player = Player::new();
    player.pour_and_stop();
    let before = player.particles();
    for exhibit in &EXHIBITS {
        visit(&mut player, exhibit.name);
        assert_eq!(shown(&player), Some(exhibit.name));
        let tick = player.tick();
        player.frames(8);
        assert!(player.tick() > tick, "{} stands still", exhibit.name);
        player.act(Action::Undo);
        player.frames(2);
        assert_eq!((shown(&player), player.particles()), (None, before), "{}", exhibit.name);
        assert_eq!(player.world().resource::<Pace>().speed, 1.0, "{} leaves its speed behind", exhibit.name);
    }
}

#[test]
fn a_reset_begins_it_again_and_another_scene_ends_it() {
    let mut player = Player::new();
    visit(&mut player, "free_fall");
    player.frames(40);
    player.act(Action::Reset);
    assert_eq!(shown(&player), Some("free_fall"));
    assert!(player.tick() < 5);
    visit(&mut player, "no such exhibit");
    assert_eq!(shown(&player), Some("free_fall"));
    let scene = Order::Scene { name: "empty".to_owned(), settings: vec![], detail: 1.0 };
    player.0.world_mut().resource_mut::<Orders>().push(scene);
    player.frames(2);
    assert_eq!(shown(&player), None);
}

#[test]
fn keys_open_the_panel_and_it_stays_beside_the_world() {
    let mut player = Player::new();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::F6]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id));
    player.chord(&[KeyCode::Escape]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id), "it stays while one looks");
}
