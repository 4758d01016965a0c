//! That the rules see what breaks them, and that shards of a run make the run.

use super::{
    case::Case,
    examine::examine,
    run::{Plan, run},
    tally::Tally,
};
use crate::{
    kernel::{bins::Neighbours, params::Preset, solids::Solids},
    lab::{
        cases::Shard,
        gauntlet::{
            examiner::Examiner,
            judged::{Found, terms},
            rule::{ONE_TOO_MANY, Rule, STILL_DENSITY},
        },
    },
    scene::{self, effects::EffectModes},
    sim::{
        simulation::Simulation,
        state::{AirGrid, ParticleStore, Rock, Setup, SolverState},
        workers::Workers,
    },
};
use glam::Vec2;
use std::{path::PathBuf, sync::Arc};

/// A pool beside rock, that should stand still.
const POOL: &str = "(title: \"T\", spacing: 0.1, size: (6, 2), effects: {sleep: off}, contents: [
    (element: \"rock\", shape: Rect(min: (1, 0), max: (1.2, 0.5))),
    (element: \"water\", shape: Rect(min: (0, 0), max: (6, 1.6)))])";

fn pool() -> Case {
    Case { scene: POOL.to_owned(), input: Vec::new(), ticks: 180 }
}

#[test]
fn a_sound_world_is_found_sound_and_one_that_is_none_is_refused() {
    let found = examine(&pool());
    assert_eq!(found.faults(), [""; 0]);
    let judged = |rule: Rule| found.findings().iter().any(|finding| finding.rule == rule && finding.measured.is_ok());
    assert!(Rule::ALL.into_iter().all(judged), "not all rules apply: {found:?}");
    let wide = Case { scene: POOL.replace("size: (6, 2)", "size: (6, -2)"), ..pool() };
    assert_eq!(examine(&wide), Found::Refused);
}

#[test]
fn every_fault_is_seen_by_its_rule() {
    type Harm = fn(&mut Simulation);
    let harms: [(Rule, Harm); 11] = [
        (Rule::Finite, |world| particles(world).x[0] = f32::NAN),
        (Rule::Inside, |world| particles(world).x[3] = 11.0),
        (Rule::Inside, |world| particles(world).y[3] = -0.5),
        (Rule::Lost, |world| particles(world).id[1] = 5),
        (Rule::Lost, |world| {
            particles(world).retain(|_, i| i > 0);
        }),
        (Rule::Lost, |world| {
            world.get_mut::<Rock>().remove(glam::IVec2::new(10, 0));
        }),
        (Rule::Speed, |world| particles(world).vx[2] = 1e6),
        (Rule::Energy, |world| particles(world).vy.iter_mut().for_each(|v| *v = 40.0)),
        (Rule::Air, |world| {
            let rock = world.get::<Rock>().clone();
            let air: &mut AirGrid = world.get_mut();
            air.build(&rock);
            air.press(Vec2::new(5.0, 18.0), 2.0, 0.1);
        }),
        (Rule::Density, |world| {
            particles(world)
                .x
                .iter_mut()
                .for_each(|x| *x = if *x < 10.0 { 0.6 * *x } else { 12.0 + 0.6 * (*x - 12.0) });
        }),
        (Rule::Cost, |world| {
            // Everybody is everybody's neighbour, and there twice, as in a search that has lost its bins.
            let mut all = particles(world).clone();
            (0..all.len()).for_each(|i| all.push(10_000 + i as u32, all.element[i], all.position(i), Vec2::ZERO));
            let Setup { domain, quality, .. } = world.get::<Setup>().clone();
            let solver = world.get_mut::<SolverState>();
            solver.neighbours = Neighbours::Brute;
            solver.bin(&mut all, &Solids::default(), &domain, &quality, 1.0, 1);
        }),
    ];
    for (rule, harm) in harms {
        // Harm comes after a tick, and before the judge looks: what a kernel at fault would do.
        let file = scene::from_text("case", POOL).unwrap();
        let blueprint = file.build(&[], None, &EffectModes::new()).unwrap();
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::single());
        let mut examiner = Examiner::new(simulation.world(), terms(simulation.world(), &[], 40));
        for tick in 0..40 {
            examiner.begin(simulation.world());
            simulation.tick();
            if tick == 39 {
                harm(&mut simulation);
            }
            examiner.look(simulation.world());
        }
        let findings = examiner.finish(simulation.world());
        let finding = findings.iter().find(|finding| finding.rule == rule).unwrap();
        assert!(finding.fault().is_some(), "{} does not see it: {finding:?}", rule.name());
    }
}

#[test]
fn rest_is_judged_with_everything_awake() {
    let restless = |world: &mut Simulation| particles(world).vx.iter_mut().for_each(|v| *v = 3.0);
    let file = scene::from_text("case", POOL).unwrap();
    let mut simulation =
        Simulation::new(Arc::new(file.build(&[], None, &EffectModes::new()).unwrap()), Workers::single());
    let mut examiner = Examiner::new(simulation.world(), terms(simulation.world(), &[], 120));
    for _ in 0..120 {
        examiner.begin(simulation.world());
        simulation.tick();
        restless(&mut simulation);
        examiner.look(simulation.world());
    }
    let findings = examiner.finish(simulation.world());
    assert!(findings[Rule::Rest as usize].fault().is_some(), "{findings:?}");
    let asleep = Case { scene: POOL.replace("effects: {sleep: off}, ", ""), ..pool() };
    let why = &examine(&asleep).findings()[Rule::Rest as usize].measured.clone();
    assert_eq!(why, &Err("sleep would hide motion"));
}

#[test]
fn what_is_hot_may_move_as_long_as_it_can_warm_the_air() {
    let lava = |effects: &str| {
        let scene = POOL.replace("water", "lava").replace("sleep: off", effects);
        examine(&Case { scene, ..pool() }).findings()[Rule::Rest as usize].measured.clone()
    };
    assert_eq!(lava("sleep: off"), Err("what is hot or cold stirs the air"));
    let calm = lava("sleep: off, convection: off").expect("it is judged");
    assert!(!calm.is_broken(), "{calm:?}");
}

#[test]
fn only_what_stays_what_it_is_is_held_to_the_bound_of_still_water() {
    let bound = |case: &Case| {
        let finding = examine(case).findings()[Rule::Density as usize].clone();
        finding.measured.expect("it is judged").bound
    };
    // The surface of oil that burns comes down, and what stands above it follows.
    let burning = Case { scene: POOL.replace("water", "burning_oil"), ..pool() };
    assert_eq!([&pool(), &burning].map(bound), [STILL_DENSITY, ONE_TOO_MANY]);
}

fn particles(world: &mut Simulation) -> &mut crate::kernel::particles::Particles {
    &mut world.get_mut::<ParticleStore>().0
}

fn folder(test: &str) -> PathBuf {
    std::env::temp_dir().join(format!("powder-master-{test}-{}", std::process::id()))
}

#[test]
fn shards_of_any_number_make_the_whole_on_any_number_of_threads() {
    let folder = folder("shards");
    let tally = |shard: Option<&str>, threads| {
        let shard = shard.map(|shard| Shard::read(shard).unwrap());
        run(&Plan { seed: 9, count: 12, presets: vec![Preset::Draft], shard, threads }, &folder, |_, _| {}).unwrap()
    };
    let whole = tally(None, 1);
    assert_eq!(whole.worlds + whole.refused, 12);
    assert_eq!(tally(None, 3), whole);
    let parts = ["3/3", "1/3", "2/3"].map(|shard| tally(Some(shard), 2));
    assert!(parts.iter().all(|part| part.worlds + part.refused == 4));
    let written = parts.iter().map(|part| serde_json::from_str(&serde_json::to_string(part).unwrap()).unwrap());
    assert_eq!(Tally::merge(written.collect()), Ok(whole.clone()));
    assert!(Tally::merge(parts[1..].to_vec()).is_err_and(|error| error.contains("3/3 is missing")));
    let other = Tally { seed: 10, ..parts[0].clone() };
    assert!(Tally::merge(vec![other, parts[1].clone(), parts[2].clone()]).is_err_and(|error| error.contains("seed 9")));
    let _ = std::fs::remove_dir_all(folder);
}

#[test]
fn what_breaks_a_rule_is_kept_small_and_breaks_it_again() {
    // Air pressed to a million atmospheres costs what it costs, until that is mended; then a world that costs more than
    // is allowed has to be found elsewhere.
    let folder = folder("kept");
    let plan = Plan { seed: 1, count: 40, presets: Preset::ALL.into(), shard: None, threads: 2 };
    let tally = run(&plan, &folder, |_, _| {}).unwrap();
    for failure in &tally.failures {
        let case = Case::read(&PathBuf::from(&failure.file)).unwrap();
        let found = examine(&case);
        let again = found.findings().iter().find(|finding| finding.rule == failure.rules[0].0);
        assert!(again.is_some_and(|finding| finding.fault().is_some()), "{failure:?} holds from its file: {found:?}");
        assert!(case.scene.contains(&format!("World 1/{}", failure.world)), "{}", case.scene);
    }
    assert!(tally.failures.is_empty() == tally.failure().is_none());
    let _ = std::fs::remove_dir_all(folder);
}
