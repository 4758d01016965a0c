//! The dial from smooth to exact: qualities and details in one order, each step dearer than the one before it and
//! truer. The autopilots' ladder stands on the same steps.

use crate::{
    kernel::params::{Preset, Quality},
    sim::state::Setup,
};
use bevy::math::ops;

/// Work of a substep's solver in units of an iteration, beside the iterations: prediction, sorting, the predictor.
const FIXED_WORK: f32 = 2.0;
/// Work of an iteration that goes only where it is still too dense: 0.13 to 0.25 in `dam_break` and `waterfall`.
const WORK_AGAIN: f32 = 0.2;
/// Work of a tick at detail 1 in units of an iteration over all particles.
pub fn work(quality: &Quality) -> f32 {
    let again = if quality.iterate_above().is_some() { WORK_AGAIN } else { 1.0 };
    quality.substeps as f32 * (FIXED_WORK + 1.0 + again * (quality.iterations as f32 - 1.0))
}

/// Whether two details are one, but for the rounding of a spacing.
pub fn is_same_detail(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-3
}

/// A preset at a detail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The preset.
    pub preset: Preset,
    /// The detail that is asked for, beside which the preset may have its own.
    pub detail: f64,
}

/// All steps, from the cheapest to the truest. Details are whole factors of each other, at which rock stays as it is on
/// the way up; at a quarter a wall of a single cell is lost.
pub const STEPS: [Step; 6] = [
    Step { preset: Preset::Draft, detail: 0.5 },
    Step { preset: Preset::Draft, detail: 1.0 },
    Step { preset: Preset::Fast, detail: 1.0 },
    Step { preset: Preset::Balanced, detail: 1.0 },
    Step { preset: Preset::Fine, detail: 1.0 },
    Step { preset: Preset::Reference, detail: 1.0 },
];

impl Step {
    /// What there is of each particle of the scene's own spacing.
    pub fn particles(self) -> f64 {
        self.own_detail().powi(2)
    }

    /// Detail of the run.
    pub fn own_detail(self) -> f64 {
        self.detail * self.preset.detail()
    }

    fn accuracy(self) -> Accuracy {
        Accuracy { quality: self.preset.quality(), detail: self.own_detail() }
    }
}

/// What a world's accuracy depends on, however it was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Its quality.
    pub quality: Quality,
    /// Its detail, with what the preset brings along.
    pub detail: f64,
}

impl Accuracy {
    /// Of a world.
    pub fn of(setup: &Setup) -> Self {
        Self { quality: setup.quality, detail: f64::from(setup.blueprint.scale.detail) }
    }

    /// The step that it is, if it is one.
    pub fn step(self) -> Option<usize> {
        STEPS.iter().position(|step| {
            let Self { quality, detail } = step.accuracy();
            quality == self.quality && is_same_detail(detail, self.detail)
        })
    }

    /// Where it stands on the dial: the number of its step; what is none stands by its work, between two of them or at
    /// an end.
    pub fn place(self) -> f32 {
        if let Some(step) = self.step() {
            return step as f32;
        }
        let own = self.work();
        let works = STEPS.map(|step| step.accuracy().work());
        let below = works.iter().rposition(|work| *work <= own);
        match below {
            None => 0.0,
            Some(last) if last + 1 == works.len() => last as f32,
            Some(below) => below as f32 + ops::ln(own / works[below]) / ops::ln(works[below + 1] / works[below]),
        }
    }

    /// Work of a tick, in units of an iteration over the particles that the scene has at detail 1. Where motion is
    /// fast, a finer detail takes more substeps, too.
    fn work(self) -> f32 {
        work(&self.quality) * (self.detail * self.detail) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_step_costs_more_than_the_one_before_and_is_no_coarser() {
        for pair in STEPS.windows(2) {
            assert!(pair[1].accuracy().work() > pair[0].accuracy().work(), "{pair:?}");
            assert!(pair[1].own_detail() >= pair[0].own_detail(), "{pair:?}");
        }
    }

    #[test]
    fn a_step_stands_at_its_own_place_and_the_same_numbers_by_another_name_too() {
        for (k, step) in STEPS.into_iter().enumerate() {
            assert_eq!((step.accuracy().step(), step.accuracy().place()), (Some(k), k as f32));
        }
        let by_hand = Step { preset: Preset::Fine, detail: 2.0 };
        assert_eq!(by_hand.accuracy().step(), Some(5), "it is the reference");
    }

    #[test]
    fn what_is_chosen_by_hand_stands_between_the_steps_or_at_an_end() {
        let place = |preset: Preset, detail: f64| {
            let found = Step { preset, detail }.accuracy();
            assert_eq!(found.step(), None);
            found.place()
        };
        let between = place(Preset::Draft, 2.0);
        assert!(between > 4.0 && between < 5.0, "draft with four times the particles costs more than fine: {between}");
        assert_eq!(place(Preset::Draft, 0.25), 0.0);
        assert_eq!(place(Preset::Reference, 2.0), 5.0);
        let three = Quality { iterations: 3, ..Preset::Fast.quality() };
        let between = Accuracy { quality: three, detail: 1.0 }.place();
        assert!(between > 2.0 && between < 3.0, "{between}");
    }
}
