//! Challenges by key and mouse: what counts, what ends them, and what they earn.

use super::*;
use crate::{
    game::challenges::earned::Earned,
    kernel::{params::Preset, simd::InstructionSet},
    sim::{
        judge::{Judge, Loss, Stars, Trial, Verdict},
        recorder::Recorder,
        recording::{End, Recording},
        replay::Replay,
        workers::Workers,
    },
};

/// The name of the one that is played here: water lifts chips out of a well.
const NAME: &str = "float";

impl Player {
    fn order(&mut self, order: Order) {
        self.0.world_mut().resource_mut::<Orders>().push(order);
        self.frame();
    }

    fn challenge(&mut self) {
        self.order(Order::Challenge(NAME.to_owned()));
        // The next frame takes up the first element of its scene.
        self.frame();
        assert!(self.trial().is_some_and(Trial::is_running));
    }

    fn trial(&self) -> Option<&Trial> {
        self.world().resource::<Judge>().trial()
    }

    /// Strokes and particles so far.
    fn used(&self) -> (u64, u64) {
        let trial = self.trial().expect("one is tried");
        (trial.strokes, trial.poured())
    }

    /// Points into the well, m.
    fn point_at_well(&mut self) {
        let spacing = self.world().resource::<Setup>().blueprint.scale.spacing;
        self.point_at(Vec2::new(5.3, 2.5) / spacing);
    }

    /// Pours into the well for so many frames.
    fn pour_into_well(&mut self, frames: usize) {
        self.point_at_well();
        self.press();
        self.frames(frames);
        self.release();
        self.frames(2);
    }
}

#[test]
fn one_press_is_one_stroke_and_all_that_it_pours_counts() {
    let mut player = Player::new();
    player.challenge();
    assert_eq!(player.used(), (0, 0));
    player.pour_into_well(8);
    let (strokes, poured) = player.used();
    assert_eq!((strokes, poured), (1, player.world().resource::<ParticleStore>().len() as u64 - 84));
    assert!(poured > 10);
    player.pour_into_well(4);
    assert_eq!(player.used().0, 2);
    // A line is one, too.
    player.key(KeyCode::ShiftLeft, ButtonState::Pressed);
    player.pour_into_well(3);
    player.key(KeyCode::ShiftLeft, ButtonState::Released);
    assert_eq!(player.used().0, 3);
    // Looking around is none.
    player.chord(&[KeyCode::KeyV]);
    player.frames(2);
    assert_eq!(player.used().0, 3);
}

#[test]
fn what_is_undone_still_counts_and_time_goes_on() {
    let mut player = Player::new();
    player.challenge();
    player.pour_into_well(6);
    let (used, ticks) = (player.used(), player.trial().unwrap().ticks);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(3);
    assert_eq!(player.particles(), 84, "the water is gone");
    assert_eq!(player.used(), used, "but it was poured");
    assert!(player.trial().unwrap().ticks > ticks);
}

#[test]
fn a_press_that_goes_on_after_an_undo_is_another_stroke() {
    let mut player = Player::new();
    player.challenge();
    player.point_at_well();
    player.press();
    player.frames(5);
    let (strokes, poured) = player.used();
    assert_eq!(strokes, 1);
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(5);
    player.release();
    player.frames(2);
    assert_eq!(player.used().0, 2);
    assert!(player.used().1 > poured);
    // Pressed and undone before any tick: what it goes on with is counted.
    player.press();
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(3);
    player.release();
    player.frames(2);
    assert_eq!(player.used().0, 3);
}

#[test]
fn no_undo_and_no_rewinding_lead_into_an_earlier_try() {
    let mut player = Player::new();
    player.pour_and_stop();
    let before = (player.particles(), player.rocks());
    assert!(before.0 > 0);
    player.challenge();
    player.pour_into_well(20);
    player.chord(&[KeyCode::KeyR]);
    player.frames(2);
    assert_eq!((player.used(), player.particles()), ((0, 0), 84), "R begins it again");
    player.chord(&[KeyCode::Backspace]);
    assert!(player.was_told("going back in time"));
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyZ]);
    player.frames(2);
    assert!(player.trial().is_none(), "undo leads out of it");
    assert_eq!((player.particles(), player.rocks()), before, "into the world before");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyY]);
    player.frames(2);
    assert!(player.trial().is_none(), "which is left for good");
}

