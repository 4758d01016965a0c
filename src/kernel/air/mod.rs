//! The air: a compressible, inviscid gas on a grid of square cells, after section 3.2 of the report on the original
//! ("Grid-based Fluid Simulation"): forward advection, then a push of every neighbour pair by its pressure difference.
//!
//! Each cell holds a pressure p (the surroundings are 1, and as in the report pressure and density are one thing) and a
//! velocity (u, v), d/s, all at its centre. With `Dρ/Dt = −ρ ∇·u` and `Du/Dt = −c² ∇p` this is the gas of `γ = 2`: sound
//! runs at `c √p`, and the energy `½ Σ p |u|² + ½ c² Σ p²` can only fall in a closed box. Far above the pressures of play
//! it is another gas, whose sound gets no faster (`law`).
//!
//! Types below, what works on them above: `tiling` → `shape` → `source`, `rooms` → the passes → `grid` → the rest.
//!
//! | module | does | writes | reads |
//! |---|---|---|---|
//! | `grid` | the state, and how it is read and checked | | |
//! | `tiling` | how the cells lie and how they are cut into tiles | | |
//! | `shape` | what follows from rock: open faces, corners, rooms | `Shape` | the solid cells |
//! | `law` | what pressure does, however high it is | | |
//! | `rooms` | what is in each room, and its pressure at rest | `Room` | pressure, `Shape` |
//! | `source` | what pass 1 reads | | |
//! | `advect` | pass 1: shares mass and momentum out | rows of new pressure, momentum | pressure, velocity |
//! | `second_order` | gives each share the velocity of its part of the cell | rows of momentum | velocity, shares |
//! | `pressure` | pass 2: pushes pairs | new velocity | rows of new pressure, momentum |
//! | `lift` | pulls warm air up, and finds how warm it is | rows of momentum, warmth | rows of new pressure |
//! | `band` | both passes over some rows | new pressure, new velocity | pressure, velocity |
//! | `crowd` | matter that stands in the way of the air | what faces let through | |
//! | `overpressure` | by how much it presses harder than the surroundings | | pressure, warmth |
//! | `press` | finds what stands in its way, and pushes it | particles | pressure, warmth, particles |
//! | `edges` | the open sides | the ring around the box, outermost cells | pressure, velocity |
//! | `tiles` | which parts are stepped and which sleep | awake tiles, fences in `Shape` | all |
//! | `step`, `report` | counts substeps, orders the passes, puts quiet air to rest | | |
//! | `ledger` | the mass of each room in each tile | | pressure, `Shape` |
//! | `balance` | keeps the mass of shut rooms | pressure | pressure, `Shape`, pressures at rest |
//! | `feedback`, `meetings` | what particles give the air, and the air them | velocity | particles, pressure |
//! | `tools` | winds of the scene and the player's air tools | velocity, pressure | |
//! | `warmth` | warm air: what lifts it, what it gets and loses | warmth | heat that matter gives |
//! | `expansion` | gas that matter gives off, or takes | pressure, velocity, warmth | releases |
//! | `walls` | rock that comes and goes | solid cells, pressure | `Solids` |
//! | `sample`, `stencils`, `measure`, `resize` | values at points, sums, another cell size | | all |

mod advect;
mod balance;
mod band;
mod crowd;
mod edges;
mod expansion;
mod feedback;
mod grid;
mod law;
mod ledger;
mod lift;
mod measure;
mod meetings;
mod overpressure;
mod press;
mod pressure;
mod report;
mod resize;
mod rooms;
mod sample;
mod second_order;
mod shape;
mod source;
mod stencils;
mod step;
mod tiles;
mod tiling;
mod tools;
mod walls;
mod warmth;

#[cfg(test)]
mod tests;

pub use expansion::Release;
pub use feedback::Rousing;
pub use grid::{Air, MAX_PRESSURE, MAX_SPEED};
pub use report::AirReport;
pub use rooms::QUIET_MACH;
pub use step::{MAX_SUBSTEPS, STABLE_COURANT};
pub use warmth::Contact;
