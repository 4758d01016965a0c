//! Every number at the ends of its range, and sizes at the ends of what there is.

use super::common::{BOILS, element, intend};
use crate::{
    kernel::brush::{BrushShape, Stroke},
    lab::gauntlet::case::{Density, Gain, GauntletCase, Over, Rules, Size},
    sim::{intent::Intent, state::Setup},
};
use glam::Vec2;

/// The knobs that every scene has with the ends of their ranges.
pub(in crate::lab::gauntlet) const KNOB_ENDS: [(&str, &str, &str); 13] = [
    ("substeps", "1", "64"),
    ("iterations", "1", "64"),
    ("kernel_radius", "2", "4"),
    ("correction_limit", "0.05", "0.5"),
    ("air_cell", "1", "32"),
    ("air_courant", "0.1", "0.9"),
    ("rest_density", "0.1", "100"),
    ("relaxation", "0.0001", "10"),
    ("constraint_floor", "-1", "0"),
    ("tension_strength", "0", "1"),
    ("tension_distance", "0.1", "0.3"),
    ("gradient", "spiky", "rational"),
    ("air_advection", "first_order", "second_order"),
];

type Settings = [(&'static str, &'static str); KNOB_ENDS.len()];

/// The runs: in the first all knobs are at their low end; in the six others each is at its high end in four, and no two
/// knobs in the same four. So any two knobs meet in all four ways: both low in the first, both high in two sets of four
/// of six at least, and in turn where the sets differ.
pub(in crate::lab::gauntlet) const RUNS: [Settings; 7] = {
    let mut runs = [[("", ""); KNOB_ENDS.len()]; 7];
    let (mut knob, mut set) = (0, 0_u32);
    while knob < KNOB_ENDS.len() {
        // The next set of four of six, as bits.
        while set.count_ones() != 4 {
            set += 1;
        }
        let (name, low, high) = KNOB_ENDS[knob];
        let mut run = 0;
        while run < 7 {
            let is_high = run > 0 && set >> (run - 1) & 1 == 1;
            runs[run][knob] = (name, if is_high { high } else { low });
            run += 1;
        }
        (knob, set) = (knob + 1, set + 1);
    }
    runs
};

