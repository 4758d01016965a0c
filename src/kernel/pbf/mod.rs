//! Position Based Fluids (Macklin & Müller 2013), the density constraint in 2-D.
//!
//! For each particle `C_i = ρ_i/ρ₀ − 1` (eq. 1), `ρ_i = Σ W` over its neighbours (eq. 2), `λ_i = −C_i / (Σ|∇C_i|² + ε)`
//! (eq. 11), `Δx_i = 1/ρ₀ Σ (λ_i + λ_j + s_corr) ∇W` (eqs. 12–14). One iteration is a pass for λ over all particles and a
//! pass for Δx (Jacobi: every particle reads the positions from before the pass).
//!
//! What writes what: `predict` moves the particles to their predicted positions, [`Solver::bin`] sorts them by cell,
//! [`Solver::solve`] leaves corrected positions beside them, to which `velocity` moves them.

mod coincident;
mod constraint;
mod correction;
mod crowd;
mod limit;
mod params;
mod solver;
#[cfg(test)]
pub(crate) mod tests;
mod walls;

pub(crate) use limit::CorrectionLimit;
pub use params::{PREDICTED_RELAXATION, SolveParams};
pub use solver::{BinReport, Solver};
pub(crate) use walls::wall_sums;
