//! Every number at the ends of its range, and sizes at the ends of what there is.

use super::common::{BOILS, element, intend};
use crate::{
    kernel::brush::{BrushShape, Stroke},
    lab::gauntlet::case::{Density, Gain, GauntletCase, Over, Rules, Size},
    scene::{KNOBS, Knob, Part, Values},
    sim::{intent::Intent, state::Setup},
};
use glam::Vec2;

/// The knobs that are turned: all that have no case of their own, first numbers, then words.
pub(in crate::lab::gauntlet) fn knobs() -> Vec<&'static Knob> {
    let mut knobs: Vec<_> = KNOBS.iter().filter(|knob| knob.part != Part::World).collect();
    knobs.sort_by_key(|knob| matches!(knob.values, Values::Words(_)));
    knobs
}

/// Whether a knob is at its high end in a run. In the first run all are at their low end; in the six others each is at its
/// high end in four, and no two knobs in the same four. So any two knobs meet in all four ways: both low in the first, both
/// high in two sets of four of six at least, and in turn where the sets differ.
pub(in crate::lab::gauntlet) const fn is_high(knob: usize, run: usize) -> bool {
    let (mut set, mut left) = (0b00_1111_u32, knob);
    while left > 0 {
        // The next set of four of six, as bits.
        set += 1;
        if set.count_ones() == 4 {
            left -= 1;
        }
    }
    run > 0 && set >> (run - 1) & 1 == 1
}

fn settings<const RUN: usize>() -> Vec<(String, String)> {
    let end = |(k, knob): (usize, &&Knob)| (knob.name.to_owned(), knob.end(is_high(k, RUN)));
    knobs().iter().enumerate().map(end).collect()
}

const fn ends<const RUN: usize>(name: &'static str, title: &'static str) -> GauntletCase {
    // The runs in which a tick has 64 substeps or iterations take longer.
    let is_long = is_high(0, RUN) || is_high(1, RUN);
    GauntletCase {
        name,
        title,
        what: "A small dam break in air with every knob of scene and quality at an end of its range; in seven such runs any \
               two knobs meet in all four ways.",
        guards: "Pairs of settings that were never tried together.",
        allowed: "A rest density of 0.1 blows the water up to ten times its area and one of 100 presses it to a hundredth; so \
                  neither its energy nor its density has a bound.",
        size: if is_long { Size::Usual } else { Size::Quick },
        scene: "(title: \"Ends\", spacing: 0.1, size: (4, 3), contents: [
            (element: \"rock\", shape: Rect(min: (2, 0), max: (2.1, 0.6))),
            (element: \"water\", shape: Rect(min: (0, 0), max: (0.8, 1.2)))])",
        settings: settings::<RUN>,
        over: Over::Method,
        ticks: if is_long { 12 } else { 60 },
        rules: Rules { work: 8.0, air: Rules::SEALED, ..Rules::ALWAYS },
        ..GauntletCase::USUAL
    }
}

pub(super) const ENDS_1: GauntletCase = ends::<0>("ends_1", "Ends of the knobs, all low");
pub(super) const ENDS_2: GauntletCase = ends::<1>("ends_2", "Ends of the knobs, second run");
pub(super) const ENDS_3: GauntletCase = ends::<2>("ends_3", "Ends of the knobs, third run");
pub(super) const ENDS_4: GauntletCase = ends::<3>("ends_4", "Ends of the knobs, fourth run");
pub(super) const ENDS_5: GauntletCase = ends::<4>("ends_5", "Ends of the knobs, fifth run");
pub(super) const ENDS_6: GauntletCase = ends::<5>("ends_6", "Ends of the knobs, sixth run");
pub(super) const ENDS_7: GauntletCase = ends::<6>("ends_7", "Ends of the knobs, seventh run");

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
