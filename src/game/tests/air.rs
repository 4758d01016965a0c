//! The tools that move the air.

use super::*;
use crate::lab::hand::WIND_LIMIT;

#[test]
fn the_wind_blows_along_the_drag_and_has_a_limit() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyW]);
    player.point_at(player.middle());
    player.press();
    player.frame();
    for step in 1..=6 {
        player.point_at(player.middle() + Vec2::new(-12.0 * step as f32, 0.0));
        player.frame();
    }
    let seen = player.seen();
    let winds: Vec<Vec2> = seen
        .iter()
        .map(|intent| match intent {
            Intent::Blow { velocity, .. } => *velocity,
            other => panic!("wind only, not {other:?}"),
        })
        .collect();
    let blueprint = &player.world().resource::<Setup>().blueprint;
    let reference = Reference::of(&blueprint.domain, &blueprint.air);
    assert!(!winds.is_empty());
    for wind in winds {
        assert!(wind.x < 0.0 && wind.y.abs() < 0.01 * wind.x.abs(), "{wind} must point along the drag");
        assert!(wind.length() <= 1.001 * WIND_LIMIT * reference.wind, "{wind} is beyond the limit");
    }
}

#[test]
fn the_pressure_tool_adds_with_the_left_button_and_sucks_with_the_right() {
    for (button, sign) in [(MouseButton::Left, 1.0), (MouseButton::Right, -1.0)] {
        let mut player = Player::new();
        player.chord(&[KeyCode::KeyQ]);
        player.point_at(player.middle());
        player.button(button, ButtonState::Pressed);
        player.frames(2);
        let seen = player.seen();
        assert!(!seen.is_empty());
        for intent in seen {
            let Intent::Press { amount, .. } = intent else { panic!("pressure only, not {intent:?}") };
            assert_eq!(amount.signum(), sign);
        }
    }
}
