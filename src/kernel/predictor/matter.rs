//! Matter of different densities on the grid. All are shares of the heaviest.
//!
//! A face has the density ρ of what is on it, and the pressure changes its velocity by −∇p/ρ. A body of density m that is
//! alone in the liquid gains more than the liquid does, or less: `1 + (ρ − m)/(ρ + m)` times as much, which is buoyancy with
//! the added mass of a cylinder, that of the liquid which it displaces (Batchelor 1967, "An introduction to fluid dynamics",
//! §6.4).
//!
//! **Layers.** A face knows means over two cells: next to a surface between two liquids each particle differs from what is
//! around it, and is where it belongs all the same. What the slope of the density makes up for is the grid's smoothing, and no
//! buoyancy ([`LAYERED`]): at a surface that the grid sees all of the difference, in a suspension nothing. Whether such a
//! surface is stable, and what moves along it, is the pressure's business.
//!
//! **Drops.** Liquids that do not mix run together in drops, which grow until the grid moves them. Those that it does not see
//! yet rise as fast as the smallest that it does ([`GROWN`]).
//!
//! **Momentum.** What some gain beside the liquid, the others lose: the faces' mean of it is taken off again.

use crate::{
    element::ElementId,
    parallel::{Rows, Sweep, Team, WORTH_A_PIECE, spread, sweep},
    predictor::{
        grid::MacGrid,
        level,
        share_out::{LEAST_WEIGHT, Pair, ShareOut},
        stencil::{Axis, LANES, Stencils},
    },
    simd::{Lanes, Pass, padded},
};
use glam::Vec2;
use std::ops::Range;

/// What is on the faces, where particles differ in their masses. The buffers are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Matter {
    /// At left and lower faces: density and its inverse; 0 where no particle is near. Before [`Matter::weigh`] mass and
    /// momentum of the particles.
    faces: [Vec<[f32; 2]>; 2],
    /// At left and lower faces: mass of the particles, and what share of it gains beside the liquid.
    beside: [Vec<[f32; 2]>; 2],
    /// Density of each particle.
    masses: Vec<f32>,
    /// What each particle gains beside the liquid, as a share of what the liquid gains.
    gains: Vec<f32>,
}

impl Matter {
    /// Density and its inverse on the faces of an axis.
    pub fn of(&self, axis: Axis) -> &[[f32; 2]] {
        &self.faces[axis as usize]
    }

    /// What the particles gain beside the liquid, each and on the mean of the faces' mass.
    pub fn beside(&self) -> Beside<'_> {
        Beside { gains: &self.gains, faces: self.beside.each_ref().map(|faces| &faces[..]) }
    }

    /// Shares out the particles' masses and momenta on the faces. `of`: masses of the elements.
    pub fn collect(
        &mut self,
        share: &ShareOut,
        at: [&[f32]; 2],
        velocities: [&[f32]; 2],
        elements: &[ElementId],
        of: &[f32],
    ) {
        let Self { faces, masses, .. } = self;
        masses.clear();
        masses.extend(elements.iter().map(|element| of[element.index()]));
        share.run(at, Some(masses), velocities, faces.each_mut());
    }

    /// Turns masses into densities, of faces `u` and `v` that have the particles' numbers, and their velocities into the mass's.
    pub fn weigh(
        &mut self,
        grid: &MacGrid,
        [u, v]: [&mut [[f32; 2]]; 2],
        reached: &Range<usize>,
        columns: Range<usize>,
        team: Team,
    ) {
        let rows = |field| Rows::new(field, grid.stride, reached);
        let [own_u, own_v] = &mut self.faces;
        let (work, len) = (Weigh { columns: columns.clone() }, columns.len());
        sweep(
            &work,
            reached.clone(),
            ((rows(u), rows(v)), (rows(own_u), rows(own_v))),
            len,
            level::WORTH_A_PIECE,
            team,
        );
    }

    /// Finds what each particle gains beside the liquid.
    pub fn find_beside(&mut self, share: &ShareOut, at: [&[f32]; 2]) {
        let Self { faces, beside, masses, gains } = self;
        gains.resize(masses.len(), 0.0);
        let (grid, team) = (share.grid, share.team);
        let densities = faces.each_ref().map(|faces| &faces[..]);
        spread([&mut gains[..]], WORTH_A_PIECE, team.threads, &|first, [gains]| {
            let own = first..first + gains.len();
            let (at, masses) = (at.map(|at| &at[own.clone()]), &masses[own]);
            team.instructions.run(FindBeside { grid, densities, at, masses, gains });
        });
        share.run(at, Some(masses), [gains, gains], beside.each_mut());
        // Here, and not where each particle looks at eight of them.
        share.find_means(beside.each_mut().map(|faces| &mut faces[..]));
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { faces, beside, masses, gains } = self;
        let fields: usize = faces.iter().chain(beside).map(Vec::capacity).sum();
        8 * fields + 4 * (masses.capacity() + gains.capacity())
    }
}

