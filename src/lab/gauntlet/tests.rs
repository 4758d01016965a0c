//! The gauntlet, and that its judge can fail a case.

use super::{
    CASES, GauntletCase, Stability,
    arrange::STARTS,
    case::{Bound, Known},
    confines::Confines,
    end::End,
    ends,
    rule::Rule,
    script::SCRIPTS,
};
use crate::{
    kernel::params::Preset,
    lab::cases::{Over, Row, Size, Verdict, jobs, run_all},
    scene::KNOBS,
    sim::state::{AirGrid, ParticleStore, Rock},
};
use bevy::{ecs::world::World, prelude::Mut};
use glam::Vec2;
use std::sync::LazyLock;

fn run(case: &'static [GauntletCase], presets: &[Preset]) -> Vec<Row<Stability>> {
    run_all(&jobs(case, |_| true, presets, 1.0), 2, |_, _| {}).unwrap()
}

/// The qualities at which the test of all cases has time for the `k`th: at every one for the quick ones; of those that take
/// seconds each runs at `balanced` and at one other, in turn. A debug build, which takes ten times as long, runs the quick
/// ones at `balanced`, and the command all of them at every quality.
fn qualities(k: usize) -> Vec<Preset> {
    const IN_TURN: [Preset; 4] = [Preset::Classic, Preset::Draft, Preset::Fast, Preset::Fine];
    match CASES[k].size {
        Size::Quick if cfg!(debug_assertions) => vec![Preset::Balanced],
        Size::Quick => Preset::ALL.to_vec(),
        Size::Usual if !cfg!(debug_assertions) => vec![Preset::Balanced, IN_TURN[k % IN_TURN.len()]],
        _ => Vec::new(),
    }
}

