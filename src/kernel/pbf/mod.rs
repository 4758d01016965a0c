//! Position Based Fluids (Macklin & Müller 2013), the density constraint in 2-D.
//!
//! For each particle `C_i = ρ_i/ρ₀ − 1` (eq. 1), `ρ_i = Σ W` over its neighbours (eq. 2), `λ_i = −C_i / (Σ|∇C_i|² + ε)`
//! (eq. 11), `Δx_i = 1/ρ₀ Σ (λ_i + λ_j + s_corr) ∇W` (eqs. 12–14). One iteration is a pass for λ over all particles and a
//! pass for Δx (Jacobi: every particle reads the positions from before the pass).
//!
//! Who writes what: `predict` fills the predicted positions, [`Solver::bin`] sorts everything by cell,
//! [`Solver::solve`] iterates on the predicted positions; `velocity` reads them.

mod coincident;
mod constraint;
mod correction;
#[cfg(test)]
pub(crate) mod tests;

use crate::kernel::{
    bins::{Bins, Neighbours, permute},
    element::ElementId,
    parallel,
    params::{Domain, FluidParams, GradientKernel, Quality},
    particles::Particles,
    predictor::TARGET_DENSITY,
    simd::InstructionSet,
    smoothing::{Gradient, Rational, Smoothing, Spiky},
    solids::Solids,
};
use coincident::separate_coincident;
use constraint::ConstraintPass;
use correction::CorrectionPass;
use glam::Vec2;
use rayon::iter::{IntoParallelRefMutIterator, ParallelIterator};

/// Positions under correction, densities, bins: what the solver keeps beside the particles. 37 bytes a particle and the
/// bins. The arrays follow the order of the particles.
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
    /// Where the particles go in this substep, d: predicted, then corrected.
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    /// The prediction, d: corrections keep within the correction limit of it.
    pub(crate) anchor_x: Vec<f32>,
    pub(crate) anchor_y: Vec<f32>,
    /// Outputs of a pass.
    pub(crate) next_x: Vec<f32>,
    pub(crate) next_y: Vec<f32>,
    pub(crate) lambda: Vec<f32>,
    spare_ids: Vec<u32>,
    spare_elements: Vec<ElementId>,
}

/// What [`Solver::solve`] is told besides the particles.
#[derive(Clone, Copy, Debug)]
pub struct SolveParams<'a> {
    /// Box and gravity.
    pub domain: &'a Domain,
    /// Liquid parameters.
    pub fluid: &'a FluidParams,
    /// Accuracy.
    pub quality: &'a Quality,
    /// Whether the tensile correction is added.
    pub tension: bool,
    /// Whether the pressure predictor ran: then the constraint aims at its target density, and pairs that are too close
    /// are set apart.
    pub predicted: bool,
    /// Threads to use.
    pub threads: usize,
}

