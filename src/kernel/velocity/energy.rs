//! The energy of the particles, which vorticity confinement must not raise.

use crate::{element::ElementParams, particles::Particles};
use glam::Vec2;

/// Particles whose sums are made side by side.
const LANES: usize = 8;

/// Kinetic and potential energy of the particles over the origin, in masses of the elements (kg/m²) times d²/s². The sum
/// is the same for any number of threads. `weights`: what the elements feel of gravity, as a share, if not all feel all.
pub fn energy(particles: &Particles, elements: &ElementParams, gravity: Vec2, weights: Option<&[f32]>) -> f64 {
    let Particles { x, y, vx, vy, element, .. } = particles;
    let gravity = gravity.as_dvec2();
    let [energy] = sum(x.len(), |i| {
        let (vx, vy) = (f64::from(vx[i]), f64::from(vy[i]));
        let height = -(gravity.x * f64::from(x[i]) + gravity.y * f64::from(y[i]));
        let height = weights.map_or(height, |weights| f64::from(weights[element[i].index()]) * height);
        [f64::from(elements.mass[element[i].index()]) * (0.5 * (vx * vx + vy * vy) + height)]
    });
    energy
}

/// Σ m v·Δv and Σ ½ m Δv² of a change of velocities from `before` to `after`: a share s of it adds the energy
/// `s Σ m v·Δv + s² Σ ½ m Δv²`.
pub(super) fn change(
    particles: &Particles,
    elements: &ElementParams,
    before: [&[f32]; 2],
    after: [&[f32]; 2],
) -> [f64; 2] {
    let mass = |i: usize| f64::from(elements.mass[particles.element[i].index()]);
    let along = |axis: usize, i: usize| {
        let from = f64::from(before[axis][i]);
        (from, f64::from(after[axis][i]) - from)
    };
    sum(before[0].len(), |i| {
        let ((vx, dx), (vy, dy)) = (along(0, i), along(1, i));
        [mass(i) * (vx * dx + vy * dy), 0.5 * mass(i) * (dx * dx + dy * dy)]
    })
}

/// Sums over `0 … count`, a few side by side.
fn sum<const K: usize>(count: usize, of: impl Fn(usize) -> [f64; K]) -> [f64; K] {
    let mut sums = [[0.0; K]; LANES];
    let whole = count - count % LANES;
    let add = |sum: &mut [f64; K], more: [f64; K]| sum.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
    for at in (0..whole).step_by(LANES) {
        sums.iter_mut().enumerate().for_each(|(lane, sum)| add(sum, of(at + lane)));
    }
    let mut all = [0.0; K];
    sums.into_iter().chain((whole..count).map(of)).for_each(|more| add(&mut all, more));
    all
}
