//! Undo, redo, reset, another scene.

use super::*;
use crate::{
    kernel::params::Preset,
    scene::effects::{Effect, Mode},
    sim::{
        effects::Effects,
        intent::{Intent, IntentQueue},
        state::Setup,
    },
};

#[test]
fn undo_and_redo_restore_the_exact_state() {
    let mut player = Player::new();
    player.chord(&[KeyCode::Space]);
    let empty = player.hash();
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    let drawn = player.hash();
    assert_ne!(drawn, empty);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), empty, "undo");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.hash(), drawn, "redo");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(player.world().resource::<Toasts>().last(), Some("Nothing to make again"));
}

#[test]
fn undo_and_redo_give_gravity_quality_and_effects_back() {
    let mut player = Player::new();
    player.point_at(player.middle());
    let of = |player: &Player| {
        let setup = player.world().resource::<Setup>();
        (setup.domain.gravity, setup.quality, player.world().resource::<Effects>().modes())
    };
    let before = of(&player);
    player.press();
    player.frame();
    player.release();
    let mut queue = player.0.world_mut().resource_mut::<IntentQueue>();
    queue.push(Intent::Gravity { gravity: -before.0 });
    queue.push(Intent::Effect { effect: Effect::Viscosity, mode: Mode::On });
    queue.push(Intent::Quality { preset: Preset::Draft, quality: Preset::Draft.quality() });
    player.frames(2);
    let after = of(&player);
    assert!(after.0 == -before.0 && after.1 != before.1 && after.2 != before.2, "{after:?}");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(of(&player), before, "undo");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    assert_eq!(of(&player), after, "redo");
}

#[test]
fn a_reset_can_be_undone() {
    let mut player = Player::new();
    player.chord(&[KeyCode::Space]);
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frames(2);
    let drawn = player.hash();
    player.chord(&[KeyCode::KeyR]);
    assert_eq!(player.particles(), 0);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!(player.hash(), drawn);
}

#[test]
fn another_scene_can_be_undone_and_shows_its_own_box() {
    let mut player = Player::new();
    player.point_at(player.middle());
    player.press();
    player.frame();
    player.release();
    player.frame();
    player.chord(&[KeyCode::Space]);
    let built = player.hash();
    let settings = vec![("columns".to_owned(), "12".to_owned())];
    player.0.world_mut().resource_mut::<Orders>().push(Order::Scene {
        name: "dam_break".into(),
        settings,
        detail: 1.0,
    });
    player.frames(2);
    let setup = player.world().resource::<Setup>();
    assert_eq!(setup.blueprint.name, "dam_break");
    assert_eq!(player.world().resource::<WorldCamera>().world(), setup.blueprint.domain.size);
    assert_eq!(player.particles(), 2 * 12 * 12);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    assert_eq!((player.hash(), player.world().resource::<Setup>().blueprint.name.as_str()), (built, "empty"));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    player.0.world_mut().resource_mut::<Orders>().push(Order::Scene {
        name: "nowhere".into(),
        settings: vec![],
        detail: 1.0,
    });
    player.frames(2);
    assert!(player.world().resource::<Toasts>().last().is_some_and(|text| text.contains("nowhere")));
    assert_eq!(
        player.world().resource::<Setup>().blueprint.name,
        "dam_break",
        "a scene that isn't there changes nothing"
    );
}

#[test]
fn a_scene_that_is_opened_has_its_own_quality_and_settings_whatever_is_in_force() {
    let open = |player: &mut Player, quality| {
        let settings =
            [("columns", "12"), ("iterations", "7")].map(|(name, value)| (name.to_owned(), value.to_owned()));
        let order = Order::Open { name: "dam_break".into(), settings: settings.into(), quality, detail: 1.0 };
        player.0.world_mut().resource_mut::<Orders>().push(order);
        player.frames(2);
        let setup = player.world().resource::<Setup>();
        (setup.preset, setup.quality)
    };
    let mut player = Player::new();
    let (own, first) = open(&mut player, None);
    let (fine, with_settings) = open(&mut player, Some(Preset::Fine));
    assert_eq!(fine, Preset::Fine);
    assert_ne!(with_settings, Preset::Fine.quality(), "what is set counts beside the quality");
    assert_eq!(open(&mut player, None), (own, first), "the quality before is forgotten");
}
