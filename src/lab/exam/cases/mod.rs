//! How each case is simulated, one concept a file. What it sets up, its answer and why its tolerances are what they are stands
//! in assets/exam/cases.ron.

mod dam;
mod drag;
mod falling;
mod orifice;
mod pulse;
mod rest;
mod shear;
mod sloshing;
mod turning;
mod vessels;
mod vortex;

use crate::lab::exam::{case::Findings, set_up::SetUp};
use std::pin::Pin;

/// A case at work.
type Run = Pin<Box<dyn Future<Output = Findings> + Send>>;

/// What runs the cases, by their names.
pub(super) const RUNS: [(&str, fn(SetUp) -> Run); 14] = [
    ("free_fall", |set_up| Box::pin(falling::free_fall(set_up))),
    ("falling_drop", |set_up| Box::pin(falling::falling_drop(set_up))),
    ("wind", |set_up| Box::pin(drag::wind(set_up))),
    ("terminal_speed", |set_up| Box::pin(drag::terminal_speed(set_up))),
    ("hydrostatic", |set_up| Box::pin(rest::hydrostatic(set_up))),
    ("vessels", |set_up| Box::pin(vessels::vessels(set_up))),
    ("dam_break", |set_up| Box::pin(dam::dam_break(set_up))),
    ("sloshing", |set_up| Box::pin(sloshing::sloshing(set_up))),
    ("orifice", |set_up| Box::pin(orifice::orifice(set_up))),
    ("rotating_drop", |set_up| Box::pin(turning::rotating_drop(set_up))),
    ("collision", |set_up| Box::pin(turning::collision(set_up))),
    ("shear_layer", |set_up| Box::pin(shear::shear_layer(set_up))),
    ("vortex", |set_up| Box::pin(vortex::vortex(set_up))),
    ("pulse", |set_up| Box::pin(pulse::pulse(set_up))),
];
