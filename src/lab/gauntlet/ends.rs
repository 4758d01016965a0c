//! Every knob at the ends of its range: seven runs in which any two knobs meet in all four ways.

use crate::scene::{KNOBS, Knob, Part, Values};

/// Name of the case that has these runs.
pub(super) const CASE: &str = "ends";

/// Names and headings of the runs.
pub(super) const RUNS: [(&str, &str); 7] = [
    ("ends_1", "Ends of the knobs, all low"),
    ("ends_2", "Ends of the knobs, second run"),
    ("ends_3", "Ends of the knobs, third run"),
    ("ends_4", "Ends of the knobs, fourth run"),
    ("ends_5", "Ends of the knobs, fifth run"),
    ("ends_6", "Ends of the knobs, sixth run"),
    ("ends_7", "Ends of the knobs, seventh run"),
];

/// The knobs that are turned: all that have no case of their own, first numbers, then words.
pub(super) fn knobs() -> Vec<&'static Knob> {
    let mut knobs: Vec<_> = KNOBS.iter().filter(|knob| knob.part != Part::World).collect();
    knobs.sort_by_key(|knob| matches!(knob.values, Values::Words(_)));
    knobs
}

/// Whether a knob is at its high end in a run. In the first run all are at their low end; in the six others each is at its
/// high end in four, and no two knobs in the same four. So any two knobs meet in all four ways: both low in the first, both
/// high in two sets of four of six at least, and in turn where the sets differ.
pub(super) fn is_high(knob: usize, run: usize) -> bool {
    // The sets of four of six, as bits.
    let set = (0_u32..).filter(|set| set.count_ones() == 4).nth(knob).unwrap_or_default();
    run > 0 && set >> (run - 1) & 1 == 1
}

/// Whether a tick of a run has the most substeps or iterations.
pub(super) fn is_long(run: usize) -> bool {
    is_high(0, run) || is_high(1, run)
}

/// The settings of a run.
pub(super) fn settings(run: usize) -> Vec<(String, String)> {
    let end = |(k, knob): (usize, &&Knob)| (knob.name.to_owned(), knob.end(is_high(k, run)));
    knobs().iter().enumerate().map(end).collect()
}
