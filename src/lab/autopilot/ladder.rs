//! The qualities that the autopilot chooses from, cheapest first: the steps of the dial that keep the detail, and what
//! lies between two of them.

use crate::{
    kernel::params::{Preset, Quality},
    lab::dial::{STEPS, work},
};
use bevy::math::ops;

/// Substeps of the highest level, which is otherwise as the finest preset: what holds an error that no preset does.
/// More of them cost more and err as much (see [`ERROR_EXPONENT`]).
const MOST_SUBSTEPS: u32 = 4;
/// Work from one level to the next grows at least by this factor.
const LEAST_STEP: f32 = 1.25;
/// How fast the density error falls with the work. Mean error of seconds 1 to 15 at the works of the levels, 3, 3.3,
/// 3.6, 7.2, 10.8 and 14.4 (commit 77a35a9, the same on every machine), %:
///
/// - `dam_break`: 0.74, 0.61, 0.60, 0.47, 0.42, 0.41;
/// - `waterfall`: 0.80, 0.68, 0.65, 0.42, 0.39, 0.38.
///
/// Least squares: error ∝ work^−0.34 and ^−0.48. Between neighbours and over two levels this guess errs by at most a
/// fifth on the way up.
const ERROR_EXPONENT: f32 = -0.4;

/// One quality.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Level {
    /// The preset that it is, or the one below.
    pub preset: Preset,
    /// Its numbers.
    pub quality: Quality,
    /// Work of a tick in units of an iteration: about in proportion to its time.
    pub work: f32,
}

impl Level {
    /// Density error in units of that of a work of 1: a first guess.
    pub fn error(&self) -> f32 {
        ops::powf(self.work, ERROR_EXPONENT)
    }
}

/// All levels, the cheapest first; each costs more than the one before.
pub fn ladder() -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let presets =
        || STEPS.iter().filter(|step| step.own_detail() == 1.0).map(|step| (step.preset, step.preset.quality()));
    let top = presets().next_back().map(|(preset, quality)| (preset, Quality { substeps: MOST_SUBSTEPS, ..quality }));
    for (preset, quality) in presets().chain(top) {
        let mut work = work(&quality);
        if let Some(&below) = levels.last() {
            between(below, work, &mut levels);
            // A preset that spends its time elsewhere (finer air, a stricter solve) costs more than its iterations say.
            work = work.max(levels.last().map_or(0.0, |level| level.work) * 1.1);
        }
        levels.push(Level { preset, quality, work });
    }
    levels
}

/// Adds what lies between a preset and one of the work `above`: more substeps or iterations of the lower.
fn between(below: Level, above: f32, levels: &mut Vec<Level>) {
    let mut choices: Vec<Quality> = Vec::new();
    for substeps in below.quality.substeps..=16 {
        // Where each goes over all of the liquid, fewer will do.
        let own = Quality { substeps, ..below.quality };
        let fewest = if own.iterate_above().is_some() { own.iterations } else { own.iterations.min(2) };
        for iterations in fewest..=own.iterations + 2 {
            choices.push(Quality { iterations, ..own });
        }
    }
    // Of two with the same work the one with more substeps has the smaller error.
    choices.sort_by(|a, b| work(a).total_cmp(&work(b)).then(b.substeps.cmp(&a.substeps)));
    let mut last = below.work;
    for quality in choices {
        let work = work(&quality);
        if work >= last * LEAST_STEP && work * LEAST_STEP <= above {
            levels.push(Level { preset: below.preset, quality, work });
            last = work;
        }
    }
}

/// The level whose work is nearest to a quality's.
pub fn nearest(levels: &[Level], quality: &Quality) -> usize {
    if let Some(same) = levels.iter().position(|level| level.quality == *quality) {
        return same;
    }
    let wanted = work(quality);
    let distance = |level: &Level| if level.work > wanted { level.work / wanted } else { wanted / level.work };
    let nearest = levels.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
    nearest.map_or(0, |(index, _)| index)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ladder_rises_and_holds_every_preset_but_classic() {
        let levels = ladder();
        assert!(levels.windows(2).all(|pair| pair[1].work > pair[0].work), "{levels:?}");
        assert!(levels.windows(2).all(|pair| pair[1].error() < pair[0].error()));
        for preset in Preset::ALL {
            let found = levels.iter().any(|level| level.preset == preset && level.quality == preset.quality());
            let keeps_detail = preset != Preset::Classic && preset.detail() == 1.0;
            assert_eq!(found, keeps_detail, "{}", preset.name());
        }
        let steepest = levels.windows(2).map(|pair| pair[1].work / pair[0].work).fold(0.0, f32::max);
        // Between one substep and two there is nothing worth its time: a second substep of one iteration takes 1.7 times
        // the work of `balanced` for 0.93 times its error, and 1.2 times that take 0.75 times that.
        assert!(steepest <= 2.0, "a step of {steepest} is too high to settle near a bound");
    }

    #[test]
    fn every_level_is_a_sound_quality() {
        for level in ladder() {
            crate::sim::checkpoint::check::quality(&level.quality).unwrap();
        }
    }

    #[test]
    fn a_quality_finds_its_own_level_or_the_nearest() {
        let levels = ladder();
        for (k, level) in levels.iter().enumerate() {
            assert_eq!(nearest(&levels, &level.quality), k);
        }
        let absurd = Quality { substeps: 64, iterations: 64, ..Preset::Fine.quality() };
        assert_eq!(nearest(&levels, &absurd), levels.len() - 1);
    }
}
