//! What the moves of a substep imply for velocities.

use crate::{
    element::{ElementId, Traits},
    forces::held,
    parallel::{WORTH_A_PIECE, spread},
    particles::Particles,
    pbf::{CorrectionLimit, Solver},
    predictor::Flow,
    simd::{Lanes, Pass},
    solids::Solids,
    units::TICK_SECONDS,
    velocity::follow::{BLOCK, PRESSED, follow},
};
use glam::Vec2;
use std::{
    iter::repeat_n,
    sync::atomic::{AtomicU64, Ordering},
};

/// What the limiters of the solve did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MoveReport {
    /// Particles whose correction was cut to the correction limit.
    pub position_clamps: u64,
}

/// Correction of a tick below which a grain stays where it is, d. Without it a bed drifts by what corrections are off.
const STILL: f32 = 0.003;

/// Share of its limit from which on a correction counts as cut: less the rounding of (anchor + limit) − anchor.
const CUT: f32 = 0.999;

/// Moves the particles to their corrected positions, stopped by rock, and sets `v = (x* − x)/Δt` (Macklin & Müller 2013,
/// algorithm 1, line 21), as the predicted velocity and the correction's: `v + (x* − (x + v Δt))/Δt`. In f32 that is not the
/// same: a free particle keeps its velocity to the last bit, where the difference of two large positions would round it
/// to whole ulps of the position over Δt (at 2,048 d and 16 substeps a tick that swallows gravity).
///
/// Where the pressure predictor ran (`flow`), velocities are its business, and a correction only ends what motion it missed:
/// where liquid is pressed together ([`PRESSED`]), a particle loses what runs against its correction of its motion beside
/// the flow around it, as matter does that meets and does not bounce. So a correction brings no particle beyond the flow:
/// however deep particles lie inside one another, they are set apart, and not shot apart, and the finer the substeps the
/// less. In a crowd ([`CROWDED`](super::follow::CROWDED)) all motion against the correction ends, not only that beside the flow: what lies inside
/// others moves with them, and a crowd that the floor holds up would keep the speed of a fall that has ended.
///
/// In a cell beside a wall that has no pressure ([`Flow::held_by_wall`]) only corrections hold matter up, and gravity would
/// make it faster and faster meanwhile. So at any density a correction there ends motion as far as it points away from the
/// wall, that of a film above all; between walls, and of a few drops in a crevice, which are their own flow, it ends all
/// that runs against it.
///
/// Grains stay where a correction is next to none ([`STILL`]).
///
/// Then the second half of the kick that [`begin_kick`](crate::forces::begin_kick) began: gravity (d/s²) and what
/// pressure and contact add. Where corrections hold a particle up they hold it against the kick, too ([`held`]).
pub fn update_velocities(
    particles: &mut Particles,
    solver: &mut Solver,
    solids: &Solids,
    gravity: Vec2,
    flow: Option<Flow>,
    traits: Traits,
    threads: usize,
    dt: f32,
) -> MoveReport {
    let Solver { instructions, x: to_x, y: to_y, density, limit, aim, substeps, .. } = solver;
    let pressed = PRESSED.map(|share| 1.0 + share / *substeps as f32);
    let clamps = AtomicU64::new(0);
    let Particles { x, y, vx, vy, push_x, push_y, element, .. } = particles;
    let arrays = [&mut vx[..], vy, push_x, push_y, to_x, to_y];
    spread(arrays, WORTH_A_PIECE, threads, &|base, [vx, vy, push_x, push_y, to_x, to_y]| {
        let anchor = [&*x, &*y].map(|anchor| &anchor[base..base + vx.len()]);
        let elements = &element[base..base + vx.len()];
        if let Some(sines) = traits.sines {
            leave_at_rest(sines, elements, anchor, [to_x, to_y], STILL * dt / TICK_SECONDS);
        }
        instructions.run(Move {
            rock: (solids.count() > 0).then_some(solids),
            limit: limit.map(|limit| (limit, &density[base..base + vx.len()])),
            flow,
            aim: *aim,
            pressed,
            half: 0.5 * dt * gravity,
            weights: traits.weights.map(|weights| (weights, elements)),
            dt,
            anchor,
            corrected: [to_x, to_y],
            velocity: [vx, vy],
            push: [push_x, push_y],
            clamps: &clamps,
        });
    });
    std::mem::swap(x, to_x);
    std::mem::swap(y, to_y);
    MoveReport { position_clamps: clamps.into_inner() }
}

/// Takes back the corrections of grains that are next to none: shorter than `still` (d).
fn leave_at_rest(
    sines: &[f32],
    elements: &[ElementId],
    [x, y]: [&[f32]; 2],
    [to_x, to_y]: [&mut [f32]; 2],
    still: f32,
) {
    for (k, _) in elements.iter().enumerate().filter(|(_, element)| sines[element.index()] > 0.0) {
        let (way_x, way_y) = (to_x[k] - x[k], to_y[k] - y[k]);
        if way_x * way_x + way_y * way_y < still * still {
            (to_x[k], to_y[k]) = (x[k], y[k]);
        }
    }
}

