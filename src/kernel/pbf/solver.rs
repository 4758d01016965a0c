//! The solver: its buffers, and the order of its passes.

use crate::{
    bins::{self, Bins, Group, Neighbours, RockBins, Strip},
    parallel::Team,
    params::{Domain, GradientKernel, Quality},
    particles::Particles,
    pbf::{
        coincident::separate_coincident, constraint::ConstraintPass, correction::CorrectionPass, crowd,
        limit::CorrectionLimit, params::SolveParams,
    },
    simd::InstructionSet,
    smoothing::{Gradient, Rational, Smoothing, Spiky},
    solids::Solids,
    velocity::Thick,
};
use glam::Vec2;
use std::sync::atomic::AtomicU64;

/// Least mass in the constraint, as a share of the heaviest: that of oil in mercury. A Jacobi step sets a light particle among
/// heavy ones off by the share of their masses, so that with a larger one it takes as many more iterations. After the
/// predictor what is set apart gets no motion from it, and what it weighs is the predictor's business; without it, as at
/// `classic`, corrections between masses further apart keep no momentum.
const LEAST_INERTIA: f32 = 1.0 / 16.0;

/// Share of its limit up to which what lies between two positions is taken for a correction: more than rounding.
const MOST_SHARE: f32 = 1.01;

/// Positions under correction, densities, bins: what the solver keeps beside the particles. 24 bytes a particle, 32
/// where masses differ, and the bins. The arrays follow the order of the particles.
#[derive(Clone, Debug)]
pub struct Solver {
    /// Cells and groups of the last [`Solver::bin`].
    pub bins: Bins,
    /// The smoothing kernels in use.
    pub smoothing: Smoothing,
    /// Lanes in use.
    pub instructions: InstructionSet,
    /// How neighbours are found.
    pub neighbours: Neighbours,
    /// Density ρ in units of the lattice's, as of the last iteration.
    pub density: Vec<f32>,
    /// Corrected positions, d, as of the last iteration. The particles themselves stay where they were predicted to be:
    /// corrections keep within the correction limit of that.
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    /// Outputs of a pass; in between, others work in them ([`Solver::room`]).
    pub(crate) next_x: Vec<f32>,
    pub(crate) next_y: Vec<f32>,
    pub(crate) lambda: Vec<f32>,
    /// Masses as shares of the heaviest; empty where all are alike.
    pub(crate) masses: Vec<f32>,
    /// The same, [`LEAST_INERTIA`] at least: what holds particles against being set apart.
    inertias: Vec<f32>,
    /// What takes several passes of viscosity.
    pub(crate) thick: Thick,
    /// Limit of the last corrections; none before the first.
    pub(crate) limit: Option<CorrectionLimit>,
    /// Density that the last solve aimed at, 1 on the lattice.
    pub(crate) aim: f32,
    /// Substeps of a calm tick at the last solve's quality.
    pub(crate) substeps: u32,
}

/// What [`Solver::bin`] did besides sorting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BinReport {
    /// Particles that were at one point with another and set apart.
    pub set_apart: u64,
}

impl Default for Solver {
    fn default() -> Self {
        Self::new(InstructionSet::detect(), Neighbours::Binned)
    }
}

impl Solver {
    /// An empty solver.
    pub fn new(instructions: InstructionSet, neighbours: Neighbours) -> Self {
        Self {
            bins: Bins::default(),
            smoothing: Smoothing::new(2.5, GradientKernel::Rational),
            instructions,
            neighbours,
            density: Vec::new(),
            x: Vec::new(),
            y: Vec::new(),
            next_x: Vec::new(),
            next_y: Vec::new(),
            lambda: Vec::new(),
            masses: Vec::new(),
            inertias: Vec::new(),
            thick: Thick::default(),
            limit: None,
            aim: 1.0,
            substeps: 1,
        }
    }

    /// Buffers in which nothing is kept between its passes, for others to work in.
    pub fn room(&mut self) -> [&mut Vec<f32>; 3] {
        [&mut self.lambda, &mut self.next_x, &mut self.next_y]
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let Self { density, x, y, next_x, next_y, lambda, masses, inertias, thick, .. } = self;
        let floats = [density, x, y, next_x, next_y, lambda, masses, inertias];
        4 * floats.iter().map(|array| array.capacity()).sum::<usize>() + thick.memory() + self.bins.memory()
    }

