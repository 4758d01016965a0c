//! A player who comes upon everything that there is a hint for sees each once, over restarts.

use super::*;
use crate::game::{actions::Action, frame::Tempo, hints::Hints, hud::panels::settings};
use std::{
    collections::BTreeMap,
    env, fs,
    path::{Path, PathBuf},
    process,
};

/// Ticks in which any hint that is due has its turn, and those that wait behind it.
const LONG: usize = 60 * 100;

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let path = env::temp_dir().join(format!("powder-master-hints-{name}-{}", process::id()));
    let _ = fs::remove_dir_all(&path);
    path
}

/// What was told while the player plays.
#[derive(Default)]
struct Told(BTreeMap<String, u32>);

impl Told {
    /// Frames that go by; what comes up in them is noted when it comes up.
    fn frames(&mut self, player: &mut Player, count: usize) {
        for _ in 0..count {
            let before: Vec<String> = player.world().resource::<Toasts>().texts().map(str::to_owned).collect();
            player.frame();
            let mut toasts = player.0.world_mut().resource_mut::<Toasts>();
            let new = toasts
                .texts()
                .filter(|text| !before.iter().any(|old| old == text))
                .map(str::to_owned)
                .collect::<Vec<_>>();
            toasts.age(1.0 / 60.0);
            new.into_iter().for_each(|text| *self.0.entry(text).or_default() += 1);
        }
    }

    /// How often something was told that begins so or holds it.
    fn count(&self, about: &str) -> u32 {
        self.0.iter().filter(|(text, _)| text.contains(about)).map(|(_, times)| times).sum()
    }
}

fn newcomer(folder: &Path) -> Player {
    let mut player = Player::new();
    player.0.insert_resource(Hints::of_folder(folder));
    player
}

fn stroke(player: &mut Player, told: &mut Told, button: MouseButton) {
    player.point_at(player.middle());
    player.button(button, ButtonState::Pressed);
    told.frames(player, 3);
    player.button(button, ButtonState::Released);
    told.frames(player, 3);
}

/// Plays once through all that there is a hint for.
fn play(player: &mut Player, told: &mut Told) {
    told.frames(player, 60 * 11);
    stroke(player, told, MouseButton::Left);
    told.frames(player, 60 * 11);
    player.choose("rock");
    stroke(player, told, MouseButton::Left);
    told.frames(player, 60 * 11);
    stroke(player, told, MouseButton::Right);
    told.frames(player, 60 * 11);
    for element in ["fire", "water"] {
        player.choose(element);
        (0..7).for_each(|_| stroke(player, told, MouseButton::Left));
        told.frames(player, 60 * 11);
    }
    for _ in 0..60 * 6 {
        player.0.world_mut().resource_mut::<Tempo>().lag = Some(0.5);
        told.frames(player, 1);
    }
    told.frames(player, LONG);
}

const ABOUT: [&str; 8] = [
    "W blows wind",
    "Ctrl+Shift and a click fills",
    "Ctrl+Z brings back",
    "Fire!",
    "The wheel makes",
    "E shows all",
    "A shows cheaper",
    "M opens the gallery",
];

#[test]
fn a_second_world_that_takes_its_time_is_no_lack_of_the_machine() {
    let folder = folder("second");
    let (mut player, mut told) = (newcomer(&folder), Told::default());
    let late = |player: &mut Player, told: &mut Told| {
        for _ in 0..60 * 20 {
            player.0.world_mut().resource_mut::<Tempo>().lag = Some(0.5);
            told.frames(player, 1);
        }
    };
    player.act(Action::Lens);
    late(&mut player, &mut told);
    assert_eq!(told.count("A shows cheaper"), 0, "{:?}", told.0);
    player.act(Action::Lens);
    late(&mut player, &mut told);
    assert_eq!(told.count("A shows cheaper"), 1, "{:?}", told.0);
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
fn a_player_sees_each_hint_exactly_once_over_restarts() {
    let folder = folder("once");
    let mut told = Told::default();
    for _ in 0..2 {
        let mut player = newcomer(&folder);
        play(&mut player, &mut told);
    }
    for about in ABOUT {
        assert_eq!(told.count(about), 1, "{about}: {:?}", told.0);
    }
    fs::remove_dir_all(folder).expect("it is ours");
}

#[test]
fn hints_come_one_at_a_time_and_not_to_who_knows() {
    let mut told = Told::default();
    let mut player = Player::new();
    stroke(&mut player, &mut told, MouseButton::Left);
    told.frames(&mut player, 60 * 4);
    assert_eq!(told.count("W blows wind"), 0, "not right after the start");
    player.0.world_mut().resource_mut::<Toolbox>().tool = Tool::Other(&crate::game::tools::WIND);
    stroke(&mut player, &mut told, MouseButton::Left);
    told.frames(&mut player, 60 * 11);
    assert_eq!(told.count("W blows wind"), 0, "the wind has been found");
}

#[test]
fn hints_that_are_off_are_not_told() {
    let mut told = Told::default();
    let mut player = Player::new();
    player.0.world_mut().resource_mut::<Hints>().switch(false);
    assert!(player.world().resource::<Panels>().iter().any(|(panel, _)| panel.id == settings::PANEL.id));
    play(&mut player, &mut told);
    for about in ABOUT {
        assert_eq!(told.count(about), 0, "{about}");
    }
}
