//! What viscosity goes over.

use crate::element::ElementId;

/// Lowest density that a volume is taken from: a lone droplet's own kernel gives about a seventh.
pub(super) const LEAST_DENSITY: f32 = 0.1;

/// What a pass goes over: an entry a particle, in the order of the groups.
#[derive(Clone, Copy)]
pub(super) struct Matter<'a> {
    pub element: &'a [ElementId],
    pub x: &'a [f32],
    pub y: &'a [f32],
    pub vx: &'a [f32],
    pub vy: &'a [f32],
    pub density: &'a [f32],
    /// Volumes m/ρ; not read where anything sticks to walls, where a volume belongs to a pair.
    pub volumes: &'a [f32],
    /// Masses as shares of the heaviest; empty where all are alike.
    pub masses: &'a [f32],
    /// Scaled coefficients of the particles, and four times that times mass; not read where masses are alike.
    pub shares: &'a [f32],
    pub loads: &'a [f32],
}

/// `scale · coefficient` of each particle's element, in lanes; a coefficient counts for `most` at most.
#[inline(always)]
pub(in crate::velocity) fn share_of(coefficients: &[f32], most: f32, elements: &[ElementId], scale: f32) -> [f32; 16] {
    let mut lanes = [0.0; 16];
    for (lane, element) in lanes.iter_mut().zip(elements) {
        let coefficient = coefficients[element.index()];
        *lane = if coefficient < most { coefficient } else { most } * scale;
    }
    lanes
}
