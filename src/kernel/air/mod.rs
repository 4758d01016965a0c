//! The air: a compressible, inviscid gas on a grid of square cells, after section 3.2 of the report on the original
//! ("Grid-based Fluid Simulation"): forward advection, then a push of every neighbour pair by its pressure difference.
//!
//! Each cell holds a pressure p (the surroundings are 1, and as in the report pressure and density are one thing) and a
//! velocity (u, v), d/s, all at its centre. With `Dρ/Dt = −ρ ∇·u` and `Du/Dt = −c² ∇p` this is the gas of `γ = 2`: sound
//! runs at `c √p`, and the energy `½ Σ p |u|² + ½ c² Σ p²` can only fall in a closed box.
//!
//! | room | does | writes | reads |
//! |---|---|---|---|
//! | `grid` | the state, who may see it | | |
//! | `shape` | what follows from rock: open faces, corners, rooms | `Shape` | the solid cells |
//! | `advect` | pass 1: shares mass and momentum out | rows of new pressure, momentum | pressure, velocity |
//! | `second_order` | gives each share the velocity of its part of the cell | rows of momentum | velocity, shares |
//! | `pressure` | pass 2: pushes pairs | new velocity | rows of new pressure, momentum |
//! | `band` | both passes over some rows | new pressure, new velocity | pressure, velocity |
//! | `edges` | the open sides | the ring around the box, outermost cells | pressure, velocity |
//! | `tiles` | which parts are stepped and which sleep | awake tiles, fences in `Shape` | all |
//! | `step` | counts substeps, orders the passes, puts quiet air to rest | | |
//! | `feedback` | what particles give the air, and the air them | velocity | particles, pressure |
//! | `tools` | fans and the hand of the player | velocity, pressure | |
//! | `walls` | rock that comes and goes | solid cells, pressure | `Solids` |
//! | `sample`, `measure`, `resize` | values at points, sums, another cell size | | all |

mod advect;
mod band;
mod edges;
mod feedback;
mod grid;
mod measure;
mod pressure;
mod resize;
mod sample;
mod second_order;
mod shape;
mod step;
mod tiles;
mod tools;
mod walls;

#[cfg(test)]
mod tests;

pub use feedback::Rousing;
pub use grid::{Air, MAX_PRESSURE, MAX_SPEED};
pub use step::{AirReport, MAX_SUBSTEPS, QUIET_MACH, STABLE_COURANT};