    /// Sorts the particles by cell, sets those at one point apart, scatters crowds and builds the groups.
    pub fn bin(
        &mut self,
        particles: &mut Particles,
        solids: &Solids,
        domain: &Domain,
        quality: &Quality,
        rest_density: f32,
        threads: usize,
    ) -> BinReport {
        if (self.smoothing.radius, self.smoothing.gradient) != (quality.kernel_radius, quality.gradient) {
            self.smoothing = Smoothing::new(quality.kernel_radius, quality.gradient);
        }
        let Self { bins, instructions, neighbours, lambda, next_x, .. } = self;
        bins.resize(domain.size, quality.kernel_radius, quality.longest_correction(), solids);
        let set_apart = AtomicU64::new(0);
        let settle = |strip: Strip| separate_coincident(strip, *instructions, domain, solids, &set_apart);
        let mut bin = |bins: &mut Bins, particles: &mut Particles| {
            bins.bin(particles, [lambda, next_x], *neighbours, *instructions, threads, &settle);
        };
        bin(bins, particles);
        let scattered =
            crowd::scatter(particles, bins.crowds(crowd::FILL * rest_density), rest_density, domain, solids);
        if scattered > 0 {
            bin(bins, particles);
        }
        BinReport { set_apart: scattered + set_apart.into_inner() }
    }

    /// The constraint C (eq. 1) of each particle that is too dense, as it was in the particle's last iteration.
    pub fn violations(&self) -> impl Iterator<Item = f32> {
        self.density.iter().map(|density| density / self.aim - 1.0).filter(|constraint| *constraint > 0.0)
    }

    /// Density of each particle as it was in its last iteration, and the one that was aimed at; 1 on the lattice.
    pub fn densities(&self) -> (&[f32], f32) {
        (&self.density, self.aim)
    }

    /// By how much of its correction limit the last substep moved the particle that is number `i` and `at` now; `None` if
    /// it was not solved, as those that sleep. Nor of particles that came or went since: one that is further from there than
    /// any correction leads is another one.
    pub fn correction_share(&self, i: usize, at: Vec2) -> Option<f32> {
        // Sleepers are in front, with a density but without a prediction.
        let k = i.checked_sub(self.density.len().checked_sub(self.x.len())?)?;
        let predicted = Vec2::new(*self.x.get(k)?, *self.y.get(k)?);
        let share = (at - predicted).abs().max_element() / self.limit?.at(self.density[i]);
        (share <= MOST_SHARE).then_some(share)
    }

    /// Iterates the density constraint on the binned particles: once over all of them, and then, where the predictor ran,
    /// only where they are still too dense.
    pub fn solve(&mut self, particles: &Particles, params: &SolveParams) {
        let count = particles.len();
        for array in [&mut self.density, &mut self.lambda, &mut self.x, &mut self.y, &mut self.next_x, &mut self.next_y]
        {
            array.resize(count, 0.0);
        }
        (self.limit, self.aim) = (Some(CorrectionLimit::new(params)), params.rest_density());
        self.substeps = params.quality.substeps;
        self.masses.clear();
        if let Some(masses) = params.masses {
            self.masses.extend(particles.element.iter().map(|element| masses[element.index()]));
            self.inertias.clear();
            self.inertias.extend(self.masses.iter().map(|mass| mass.max(LEAST_INERTIA)));
        }
        let anchor = [&particles.x[..], &particles.y[..]];
        for iteration in 0..params.quality.iterations {
            let reach = match params.iterate_above() {
                _ if iteration == 0 => Reach::First,
                None => Reach::All,
                Some(bound) => {
                    let team = Team { instructions: self.instructions, threads: params.threads };
                    self.bins.focus(anchor, &self.density, bound, team);
                    Reach::Focused
                }
            };
            if reach == Reach::Focused && self.bins.focused().is_empty() {
                return;
            }
            match (params.quality.gradient, params.masses.is_some()) {
                (GradientKernel::Spiky, false) => self.iterate::<Spiky, false>(anchor, reach, params),
                (GradientKernel::Spiky, true) => self.iterate::<Spiky, true>(anchor, reach, params),
                (GradientKernel::Rational, false) => self.iterate::<Rational, false>(anchor, reach, params),
                (GradientKernel::Rational, true) => self.iterate::<Rational, true>(anchor, reach, params),
            }
        }
    }

