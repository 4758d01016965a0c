//! The pressure predictor: a coarse grid solve that makes the predicted velocities nearly divergence-free before the
//! density constraint sees them.
//!
//! Position Based Fluids carries pressure one kernel radius an iteration, so its error grows with depth. Here the bulk of
//! the pressure is found at once: velocities go to a staggered (MAC) grid with cells of about one kernel radius, a
//! Poisson equation with a density feedback is solved by conjugate gradients with a multigrid preconditioner, and the
//! change of velocity comes back to the particles (Zhu & Bridson 2005, "Animating sand as a fluid"; McAdams et al. 2010
//! for the solver). A few iterations of the constraint then do the detail, whatever the depth.
//!
//! Modules: `steps` the whole, `grid` the geometry, `parts` what rock leaves of cells, `open_shares` of faces, `slivers` cells of
//! which a thin wall leaves little, `behind` what thin walls hide, `rock` all that of a box, `stencil`, `share_out`, `transfer` and `way_back` particles to grid and
//! back, `matter` what of it is heavier, `grains` friction among powders, `pressure` and `equation` the equation, `feedback` what wrong densities ask of it, `changes` what
//! follows from its solution on the faces, `flow` the velocity that comes of it, `pressure_at` the pressure between the cells,
//! `pockets` where it is singular, `pieces` where there is any, `operator`, `level`, `multigrid` and `conjugate` its solver, `wide` how they
//! go over cells.

mod behind;
mod changes;
mod conjugate;
mod equation;
mod feedback;
mod flow;
mod fold;
mod grains;
mod grid;
mod letting_go;
mod level;
mod matter;
mod multigrid;
mod open_shares;
mod operator;
mod outline;
mod parts;
mod pieces;
mod pockets;
mod pressure;
mod pressure_at;
mod report;
mod rock;
mod share_out;
mod slivers;
mod stencil;
mod steps;
#[cfg(test)]
mod tests;
mod transfer;
mod way_back;
mod wide;

pub use flow::Flow;
pub use grains::GrainParams;
pub use matter::Buoyancy;
pub use report::PredictorReport;
pub use steps::{Kept, Predictor, PredictorParams};
