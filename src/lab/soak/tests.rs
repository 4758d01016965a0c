//! A soak that was stopped and resumed is the one that was not.

use super::{Entry, Report, Soak, Totals, run::are_same};
use crate::{
    kernel::simd::InstructionSet,
    scene::{self, effects::EffectModes},
    sim::{checkpoint::Checkpoint, workers::Workers},
};
use std::sync::Arc;

const MINUTES: u64 = 3;

fn start() -> Checkpoint {
    let scene = scene::load("waterfall").unwrap().at_detail(0.25);
    Checkpoint::of_scene(Arc::new(scene.build(&[], None, &EffectModes::new()).unwrap()))
}

/// Plays in pieces that end after these minutes; what it ends with, the last world's save in it.
fn played(ends: &[u64]) -> Entry {
    let set = InstructionSet::detect();
    let mut soak = Soak::new(&start(), 7, MINUTES, Workers::single(), set);
    for end in ends {
        while soak.report().minutes < *end {
            soak.minute();
        }
        let bytes = soak.entry(&[]).unwrap().encode();
        if *end < MINUTES {
            let entry = Entry::decode(&bytes).unwrap();
            // Another process: nothing is left but the file, and the scene is read anew.
            soak = Soak::resume(&start(), entry, MINUTES, Workers::single(), set).unwrap();
        }
    }
    assert!(soak.is_over());
    soak.entry(&[]).unwrap()
}

/// All but times, memory and who ran it.
fn bits(report: &Report) -> Report {
    let bits = |totals: &Totals| Totals { ms: 0.0, ms_p99: 0.0, resident: None, ..*totals };
    Report { periods: report.periods.iter().map(bits).collect(), sittings: Vec::new(), ..report.clone() }
}

#[test]
fn a_soak_in_pieces_comes_to_the_same_world_and_the_same_rows() {
    let whole = played(&[MINUTES]);
    let pieces = played(&[0, 1, 2, MINUTES]);
    let state = |entry: &Entry| Checkpoint::decode(&entry.world).unwrap().state;
    assert!(are_same(&state(&whole), &state(&pieces)), "another world");
    assert_eq!(bits(&whole.report), bits(&pieces.report));
    assert_eq!(whole.hand, pieces.hand, "the player goes on otherwise");
    assert_eq!(whole.report.periods.len(), MINUTES as usize);
    assert!(whole.report.periods.iter().all(|totals| totals.particles > 100.0 && totals.kinetic > 0.0));
    let from = |entry: &Entry| entry.report.sittings.iter().map(|sitting| sitting.from).collect::<Vec<_>>();
    assert_eq!((from(&whole), from(&pieces)), (vec![0], vec![0, 0, 1, 2]));
}

#[test]
fn a_world_that_no_save_holds_makes_no_entry() {
    let mut start = start();
    let mut state = (*start.state).clone();
    state.particles.x[0] = f32::NAN;
    start.state = Arc::new(state);
    let soak = Soak::new(&start, 7, 1, Workers::single(), InstructionSet::detect());
    assert!(soak.entry(&[]).is_none());
}
