//! What of the corrections ends motion where the pressure predictor ran ([`update_velocities`](super::update_velocities)).

use crate::{predictor::Flow, simd::MOST_LANES};
use glam::Vec2;
use std::array::from_fn;

/// How far liquid is too dense, as a share of the density aimed at, from which on it counts as pressed together where the
/// pressure predictor ran, and where it does so in full: shared by the substeps of a quality, as what iterating goes by is.
/// Below are the particles that find their places: at rest the sum over the neighbours differs by a hundredth or two from
/// one to the next, and to take that for motion would make a still pool simmer and brake what flows.
pub(super) const PRESSED: [f32; 2] = [0.02, 0.07];

/// Density, as a multiple of the one aimed at, from which on a particle is held by its crowd and not by the flow: as that
/// from which on corrections may be longer.
pub(super) const CROWDED: f32 = 1.5;

/// Particles that are looked through at a time.
pub(super) const BLOCK: usize = 64;

/// Particles that are worked on side by side.
const LANES: usize = MOST_LANES;

/// A number of each of them.
type Each = [f32; LANES];

/// Leaves of the changes of velocity (d/s) that corrections would be what ends the motion beside the flow. At most [`BLOCK`]
/// particles; few of them have anything to do with it, and those go side by side.
#[inline(always)]
pub(super) fn follow(
    flow: Flow,
    (aim, pressed): (f32, [f32; 2]),
    density: &[f32],
    [x, y]: [&[f32]; 2],
    [vx, vy]: [&[f32]; 2],
    [change_x, change_y]: [&mut [f32]; 2],
) {
    let [from, to] = pressed.map(|density| density * aim);
    let is_near_dry_wall = flow.has_dry_wall([range(x), range(y)]);
    let is_held = density.iter().fold(is_near_dry_wall, |any, density| any | (*density > from));
    if density.is_empty() || !is_held {
        change_x.fill(0.0);
        change_y.fill(0.0);
        return;
    }
    let (mut chosen, mut count) = ([0_u8; BLOCK], 0);
    for (k, density) in density.iter().enumerate() {
        chosen[count] = k as u8;
        let is_pressed = *density > from;
        count += usize::from(is_pressed || is_near_dry_wall && flow.is_beside_dry_wall(Vec2::new(x[k], y[k])));
    }
    let (mut left_x, mut left_y) = ([0.0; BLOCK], [0.0; BLOCK]);
    for chosen in chosen[..count].chunks(LANES) {
        // Lanes that are left over do what the last one does.
        let of = |numbers: &[f32]| from_fn(|lane| numbers[usize::from(chosen[lane.min(chosen.len() - 1)])]);
        let matter = Pressed { density: of(density), at: [of(x), of(y)], velocity: [of(vx), of(vy)] };
        let change = [of(change_x), of(change_y)];
        let ends = matter.ends(flow, (CROWDED * aim, [from, to]), is_near_dry_wall, change);
        for (lane, k) in chosen.iter().enumerate() {
            let k = usize::from(*k);
            (left_x[k], left_y[k]) = (change[0][lane] * ends[lane], change[1][lane] * ends[lane]);
        }
    }
    change_x.copy_from_slice(&left_x[..change_x.len()]);
    change_y.copy_from_slice(&left_y[..change_y.len()]);
}

/// Particles that corrections may hold.
struct Pressed {
    density: Each,
    /// Where they were predicted to be, d.
    at: [Each; 2],
    /// Predicted velocity, d/s.
    velocity: [Each; 2],
}

impl Pressed {
    /// Share of the changes (d/s) that ends motion. `from` and `to`: densities from which on liquid is pressed together, and in full.
    #[inline(always)]
    fn ends(
        &self,
        flow: Flow,
        (crowded, [from, to]): (f32, [f32; 2]),
        is_near_dry_wall: bool,
        change: [Each; 2],
    ) -> Each {
        let Self { density, at: [x, y], velocity: [vx, vy] } = self;
        let [change_x, change_y] = &change;
        let length: Each = from_fn(|i| (change_x[i] * change_x[i] + change_y[i] * change_y[i]).sqrt());
        // How much of the correction may end of the motion, and what runs against it.
        let held: Each = from_fn(|i| {
            if density[i] > crowded {
                1.0
            } else if is_near_dry_wall && length[i] > 0.0 {
                flow.held_by_wall(Vec2::new(x[i], y[i]), Vec2::new(change_x[i], change_y[i]))
            } else {
                0.0
            }
        });
        let [beside_x, beside_y] = flow.beside(&self.at, &self.velocity);
        let per_density = 1.0 / (to - from);
        from_fn(|i| {
            let along = |x: f32, y: f32| (x * change_x[i] + y * change_y[i]) / length[i];
            let least = |a: f32, b: f32| if a < b { a } else { b };
            let most = |a: f32, b: f32| if a > b { a } else { b };
            let own = least(held[i] * length[i], along(-vx[i], -vy[i]));
            let share = least((density[i] - from) * per_density, 1.0);
            let of_flow = most(own, least(share * length[i], along(beside_x[i], beside_y[i])));
            let ends = if held[i] < 1.0 && density[i] > from { of_flow } else { own };
            // One whose square is too small for a number ends nothing.
            if length[i] > 0.0 { most(ends, 0.0) / length[i] } else { 0.0 }
        })
    }
}

/// Least and most of up to [`BLOCK`] numbers.
#[inline(always)]
fn range(numbers: &[f32]) -> [f32; 2] {
    let Some(first) = numbers.first() else { return [0.0; 2] };
    let mut all = [*first; BLOCK];
    all[..numbers.len()].copy_from_slice(numbers);
    [folded(&all, |a, b| if b < a { b } else { a }), folded(&all, |a, b| if b > a { b } else { a })]
}

/// One of all numbers: in lanes first, which one number after the other would not be.
#[inline(always)]
fn folded(numbers: &[f32; BLOCK], one: impl Fn(f32, f32) -> f32) -> f32 {
    let mut lanes: Each = from_fn(|lane| numbers[lane]);
    for others in numbers[LANES..].as_chunks::<LANES>().0 {
        lanes = from_fn(|lane| one(lanes[lane], others[lane]));
    }
    let mut width = LANES / 2;
    while width > 0 {
        for lane in 0..width {
            lanes[lane] = one(lanes[lane], lanes[lane + width]);
        }
        width /= 2;
    }
    lanes[0]
}
