//! The gauntlet, and that its judge can fail a case.

use super::{
    CASES, GauntletCase, Stability,
    arrange::STARTS,
    case::{Confines, Density, Gain, Known, Rules},
    end::End,
    ends,
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

/// A debug build, which takes ten times as long, runs the quick cases at one quality; a release build runs every case but
/// the long ones at every quality.
#[test]
fn every_case_holds() {
    let (most, presets) = match cfg!(debug_assertions) {
        true => (Size::Quick, &[Preset::Balanced][..]),
        false => (Size::Usual, &Preset::ALL[..]),
    };
    let rows = run_all(&jobs(&CASES, |case| case.size <= most, presets, 1.0), 2, |_, _| {}).unwrap();
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
    let timeless = |side_by_side| {
        let rows = run_all(&jobs, side_by_side, |_, _| {}).unwrap();
        let timeless = |row: Row<Stability>| Row {
            figures: Stability { ms_median: 0.0, ms_max: 0.0, ms_total: 0.0, ..row.figures },
            ..row
        };
        rows.into_iter().map(timeless).collect::<Vec<_>>()
    };
    assert_eq!(timeless(1), timeless(3));
}

/// A small pool, for cases that must fail.
const POOL: &str =
    "(title: \"Pool\", spacing: 0.1, size: (2, 2), gravity: (0, -9.81), effects: {drag: off}, contents: [
    (element: \"water\", shape: Rect(min: (0, 0), max: (2, 0.5)))])";

fn sabotaged(name: &'static str, rules: Rules, act: fn(&mut World, u64)) -> GauntletCase {
    GauntletCase { name, scene: POOL, act: Some(act), ticks: 40, rules, ..GauntletCase::default() }
}

/// A script's changes count as edits, so a fault of the kernel can't be played by a script; rules that a sound kernel breaks
/// stand in for it.
static SABOTAGED: LazyLock<[GauntletCase; 10]> = LazyLock::new(|| {
    [
        sabotaged("sound", Rules { gain: Some(Gain::Speed(1.0)), ..Rules::default() }, |_, _| {}),
        sabotaged("gain", Rules { gain: Some(Gain::Speed(-1.0)), ..Rules::default() }, |_, _| {}),
        sabotaged("fast", Rules { fastest: Some(5.0), ..Rules::default() }, |world, tick| {
            if tick == 5 {
                world.resource_mut::<ParticleStore>().0.vy[0] = 300.0;
            }
        }),
        sabotaged(
            "confined",
            Rules { confines: Some(Confines::Sides(vec![(-1.0, 0.0, -1.0)])), ..Rules::default() },
            |_, _| {},
        ),
        sabotaged("density", Rules { density: Some(DENSE), ..Rules::default() }, |world, _| {
            // Half of the water, pressed together again before every tick.
            let particles = &mut world.resource_mut::<ParticleStore>().0;
            particles.x.iter_mut().enumerate().for_each(|(i, x)| *x = 5.0 + 0.25 * (i % 20) as f32);
        }),
        sabotaged("rest", Rules { rest: Some(1e-3), ..Rules::default() }, |world, _| {
            world.resource_mut::<ParticleStore>().0.vx.iter_mut().for_each(|speed| *speed = 10.0);
        }),
        sabotaged("work", Rules { work: Some(1.2), ..Rules::default() }, |world, _| {
            world.resource_mut::<ParticleStore>().0.vx[0] = 2000.0;
        }),
        sabotaged("removed", Rules::default(), |world, tick| {
            if tick == 5 {
                world.resource_mut::<ParticleStore>().0.vx[0] = f32::NAN;
            }
        }),
        sabotaged("calm", Rules { calm: true, ..Rules::default() }, |world, tick| {
            if tick == 5 {
                world.resource_scope(|world, mut air: Mut<AirGrid>| {
                    air.build(world.resource::<Rock>());
                    air.press(Vec2::splat(10.0), 3.0, -100.0);
                });
            }
        }),
        sabotaged("end", Rules { end: Some(End::Unmoved), ..Rules::default() }, |_, _| {}),
    ]
});

const DENSE: Density = Density { shock: 0, worst: 0.2, end: 0.2 };

#[test]
fn the_judge_finds_every_kind_of_fault_and_no_other() {
    let expected = [
        ("sound", ""),
        ("gain", "energy gained"),
        ("fast", "fastest"),
        ("confined", "through to"),
        ("density", "density error"),
        ("rest", "motion"),
        ("work", "work of a tick"),
        ("removed", "1 particles went, 1 as no number, where 0 should"),
        ("calm", "air cells cut"),
        ("end", "particles moved"),
    ];
    let rows = run(&*SABOTAGED, &[Preset::Draft]);
    for (row, (name, what)) in rows.iter().zip(expected) {
        assert_eq!(row.case, name);
        let verdict = if what.is_empty() { Verdict::Pass } else { Verdict::Fail };
        assert_eq!(row.verdict, verdict, "{name}: {:?}", row.figures.broken);
        assert!(row.figures.broken.iter().all(|broken| broken.contains(what)), "{name}: {:?}", row.figures.broken);
    }
}

#[test]
fn only_classic_may_be_known_to_fail() {
    static CASE: LazyLock<[GauntletCase; 1]> = LazyLock::new(|| {
        let rules = Rules { gain: Some(Gain::Speed(-1.0)), ..Rules::default() };
        [GauntletCase { known: Some(Known::Boils), ..sabotaged("known", rules, |_, _| {}) }]
    });
    let verdicts: Vec<Verdict> = run(&*CASE, &[Preset::Classic, Preset::Draft]).iter().map(|row| row.verdict).collect();
    assert_eq!(verdicts, [Verdict::Known, Verdict::Fail]);
}
