//! Copy, cut and paste.

use super::*;
use crate::{
    game::{
        actions::{Action, Take},
        stamps::{hand::Hand, shelf::Shelf},
    },
    kernel::{
        brush::Stroke,
        heat::held,
        piece::Turn,
        sources::{Drain, Rect},
    },
    sim::state::Sources,
};

impl Player {
    /// A box with warm water on a beam of rock, and time that stands.
    pub(super) fn at_a_pool() -> Self {
        let mut player = Self::new();
        player.chord(&[KeyCode::KeyP]);
        for (element, low, high) in [("rock", (-30.0, -10.0), (-10.0, -7.0)), ("water", (-30.0, -7.0), (-10.0, 5.0))] {
            player.choose(element);
            player.key(KeyCode::ControlLeft, ButtonState::Pressed);
            player.drag(low.into(), high.into());
            player.key(KeyCode::ControlLeft, ButtonState::Released);
        }
        player.chord(&[KeyCode::KeyT]);
        player.drag(Vec2::new(-20.0, 0.0), Vec2::new(-18.0, 0.0));
        player.choose("water");
        assert!(player.particles() > 150 && player.rocks() > 40 && player.heat() > 0);
        player
    }

    /// Drags with the left button between two places beside the middle, d.
    pub(super) fn drag(&mut self, from: Vec2, to: Vec2) {
        self.point_at(self.middle() + from);
        self.press();
        self.frame();
        self.point_at(self.middle() + to);
        self.frame();
        self.release();
        self.frames(2);
    }

    /// Clicks at a place beside the middle, d.
    pub(super) fn click(&mut self, at: Vec2) {
        self.drag(at, at);
    }

    /// Copies or cuts all of the pool.
    pub(super) fn take(&mut self, key: KeyCode) {
        self.chord(&[KeyCode::ControlLeft, key]);
        self.drag(Vec2::new(-31.0, -11.0), Vec2::new(-9.0, 6.0));
    }

    fn heat(&self) -> i64 {
        held(self.world().resource::<ParticleStore>(), self.world().resource::<Rock>())
    }

    fn hand(&self) -> &Hand {
        self.world().resource::<Hand>()
    }

    fn undo(&mut self) {
        self.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
        self.frames(2);
    }

    fn told(&self) -> String {
        self.world().resource::<Toasts>().last().unwrap_or_default().to_owned()
    }
}

#[test]
fn a_copy_is_pasted_as_often_as_one_likes_and_each_is_undone() {
    let mut player = Player::at_a_pool();
    let (particles, rocks, heat, before) = (player.particles(), player.rocks(), player.heat(), player.hash());
    player.take(KeyCode::KeyC);
    assert!(matches!(player.hand(), Hand::Stamp(..)), "{:?}", player.told());
    assert_eq!(player.hash(), before, "copying changes nothing");
    let mut hashes = vec![before];
    for (copies, x) in [(2, 0.0), (3, 24.0)] {
        player.click(Vec2::new(x, 0.0));
        let counts = (player.particles(), player.rocks(), player.heat());
        assert_eq!(counts, (copies * particles, copies * rocks, copies as i64 * heat), "{}", player.told());
        hashes.push(player.hash());
    }
    player.click(Vec2::new(24.0, 0.0));
    assert_eq!(player.particles(), 3 * particles, "it is pasted where it is already");
    assert!(player.told().contains("did not fit"), "{}", player.told());
    for hash in hashes.into_iter().rev() {
        player.undo();
        assert_eq!(player.hash(), hash);
        if hash != before {
            assert!(matches!(player.hand(), Hand::Stamp(..)));
        }
    }
}

#[test]
fn what_is_cut_goes_and_comes_back_pasted_in_place() {
    let mut player = Player::at_a_pool();
    let (particles, rocks, heat, before) = (player.particles(), player.rocks(), player.heat(), player.hash());
    player.take(KeyCode::KeyX);
    assert_eq!((player.particles(), player.rocks(), player.heat()), (0, 0, 0));
    let empty = player.hash();
    // The middle of the frame.
    player.click(Vec2::new(-20.0, -2.5));
    assert_eq!((player.particles(), player.rocks(), player.heat()), (particles, rocks, heat), "{}", player.told());
    player.undo();
    assert_eq!(player.hash(), empty);
    player.undo();
    assert_eq!(player.hash(), before);
}

