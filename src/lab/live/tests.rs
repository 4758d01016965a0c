//! Looking at a world while it is played, without touching it.

use super::{LivePlugin, survey::Surveyor};
use crate::{
    kernel::{
        brush::{BrushShape, Stroke},
        params::Preset,
    },
    lab::{
        autopilot::{self, Autopilot, Goal, controller::Verdict},
        dial,
        live::{
            accuracy::{LiveError, Survey, SurveyRequest, Watched},
            measures::{Measured, Measures},
        },
        run::{Plan, run},
        sampler::Sampler,
    },
    scene::{self, effects::EffectModes, passes::Pass},
    sim::{
        checkpoint::Checkpoint,
        control,
        intent::{Intent, IntentQueue},
        ledger::{Extent, PassLedger},
        pace::Pace,
        recorder::{self, Recorder},
        recording::{Entry, Recording},
        simulation::Simulation,
        state::{Clock, Setup},
        workers::Workers,
    },
};
use bevy::{
    app::Plugins,
    platform::time::Instant,
    prelude::{App, FixedUpdate, IntoScheduleConfigs, Res, ResMut},
};
use std::{sync::Arc, thread, time::Duration};

fn begin<M>(scene: &str, settings: &[(&str, &str)], plugins: impl Plugins<M>) -> Simulation {
    let settings: Vec<_> = settings.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let blueprint = scene::load(scene).unwrap().build(&settings, None, &EffectModes::new()).unwrap();
    Simulation::with_plugins(&Checkpoint::of_scene(Arc::new(blueprint)), Workers::single(), plugins)
}

fn survey(simulation: &Simulation) -> &Survey {
    simulation.world().resource::<Survey>()
}

fn ask(simulation: &mut Simulation, request: SurveyRequest) {
    simulation.world_mut().resource_mut::<Survey>().request = Some(request);
}

#[test]
fn a_watched_and_surveyed_world_has_the_hash_of_an_unwatched_one() {
    let small = [("columns", "24")];
    let mut plain = begin("dam_break", &small, ());
    let mut watched = begin("dam_break", &small, LivePlugin);
    watched.world_mut().resource_mut::<Watched>().0 = true;
    for tick in 0..90 {
        if tick == 20 {
            ask(&mut watched, SurveyRequest::Begin);
        }
        plain.tick();
        watched.tick();
    }
    assert_eq!(control::hash(plain.world()), control::hash(watched.world()), "measuring changes the world");
    let error = watched.world().resource::<LiveError>();
    assert!(error.mean().is_some_and(|mean| mean > 0.0) && error.p99() >= error.mean(), "{error:?}");
}

#[test]
fn what_is_not_shown_is_not_measured() {
    let mut simulation = begin("dam_break", &[("columns", "8")], LivePlugin);
    (0..10).for_each(|_| simulation.tick());
    assert_eq!(simulation.world().resource::<LiveError>().latest(), None);
    assert_eq!(simulation.world().resource::<Measures>().latest(), None);
}

#[test]
fn a_world_that_stands_is_sampled_when_it_is_watched() {
    let mut simulation = begin("dam_break", &[("columns", "24")], LivePlugin);
    (0..31).for_each(|_| simulation.tick());
    simulation.world_mut().resource_mut::<Pace>().paused = true;
    simulation.world_mut().resource_mut::<Watched>().0 = true;
    simulation.tick();
    assert_eq!(simulation.world().resource::<LiveError>().latest().map(|sample| sample.tick), Some(31));
}

fn measured(simulation: &Simulation) -> Measured {
    *simulation.world().resource::<Measures>().latest().expect("it is measured")
}

/// Looks away and back, so that the next tick is measured.
fn look_again(simulation: &mut Simulation) {
    simulation.world_mut().resource_mut::<Measures>().want(true);
    simulation.tick();
}

#[test]
fn all_measures_are_those_of_the_metrics_and_change_nothing() {
    let mut plain = begin("waterfall", &[], ());
    let mut looked_at = begin("waterfall", &[], LivePlugin);
    for tick in 0..90 {
        if tick % 30 == 0 {
            looked_at.world_mut().resource_mut::<Measures>().want(true);
        }
        plain.tick();
        looked_at.tick();
    }
    assert_eq!(control::hash(plain.world()), control::hash(looked_at.world()), "measuring changes the world");
    look_again(&mut looked_at);
    let mut sampler = Sampler::new(plain.world(), 0);
    run(&mut plain, &Plan { ticks: 1, ..Plan::default() }, &mut [&mut sampler]).unwrap();
    let (found, metrics) = (measured(&looked_at), sampler.finish(plain.world()).accuracy);
    assert_eq!((found.residual, found.volume_error), (metrics.residual, metrics.volume_error));
    assert_eq!((found.kinetic + found.potential, found.momentum.to_array()), (metrics.energy, metrics.momentum));
    let air = found.air.expect("the waterfall has air");
    assert_eq!(Some(air.divergence), metrics.air_divergence_rms);
    assert!(air.mass > 0.0 && found.kinetic > 0.0 && !found.cost.is_zero(), "{found:?}");
}

