//! Watching a hard case.

use super::*;
use crate::{
    game::hud::panels::cases::window::Suite,
    lab::gauntlet::{CASES, GauntletCase},
};

fn gravity(player: &Player) -> f32 {
    player.world().resource::<Setup>().domain.gravity.y
}

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

#[test]
fn a_case_is_played_with_its_script_until_another_scene_is() {
    let mut player = Player::new();
    let case = CASES.iter().find(|case| case.name == "gravity_flips").expect("it is there");
    order(&mut player, Order::Watch(case.name));
    assert!(case.is_played(player.world().resource::<Setup>()));
    let mut turns = 0;
    let mut before = gravity(&player);
    for _ in 0..10 {
        player.frame();
        turns += u32::from(gravity(&player) * before < 0.0);
        before = gravity(&player);
    }
    assert!(turns >= 9, "its script turns gravity before each tick");
    order(&mut player, Order::Scene { name: "hydrostatic".to_owned(), settings: vec![], detail: 1.0 });
    player.frames(10);
    assert!(gravity(&player) < 0.0, "in another scene it does not");
    let tick = player.tick();
    order(&mut player, Order::Watch("no such case"));
    assert!(player.tick() > tick, "what is not there changes nothing");
}

#[test]
fn a_key_opens_and_closes_the_list() {
    let mut player = Player::new();
    player.chord(&[KeyCode::F7]);
    assert!(player.world().resource::<Panels>().shows(GauntletCase::PANEL.id));
    player.chord(&[KeyCode::F7]);
    assert!(!player.world().resource::<Panels>().shows(GauntletCase::PANEL.id));
}