#[test]
fn a_stamp_is_laid_down_by_esc_and_by_the_right_button_and_taken_up_again() {
    let mut player = Player::at_a_pool();
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyV]);
    assert!(player.hand().is_empty() && player.told().contains("no stamp yet"), "{}", player.told());
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyC]);
    assert_eq!(*player.hand(), Hand::Frame(Take::Copy));
    player.chord(&[KeyCode::Escape]);
    assert!(player.hand().is_empty());
    let before = player.hash();
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyX]);
    player.point_at(player.middle() - Vec2::new(31.0, 11.0));
    player.press();
    player.frame();
    player.point_at(player.middle());
    player.chord(&[KeyCode::Escape]);
    player.release();
    player.frames(2);
    assert!(player.hand().is_empty() && player.hash() == before, "Esc gives a frame up while it is dragged");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyC]);
    player.drag(Vec2::new(20.0, 20.0), Vec2::new(25.0, 25.0));
    assert_eq!((player.told().as_str(), player.hand()), ("Nothing is in there", &Hand::Frame(Take::Copy)));
    player.drag(Vec2::new(-31.0, -11.0), Vec2::new(-9.0, 6.0));
    let before = player.hash();
    player.button(MouseButton::Right, ButtonState::Pressed);
    player.button(MouseButton::Right, ButtonState::Released);
    player.frames(3);
    assert!(player.hand().is_empty());
    assert_eq!(player.hash(), before, "the right button erased");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyV]);
    player.click(Vec2::new(10.0, 0.0));
    assert_ne!(player.hash(), before);
    assert_eq!(player.0.world_mut().resource_mut::<Shelf>().stamps().len(), 1);
}

#[test]
fn a_stamp_is_turned_and_mirrored_by_keys() {
    let mut player = Player::at_a_pool();
    player.take(KeyCode::KeyC);
    for (key, turn) in [
        (KeyCode::KeyR, Turn::default().quarter()),
        (KeyCode::KeyH, Turn::default().quarter().mirrored()),
        (KeyCode::KeyV, Turn::default().quarter().mirrored().flipped()),
    ] {
        player.chord(&[KeyCode::ShiftLeft, key]);
        assert!(matches!(player.hand(), Hand::Stamp(_, now) if *now == turn), "{key:?}");
    }
    // A beam that stands upright.
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyV]);
    player.click(Vec2::new(20.0, 0.0));
    let middle = player.middle();
    let cells: Vec<_> = player.world().resource::<Rock>().iter().map(|(cell, ..)| cell.as_vec2() - middle).collect();
    let pasted: Vec<_> = cells.into_iter().filter(|at| at.x > 0.0).collect();
    let extent = |of: fn(&Vec2) -> f32| {
        let values: Vec<f32> = pasted.iter().map(of).collect();
        values.iter().copied().fold(f32::MIN, f32::max) - values.iter().copied().fold(f32::MAX, f32::min)
    };
    assert!(extent(|at| at.y) > 4.0 * extent(|at| at.x), "{} × {}", extent(|at| at.x), extent(|at| at.y));
}

#[test]
fn at_another_detail_a_stamp_has_as_much_matter_in_smaller_lumps() {
    let mut player = Player::at_a_pool();
    let counts = (player.particles(), player.rocks());
    player.take(KeyCode::KeyX);
    player.0.world_mut().resource_mut::<Orders>().push(Order::Detail(2.0));
    player.frames(2);
    assert_eq!(player.particles(), 0);
    player.click(Vec2::ZERO);
    assert_eq!((player.particles(), player.rocks()), (4 * counts.0, 4 * counts.1), "{}", player.told());
}

#[test]
fn a_stamp_of_elements_that_a_world_lacks_is_refused_in_a_line() {
    let mut player = Player::at_a_pool();
    player.take(KeyCode::KeyC);
    let mut hand = player.hand().clone();
    let Hand::Stamp(kept, _) = &mut hand else { panic!("{hand:?}") };
    Arc::make_mut(&mut kept.stamp).elements[0] = "phlogiston".to_owned();
    player.0.insert_resource(hand);
    let before = player.hash();
    player.click(Vec2::new(10.0, 0.0));
    assert_eq!(player.hash(), before);
    assert_eq!(player.told(), "The stamp does not fit: this world has no phlogiston");
}

impl Player {
    /// A drain in the pool, and a spring that pours to the right, as those of scenes may.
    pub(super) fn set_springs(&mut self) {
        let (middle, element) = (self.middle(), self.world().resource::<Setup>().elements().find("water").unwrap());
        let area = |low: (f32, f32), high: (f32, f32)| (middle + Vec2::from(low), middle + Vec2::from(high));
        let (low, high) = area((-24.0, 0.0), (-20.0, 2.0));
        let (drain_low, drain_high) = area((-16.0, -5.0), (-14.0, -3.0));
        for intent in [
            Intent::SetEmitter { element, stroke: Stroke::rectangle(low, high) },
            Intent::SetDrain { stroke: Stroke::rectangle(drain_low, drain_high) },
        ] {
            control::edit(self.0.world_mut(), intent);
        }
        self.0.world_mut().resource_mut::<Sources>().emitters[0].velocity = Vec2::new(30.0, 0.0);
    }

