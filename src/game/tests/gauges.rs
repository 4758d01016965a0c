//! Gauges by key and mouse: set, found and taken away, and what becomes of them in another world.

use super::*;
use crate::{
    game::{
        gauges::desk::{GaugeDesk, mark},
        hud::panels::gauges::{panel::PANEL, plot},
        input::pointer::Pointer,
        rewind::Rewind,
    },
    lab::gauges::{
        place::Place,
        quantity::QUANTITIES,
        set::{Gauge, Gauges, Reading},
    },
};
use bevy::{
    input::touch::{TouchInput, TouchPhase},
    prelude::DetectChanges,
};

fn gauges(player: &Player) -> Vec<(u32, Place)> {
    player.world().resource::<Gauges>().iter().map(|gauge| (gauge.number, gauge.place)).collect()
}

fn gauge(player: &Player, number: u32) -> &Gauge {
    player.world().resource::<Gauges>().iter().find(|gauge| gauge.number == number).expect("it is set")
}

fn set_at(player: &mut Player, at: Vec2) {
    player.point_at(at);
    player.frame();
    player.chord(&[KeyCode::KeyG]);
}

/// Points at the mark of a gauge.
fn point_at_mark(player: &mut Player, number: u32) {
    let (camera, setup) = (player.world().resource::<WorldCamera>(), player.world().resource::<Setup>());
    let position = mark(gauge(player, number), camera, setup.blueprint.scale);
    player.event(WindowEvent::CursorMoved(CursorMoved { window: Entity::PLACEHOLDER, position, delta: None }));
    player.frame();
}

fn click(player: &mut Player, button: MouseButton) {
    player.button(button, ButtonState::Pressed);
    player.frame();
    player.button(button, ButtonState::Released);
    player.frames(2);
}

#[test]
fn a_key_sets_one_under_the_pointer_and_opens_the_panel() {
    let mut player = Player::new();
    assert!(gauges(&player).is_empty() && !player.world().resource::<Panels>().shows(PANEL.id));
    set_at(&mut player, Vec2::new(40.0, 30.0));
    let [(1, Place::Spot { at, radius })] = gauges(&player)[..] else { panic!("{:?}", gauges(&player)) };
    assert!(at.distance(Vec2::new(4.0, 3.0)) < 1e-3 && (radius - 0.3).abs() < 1e-6, "{at} {radius}");
    assert!(player.world().resource::<Panels>().shows(PANEL.id));
    let before = player.tick();
    player.frames(20);
    let ticks = gauge(&player, 1).samples().count() as u64;
    assert_eq!(ticks, player.tick() - before + 2, "it reads at once, in the tick of its frame and in each since");
    player.chord(&[KeyCode::ControlLeft, KeyCode::KeyG]);
    assert!(!player.world().resource::<Panels>().shows(PANEL.id), "the panel has a key of its own");
    assert_eq!(gauges(&player).len(), 1, "and gauges stay without it");
}

#[test]
fn without_one_nothing_is_called_and_nothing_held() {
    let mut player = Player::new();
    let changed = |player: &Player| player.world().get_resource_ref::<Gauges>().expect("it is there").last_changed();
    let before = changed(&player);
    player.frames(10);
    assert_eq!((changed(&player), player.world().resource::<Gauges>().held()), (before, 0));
    set_at(&mut player, Vec2::new(40.0, 30.0));
    let with = changed(&player);
    player.frame();
    assert!(changed(&player) != with && player.world().resource::<Gauges>().held() > 0);
    player.0.world_mut().resource_mut::<Orders>().push(Order::RemoveGauge(1));
    player.frame();
    let after = changed(&player);
    player.frames(10);
    assert_eq!((changed(&player), player.world().resource::<Gauges>().held()), (after, 0));
}