#[test]
fn what_it_does_not_give_is_refused_and_costs_no_stroke() {
    let mut player = Player::new();
    player.challenge();
    player.choose("lava");
    player.pour_into_well(5);
    assert!(player.was_told("No lava in this challenge: you have water"));
    player.button(MouseButton::Right, ButtonState::Pressed);
    player.frames(3);
    player.button(MouseButton::Right, ButtonState::Released);
    player.frames(2);
    player.chord(&[KeyCode::Equal]);
    assert!(player.was_told("clearing the air"));
    player.frames(2);
    assert_eq!((player.used(), player.particles()), ((0, 0), 84));
    assert!(player.trial().is_some_and(Trial::is_running), "nothing of it was done");
    // What comes past the game all the same loses it.
    player.0.world_mut().resource_mut::<IntentQueue>().push(Intent::ClearAir);
    player.frames(2);
    assert_eq!(player.trial().unwrap().verdict, Verdict::Lost(Loss::Means("clearing the air".to_owned())));
}

#[test]
fn another_scene_ends_it_and_a_choice_of_quality_does_not() {
    let mut player = Player::new();
    player.challenge();
    player.order(Order::Quality(Preset::Reference));
    player.frames(2);
    player.pour_into_well(6);
    let (_, poured) = player.used();
    let particles = player.particles() as u64;
    assert!(poured > 10 && particles > 4 * 84 + 3 * poured, "{poured} of the scene's own size, {particles} at all");
    player.order(Order::Scene { name: "empty".to_owned(), settings: Vec::new(), detail: 1.0 });
    player.frames(2);
    assert!(player.trial().is_none());
    player.challenge();
    player.order(Order::Scene { name: "nowhere".to_owned(), settings: Vec::new(), detail: 1.0 });
    assert!(player.trial().is_some(), "a scene that does not open ends nothing");
    player.order(Order::LeaveChallenge);
    player.frames(2);
    assert!(player.trial().is_none());
}

/// Wins by the mouse.
fn win(player: &mut Player) -> Stars {
    player.challenge();
    player.pour_into_well(120);
    for _ in 0..40 {
        if let Verdict::Won(stars) = player.trial().unwrap().verdict {
            return stars;
        }
        player.pour_into_well(20);
        player.frames(20);
    }
    panic!("{:?}", player.trial());
}

#[test]
fn a_win_by_the_mouse_earns_stars_and_its_recording_is_judged_the_same() {
    let mut player = Player::new();
    player.0.world_mut().insert_resource(Earned::default());
    let world = player.0.world_mut();
    world.resource::<Recorder>().begin(world, None);
    let stars = win(&mut player);
    assert!(stars.done);
    assert_eq!(player.world().resource::<Earned>().of(NAME), stars);
    let bytes = player.world().resource::<Recorder>().recording(End::Crashed).expect("it runs");
    let recording = Recording::decode(&bytes).expect("it was just written");
    let mut replay =
        Replay::new(&recording, Workers::default(), InstructionSet::detect()).expect("its states are good");
    while replay.tick().expect("it goes the same way") {}
    let (own, there) = (player.trial().unwrap(), replay.world().resource::<Judge>().trial().expect("it was begun"));
    assert_eq!((&own.verdict, own.ticks, own.strokes), (&there.verdict, there.ticks, there.strokes));
    assert_eq!(own.poured(), there.poured());
}

#[test]
fn a_recording_that_is_shown_is_judged_but_earns_nothing() {
    let mut player = Player::new();
    let world = player.0.world_mut();
    world.resource::<Recorder>().begin(world, None);
    let stars = win(&mut player);
    let bytes = player.world().resource::<Recorder>().recording(End::Crashed).expect("it runs");
    let ticks = player.trial().unwrap().ticks as usize;
    let mut other = Player::new();
    other.order(Order::LoadBytes { name: "win.pmr".to_owned(), bytes });
    other.frames(ticks + 20);
    assert_eq!(other.trial().map(|trial| trial.verdict.clone()), Some(Verdict::Won(stars)));
    assert_eq!(other.world().resource::<Earned>().of(NAME), Stars::default());
}

#[test]
fn time_that_is_up_loses_it_and_stands_while_the_world_is_paused() {
    let mut player = Player::new();
    player.challenge();
    player.chord(&[KeyCode::Space]);
    let left = player.trial().unwrap().left();
    player.frames(10);
    assert_eq!(player.trial().unwrap().left(), left);
    player.chord(&[KeyCode::Space]);
    player.frames(left as usize + 5);
    assert_eq!(player.trial().unwrap().verdict, Verdict::Lost(Loss::Time));
    assert_eq!(player.world().resource::<Earned>().of(NAME), Stars::default());
}