    fn all_sources(&self) -> Sources {
        self.world().resource::<Sources>().clone()
    }
}

#[test]
fn springs_and_drains_are_copied_turned_and_pour() {
    let mut player = Player::at_a_pool();
    player.set_springs();
    player.take(KeyCode::KeyC);
    assert!(player.told().ends_with("springs and drains: 2"), "{}", player.told());
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyR]);
    let before = player.hash();
    // Out of the way of the first.
    player.click(Vec2::new(20.0, 0.0));
    let Sources { emitters, drains, .. } = player.all_sources();
    assert_eq!((emitters.len(), drains.len()), (2, 2), "{}", player.told());
    let Rect { min, max } = emitters[1].area;
    assert!((max - min).distance(Vec2::new(2.0, 4.0)) < 1e-3, "it does not stand upright: {min} {max}");
    assert_eq!((emitters[1].velocity, emitters[1].rate), (Vec2::new(0.0, 30.0), emitters[0].rate));
    player.undo();
    assert_eq!((player.hash(), player.all_sources().emitters.len()), (before, 1));
    player.click(Vec2::new(20.0, 0.0));
    player.chord(&[KeyCode::Escape]);
    let count = player.particles();
    // Time that passes, and drains that would take what comes.
    player.0.world_mut().resource_mut::<Sources>().drains.clear();
    player.chord(&[KeyCode::KeyP]);
    player.frames(60);
    let given = &player.all_sources().emitters[1].given;
    assert!(*given > 0 && player.particles() > count, "{given} of {}", player.particles());
}

#[test]
fn where_a_spring_is_no_other_is_pasted_and_cut_ones_come_back() {
    let mut player = Player::at_a_pool();
    player.set_springs();
    let before = player.all_sources();
    player.take(KeyCode::KeyX);
    assert!(player.all_sources().emitters.is_empty() && player.all_sources().drains.is_empty());
    let in_place = Vec2::new(-20.0, -2.5);
    player.click(in_place);
    assert_eq!(player.all_sources(), before);
    player.click(in_place);
    assert_eq!(player.all_sources(), before);
    assert!(player.told().starts_with("2 of 2 springs and drains are left out"), "{}", player.told());
    player.undo();
    player.undo();
    assert!(player.all_sources().emitters.is_empty());
    let most = Sources::MOST;
    let far = |k: usize| Rect { min: Vec2::new(2.0 * k as f32, 1.0), max: Vec2::new(2.0 * k as f32 + 1.0, 2.0) };
    player.0.world_mut().resource_mut::<Sources>().drains = (0..most).map(|k| Drain { area: far(k) }).collect();
    player.click(in_place);
    let Sources { emitters, drains, .. } = player.all_sources();
    assert_eq!((emitters.len(), drains.len()), (1, most));
    assert!(player.told().starts_with("1 of 2 springs and drains are left out"), "{}", player.told());
}

#[test]
fn a_stamp_may_be_of_a_spring_alone_and_half_of_one_gives_half() {
    let mut player = Player::new();
    player.chord(&[KeyCode::KeyP]);
    player.set_springs();
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyX]);
    player.drag(Vec2::new(-22.0, -1.0), Vec2::new(-19.0, 3.0));
    assert_eq!(player.all_sources().emitters.len(), 1, "what is cut through stays");
    player.click(Vec2::new(20.0, 10.0));
    let [whole, half] = &player.all_sources().emitters[..] else { panic!("{}", player.told()) };
    assert!((half.rate / whole.rate - 0.5).abs() < 0.01, "{} of {}", half.rate, whole.rate);
}

#[test]
fn the_panel_and_the_keys_ask_for_the_same() {
    let mut player = Player::at_a_pool();
    player.0.world_mut().resource_mut::<Orders>().push(Order::Act(Action::Take(Take::Cut)));
    player.frame();
    assert_eq!(*player.hand(), Hand::Frame(Take::Cut));
    player.drag(Vec2::new(-31.0, -11.0), Vec2::new(-9.0, 6.0));
    player.chord(&[KeyCode::Escape]);
    let number = player.0.world_mut().resource_mut::<Shelf>().stamps()[0].number;
    player.0.world_mut().resource_mut::<Orders>().push(Order::TakeUpStamp(number));
    player.frame();
    assert!(matches!(player.hand(), Hand::Stamp(kept, _) if kept.number == number));
}