#[test]
fn a_line_takes_two_places_and_counts_what_is_poured_through_it() {
    let mut player = Player::new();
    let shift = [KeyCode::ShiftLeft, KeyCode::KeyG];
    player.point_at(Vec2::new(60.0, 40.0));
    player.frame();
    player.chord(&shift);
    assert!(gauges(&player).is_empty(), "it has one end only");
    player.point_at(Vec2::new(160.0, 40.0));
    player.frame();
    player.chord(&shift);
    let [(1, Place::Line { from, to })] = gauges(&player)[..] else { panic!("{:?}", gauges(&player)) };
    assert!(from.distance(Vec2::new(6.0, 4.0)) < 1e-3 && to.distance(Vec2::new(16.0, 4.0)) < 1e-3);
    player.point_at(Vec2::new(110.0, 60.0));
    player.press();
    player.frames(30);
    player.release();
    player.frames(90);
    assert_eq!(player.world().resource::<GaugeDesk>().shown.0.name, "flow", "the plot shows what it reads");
    let Some(Reading::Line(reading)) = gauge(&player, 1).latest() else { panic!("it is a line") };
    let water = player.world().resource::<Setup>().elements().find("water").unwrap();
    let below = player.world().resource::<ParticleStore>().y.iter().filter(|y| **y < 40.0).count() as i64;
    assert!(below > 30, "{below} fell");
    assert_eq!((reading.crossed, gauge(&player, 1).crossed(water)[0]), (below, below), "downwards is to its right");
}

#[test]
fn escape_lays_a_begun_line_down_and_leaves_the_panels() {
    let mut player = Player::new();
    player.act(Action::Panel(PANEL.id));
    player.point_at(player.middle());
    player.frame();
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyG]);
    let begun = |player: &Player| player.world().resource::<GaugeDesk>().clone();
    let scene = crate::sim::generation::Generation::of(player.world()).scene;
    assert!(begun(&player).begun(scene).is_some());
    player.chord(&[KeyCode::Escape]);
    assert!(begun(&player).begun(scene).is_none() && player.world().resource::<Panels>().shows(PANEL.id));
    player.chord(&[KeyCode::ShiftLeft, KeyCode::KeyG]);
    assert!(gauges(&player).is_empty(), "it begins anew");
}

#[test]
fn a_click_on_a_mark_finds_it_and_the_right_button_takes_it_away() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    set_at(&mut player, Vec2::new(90.0, 30.0));
    assert_eq!(player.world().resource::<GaugeDesk>().selected, Some(2));
    player.act(Action::Panel(PANEL.id));
    point_at_mark(&mut player, 1);
    click(&mut player, MouseButton::Left);
    assert_eq!(player.world().resource::<GaugeDesk>().selected, Some(1));
    assert!(player.world().resource::<Panels>().shows(PANEL.id));
    assert_eq!(player.particles(), 0, "no water is poured there");
    click(&mut player, MouseButton::Right);
    assert_eq!(gauges(&player).iter().map(|(number, _)| *number).collect::<Vec<_>>(), [2]);
    point_at_mark(&mut player, 2);
    player.chord(&[KeyCode::KeyG]);
    assert!(gauges(&player).is_empty(), "its key takes it away, too");
    click(&mut player, MouseButton::Left);
    assert!(player.particles() > 0, "where a mark was the tool works again");
}

impl Player {
    /// Drags with the left button by `way` d, in two steps, from where the pointer is.
    fn drag_by(&mut self, way: Vec2) {
        let start = self.world().resource::<WorldCamera>().to_world(self.world().resource::<Pointer>().at.unwrap());
        self.press();
        self.frame();
        for part in [0.5, 1.0] {
            self.point_at(start + part * way);
            self.frame();
        }
    }
}

#[test]
fn a_mark_is_dragged_and_its_gauge_reads_on_the_way() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    player.act(Action::Panel(PANEL.id));
    player.frames(10);
    let samples = gauge(&player, 1).samples().count();
    point_at_mark(&mut player, 1);
    player.drag_by(Vec2::new(30.0, 10.0));
    let Place::Spot { at, radius } = gauge(&player, 1).place else { panic!("it is a place") };
    assert!(at.distance(Vec2::new(7.0, 4.0)) < 1e-3 && (radius - 0.3).abs() < 1e-6, "before the release: {at}");
    player.release();
    player.frames(3);
    assert_eq!((player.particles(), player.seen()), (0, Vec::new()), "nothing is poured, and the world knows nothing");
    assert!(!player.world().resource::<Panels>().shows(PANEL.id), "no click");
    let ticks: Vec<u64> = gauge(&player, 1).samples().map(|sample| sample.tick).collect();
    assert!(ticks.len() > samples && ticks.is_sorted_by(|a, b| a < b), "the plot goes on, a reading for each tick");
    point_at_mark(&mut player, 1);
    player.drag_by(Vec2::new(-900.0, 0.0));
    player.release();
    player.frame();
    let Place::Spot { at, .. } = gauge(&player, 1).place else { panic!("it is a place") };
    assert!(at.x == 0.0 && (at.y - 4.0).abs() < 1e-3, "it stays in the box: {at}");
}