const fn ends(name: &'static str, title: &'static str, run: usize) -> GauntletCase {
    // The runs in which a tick has 64 substeps or iterations take longer.
    let (substeps, iterations) = (RUNS[run][0].1.len(), RUNS[run][1].1.len());
    let is_expensive = substeps + iterations > 2;
    GauntletCase {
        name,
        title,
        what: "A small dam break in air with every knob of scene and quality at an end of its range; in seven such runs any \
               two knobs meet in all four ways.",
        guards: "Pairs of settings that nobody tried together.",
        allowed: "A rest density of 0.1 blows the water up to ten times its area and one of 100 presses it to a hundredth; so \
                  neither its energy nor its density has a bound.",
        size: if is_expensive { Size::Usual } else { Size::Quick },
        scene: "(title: \"Ends\", spacing: 0.1, size: (4, 3), contents: [
            (element: \"rock\", shape: Rect(min: (2, 0), max: (2.1, 0.6))),
            (element: \"water\", shape: Rect(min: (0, 0), max: (0.8, 1.2)))])",
        settings: &RUNS[run],
        over: Over::Method,
        ticks: if is_expensive { 12 } else { 60 },
        rules: Rules { work: 8.0, air: Rules::SEALED, ..Rules::ALWAYS },
        ..GauntletCase::USUAL
    }
}

pub(super) const ENDS_1: GauntletCase = ends("ends_1", "Ends of the knobs, all low", 0);
pub(super) const ENDS_2: GauntletCase = ends("ends_2", "Ends of the knobs, second run", 1);
pub(super) const ENDS_3: GauntletCase = ends("ends_3", "Ends of the knobs, third run", 2);
pub(super) const ENDS_4: GauntletCase = ends("ends_4", "Ends of the knobs, fourth run", 3);
pub(super) const ENDS_5: GauntletCase = ends("ends_5", "Ends of the knobs, fifth run", 4);
pub(super) const ENDS_6: GauntletCase = ends("ends_6", "Ends of the knobs, sixth run", 5);
pub(super) const ENDS_7: GauntletCase = ends("ends_7", "Ends of the knobs, seventh run", 6);

pub(super) const SPACING_1_MM: GauntletCase = GauntletCase {
    name: "spacing_1_mm",
    title: "Particles of a millimetre",
    what: "A dam break of 20 × 40 particles of 1 mm, in air.",
    guards: "Numbers in units of d that are a hundred times the usual: gravity is 9,810 d/s².",
    allowed: "Energy: 0.15 m/s (the column is 4 cm high: it falls at 0.9 m/s). A tick's fall is 2.7 d, so that the front of \
              the collapse is pressed together for a moment, as under 100 g: three times too dense at most, 20 % at the end.",
    scene: "(title: \"Small\", spacing: 0.001, size: (0.08, 0.05), effects: {drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (0.02, 0.04)))])",
    ticks: 240,
    rules: Rules {
        gain: Some(Gain::Speed(0.15)),
        density: Some(Density { shock: 10, worst: 2.0, end: 0.2 }),
        ..Rules::ALWAYS
    },
    known: Some(BOILS),
    ..GauntletCase::USUAL
};

pub(super) const SPACING_10_M: GauntletCase = GauntletCase {
    name: "spacing_10_m",
    title: "Particles of ten metres",
    what: "A dam break of 20 × 40 particles of 10 m.",
    guards: "The same at the other end: gravity is 1 d/s², and a fall takes minutes.",
    allowed: "Gravity is weak in units of d, and what corrections do shows the more: energy a quarter of their speed (15 m/s at \
              `draft`; the column falls at 89 m/s).",
    size: Size::Quick,
    scene: "(title: \"Large\", spacing: 10, size: (800, 500), effects: {air: off, drag: off}, contents: [
        (element: \"water\", shape: Rect(min: (0, 0), max: (200, 400)))])",
    ticks: 600,
    rules: Rules {
        gain: Some(Gain::Corrections(0.25)),
        density: Some(Density { shock: 10, worst: 0.2, end: 0.1 }),
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const FAR_AWAY: GauntletCase = GauntletCase {
    name: "far_away",
    title: "100 km from the origin",
    what: "A pool of 30 × 12 particles of 10 m between two walls of rock, 100 km (10,000 d) from the world's origin.",
    guards: "A position in f32 is coarser the further out it is; here by a thousandth of a spacing.",
    allowed: "At rest to 0.1 d a tick. Energy: a fifth of the speed of corrections, as the water finds its places under a weak \
              gravity.",
    size: Size::Quick,
    scene: "(title: \"Far away\", spacing: 10, size: (101000, 300), effects: {air: off, drag: off}, contents: [
        (element: \"rock\", shape: Rect(min: (99970, 0), max: (100000, 300))),
        (element: \"rock\", shape: Rect(min: (100300, 0), max: (100330, 300))),
        (element: \"water\", shape: Rect(min: (100000, 0), max: (100300, 120)))])",
    ticks: 300,
    rules: Rules {
        confines: Some(|at| (100_000.0..=100_300.0).contains(&at.x)),
        gain: Some(Gain::Corrections(0.2)),
        density: Some(Density { shock: 0, worst: 0.06, end: 0.05 }),
        rest: Some(0.1),
        work: 1.5,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const MILLION: GauntletCase = GauntletCase {
    name: "million",
    title: "A million particles",
    what: "A dam break of 707 × 1,414 particles, ten ticks.",
    guards: "Indices, sums and buffers at the largest size.",
    allowed: "Energy: swollen by 2 %, 5.3 m/s. The cost of a particle is that of a small world.",
    size: Size::Long,
    scene: "(title: \"A million\", spacing: 0.1, size: (282.8, 148.5), effects: {air: off, drag: off}, particle_limit: 4000000,
        contents: [(element: \"water\", shape: Rect(min: (0, 0), max: (70.7, 141.4)))])",
    ticks: 10,
    rules: Rules {
        gain: Some(Gain::Speed(5.3)),
        density: Some(Density { shock: 0, worst: 0.1, end: 0.1 }),
        work: 1.5,
        ..Rules::ALWAYS
    },
    ..GauntletCase::USUAL
};

pub(super) const NOBODY: GauntletCase = GauntletCase {
    name: "nobody",
    title: "No particles at all",
    what: "An empty box with every effect on; after half a second one particle, which is erased again.",
    guards: "Means over nothing, buffers of length 0.",
    allowed: "Nothing may happen.",
    size: Size::Quick,
    scene: "(title: \"Nobody\", spacing: 0.1, size: (4, 4),
        effects: {air: on, drag: on, predictor: on, tension: on, viscosity: on, vorticity: on})",
    act: Some(|world, tick| {
        let stroke = Stroke::dab(BrushShape::Disc, Vec2::splat(20.0), 0.0);
        let water = element(world.resource::<Setup>().elements(), "water");
        match tick {
            30 => intend(world, Intent::Stamp { element: water, stroke }),
            31 => intend(world, Intent::Erase { stroke: Stroke { radius: 5.0, ..stroke } }),
            _ => {}
        }
    }),
    ticks: 60,
    rules: Rules { air: Rules::SEALED, calm: true, ..Rules::ALWAYS },
    ..GauntletCase::USUAL
};