    fn iterate<G: Gradient, const MASSES: bool>(&mut self, anchor: [&[f32]; 2], reach: Reach, params: &SolveParams) {
        let Self { bins, smoothing, instructions, density, x, y, next_x, next_y, lambda, inertias, .. } = self;
        let pass = Iteration::<MASSES> {
            groups: if reach == Reach::Focused { bins.focused() } else { bins.groups() },
            rock: bins.rock(),
            smoothing,
            instructions: *instructions,
            params,
            masses: inertias,
            anchor,
            at: if reach == Reach::First { anchor } else { [&x[..], &y[..]] },
        };
        pass.find_lambda::<G>(lambda, density);
        let density = &density[..];
        let next = [&mut next_x[..], &mut next_y[..]];
        match (params.tension, params.predicted) {
            (false, false) => pass.correct::<G, false, false>(lambda, density, next),
            (false, true) => pass.correct::<G, false, true>(lambda, density, next),
            (true, false) => pass.correct::<G, true, false>(lambda, density, next),
            (true, true) => pass.correct::<G, true, true>(lambda, density, next),
        }
        if reach == Reach::Focused {
            // The others stay where they are.
            bins::split(bins.focused(), [x, y], params.threads, &|groups, base, at| {
                take_over(groups, base, at, [next_x, next_y]);
            });
        } else {
            std::mem::swap(x, next_x);
            std::mem::swap(y, next_y);
        }
    }
}

/// Sets the particles of `groups` to where they are `next`; `at` begins with particle `base`.
fn take_over(groups: &[Group], base: usize, at: [&mut [f32]; 2], next: [&[f32]; 2]) {
    for (at, next) in at.into_iter().zip(next) {
        for own in groups.iter().map(Group::particles) {
            at[own.start - base..own.end - base].copy_from_slice(&next[own]);
        }
    }
}

/// What an iteration goes over.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reach {
    /// All, and sets out from the prediction itself.
    First,
    /// All.
    All,
    /// What is still too dense, and what is around it.
    Focused,
}

/// What the two passes of an iteration read.
struct Iteration<'a, const MASSES: bool> {
    groups: &'a [Group],
    rock: &'a RockBins,
    smoothing: &'a Smoothing,
    instructions: InstructionSet,
    params: &'a SolveParams<'a>,
    /// Masses as shares of the heaviest, if they differ.
    masses: &'a [f32],
    /// Predicted positions, d.
    anchor: [&'a [f32]; 2],
    /// Positions before the iteration, d.
    at: [&'a [f32]; 2],
}

impl<const MASSES: bool> Iteration<'_, MASSES> {
    fn find_lambda<G: Gradient>(&self, lambda: &mut [f32], density: &mut [f32]) {
        let Self { groups, rock, smoothing, instructions, params, masses, at: [x, y], .. } = *self;
        bins::split(groups, [lambda, density], params.threads, &|groups, base, [lambda, density]| {
            instructions.run(ConstraintPass::<G, MASSES> {
                smoothing,
                domain: params.domain,
                fluid: params.fluid,
                rest_density: params.rest_density(),
                relaxation: params.relaxation(),
                x,
                y,
                masses,
                rock,
                groups,
                base,
                lambda,
                density,
                gradient: std::marker::PhantomData,
            });
        });
    }

    fn correct<G: Gradient, const TENSION: bool, const APART: bool>(
        &self,
        lambda: &[f32],
        density: &[f32],
        next: [&mut [f32]; 2],
    ) {
        let Self { groups, rock, smoothing, instructions, params, masses, anchor, at: [x, y] } = *self;
        bins::split(groups, next, params.threads, &|groups, base, next| {
            instructions.run(CorrectionPass::<G, TENSION, APART, MASSES> {
                smoothing,
                domain: params.domain,
                fluid: params.fluid,
                rest_density: params.rest_density(),
                limit: CorrectionLimit::new(params),
                density,
                x,
                y,
                masses,
                anchor,
                lambda,
                rock,
                groups,
                base,
                next,
                gradient: std::marker::PhantomData,
            });
        });
    }
}
