//! What the autopilot advises and leaves to the player: another detail, where the time can't be held at this one, or
//! where there is time for a finer one, which buys more truth than any quality. It never changes the detail itself
//! (docs/detail.md).

use crate::{
    kernel::params::{Preset, Quality},
    lab::dial::work,
    scene::DETAIL,
};

/// The coarsest detail that is advised: at a quarter a wall of a single cell is lost.
const COARSEST: f64 = 0.5;
/// Time of a tick at twice the detail over that at the same quality: four times the particles, in up to twice the
/// substeps.
const FINER: f32 = 8.0;
/// The same at half of it: a quarter of the particles, in as many substeps if none was for fast motion.
const COARSER: f32 = 0.25;

/// A detail to go on at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advice {
    /// The detail to ask for.
    pub detail: f64,
    /// What a tick is expected to take there, at the cheapest quality if that is more than now, ms.
    pub milliseconds: f32,
}

/// What a tick takes, and at what.
#[derive(Clone, Copy, Debug)]
pub struct Now {
    /// ms.
    pub milliseconds: f32,
    /// Quality.
    pub quality: Quality,
    /// The detail that is asked for.
    pub detail: f64,
}

/// Where no quality takes less than a bound.
pub fn coarser(now: Now) -> Option<Advice> {
    let detail = now.detail / 2.0;
    (detail >= COARSEST).then_some(Advice { detail, milliseconds: now.milliseconds * COARSER })
}

/// Where the cheapest quality at twice the detail is expected to take at most `aim`, ms.
pub fn finer(now: Now, aim: f32) -> Option<Advice> {
    let detail = 2.0 * now.detail;
    let milliseconds = now.milliseconds * FINER * work(&Preset::Draft.quality()) / work(&now.quality);
    (detail <= DETAIL.max && milliseconds <= aim).then_some(Advice { detail, milliseconds })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn now(preset: Preset, milliseconds: f32, detail: f64) -> Now {
        Now { milliseconds, quality: preset.quality(), detail }
    }

    #[test]
    fn a_detail_is_advised_that_is_expected_to_hold_and_none_that_loses_walls() {
        let at_draft = now(Preset::Draft, 40.0, 1.0);
        assert_eq!(coarser(at_draft), Some(Advice { detail: 0.5, milliseconds: 10.0 }));
        assert_eq!(coarser(now(Preset::Draft, 40.0, 0.5)), None);
        // 2 ms at `fine`, of a work of 7.2, are 0.83 at `draft`, of 3.
        let found = finer(now(Preset::Fine, 2.0, 1.0), 7.0).expect("there is time");
        assert!((found.milliseconds - 8.0 * 2.0 * 3.0 / 7.2).abs() < 1e-4 && found.detail == 2.0, "{found:?}");
        assert_eq!(finer(now(Preset::Fine, 2.2, 1.0), 7.0), None);
        assert_eq!(finer(now(Preset::Fine, 0.1, 8.0), 7.0), None, "there is no such detail");
    }

    #[test]
    fn what_is_advised_is_not_taken_back_by_the_next_advice() {
        // From the finer detail, at what was expected or half of it, the coarser is not advised unless that can't be
        // held; from the coarser one the finer only where it would take less than what could not be held.
        for milliseconds in [9.0, 20.0, 80.0] {
            let Some(there) = coarser(now(Preset::Draft, milliseconds, 1.0)) else {
                panic!("none from {milliseconds}")
            };
            let back = finer(now(Preset::Draft, there.milliseconds, there.detail), 0.7 * 8.0);
            assert_eq!(back, None, "8 ms could not be held at {milliseconds}");
        }
    }
}