#[test]
#[cfg_attr(target_arch = "wasm32", ignore = "heavy: natively only")]
fn every_case_holds() {
    let jobs: Vec<_> = (0..CASES.len()).flat_map(|k| jobs(&CASES[k..=k], |_| true, &qualities(k), 1.0)).collect();
    let rows = run_all(&jobs, 2, |_, _| {}).unwrap();
    let failed: Vec<String> = (rows.iter().filter(|row| row.verdict == Verdict::Fail))
        .map(|row| format!("{} at {}: {}", row.case, row.setting, row.figures.broken.join("; ")))
        .collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn the_ends_of_the_knobs_are_the_same_at_all_qualities_but_classic() {
    let qualities = |case: &GauntletCase| {
        Preset::ALL.map(|preset| case.blueprint(preset, 1.0).map(|blueprint| blueprint.quality).unwrap())
    };
    let mut cases = CASES.iter().filter(|case| case.over == Over::Method);
    assert!(cases.clone().count() == 7 && cases.all(|case| qualities(case)[1..] == [qualities(case)[1]; 5]));
}

#[test]
fn cases_have_names_of_their_own_and_say_what_they_are() {
    for (k, case) in CASES.iter().enumerate() {
        assert!(CASES[..k].iter().all(|other| other.name != case.name), "two cases are called {}", case.name);
        let texts = [case.title, case.what, case.guards, case.allowed];
        assert!(texts.iter().all(|text| !text.is_empty()), "{} lacks a text", case.name);
        assert!(case.ticks > 0);
        // No name of a shared text that is not there.
        assert!(case.scene.starts_with('(') && case.allowed.contains(' '), "{} names what is not shared", case.name);
    }
    let is_case = |name: &str| CASES.iter().any(|case| case.name == name);
    assert!(STARTS.iter().all(|(name, _)| is_case(name)), "a start belongs to no case");
    assert!(SCRIPTS.iter().all(|(name, _)| is_case(name)), "a script belongs to no case");
}

#[test]
fn any_two_knobs_meet_at_both_ends() {
    let knobs = ends::knobs();
    let runs = CASES.iter().filter(|case| case.over == Over::Method).count();
    assert_eq!(knobs.len(), KNOBS.len() - 1, "only the particle limit has a case of its own");
    for a in 0..knobs.len() {
        for b in 0..a {
            let mut met: Vec<_> = (0..runs).map(|run| (ends::is_high(a, run), ends::is_high(b, run))).collect();
            met.sort_unstable();
            met.dedup();
            assert_eq!(met.len(), 4, "{} and {} do not meet in all ways", knobs[a].name, knobs[b].name);
        }
    }
}

#[test]
fn a_row_is_the_same_side_by_side_and_alone_but_for_its_times() {
    let jobs = jobs(&CASES, |case| ["shots", "suction"].contains(&case.name), &[Preset::Draft, Preset::Fast], 1.0);
    let without_times = |side_by_side| {
        let rows = run_all(&jobs, side_by_side, |_, _| {}).unwrap();
        let without = |row: Row<Stability>| Row {
            figures: Stability { late: None, time: 0.0, ms_median: 0.0, ms_max: 0.0, ms_total: 0.0, ..row.figures },
            ..row
        };
        rows.into_iter().map(without).collect::<Vec<_>>()
    };
    assert_eq!(without_times(1), without_times(3));
}

/// A small pool, for cases that must fail.
const POOL: &str =
    "(title: \"Pool\", spacing: 0.1, size: (4, 2), gravity: (0, -9.81), effects: {drag: off}, contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (4, 1)))])";

/// A case that differs from the pool at rest by its script and by what `change` says.
fn sabotaged(name: &'static str, act: fn(&mut World, u64), change: fn(&mut GauntletCase)) -> GauntletCase {
    let mut case = GauntletCase { name, scene: POOL, act: Some(act), ticks: 40, ..GauntletCase::default() };
    change(&mut case);
    case
}

fn bound(case: &mut GauntletCase, rule: Rule, most: f64) {
    case.bounds.insert(rule, Bound { most, why: "so that it fails" });
}

/// A script's changes count as edits, so a fault of the kernel can't be played by a script; bounds that a sound kernel breaks
/// stand in for it.
static SABOTAGED: LazyLock<[GauntletCase; 11]> = LazyLock::new(|| {
    let still = |_: &mut World, _| {};
    let poison = |world: &mut World, tick| {
        if tick == 5 {
            world.resource_mut::<ParticleStore>().0.vx[0] = f32::NAN;
        }
    };
    [
        sabotaged("sound", still, |_| {}),
        sabotaged(
            "energy",
            |world, tick| {
                // What is pressed together has to rise.
                if tick == 5 {
                    world.resource_mut::<ParticleStore>().0.x.iter_mut().for_each(|x| *x *= 0.5);
                }
            },
            |case| {
                (case.moves, _) = (Some("pressed"), bound(case, Rule::Energy, 1e-3));
                case.waived.insert(Rule::Density, "pressed");
            },
        ),
        sabotaged(
            "fast",
            |world, tick| {
                if tick == 5 {
                    world.resource_mut::<ParticleStore>().0.vy[0] = 300.0;
                }
            },
            |case| (case.moves, _) = (Some("shot"), bound(case, Rule::Speed, 5.0)),
        ),
        sabotaged("confined", still, |case| case.confines = Some(Confines::Sides(vec![(-1.0, 0.0, -1.0)]))),
        sabotaged(
            "density",
            |world, _| {
                // Twice as many as have room, put there again before every tick.
                let particles = &mut world.resource_mut::<ParticleStore>().0;
                particles.x.iter_mut().zip(&particles.id).for_each(|(x, id)| *x = 10.0 + 0.5 * (id % 40) as f32);
            },
            |case| {
                case.moves = Some("pressed");
                case.waived.insert(Rule::Energy, "pressed");
            },
        ),
        sabotaged(
            "rest",
            |world, _| world.resource_mut::<ParticleStore>().0.vx.iter_mut().for_each(|speed| *speed = 10.0),
            |_| {},
        ),
        sabotaged(
            "cost",
            |world, _| world.resource_mut::<ParticleStore>().0.vx[0] = 2000.0,
            |case| {
                (case.moves, _) = (Some("shot"), bound(case, Rule::Cost, 1.2));
                case.waived.insert(Rule::Density, "shot");
            },
        ),
        sabotaged("lost", poison, |_| {}),
        sabotaged(
            "calm",
            |world, tick| {
                if tick == 5 {
                    world.resource_scope(|world, mut air: Mut<AirGrid>| {
                        air.build(world.resource::<Rock>());
                        air.press(Vec2::splat(15.0), 3.0, -100.0);
                    });
                }
            },
            |case| case.calm = true,
        ),
        sabotaged("end", still, |case| case.end = Some(End::Unmoved)),
        sabotaged(
            "amount",
            |world, tick| {
                if tick == 5 {
                    // Two less of four hundred.
                    world.resource_mut::<ParticleStore>().0.retain(|particles, i| particles.id[i] > 1);
                }
            },
            |case| case.end = Some(End::Amount { off: 1.0 }),
        ),
    ]
});

#[test]
fn the_judge_finds_every_kind_of_fault_and_no_other() {
    let expected = [
        ("sound", ""),
        ("energy", "energy: "),
        ("fast", "speed: "),
        ("confined", "astray"),
        ("density", "density: "),
        ("rest", "rest: "),
        ("cost", "cost: "),
        ("lost", "lost: 1 particles went"),
        ("calm", "air cells cut"),
        ("end", "particles moved"),
        ("amount", "particles' worth of 400.0"),
    ];
    let rows = run(&*SABOTAGED, &[Preset::Draft]);
    for (row, (name, what)) in rows.iter().zip(expected) {
        assert_eq!(row.case, name);
        let verdict = if what.is_empty() { Verdict::Pass } else { Verdict::Fail };
        let broken = &row.figures.broken;
        assert_eq!(row.verdict, verdict, "{name}: {broken:?}");
        assert!(broken.iter().all(|broken| broken.contains(what)), "{name}: {broken:?}");
        assert_eq!(broken.is_empty(), what.is_empty(), "{name}");
    }
}

#[test]
fn only_classic_may_be_known_to_fail_and_only_by_the_rule_that_is_named() {
    static CASES: LazyLock<[GauntletCase; 2]> = LazyLock::new(|| {
        let case = |name, rule| {
            let mut case = sabotaged(name, |_, _| {}, |case| bound(case, Rule::Cost, 0.1));
            case.moves = Some("trembles");
            case.known.insert(rule, Known::Boils);
            case
        };
        [case("named", Rule::Cost), case("another", Rule::Energy)]
    });
    let rows = run(&*CASES, &[Preset::Classic, Preset::Draft]);
    let verdicts: Vec<bool> = rows.iter().map(|row| row.figures.known.is_some()).collect();
    assert_eq!(verdicts, [true, false, false, false], "which are known");
    assert!(rows[1..].iter().all(|row| row.verdict == Verdict::Fail));
}

#[test]
fn nothing_excuses_what_is_no_number_astray_or_lost() {
    for case in CASES.iter() {
        for rule in [Rule::Finite, Rule::Inside, Rule::Lost] {
            let named =
                [case.known.contains_key(&rule), case.waived.contains_key(&rule), case.bounds.contains_key(&rule)];
            assert_eq!(named, [false; 3], "{} excuses {}", case.name, rule.name());
        }
    }
}