#[test]
fn a_measurement_stands_for_a_second_and_the_drift_begins_with_each_world() {
    let mut simulation = begin("sealed_air", &[], LivePlugin);
    look_again(&mut simulation);
    let first = measured(&simulation);
    simulation.tick();
    assert_eq!(measured(&simulation), first, "it is measured every tick");
    assert!(first.air.is_some_and(|air| air.drift.abs() < 1e-6), "a closed box keeps its air: {first:?}");
    thread::sleep(Duration::from_millis(1100));
    let size = simulation.world().resource::<Setup>().blueprint.domain.size;
    let stroke = Stroke::dab(BrushShape::Disc, size / 2.0, 6.0);
    simulation.world_mut().resource_mut::<IntentQueue>().push(Intent::Press { stroke, amount: 2.0 });
    simulation.tick();
    let pumped = measured(&simulation);
    assert!(pumped.seen.0 == first.seen.0 + 2 && pumped.air.is_some_and(|air| air.drift > 1e-3), "{pumped:?}");
    control::reset(simulation.world_mut());
    simulation.tick();
    let again = measured(&simulation);
    assert!(again.seen.0 == 1 && again.air.is_some_and(|air| air.drift.abs() < 1e-6), "{again:?}");
    simulation.world_mut().resource_mut::<Measures>().want(false);
    simulation.tick();
    assert_eq!(simulation.world().resource::<Measures>().latest(), None);
}

#[test]
fn a_survey_measures_every_preset_from_this_moment_while_play_goes_on() {
    for sliced in [false, true] {
        // Particles enough to have an error at half the detail, too.
        let mut simulation = begin("dam_break", &[("columns", "16")], LivePlugin);
        if sliced {
            simulation.world_mut().insert_resource(Surveyor::sliced());
        }
        (0..25).for_each(|_| simulation.tick());
        ask(&mut simulation, SurveyRequest::Begin);
        simulation.tick();
        assert!(survey(&simulation).is_running());
        let (begun, mut seen) = (Instant::now(), 0.0);
        while survey(&simulation).is_running() {
            let progress = survey(&simulation).progress.unwrap();
            assert!((seen..=1.0).contains(&progress), "progress went from {seen} to {progress}");
            seen = progress;
            simulation.tick();
            thread::sleep(Duration::from_millis(1));
            assert!(begun.elapsed() < Duration::from_secs(120), "the survey does not end");
        }
        let curve = survey(&simulation).curve.clone();
        assert_eq!((curve.scene.as_str(), curve.tick), ("dam_break", 26));
        assert_eq!(curve.points.len(), Preset::ALL.len() + 3, "the presets, and three at other details");
        let point = |preset| *curve.point(preset, 1.0).expect("every preset is measured");
        for preset in Preset::ALL {
            assert!(point(preset).milliseconds > 0.0 && point(preset).error.is_some(), "{}", preset.name());
        }
        let (draft, reference) = (point(Preset::Draft), point(Preset::Reference));
        assert!(draft.milliseconds < reference.milliseconds, "{curve:?}");
        assert!(draft.error > reference.error, "{curve:?}");
        let coarse = curve.point(Preset::Fine, 0.5).expect("at half the detail, too");
        let fine = point(Preset::Fine).milliseconds;
        assert!(coarse.error.is_some() && coarse.milliseconds < fine, "a quarter of the particles: {curve:?}");
        assert!(curve.scale().is_some_and(|scale| scale > 0.0));
        assert!(simulation.world().resource::<Clock>().tick > 26, "play stood still meanwhile");
    }
}

