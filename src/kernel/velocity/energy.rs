//! The energy of the particles, which vorticity confinement must not raise.

use crate::{
    element::{ElementId, ElementParams},
    particles::Particles,
    simd::{InstructionSet, Lanes, Pass},
};
use glam::Vec2;

/// Particles whose sums are made side by side.
const LANES: usize = 8;

/// Kinetic and potential energy of the particles over the origin, in masses of the elements (kg/m²) times d²/s². The sum
/// is the same for any instruction set. `weights`: what the elements feel of gravity, as a share, if not all feel all.
pub fn energy(
    particles: &Particles,
    elements: &ElementParams,
    gravity: Vec2,
    weights: Option<&[f32]>,
    instructions: InstructionSet,
) -> f64 {
    let Particles { x, y, vx, vy, element, .. } = particles;
    let gravity = gravity.as_dvec2();
    let of = |[x, y, vx, vy]: [f64; 4], mass: f64, weight: f64| {
        [mass * (0.5 * (vx * vx + vy * vy) + weight * -(gravity.x * x + gravity.y * y))]
    };
    let mut sums = [0.0];
    instructions.run(Sum { columns: [x, y, vx, vy], element, elements, weights, of, sums: &mut sums });
    sums[0]
}

/// Σ m v·Δv and Σ ½ m Δv² of a change of velocities from `before` to `after`: a share s of it adds the energy
/// `s Σ m v·Δv + s² Σ ½ m Δv²`.
pub(super) fn change(
    particles: &Particles,
    elements: &ElementParams,
    before: [&[f32]; 2],
    after: [&[f32]; 2],
    instructions: InstructionSet,
) -> [f64; 2] {
    let of = |[vx, vy, after_x, after_y]: [f64; 4], mass: f64, _: f64| {
        let (dx, dy) = (after_x - vx, after_y - vy);
        [mass * (vx * dx + vy * dy), 0.5 * mass * (dx * dx + dy * dy)]
    };
    let (columns, element) = ([before[0], before[1], after[0], after[1]], &particles.element[..]);
    let mut sums = [0.0; 2];
    instructions.run(Sum { columns, element, elements, weights: None, of, sums: &mut sums });
    sums
}

/// Adds up what `of` makes of the values of each particle in four columns, its mass and its weight, a few side by side.
struct Sum<'a, const K: usize, F> {
    columns: [&'a [f32]; 4],
    element: &'a [ElementId],
    elements: &'a ElementParams,
    /// What the elements feel of gravity, as a share, if not all feel all.
    weights: Option<&'a [f32]>,
    of: F,
    /// Out.
    sums: &'a mut [f64; K],
}

impl<const K: usize, F: Fn([f64; 4], f64, f64) -> [f64; K]> Pass for Sum<'_, K, F> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { columns, element, elements, weights, of, sums } = self;
        let mut side_by_side = [[0.0; LANES]; K];
        let whole = element.len() - element.len() % LANES;
        for at in (0..whole).step_by(LANES) {
            let mut values = [[0.0; LANES]; 4];
            for (values, column) in values.iter_mut().zip(columns) {
                values.iter_mut().zip(&column[at..at + LANES]).for_each(|(value, number)| *value = f64::from(*number));
            }
            let own = &element[at..at + LANES];
            let (mut masses, mut shares) = ([0.0; LANES], [1.0; LANES]);
            for (mass, element) in masses.iter_mut().zip(own) {
                *mass = f64::from(elements.mass[element.index()]);
            }
            if let Some(weights) = weights {
                for (share, element) in shares.iter_mut().zip(own) {
                    *share = f64::from(weights[element.index()]);
                }
            }
            for lane in 0..LANES {
                let more = of(values.map(|values| values[lane]), masses[lane], shares[lane]);
                for (sum, more) in side_by_side.iter_mut().zip(more) {
                    sum[lane] += more;
                }
            }
        }
        for lane in 0..LANES {
            sums.iter_mut().zip(&side_by_side).for_each(|(sum, lanes)| *sum += lanes[lane]);
        }
        for i in whole..element.len() {
            let (mass, share) =
                (elements.mass[element[i].index()], weights.map_or(1.0, |weights| weights[element[i].index()]));
            let more = of(columns.map(|column| f64::from(column[i])), f64::from(mass), f64::from(share));
            sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
    }
}
