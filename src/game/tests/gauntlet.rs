//! Watching a hard case.

use super::*;
use crate::{
    game::hud::panels::gauntlet::ID,
    sim::gauntlet::{Cases, Entry},
};

/// A player who is offered a case in which gravity points up from its fourth tick on.
fn offered() -> Player {
    let mut player = Player::new();
    let start = |preset| {
        let columns = [("columns".to_owned(), "6".to_owned())];
        scene::load("dam_break")?.build(&columns, Some(preset), &EffectModes::new())
    };
    let act = |world: &mut World, tick| {
        if tick >= 3 {
            world.resource_mut::<IntentQueue>().push(Intent::Gravity { gravity: Vec2::new(0.0, 50.0) });
        }
    };
    let case = Entry { name: "up", title: "Up", what: "It falls up.", start: Arc::new(start), act: Some(act) };
    player.0.insert_resource(Cases(vec![case]));
    player
}

fn gravity(player: &Player) -> f32 {
    player.world().resource::<Setup>().domain.gravity.y
}

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frame();
}

#[test]
fn a_case_is_played_with_its_script_until_another_scene_is() {
    let mut player = offered();
    order(&mut player, Order::Watch("up"));
    assert_eq!((player.particles(), gravity(&player) < 0.0), (72, true), "the start of the case");
    player.frames(10);
    assert_eq!(gravity(&player), 50.0, "its script acts from the fourth tick on");
    order(&mut player, Order::Scene { name: "hydrostatic".to_owned(), settings: vec![] });
    player.frames(10);
    assert!(gravity(&player) < 0.0, "in another scene it does not");
    let tick = player.tick();
    order(&mut player, Order::Watch("no such case"));
    assert!(player.tick() > tick, "what is not there changes nothing");
}

#[test]
fn a_key_opens_and_closes_the_list() {
    let mut player = offered();
    player.chord(&[KeyCode::F7]);
    assert!(player.world().resource::<Panels>().shows(ID));
    player.chord(&[KeyCode::F7]);
    assert!(!player.world().resource::<Panels>().shows(ID));
}
