//! How the cases are simulated, by kinds. What each sets up, its answer and why its tolerances are what they are stands in
//! assets/exam/cases.ron.

mod air;
pub(super) mod dam;
mod falling;
pub(super) mod field;
mod grains;
mod heat;
pub(super) mod layers;
mod order;
pub(super) mod outflow;
pub(super) mod tank;
mod viscous;
mod weightless;

use crate::lab::exam::finding::Run;

/// What runs each case, by its name.
pub(super) fn runs() -> impl Iterator<Item = &'static (&'static str, Run)> {
    [
        air::RUNS,
        dam::RUNS,
        falling::RUNS,
        field::RUNS,
        grains::RUNS,
        heat::RUNS,
        layers::RUNS,
        order::RUNS,
        outflow::RUNS,
        tank::RUNS,
        viscous::RUNS,
        weightless::RUNS,
    ]
    .into_iter()
    .flatten()
}