#[test]
fn a_survey_can_be_given_up_and_begun_again() {
    let mut simulation = begin("dam_break", &[("columns", "10")], LivePlugin);
    (0..3).for_each(|_| simulation.tick());
    ask(&mut simulation, SurveyRequest::Begin);
    simulation.tick();
    ask(&mut simulation, SurveyRequest::Cancel);
    simulation.tick();
    assert!(!survey(&simulation).is_running());
    thread::sleep(Duration::from_millis(60));
    let before = survey(&simulation).curve.clone();
    simulation.tick();
    assert_eq!(survey(&simulation).curve, before, "a survey that was given up goes on");
    ask(&mut simulation, SurveyRequest::Begin);
    simulation.tick();
    assert!(survey(&simulation).is_running() && survey(&simulation).curve.tick > before.tick);
    ask(&mut simulation, SurveyRequest::Cancel);
    simulation.tick();
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "a module has no threads: there it never begins")]
fn nobody_is_made_to_wait_for_a_survey_that_nobody_asked_for() {
    let mut simulation = begin("dam_break", &[("columns", "10")], LivePlugin);
    simulation.world_mut().insert_resource(Surveyor::sliced());
    simulation.tick();
    ask(&mut simulation, SurveyRequest::BeginQuietly);
    simulation.tick();
    assert!(!survey(&simulation).is_running(), "slices are time of the game's frames");
    simulation.world_mut().insert_resource(Surveyor::default());
    ask(&mut simulation, SurveyRequest::BeginQuietly);
    simulation.tick();
    assert!(survey(&simulation).is_running());
    ask(&mut simulation, SurveyRequest::Cancel);
    simulation.tick();
    assert!(!survey(&simulation).is_running());
}

/// What a tick would cost on a machine where it costs in proportion to the work, and three times as much for a while.
fn pretend_load(setup: Res<Setup>, clock: Res<Clock>, mut ledger: ResMut<PassLedger>) {
    let load = if (200..400).contains(&clock.tick) { 3.0 } else { 1.0 };
    ledger.end_tick(Extent::default(), Duration::from_secs_f32(load * dial::work(&setup.quality) / 1000.0));
}

/// A recorded world with the autopilot on, after `ticks` ticks: its hash, what was recorded, and the world.
fn fly(goal: Goal, ticks: u64) -> (u64, Vec<Entry>, Simulation) {
    let mut simulation = begin("dam_break", &[("columns", "12")], |app: &mut App| {
        app.add_plugins((LivePlugin, autopilot::plugin));
        app.add_systems(FixedUpdate, pretend_load.after(Pass::Measure).before(autopilot::steer));
        recorder::plugin(app);
    });
    simulation.world_mut().resource_mut::<Watched>().0 = true;
    simulation.world_mut().resource_mut::<Autopilot>().hold(Some(goal));
    (0..ticks).for_each(|_| simulation.tick());
    let world = simulation.world();
    let bytes = world.resource::<Recorder>().last_minute(recorder::end_now(world));
    let recording = Recording::decode(&bytes).unwrap();
    let input = recording.segments[0].entries.clone();
    (control::hash(world), input, simulation)
}

#[test]
fn a_run_under_it_is_recorded_and_repeats_to_the_bit_without_the_autopilot() {
    // An error that is over its bound at the start, so that there are moves in ten seconds: moves down wait for half a
    // minute.
    for goal in [Goal::Time(16.0), Goal::Error(0.00001)] {
        let (hash, input, flown) = fly(goal, 600);
        let moves = input.iter().filter(|entry| matches!(entry.intent, Intent::Quality { .. })).count();
        assert!(moves >= 1, "{goal:?} never moved: nothing is tested");
        assert!(flown.world().resource::<Autopilot>().moves() as usize >= moves);
        let mut again = begin("dam_break", &[("columns", "12")], ());
        run(&mut again, &Plan { ticks: 600, input, complete: true, ..Plan::default() }, &mut []).unwrap();
        assert_eq!(control::hash(again.world()), hash, "{goal:?}");
        assert_eq!(again.world().resource::<Setup>().quality, flown.world().resource::<Setup>().quality);
    }
}

#[test]
fn a_run_under_it_keeps_to_its_time_and_says_when_it_cannot() {
    let (_, _, flown) = fly(Goal::Time(16.0), 390);
    let (setup, autopilot) = (flown.world().resource::<Setup>(), flown.world().resource::<Autopilot>());
    assert!(3.0 * dial::work(&setup.quality) <= 16.0, "{:?} is too expensive under the load", setup.quality);
    assert_eq!(autopilot.verdict(), Verdict::Holds);
    let (_, _, flown) = fly(Goal::Time(16.0), 600);
    let work = dial::work(&flown.world().resource::<Setup>().quality);
    assert!(work <= 16.0 && work > 9.0, "after the load it goes back to {work} of 16 ms");
    let (_, _, flown) = fly(Goal::Time(0.5), 100);
    assert_eq!(flown.world().resource::<Autopilot>().verdict(), Verdict::Beyond);
    assert_eq!(flown.world().resource::<Setup>().preset, Preset::Draft);
}