/// What matter would gain beside the liquid, wherever it is.
#[derive(Clone, Copy)]
pub struct Buoyancy<'a> {
    grid: &'a MacGrid,
    matter: &'a Matter,
    reached: &'a Range<usize>,
    area: &'a Range<usize>,
}

/// Rate at which matter loses its motion beside the liquid, 1/s: particles among others, at `balanced` (see [`GROWN`]).
const RESISTANCE: f32 = 1.9;

impl<'a> Buoyancy<'a> {
    pub(super) fn new(grid: &'a MacGrid, matter: &'a Matter, [reached, area]: [&'a Range<usize>; 2]) -> Self {
        Self { grid, matter, reached, area }
    }

    /// Speed at which a particle of that density is about to rise or sink at a place (d) under `gravity` (d/s²), d/s. Where heavy
    /// matter lies above light, the surface between them is about to.
    pub fn speed(&self, at: Vec2, mass: f32, gravity: Vec2) -> f32 {
        let Self { grid, matter, reached, area } = *self;
        let columns = grid.padded(area);
        let around = |axis: Axis| {
            let ((column, right), (row, upper)) = (axis.column(grid, at.x), axis.row(grid, at.y));
            let (column, row) = (column as usize, row as usize);
            // Beyond what particles reached lies what is left from before.
            let is_reached = columns.contains(&column) && column + 1 < columns.end;
            let is_known = is_reached && reached.contains(&row) && row + 1 < reached.end;
            is_known.then(|| Around::new(matter.of(axis), grid.stride, grid.row(row) + column, [right, upper]))
        };
        let strength = gravity.length();
        let down = gravity / strength.max(f32::MIN_POSITIVE);
        let stable = |slope: [f32; 2]| Vec2::from(slope).dot(down).max(0.0);
        let gains = around(Axis::U).zip(around(Axis::V)).map_or(0.0, |(u, v)| beside(mass, &u, &v, stable));
        gains.abs() * strength / RESISTANCE
    }
}

/// What particles gain beside the liquid.
#[derive(Clone, Copy)]
pub(super) struct Beside<'a> {
    gains: &'a [f32],
    faces: [&'a [[f32; 2]]; 2],
}

impl<'a> Beside<'a> {
    /// That of the particles from `first` on.
    pub fn from(self, first: usize) -> Self {
        Self { gains: &self.gains[first..], ..self }
    }

    /// By how many times what the liquid gains particle `i` gains more, at a stencil of an axis.
    #[inline(always)]
    pub fn more(&self, i: usize, axis: Axis, stride: usize, corner: usize, [right, upper]: [f32; 2]) -> f32 {
        let faces = self.faces[axis as usize];
        let row = |at: usize| (1.0 - right) * faces[at][1] + right * faces[at + 1][1];
        self.gains[i] - ((1.0 - upper) * row(corner) + upper * row(corner + stride))
    }
}

/// Cells over which a slope of the density makes up for the difference of a particle to its surroundings. Shared out to the faces
/// and taken back, both with bilinear weights, a step is a cubic spline over four cells: in its middle half of the step is
/// missing and the slope is ⅔ of it a cell, and towards its ends less is missing for the same slope.
const LAYERED: f32 = 0.75;

/// How many times its own buoyancy a particle has: as that of drops of two cells, 5 d, the smallest that faces tell from what is
/// around them. A cylinder of diameter D rises at `√(π/2 · g D |ρ − m|/ρ)` if its drag coefficient is 1, as it is about there
/// (Batchelor, §4.12). Among particles drag goes with the speed: oil alone in water rises at 3.1 d/s by its own buoyancy (3.9 in
/// that law for D = d), at 8.3 by three times that (8.8 for D = 5 d).
const GROWN: f32 = 3.0;

struct Weigh {
    columns: Range<usize>,
}

impl<'a> Sweep<(Pair<'a>, Pair<'a>)> for Weigh {
    #[inline(always)]
    fn run(&self, _: Range<usize>, ((mut u, mut v), (mut own_u, mut own_v)): (Pair<'a>, Pair<'a>)) {
        let faces = u.each().chain(v.each());
        for (row, own) in faces.zip(own_u.each().chain(own_v.each())) {
            for (face, own) in row[self.columns.clone()].iter_mut().zip(&mut own[self.columns.clone()]) {
                let ([count, velocity], [mass, momentum]) = (face, *own);
                let is_there = *count > LEAST_WEIGHT && mass > LEAST_WEIGHT;
                *velocity = if is_there { momentum / mass } else { 0.0 };
                *own = if is_there { [mass / *count, *count / mass] } else { [0.0; 2] };
            }
        }
    }
}

