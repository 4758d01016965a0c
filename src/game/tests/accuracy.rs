//! The accuracy panel's orders: autopilot, survey, A/B split.

use super::*;
use crate::{
    game::hud::panels::accuracy::panel::{AccuracyPanel, PANEL},
    kernel::params::Preset,
    lab::{
        autopilot::{Autopilot, Goal},
        difference::{Difference, Half},
        live::{
            accuracy::{Survey, SurveyRequest, Watched},
            measures::Measures,
        },
        split::Split,
    },
};

fn order(player: &mut Player, order: Order) {
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frames(2);
}

fn second(player: &Player) -> &World {
    player.world().resource::<Split>().world().expect("the split is on")
}

fn apart(player: &Player) -> Difference {
    let mut difference = Difference::default();
    let blueprint = &player.world().resource::<Setup>().blueprint;
    difference.measure(blueprint, Half::of(player.world()), Half::of(second(player)));
    difference
}

#[test]
fn a_key_opens_the_panel_and_only_then_the_error_is_measured() {
    let mut player = Player::new();
    assert!(!player.world().resource::<Watched>().0);
    player.chord(&[KeyCode::KeyA]);
    assert!(player.world().resource::<Panels>().shows(PANEL.id) && player.world().resource::<Watched>().0);
    player.chord(&[KeyCode::KeyH]);
    player.frame();
    assert!(!player.world().resource::<Watched>().0, "a hidden panel looks at nothing");
}

#[test]
fn all_is_measured_only_while_its_part_of_the_panel_is_open_and_seen() {
    let mut player = Player::new();
    let wanted = |player: &Player| player.world().resource::<Measures>().wanted();
    player.chord(&[KeyCode::KeyA]);
    assert!(!wanted(&player), "the panel opens with it closed");
    player.0.world_mut().resource_mut::<AccuracyPanel>().measures = true;
    player.frame();
    assert!(wanted(&player));
    player.chord(&[KeyCode::KeyH]);
    player.frame();
    assert!(!wanted(&player), "a hidden panel measures nothing");
    player.chord(&[KeyCode::KeyH]);
    player.frame();
    assert!(wanted(&player));
    player.chord(&[KeyCode::KeyA]);
    player.frame();
    assert!(!wanted(&player), "a closed panel measures nothing");
}

#[test]
fn who_chooses_a_quality_takes_over_from_the_autopilot() {
    let mut player = Player::new();
    order(&mut player, Order::Hold(Some(Goal::Time(4.0))));
    assert_eq!(player.world().resource::<Autopilot>().goal(), Some(Goal::Time(4.0)));
    assert!(player.world().resource::<Watched>().0);
    order(&mut player, Order::Quality(Preset::Fine));
    assert_eq!(player.world().resource::<Autopilot>().goal(), None);
    assert_eq!(player.world().resource::<Setup>().preset, Preset::Fine);
}

#[test]
fn a_survey_is_asked_for_once() {
    let mut player = Player::new();
    order(&mut player, Order::Survey(SurveyRequest::Begin));
    assert_eq!(player.world().resource::<Survey>().request, Some(SurveyRequest::Begin), "nobody is there to do it");
}

#[test]
fn edits_go_to_both_worlds_from_either_half_and_one_key_ends_the_split() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyB]);
    let preset = player.world().resource::<Setup>().preset;
    order(&mut player, Order::SecondQuality(preset));
    let half = |x: f32| Area { min: Vec2::new(x, 0.0), max: Vec2::new(x + 400.0, 700.0) };
    {
        let mut camera = player.0.world_mut().resource_mut::<WorldCamera>();
        let window = camera.window();
        camera.set_window(window, half(0.0));
        camera.set_others(Some([half(420.0), half(840.0)]));
    }
    player.choose("rock");
    player.point_at(player.middle());
    player.press();
    player.release();
    player.frames(2);
    player.choose("water");
    let above = player.world().resource::<WorldCamera>().to_pixel(player.middle() + Vec2::new(0.0, 20.0));
    let position = above + Vec2::new(420.0, 0.0);
    player.event(WindowEvent::CursorMoved(CursorMoved { window: Entity::PLACEHOLDER, position, delta: None }));
    player.press();
    player.frames(4);
    player.release();
    player.frames(20);
    assert!(player.rocks() > 0 && player.particles() > 0);
    assert_eq!(control::hash(second(&player)), player.hash(), "equal settings, equal worlds");
    assert!(apart(&player).is_nothing());
    order(&mut player, Order::SecondQuality(Preset::Classic));
    player.frames(30);
    assert_ne!(control::hash(second(&player)), player.hash());
    assert!(!apart(&player).is_nothing());
    // B at A's quality again, and A at B's: from then on there is nothing to see.
    order(&mut player, Order::SecondQuality(preset));
    assert!(apart(&player).is_nothing());
    order(&mut player, Order::SecondQuality(Preset::Classic));
    player.frames(10);
    assert!(!apart(&player).is_nothing());
    order(&mut player, Order::Quality(Preset::Classic));
    player.frames(10);
    assert_eq!(control::hash(second(&player)), player.hash());
    assert!(apart(&player).is_nothing());
    player.chord(&[KeyCode::Space]);
    let hash = player.hash();
    player.chord(&[KeyCode::KeyB]);
    assert!(!player.world().resource::<Split>().is_on());
    assert_eq!(player.hash(), hash, "the first world goes on");
}