impl SolveParams<'_> {
    /// Density that the constraint aims at, 1 on the lattice.
    fn rest_density(&self) -> f32 {
        self.fluid.rest_density * if self.predicted { TARGET_DENSITY } else { 1.0 }
    }
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
            anchor_x: Vec::new(),
            anchor_y: Vec::new(),
            next_x: Vec::new(),
            next_y: Vec::new(),
            lambda: Vec::new(),
            spare_ids: Vec::new(),
            spare_elements: Vec::new(),
        }
    }

    /// Predicted or corrected position of particle `i`, d.
    pub fn position(&self, i: usize) -> Vec2 {
        Vec2::new(self.x[i], self.y[i])
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        let floats = [&self.density, &self.x, &self.y, &self.anchor_x, &self.anchor_y, &self.next_x, &self.next_y];
        let floats: usize = floats.iter().map(|array| array.capacity()).sum();
        4 * (floats + self.lambda.capacity() + self.spare_ids.capacity())
            + self.spare_elements.capacity()
            + self.bins.memory()
    }

    /// Sorts the particles and their predicted positions by cell and builds the groups. From here on the prediction is
    /// the anchor of the corrections.
    pub fn bin(
        &mut self,
        particles: &mut Particles,
        solids: &Solids,
        domain: &Domain,
        quality: &Quality,
        threads: usize,
    ) {
        if (self.smoothing.radius, self.smoothing.gradient) != (quality.kernel_radius, quality.gradient) {
            self.smoothing = Smoothing::new(quality.kernel_radius, quality.gradient);
        }
        self.bins.lay(domain.size, quality.kernel_radius, quality.correction_limit, solids);
        self.bins.sort(&self.x, &self.y, self.instructions, threads);
        self.follow_sort(particles, threads);
        separate_coincident(&particles.id, &mut self.x, &mut self.y, self.instructions, domain, solids);
        self.bins.group(&self.x, self.instructions.width(), self.neighbours);
        self.anchor_x.clone_from(&self.x);
        self.anchor_y.clone_from(&self.y);
    }

    /// Moves everything to where the sort wants it, array by array: those that the solve will fill take what comes.
    fn follow_sort(&mut self, particles: &mut Particles, threads: usize) {
        let Self { bins: Bins { places, .. }, x, y, anchor_x, anchor_y, next_x, next_y, .. } = self;
        let Particles { x: from_x, y: from_y, vx, vy, id, element } = particles;
        let mut arrays = [
            (x, next_x),
            (y, next_y),
            (from_x, anchor_x),
            (from_y, anchor_y),
            (vx, &mut self.lambda),
            (vy, &mut self.density),
        ];
        let (spare_ids, spare_elements) = (&mut self.spare_ids, &mut self.spare_elements);
        let mut move_names = || {
            permute(id, places, spare_ids);
            permute(element, places, spare_elements);
        };
        if threads > 1 {
            let move_arrays = || arrays.par_iter_mut().for_each(|(values, spare)| permute(values, places, spare));
            rayon::join(move_arrays, move_names);
        } else {
            arrays.iter_mut().for_each(|(values, spare)| permute(values, places, spare));
            move_names();
        }
    }

    /// Iterates the density constraint on the binned positions.
    pub fn solve(&mut self, params: &SolveParams) {
        let particles = self.x.len();
        for array in [&mut self.density, &mut self.lambda, &mut self.next_x, &mut self.next_y] {
            array.resize(particles, 0.0);
        }
        for _ in 0..params.quality.iterations {
            match params.quality.gradient {
                GradientKernel::Spiky => self.iterate::<Spiky>(params),
                GradientKernel::Rational => self.iterate::<Rational>(params),
            }
        }
    }

    fn iterate<G: Gradient>(&mut self, params: &SolveParams) {
        self.find_lambda::<G>(params);
        match (params.tension, params.predicted) {
            (false, false) => self.correct::<G, false, false>(params),
            (false, true) => self.correct::<G, false, true>(params),
            (true, false) => self.correct::<G, true, false>(params),
            (true, true) => self.correct::<G, true, true>(params),
        }
        std::mem::swap(&mut self.x, &mut self.next_x);
        std::mem::swap(&mut self.y, &mut self.next_y);
    }

    fn find_lambda<G: Gradient>(&mut self, params: &SolveParams) {
        let (smoothing, instructions) = (&self.smoothing, self.instructions);
        let (x, y, rock) = (&self.x, &self.y, self.bins.rock());
        let outputs = [&mut self.lambda[..], &mut self.density[..]];
        parallel::split(self.bins.groups(), outputs, params.threads, &|groups, base, [lambda, density]| {
            instructions.run(ConstraintPass::<G> {
                smoothing,
                domain: params.domain,
                fluid: params.fluid,
                rest_density: params.rest_density(),
                x,
                y,
                rock,
                groups,
                base,
                lambda,
                density,
                gradient: std::marker::PhantomData,
            });
        });
    }

    fn correct<G: Gradient, const TENSION: bool, const APART: bool>(&mut self, params: &SolveParams) {
        let (smoothing, instructions) = (&self.smoothing, self.instructions);
        let (x, y, rock, lambda) = (&self.x, &self.y, self.bins.rock(), &self.lambda);
        let anchor = [&self.anchor_x[..], &self.anchor_y[..]];
        let outputs = [&mut self.next_x[..], &mut self.next_y[..]];
        parallel::split(self.bins.groups(), outputs, params.threads, &|groups, base, next| {
            instructions.run(CorrectionPass::<G, TENSION, APART> {
                smoothing,
                domain: params.domain,
                fluid: params.fluid,
                rest_density: params.rest_density(),
                limit: params.quality.correction_limit,
                x,
                y,
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

/// Scrambles a number (the finaliser of MurmurHash3), so that neighbouring ids point in unrelated directions.
pub(crate) fn mix(mut word: u32) -> u32 {
    word ^= word >> 16;
    word = word.wrapping_mul(0x85eb_ca6b);
    word ^= word >> 13;
    word = word.wrapping_mul(0xc2b2_ae35);
    word ^ (word >> 16)
}

/// The low 16 bits as a number in −1 … 1.
pub(crate) fn unit(bits: u32) -> f32 {
    (bits & 0xffff) as f32 / 32_767.5 - 1.0
}

/// Distance and inward sign of the walls that a kernel of radius `h` at `position` reaches, as the density that they add
/// and the sum of `g (x_i − x_j)` over them. Where two walls meet, their overlap is counted once (as for a separable
/// kernel).
#[inline]
pub(crate) fn wall_sums(smoothing: &Smoothing, domain: &Domain, position: Vec2) -> (f32, Vec2) {
    let axis = |at: f32, size: f32| {
        let (low, low_push) = smoothing.wall(at);
        let (high, high_push) = smoothing.wall(size - at);
        (low + high, low_push - high_push)
    };
    let (density_x, push_x) = axis(position.x, domain.size.x);
    let (density_y, push_y) = axis(position.y, domain.size.y);
    (density_x + density_y - density_x * density_y, Vec2::new(push_x * (1.0 - density_y), push_y * (1.0 - density_x)))
}