struct FindBeside<'a> {
    grid: &'a MacGrid,
    /// Density and its inverse at left and at lower faces.
    densities: [&'a [[f32; 2]]; 2],
    at: [&'a [f32]; 2],
    masses: &'a [f32],
    /// Out: what each gains beside the liquid.
    gains: &'a mut [f32],
}

impl Pass for FindBeside<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self) {
        let Self { grid, densities, at: [x, y], masses, gains } = self;
        for first in (0..x.len()).step_by(LANES) {
            let [x, y]: [[f32; LANES]; 2] = [&x[first..], &y[first..]].map(padded);
            let [u, v] = [Axis::U, Axis::V].map(|axis| Stencils::new(grid, &x, &y, axis));
            let own = first..gains.len().min(first + LANES);
            for (lane, (gain, mass)) in gains[own.clone()].iter_mut().zip(&masses[own]).enumerate() {
                let [by_u, by_v] = [(&u, Axis::U), (&v, Axis::V)].map(|(stencils, axis)| {
                    let share = [stencils.right[lane], stencils.upper[lane]];
                    let corner = stencils.corner[lane] as usize;
                    Around::new(densities[axis as usize], grid.stride, corner, share)
                });
                *gain = beside(*mass, &by_u, &by_v, |[x, y]| (x * x + y * y).sqrt());
            }
        }
    }
}

/// What the faces around a place know.
struct Around {
    /// Share of the faces that know a density, and their mean of it.
    known: f32,
    density: f32,
    /// Difference of the density over a cell along x and along y, as far as it is known.
    slope: [f32; 2],
}

impl Around {
    #[inline(always)]
    fn new(densities: &[[f32; 2]], stride: usize, corner: usize, [right, upper]: [f32; 2]) -> Self {
        let ([left, lower], faces) =
            ([1.0 - right, 1.0 - upper], [corner, corner + 1, corner + stride, corner + stride + 1]);
        let shares = [left * lower, right * lower, left * upper, right * upper];
        let density = faces.map(|face| densities[face][0]);
        let (mut known, mut sum) = (0.0, 0.0);
        for k in 0..4 {
            known += if density[k] > 0.0 { shares[k] } else { 0.0 };
            sum += shares[k] * density[k];
        }
        let between = |from: usize, to: usize| {
            let is_known = density[from] > 0.0 && density[to] > 0.0;
            if is_known { density[to] - density[from] } else { 0.0 }
        };
        let slope = [lower * between(0, 1) + upper * between(2, 3), left * between(0, 2) + right * between(1, 3)];
        Self { known, density: sum, slope }
    }
}

/// What a particle of density `mass` gains beside the liquid, as a share of what that gains: −1 … 1, at most that which a body
/// without mass has, or one that nothing holds. `seen`: how much of the slope, density a cell, makes up for differences.
#[inline(always)]
fn beside(mass: f32, u: &Around, v: &Around, seen: impl Fn([f32; 2]) -> f32) -> f32 {
    let known = u.known + v.known;
    if known <= 0.0 {
        return 0.0;
    }
    let density = (u.density + v.density) / known;
    let layered = LAYERED * seen([0, 1].map(|axis| 0.5 * (u.slope[axis] + v.slope[axis])));
    let differs = mass - density;
    let differs = match differs {
        _ if differs > layered => differs - layered,
        _ if differs < -layered => differs + layered,
        _ => 0.0,
    };
    let gains = -GROWN * differs / (2.0 * density + differs);
    let gains = if gains > -1.0 { gains } else { -1.0 };
    if gains < 1.0 { gains } else { 1.0 }
}