/// Moves a piece of the particles.
struct Move<'a> {
    /// Rock, if there is any.
    rock: Option<&'a Solids>,
    /// Limit of the corrections and the densities that it goes by, if there were any.
    limit: Option<(CorrectionLimit, &'a [f32])>,
    /// What the liquid does around a particle, if the predictor ran.
    flow: Option<Flow<'a>>,
    /// Density aimed at, 1 on the lattice.
    aim: f32,
    /// Multiples of it from which on liquid counts as pressed together, and in full.
    pressed: [f32; 2],
    /// What gravity adds in the second half of the substep, d/s.
    half: Vec2,
    /// What the elements feel of that and the elements, if not all feel all.
    weights: Option<(&'a [f32], &'a [ElementId])>,
    dt: f32,
    /// Predicted positions, d.
    anchor: [&'a [f32]; 2],
    /// In and out: corrected positions, d; stopped by rock.
    corrected: [&'a mut [f32]; 2],
    /// In and out: velocities, d/s.
    velocity: [&'a mut [f32]; 2],
    /// In and out: what is added besides gravity, d/s.
    push: [&'a mut [f32]; 2],
    /// Counts the corrections that were cut.
    clamps: &'a AtomicU64,
}

impl Pass for Move<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { rock, limit, flow, aim, pressed, half, weights, dt, anchor: [from_x, from_y], clamps, .. } = self;
        let ([to_x, to_y], [vx, vy], [push_x, push_y]) = (self.corrected, self.velocity, self.push);
        let per_dt = 1.0 / dt;
        if let Some((limit, density)) = limit {
            let mut cuts = 0_u32;
            for k in 0..from_x.len() {
                let cut = limit.at(density[k]) * CUT;
                let (far_x, far_y) = ((to_x[k] - from_x[k]).abs() >= cut, (to_y[k] - from_y[k]).abs() >= cut);
                cuts += u32::from(far_x | far_y);
            }
            clamps.fetch_add(u64::from(cuts), Ordering::Relaxed);
        }
        if let Some(rock) = rock {
            rock.sweep_all([from_x, from_y], [to_x, to_y]);
        }
        let (mut change_x, mut change_y) = ([0.0; BLOCK], [0.0; BLOCK]);
        for first in (0..from_x.len()).step_by(BLOCK) {
            let own = first..from_x.len().min(first + BLOCK);
            let count = own.len();
            let (change_x, change_y) = (&mut change_x[..count], &mut change_y[..count]);
            let (vx, vy) = (&mut vx[own.clone()], &mut vy[own.clone()]);
            for (change, to, from) in [(&mut *change_x, &*to_x, from_x), (&mut *change_y, &*to_y, from_y)] {
                let ways = to[own.clone()].iter().zip(&from[own.clone()]);
                change.iter_mut().zip(ways).for_each(|(change, (to, from))| *change = (to - from) * per_dt);
            }
            if let Some(flow) = flow {
                let density = limit.map_or(&[][..], |(_, density)| &density[own.clone()]);
                let at = [&from_x[own.clone()], &from_y[own.clone()]];
                follow(flow, (aim, pressed), density, at, [vx, vy], [change_x, change_y]);
            }
            let (push_x, push_y) = (&mut push_x[own.clone()], &mut push_y[own.clone()]);
            match weights {
                Some((weights, elements)) => {
                    let weights = elements[own].iter().map(|element| weights[element.index()]);
                    let halves = weights.map(|weight| [weight * half.x, weight * half.y]);
                    end_kick(halves, [change_x, change_y], [vx, vy], [push_x, push_y]);
                }
                None => {
                    end_kick(repeat_n([half.x, half.y], count), [change_x, change_y], [vx, vy], [push_x, push_y]);
                }
            }
        }
    }
}

/// Adds changes, half of gravity and pushes to velocities (all d/s), as far as the changes do not hold them. Leaves of the
/// pushes what was added.
#[inline(always)]
fn end_kick(
    halves: impl Iterator<Item = [f32; 2]>,
    [change_x, change_y]: [&[f32]; 2],
    [vx, vy]: [&mut [f32]; 2],
    [push_x, push_y]: [&mut [f32]; 2],
) {
    for (k, half) in (0..vx.len()).zip(halves) {
        let kick = held(Vec2::new(half[0] + push_x[k], half[1] + push_y[k]), Vec2::new(change_x[k], change_y[k]));
        (vx[k], vy[k]) = (vx[k] + change_x[k] + kick.x, vy[k] + change_y[k] + kick.y);
        (push_x[k], push_y[k]) = (kick.x - half[0], kick.y - half[1]);
    }
}
