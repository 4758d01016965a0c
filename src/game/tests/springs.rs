//! Springs and drains under the mouse.

use super::Player;
use crate::{
    game::{
        actions::Action,
        brush_mode::BrushMode,
        camera::WorldCamera,
        orders::{Order, Orders},
        toolbox::Toolbox,
    },
    kernel::{brush::Stroke, sources::Rect},
    sim::state::Sources,
};
use bevy::{
    input::ButtonState,
    prelude::{KeyCode, MouseButton},
};
use glam::Vec2;

impl Player {
    /// Emitters and drains.
    fn sources(&self) -> (usize, usize) {
        let sources = self.world().resource::<Sources>();
        (sources.emitters.len(), sources.drains.len())
    }

    /// Presses a button at a place, d, and holds it for some frames.
    fn press_at(&mut self, button: MouseButton, at: Vec2) {
        self.point_at(at);
        self.button(button, ButtonState::Pressed);
        self.frames(5);
        self.button(button, ButtonState::Released);
        self.frames(2);
    }
}

#[test]
fn a_spring_flows_on_and_goes_by_another_press() {
    let mut player = Player::new();
    let (above, below) = (player.middle() + Vec2::new(0.0, 20.0), player.middle() - Vec2::new(0.0, 20.0));
    player.chord(&[KeyCode::KeyU]);
    assert!(player.was_told("Springs: the left button sets one of water"));
    player.press_at(MouseButton::Left, above);
    assert_eq!(player.sources(), (1, 0), "one for each press, however long it is held");
    player.frames(60);
    let given = player.particles();
    assert!(given > 50, "{given} particles in a second");
    player.press_at(MouseButton::Right, below);
    assert_eq!(player.sources(), (1, 1));
    player.press_at(MouseButton::Left, above);
    assert_eq!(player.sources(), (0, 1), "a press on a spring takes it away");
    player.press_at(MouseButton::Left, below);
    assert_eq!(player.sources(), (0, 0), "and one on a drain");
    player.act(Action::Undo);
    assert_eq!(player.sources(), (0, 1));
    (0..3).for_each(|_| player.act(Action::Undo));
    assert_eq!((player.sources(), player.particles()), ((0, 0), 0));
}

#[test]
fn a_rectangle_is_a_spring_and_what_is_fixed_is_none() {
    let mut player = Player::new();
    player.act(Action::BrushMode(BrushMode::Spring));
    let (low, high) = (player.middle() - Vec2::new(9.0, 3.0), player.middle() + Vec2::new(9.0, 3.0));
    player.point_at(low);
    player.key(KeyCode::ControlLeft, ButtonState::Pressed);
    player.press();
    player.frame();
    player.point_at(high);
    player.frame();
    player.release();
    player.key(KeyCode::ControlLeft, ButtonState::Released);
    player.frames(2);
    let Rect { min, max } = player.world().resource::<Sources>().emitters[0].area;
    assert!((min - low).length() < 0.1 && (max - high).length() < 0.1, "{min} {max}");
    player.choose("rock");
    player.press_at(MouseButton::Left, high + 20.0);
    assert!(player.was_told("rock does not flow"));
    assert_eq!(player.sources(), (1, 0));
    player.act(Action::BrushMode(BrushMode::Spring));
    assert_eq!(player.world().resource::<Toolbox>().mode(), BrushMode::Draw, "the key again draws");
    player.press_at(MouseButton::Left, high + 20.0);
    assert!(player.rocks() > 0 && player.sources() == (1, 0));
}

#[test]
fn the_largest_brush_sets_one_at_every_detail_and_a_larger_rectangle_is_refused() {
    let mut player = Player::new();
    player.act(Action::BrushMode(BrushMode::Spring));
    player.0.world_mut().resource_mut::<Toolbox>().set_radius(40.0);
    for detail in [1.0, 2.0] {
        player.0.world_mut().resource_mut::<Orders>().push(Order::Detail(detail));
        player.frames(2);
        player.press_at(MouseButton::Left, player.middle());
        assert_eq!(player.sources(), (1, 0), "detail {detail}");
        player.press_at(MouseButton::Left, player.middle());
        assert_eq!(player.sources(), (0, 0));
    }
    let size = player.world().resource::<WorldCamera>().world();
    let whole = Order::SetSource(MouseButton::Right, Stroke::rectangle(Vec2::ZERO, size));
    player.0.world_mut().resource_mut::<Orders>().push(whole);
    player.frames(2);
    assert!(player.sources() == (0, 0) && player.was_told("Too large"));
}

#[test]
fn there_are_no_more_than_can_be_and_this_is_said() {
    let mut player = Player::new();
    player.act(Action::BrushMode(BrushMode::Spring));
    player.0.world_mut().resource_mut::<Toolbox>().set_radius(0.5);
    for k in 0..Sources::MOST + 2 {
        player.press_at(MouseButton::Right, Vec2::new(4.0 + 3.0 * (k % 20) as f32, 10.0 + 3.0 * (k / 20) as f32));
    }
    assert_eq!(player.sources(), (0, Sources::MOST));
    assert!(player.was_told("There are 64 already"));
}
