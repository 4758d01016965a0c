//! The cases, one concept a room. Each says its setup, its answer and why its tolerances are what they are; those texts
//! stand in docs/exam.md.

pub(super) mod dam;
pub(super) mod drag;
pub(super) mod falling;
pub(super) mod orifice;
pub(super) mod pulse;
pub(super) mod rest;
pub(super) mod shear;
pub(super) mod sloshing;
pub(super) mod turning;
pub(super) mod vessels;
pub(super) mod vortex;

/// Acceleration of gravity of the scenes, m/s².
const GRAVITY: f64 = 9.81;
