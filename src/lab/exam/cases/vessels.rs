//! Communicating vessels.

use crate::{
    lab::{
        exam::{
            case::{
                ExamCase, Finding, Over, Setting, Size,
                Tolerance::{Share, Within},
            },
            fit::falls_to,
            world::{CaseSimulation, GRAVITY, Stopwatch, builtin, own},
        },
        stats,
    },
    scene::SceneError,
};
use std::f64::consts::PI;

pub(super) const VESSELS: ExamCase = ExamCase {
    name: "vessels",
    title: "Communicating vessels",
    setup: "The scene `communicating_vessels`: tanks of 7 m and 4.4 m width, filled to 5 m and 1.5 m, joined by a slot of \
            0.8 m at the floor through a wall of 0.6 m. Levels are means over the last 13 of 26 s, three swings from \
            side to side, weighted by sin² (Hann), so that what is left of the swing cancels. \
            When half of their difference is gone is taken in the same tanks at d = 0.05 m (assets/exam/vessels.ron), where \
            the slot is 16 particles high; at 8 the jet does not contract. When they first meet is no measure: by then \
            the waves that the jet makes in the tanks are higher than what is left of the difference, and the least change \
            of the program moves it by 12 %, but the half by less than 1 %.",
    answer: "The levels meet at the height that the volume gives. The time to half the difference: the water in the slot is \
             driven by `g` times the difference of the levels and loses the head of a jet contracted to π/(π + 2) = 0.611 of \
             the slot (Kirchhoff's free streamlines): `l dv/dt = g Δ − ½ (v/0.611)²`, `dΔ/dt = −v b (1/A + 1/B)`.",
    tolerance: "Levels: half a spacing, as the surface is made of particles. Height: 2 % as at rest. Time: 15 %; how \
                much water swings along with that in the slot is a guess (none at all: 5 % later), and measured contractions \
                of such slots lie between 0.59 and 0.65.",
    over: Over::Qualities,
    size: Size::Usual,
    run: |setting, stopwatch| Box::pin(vessels(setting, stopwatch)),
};

/// Widths of the tanks, of the wall and of the slot, m.
const LEFT: f64 = 7.0;
const RIGHT: f64 = 4.4;
const WALL: f64 = 0.6;
const SLOT: f64 = 0.8;
/// Levels at the start, m.
const START: (f64, f64) = (5.0, 1.5);
/// Contraction of a jet out of a slot.
pub(super) const CONTRACTION: f64 = PI / (PI + 2.0);

async fn vessels(setting: Setting, stopwatch: Stopwatch) -> Result<Vec<Finding>, SceneError> {
    let blueprint = builtin("communicating_vessels", &[("left", START.0), ("right", START.1)], &setting)?;
    let mut simulation = CaseSimulation::new(blueprint, &stopwatch);
    simulation.run(13.0).await;
    let (mut left, mut right) = (0.0, 0.0);
    for look in 0..LOOKS {
        simulation.run(1.0 / 6.0).await;
        let tops = simulation.matter().column_tops();
        // The weights add up to 1.
        let weight = 2.0 / f64::from(LOOKS) * (PI * (f64::from(look) + 0.5) / f64::from(LOOKS)).sin().powi(2);
        left += weight * level(&tops, 0.0, LEFT, simulation.spacing());
        right += weight * level(&tops, LEFT + WALL, LEFT + WALL + RIGHT, simulation.spacing());
    }
    let volume = LEFT * START.0 + RIGHT * START.1;
    Ok(vec![
        Finding {
            quantity: "difference of the levels",
            unit: "m",
            expected: 0.0,
            got: left - right,
            tolerance: Within(0.5 * simulation.spacing()),
        },
        Finding {
            quantity: "level",
            unit: "m",
            expected: volume / (LEFT + RIGHT),
            got: (LEFT * left + RIGHT * right) / (LEFT + RIGHT),
            tolerance: Share(0.02),
        },
        Finding {
            quantity: "time to half the difference",
            unit: "s",
            expected: theory(),
            got: time_to_half(&setting, &stopwatch).await?,
            tolerance: Share(0.15),
        },
    ])
}

/// Looks at the levels, a sixth of a second apart.
const LOOKS: u32 = 78;
/// Half of the difference at the start, m.
const HALF: f64 = 0.5 * (START.0 - START.1);

/// When half of the difference is gone in the finer tanks, s.
async fn time_to_half(setting: &Setting, stopwatch: &Stopwatch) -> Result<f64, SceneError> {
    let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/exam/vessels.ron"));
    let mut simulation = CaseSimulation::new(own("vessels", text, &[], setting)?, stopwatch);
    let mut differences = vec![(0.0, START.0 - START.1)];
    while simulation.seconds() < 10.0 && differences.last().is_some_and(|(_, difference)| *difference > HALF) {
        simulation.tick().await;
        differences.push((simulation.seconds(), filled(&simulation)));
    }
    Ok(falls_to(&differences, HALF).unwrap_or(f64::NAN))
}

/// Difference of the levels by the number of particles in the tanks, m: what splashes does not matter.
fn filled(simulation: &CaseSimulation) -> f64 {
    let d = simulation.spacing();
    let count = |from: f64, to: f64| {
        let inside = |x: &&f32| (from..to).contains(&(f64::from(**x) * d));
        simulation.particles().x.iter().filter(inside).count() as f64 * d * d / (to - from)
    };
    count(0.0, LEFT) - count(LEFT + WALL, LEFT + WALL + RIGHT)
}

/// Median height of the columns between two places (m), m.
fn level(tops: &[f64], from: f64, to: f64, d: f64) -> f64 {
    let mut tops = tops[(from / d).round() as usize..(to / d).round() as usize].to_vec();
    stats::quantile(&mut tops, 0.5).map_or(f64::NAN, |y| (y + 0.5) * d)
}

/// Time to half the difference by the theory, s.
fn theory() -> f64 {
    let (step, mut t, mut speed, mut difference) = (1e-4, 0.0, 0.0_f64, START.0 - START.1);
    // The water on both sides of the slot that moves with it adds about its height to its length.
    let length = WALL + SLOT;
    while difference > HALF && t < 100.0 {
        let jet = speed / CONTRACTION;
        speed += step * (GRAVITY * difference - 0.5 * jet * jet) / length;
        difference -= step * speed * SLOT * (1.0 / LEFT + 1.0 / RIGHT);
        t += step;
    }
    t
}