#[test]
fn a_gauge_that_is_moved_while_time_stands_reads_there_at_once() {
    let mut player = Player::new();
    player.pour_and_stop();
    let middle = player.middle();
    set_at(&mut player, middle - Vec2::new(60.0, 0.0));
    let density = |player: &Player| match gauge(player, 1).latest() {
        Some(Reading::Spot(reading)) => reading.density,
        other => panic!("{other:?}"),
    };
    assert_eq!(density(&player), Some(0.0));
    point_at_mark(&mut player, 1);
    player.drag_by(Vec2::new(60.0, 0.0));
    player.release();
    player.frame();
    assert!(density(&player) > Some(100.0), "{:?}", density(&player));
    assert_eq!(gauge(&player, 1).samples().count(), 1, "one reading for a tick");
}

#[test]
fn a_line_moves_by_its_mark_and_each_end_by_itself() {
    let mut player = Player::new();
    let shift = [KeyCode::ShiftLeft, KeyCode::KeyG];
    for at in [Vec2::new(60.0, 40.0), Vec2::new(160.0, 40.0)] {
        player.point_at(at);
        player.frame();
        player.chord(&shift);
    }
    player.point_at(Vec2::new(110.0, 60.0));
    player.press();
    player.frames(30);
    player.release();
    player.frames(90);
    let crossed = |player: &Player| match gauge(player, 1).latest() {
        Some(Reading::Line(reading)) => reading.crossed,
        other => panic!("{other:?}"),
    };
    assert!(crossed(&player) > 30);
    let line = |player: &Player| match gauge(player, 1).place {
        Place::Line { from, to } => [from, to].map(|end| (10.0 * end).round()),
        Place::Spot { .. } => panic!("it is a line"),
    };
    let ends = |a: (f32, f32), b: (f32, f32)| [Vec2::from(a), Vec2::from(b)];
    for (from, way, after) in [
        ((160.0, 40.0), (0.0, 20.0), ends((60.0, 40.0), (160.0, 60.0))),
        ((60.0, 40.0), (-20.0, 0.0), ends((40.0, 40.0), (160.0, 60.0))),
        // Shorter than a line can be it does not become.
        ((40.0, 40.0), (120.0, 20.0), ends((100.0, 50.0), (160.0, 60.0))),
    ] {
        player.point_at(from.into());
        player.frame();
        player.drag_by(way.into());
        assert_eq!(line(&player), after, "from {from:?} by {way:?}");
        player.release();
        player.frames(2);
    }
    point_at_mark(&mut player, 1);
    player.drag_by(Vec2::new(-20.0, -10.0));
    player.release();
    player.frames(2);
    assert_eq!(line(&player), ends((80.0, 40.0), (140.0, 50.0)));
    assert_eq!(crossed(&player), 0, "it counts anew where it is");
}

#[test]
fn a_finger_drags_a_mark() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    let camera = *player.world().resource::<WorldCamera>();
    let at = mark(gauge(&player, 1), &camera, player.world().resource::<Setup>().blueprint.scale);
    let to = at + camera.pixels_per_d() * Vec2::new(30.0, 0.0);
    for (phase, position) in [(TouchPhase::Started, at), (TouchPhase::Moved, to), (TouchPhase::Ended, to)] {
        let touch = TouchInput { phase, position, window: Entity::PLACEHOLDER, force: None, id: 0 };
        player.event(WindowEvent::TouchInput(touch));
        player.frame();
    }
    let Place::Spot { at, .. } = gauge(&player, 1).place else { panic!("it is a place") };
    assert!(at.distance(Vec2::new(7.0, 3.0)) < 1e-3 && player.particles() == 0, "{at}");
}

#[test]
fn a_hidden_hud_has_no_marks_to_click() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    player.chord(&[KeyCode::KeyH]);
    point_at_mark(&mut player, 1);
    click(&mut player, MouseButton::Left);
    assert!(player.particles() > 0);
}

#[test]
fn a_ninth_is_refused_with_a_line_and_none_can_be_outside() {
    let mut player = Player::new();
    for k in 0..8 {
        set_at(&mut player, Vec2::new(20.0 + 25.0 * k as f32, 30.0));
    }
    let told =
        |player: &Player, says: &str| player.world().resource::<Toasts>().texts().any(|text| text.contains(says));
    assert!(gauges(&player).len() == 8 && !told(&player, "No gauge"));
    set_at(&mut player, Vec2::new(20.0, 90.0));
    assert!(gauges(&player).len() == 8 && told(&player, "8 at most"));
    point_at_mark(&mut player, 4);
    player.chord(&[KeyCode::KeyG]);
    set_at(&mut player, Vec2::new(-1.0, 30.0));
    assert!(gauges(&player).len() == 7 && told(&player, "is not in the box"));
}

