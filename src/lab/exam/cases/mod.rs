//! The cases, one concept a file. Each says its setup, its answer and why its tolerances are what they are; those texts
//! stand in docs/exam.md.

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

use crate::lab::exam::case::ExamCase;

/// All cases, in the order in which they are shown.
pub const CASES: &[ExamCase] = &[
    falling::FREE_FALL,
    falling::BLOB_FALL,
    drag::WIND,
    drag::TERMINAL_SPEED,
    rest::HYDROSTATIC,
    vessels::VESSELS,
    dam::DAM_BREAK,
    sloshing::SLOSHING,
    orifice::ORIFICE,
    turning::ROTATING_BLOB,
    turning::COLLISION,
    shear::SHEAR_LAYER,
    vortex::VORTEX,
    pulse::PULSE,
];
