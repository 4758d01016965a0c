//! That worlds take what is thrown at them, that what they don't take is said, and that all of it is there.

use super::{
    list::{THROWS, Throw},
    stress_test::{Progress, TICKS, verdict},
};
use crate::{
    kernel::params::Preset,
    lab::{
        gauntlet::{
            judged::{Found, Judged},
            rule::{Finding, Measured, Rule},
        },
        jobs::pool,
    },
    scene::{self, effects::EffectModes},
    sim::{
        intent::Intent,
        simulation::Simulation,
        state::{Clock, ParticleStore, Setup},
        workers::Workers,
    },
};
use std::{num::NonZero, sync::Arc, thread};

/// Water beside sand under rock, in a box of air.
const WORLD: &str = "(title: \"T\", spacing: 0.1, size: (6, 4), contents: [
    (element: \"rock\", shape: Rect(min: (2.5, 0), max: (3, 1.4))),
    (element: \"rock\", shape: Rect(min: (1, 2), max: (2, 2.2))),
    (element: \"water\", shape: Rect(min: (0, 0), max: (2.5, 1.2))),
    (element: \"sand\", shape: Rect(min: (3, 0), max: (5, 0.8)))])";

fn world(preset: Preset) -> Simulation {
    let blueprint =
        scene::from_text("thrown_at", WORLD).unwrap().build(&[], Some(preset), &EffectModes::new()).unwrap();
    let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
    simulation.run(60);
    simulation
}

fn thrown(throw: &Throw, preset: Preset) -> Progress {
    let simulation = world(preset);
    let input = throw.input(simulation.get::<Setup>(), simulation.get::<Clock>().tick);
    let mut judged = Judged::new(simulation, input, TICKS);
    (0..TICKS).for_each(|_| judged.tick());
    let particles = judged.world().resource::<ParticleStore>().len();
    verdict(&judged.finish(), particles)
}

#[test]
fn a_small_world_takes_whatever_is_thrown_at_it() {
    let presets =
        if cfg!(debug_assertions) { &[Preset::Fast][..] } else { &[Preset::Classic, Preset::Draft, Preset::Balanced] };
    let jobs: Vec<(&Throw, Preset)> =
        THROWS.iter().flat_map(|throw| presets.iter().map(move |preset| (throw, *preset))).collect();
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    let verdicts = pool::run(&jobs, threads, |_| 1, |_, _| {}, |&(throw, preset)| thrown(throw, preset));
    let mut broken = Vec::new();
    for ((throw, preset), verdict) in jobs.iter().zip(verdicts) {
        println!("{} at {}: {verdict:?}", throw.name, preset.name());
        let holds = match &verdict {
            Progress::Held { particles, nearest } => *particles > 0 && !nearest.is_empty(),
            Progress::Broke { known, .. } => *known && *preset == Preset::Classic,
            _ => false,
        };
        if !holds {
            broken.push(format!("{} at {}: {verdict:?}", throw.name, preset.name()));
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

#[test]
fn what_a_world_does_not_take_is_said() {
    let finding = |rule, value| {
        let measured = Measured { value, bound: 2.0, tick: 7, what: String::new() };
        Finding { rule, measured: Ok(measured) }
    };
    let found = |is_plain, speed, density| {
        let findings = vec![finding(Rule::Speed, speed), finding(Rule::Density, density)];
        verdict(&Found::Judged { findings, is_plain }, 9)
    };
    let nearest = "speed 1.5 of 2 d/s".to_owned();
    assert_eq!(found(false, 1.5, 1.0), Progress::Held { particles: 9, nearest });
    let Progress::Broke { faults, known: false } = found(false, 3.0, 1.0) else { panic!("it holds") };
    assert!(faults.len() == 1 && faults[0].starts_with("speed: 3 d/s at tick 7"), "{faults:?}");
    // What the plain method is known for is its own; what it is not known for is not.
    assert!(matches!(found(true, 1.0, 3.0), Progress::Broke { known: true, .. }));
    assert!(matches!(found(true, 3.0, 3.0), Progress::Broke { known: false, .. }));
}

#[test]
fn all_can_be_thrown_at_a_world_of_all_elements_and_leave_it_as_heavy_as_it_was() {
    let simulation = world(Preset::Balanced);
    let setup = simulation.get::<Setup>();
    for throw in &THROWS {
        assert_eq!(throw.lacks(setup), None, "{}", throw.name);
        let input = throw.input(setup, 1000);
        assert!(input.first().is_some_and(|entry| entry.tick == 1000), "{} begins at once", throw.name);
        assert!(input.is_sorted_by_key(|entry| entry.tick), "{}", throw.name);
        assert!(input.last().is_some_and(|entry| entry.tick <= 1120), "{} takes two seconds at most", throw.name);
        let pull = input.iter().rev().find_map(|entry| match entry.intent {
            Intent::Gravity { gravity } => Some(gravity),
            _ => None,
        });
        assert!(pull.is_none_or(|gravity| gravity == setup.domain.gravity), "{} leaves another gravity", throw.name);
        assert!(throw.title.len() <= 20 && throw.what.ends_with('.'), "{}", throw.name);
    }
    let names: std::collections::BTreeSet<_> = THROWS.iter().map(|throw| throw.name).collect();
    assert_eq!(names.len(), THROWS.len());
}