#[test]
fn rewinding_cuts_the_plot_and_a_new_scene_clears_all() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    player.frames(60);
    let last = player.tick();
    player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(KeyCode::Backspace);
    player.key(KeyCode::Backspace, ButtonState::Pressed);
    while player.world().resource::<Rewind>().progress().is_none_or(|(back, _)| back < 20) {
        player.frame();
    }
    player.0.world_mut().resource_mut::<ButtonInput<KeyCode>>().release(KeyCode::Backspace);
    player.key(KeyCode::Backspace, ButtonState::Released);
    player.frame();
    let now = player.tick();
    let ticks: Vec<u64> = gauge(&player, 1).samples().map(|sample| sample.tick).collect();
    assert!(now < last && ticks.last() == Some(&now) && ticks.is_sorted_by(|a, b| a < b), "{now} {ticks:?}");
    let order = Order::Scene { name: "dam_break".to_owned(), settings: Vec::new(), detail: 1.0 };
    player.0.world_mut().resource_mut::<Orders>().push(order);
    player.frames(2);
    assert!(gauges(&player).is_empty());
}

#[test]
fn gauges_keep_their_place_where_the_detail_changes() {
    let mut player = Player::new();
    player.pour_and_stop();
    player.chord(&[KeyCode::Space]);
    set_at(&mut player, Vec2::new(40.0, 30.0));
    let before = gauges(&player);
    player.0.world_mut().resource_mut::<Orders>().push(Order::Detail(2.0));
    player.frames(3);
    assert_eq!(gauges(&player), before);
    player.frames(5);
    assert!(gauge(&player, 1).samples().count() > 5);
}

#[test]
fn the_world_is_the_same_with_gauges_and_without() {
    let hash = |with: bool| {
        let mut player = Player::new();
        let middle = player.middle();
        player.point_at(middle);
        player.frame();
        if with {
            player.act(Action::Gauge);
            player.act(Action::GaugeLine);
        } else {
            player.frames(2);
        }
        player.press();
        player.frames(20);
        player.release();
        player.frames(30);
        player.hash()
    };
    assert_eq!(hash(true), hash(false));
}

#[test]
fn curves_have_gaps_where_nothing_is_measured_and_end_at_the_tick_that_is_seen() {
    let mut player = Player::new();
    let speed = &QUANTITIES[0];
    let at = Vec2::new(128.0, 40.0);
    set_at(&mut player, at);
    player.frames(20);
    assert!(plot::curve(gauge(&player, 1), speed, player.tick()).is_empty(), "nothing is there");
    assert_eq!(plot::now(gauge(&player, 1), speed, player.tick()), None);
    player.point_at(at + Vec2::new(0.0, 25.0));
    player.press();
    player.frames(5);
    player.release();
    player.frames(120);
    let tick = player.tick();
    let curve = plot::curve(gauge(&player, 1), speed, tick);
    assert_eq!(curve.len(), 1, "the water came by once: {curve:?}");
    assert!(curve[0].iter().all(|(before, value)| *before > 0.0 && *value > 1.0), "{curve:?}");
    let early = plot::curve(gauge(&player, 1), speed, tick - 100);
    assert!(early.iter().flatten().count() < curve.iter().flatten().count(), "what comes later is not seen yet");
}

#[test]
#[cfg(not(target_arch = "wasm32"))]
fn a_button_saves_the_readings() {
    let mut player = Player::new();
    set_at(&mut player, Vec2::new(40.0, 30.0));
    player.frames(5);
    player.0.world_mut().resource_mut::<Orders>().push(Order::SaveReadings);
    player.frame();
    let told: Vec<String> = player.world().resource::<Toasts>().texts().map(str::to_owned).collect();
    let path = told.iter().find_map(|text| text.strip_prefix("Readings: ")).unwrap_or_else(|| panic!("{told:?}"));
    let text = std::fs::read_to_string(path).expect("it is written");
    std::fs::remove_file(path).expect("it is ours");
    assert!(text.starts_with("tick,time_s,gauge1_speed_m_per_s,") && text.lines().count() > 5, "{text}");
}
