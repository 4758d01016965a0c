//! What worlds sound like.

use super::{Audible, Ear, Listener, track::Sound};
use crate::{
    kernel::{params::Preset, particles::Particles},
    lab::gauntlet::CASES,
    scene::{self, effects::EffectModes},
    sim::{checkpoint::Checkpoint, simulation::Simulation, workers::Workers},
    sound::{CEILING, Controls},
};
use std::sync::Arc;

fn checkpoint(name: &str, settings: &[(String, String)]) -> Checkpoint {
    let blueprint = scene::load(name).unwrap().build(settings, None, &EffectModes::new()).unwrap();
    Checkpoint::of_scene(Arc::new(blueprint))
}

fn simulation(name: &str) -> Simulation {
    Simulation::resume(&checkpoint(name, &[]), Workers::single())
}

/// What a world sounds like in the next ticks.
fn hear(simulation: &mut Simulation, ticks: u32) -> Vec<Controls> {
    let mut ear = Ear::default();
    let mut listen = || {
        simulation.tick();
        let audible = Audible::of(simulation.world());
        ear.listen(&audible, Listener::of_box(audible.size()))
    };
    (0..ticks).map(|_| listen()).collect()
}

fn most(heard: &[Controls], level: fn(&Controls) -> f32) -> f32 {
    heard.iter().map(level).fold(0.0, f32::max)
}

#[test]
fn each_sound_has_its_cause() {
    type Level = fn(&Controls) -> f32;
    let levels: [(&str, Level); 8] = [
        ("splash", |c| c.splash_level),
        ("stream", |c| c.stream_level),
        ("wind", |c| c.wind_level),
        ("hiss", |c| c.hiss_level),
        ("clatter", |c| c.clatter_level),
        ("fire", |c| c.fire_level),
        ("boil", |c| c.boil_level),
        ("blast", |c| c.blast_level),
    ];
    // Silent is what has nothing that could make it: the water on the burning house may well drip.
    let scenes: [(&str, u32, &[&str], &[&str]); 6] = [
        ("dam_break", 120, &["splash", "stream"], &["wind", "hiss", "clatter", "fire", "boil", "blast"]),
        ("wind_tunnel", 120, &["wind"], &["hiss", "clatter", "fire", "boil"]),
        ("hourglass", 120, &["hiss", "clatter"], &["splash", "stream", "fire", "boil"]),
        ("burning_house", 240, &["fire"], &["boil"]),
        ("geyser", 300, &["boil", "splash"], &["fire"]),
        ("fireworks", 300, &["blast", "fire"], &["splash", "stream", "boil"]),
    ];
    for (name, ticks, sounding, silent) in scenes {
        let heard = hear(&mut simulation(name), ticks);
        for (sound, level) in levels {
            let most = most(&heard, level);
            assert!(!sounding.contains(&sound) || most > 0.02, "{name}: {sound} is only {most}");
            assert!(!silent.contains(&sound) || most == 0.0, "{name}: {sound} of {most} without a cause");
        }
    }
}

#[test]
fn what_falls_from_higher_is_louder() {
    let energy = |columns: u32| -> f32 {
        let start = checkpoint("dam_break", &[("columns".to_owned(), columns.to_string())]);
        let mut simulation = Simulation::resume(&start, Workers::single());
        let mut ear = Ear::default();
        let heard = (0..300).map(|_| {
            simulation.tick();
            let audible = Audible::of(simulation.world());
            // All are heard from as far.
            ear.listen(&audible, Listener { centre: audible.size() / 2.0, width: 24.0 })
        });
        heard.map(|controls| controls.splash_level * controls.splash_level).sum()
    };
    let [low, middle, high] = [8, 16, 32].map(energy);
    assert!(low > 0.0 && middle > 1.5 * low && high > 1.5 * middle, "{low} {middle} {high}");
}

#[test]
fn a_mirrored_world_is_heard_mirrored() {
    let mut simulation = simulation("dam_break");
    let (mut ear, mut other) = (Ear::default(), Ear::default());
    let (mut furthest, mut loudest) = (0.0_f32, 0.0_f32);
    for _ in 0..90 {
        simulation.tick();
        let audible = Audible::of(simulation.world());
        let listener = Listener::of_box(audible.size());
        let here = ear.listen(&audible, listener);
        let width = audible.air.size().x;
        let mut particles: Particles = audible.particles.clone();
        particles.x.iter_mut().for_each(|x| *x = width - *x);
        particles.vx.iter_mut().for_each(|vx| *vx = -*vx);
        let there = other.listen(&Audible { particles: &particles, ..audible }, listener);
        for ((control, here), there) in Controls::ALL.iter().zip(here.to_array()).zip(there.to_array()) {
            let turned = if control.name.ends_with("_pan") { -there } else { there };
            // A lump on the edge of a cell counts to the one cell and in the mirror to the other: it and the two that have company
            // by it are heard on one side only. Of 10,082, of which the loudest have some three times the mean power, that
            // is a thousandth.
            assert!((here - turned).abs() < 2e-3 * here.abs().max(0.5), "{}: {here} and {there}", control.name);
        }
        furthest = furthest.max(here.stream_pan.abs());
        loudest = loudest.max(here.stream_level);
    }
    assert!(furthest > 0.2 && loudest > 0.02, "it was not beside the middle: {furthest}, {loudest}");
}

#[test]
fn a_still_world_is_silent_after_two_seconds() {
    let (mut sound, mut samples) = (Sound::default(), [0.0; 1600]);
    let mut loud = simulation("dam_break");
    let mut peak = 0.0_f32;
    for _ in 0..90 {
        loud.tick();
        sound.next(loud.world(), &mut samples);
        peak = samples.iter().fold(peak, |peak, sample| peak.max(sample.abs()));
    }
    assert!(peak > 0.1);
    let mut still = simulation("hydrostatic");
    for tick in 0..240 {
        still.tick();
        sound.next(still.world(), &mut samples);
        assert!(tick < 120 || samples == [0.0; 1600], "it sounds after {tick} ticks");
    }
}

#[test]
fn another_state_of_the_world_is_no_splash() {
    let mut simulation = simulation("dam_break");
    let start = Checkpoint::of(simulation.world());
    let mut ear = Ear::default();
    let mut listen = |simulation: &Simulation| {
        let audible = Audible::of(simulation.world());
        ear.listen(&audible, Listener::of_box(audible.size()))
    };
    for _ in 0..180 {
        simulation.tick();
        listen(&simulation);
    }
    let before = listen(&simulation);
    assert!(before.splash_level > 0.02, "{before:?}");
    assert_eq!(listen(&simulation), before, "no time has passed");
    start.restore(simulation.world_mut());
    assert_eq!(listen(&simulation).splash_level, 0.0);
    simulation.tick();
    assert!(listen(&simulation).splash_level < 0.1 * before.splash_level, "nothing strikes at the start");
}

#[test]
fn it_sounds_the_same_on_any_number_of_threads() {
    let heard = |threads: usize| {
        let workers = Workers::new(threads).unwrap();
        hear(&mut Simulation::resume(&checkpoint("waterfall", &[]), workers), 60)
    };
    let (one, two) = (heard(1), heard(2));
    assert!(most(&one, |controls| controls.stream_level) > 0.01);
    assert!(
        one.iter().zip(&two).all(|(one, two)| one.to_array().map(f32::to_bits) == two.to_array().map(f32::to_bits))
    );
}

#[test]
fn no_hard_case_is_above_the_ceiling() {
    let mut samples = [0.0; 1600];
    let mut sounding = 0;
    for case in CASES.iter().filter(|case| case.is_watchable()) {
        let mut simulation = simulation("empty");
        case.play(simulation.world_mut(), Preset::Balanced).unwrap();
        let (mut sound, mut peak) = (Sound::default(), 0.0_f32);
        for _ in 0..30 {
            simulation.tick();
            let controls = sound.next(simulation.world(), &mut samples);
            assert_eq!(controls, controls.within(), "{}", case.name);
            assert!(samples.iter().all(|sample| sample.abs() <= CEILING), "{}: above the ceiling", case.name);
            peak = samples.iter().fold(peak, |peak, sample| peak.max(sample.abs()));
        }
        sounding += u32::from(peak > 0.5);
    }
    assert!(sounding > 10, "only {sounding} cases are loud");
}
