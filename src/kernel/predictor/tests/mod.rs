//! The predictor's parts against known answers: each test has a solution on paper, or a sum that must come out.

mod disc;
mod equation;
mod feedback;
mod grains;
mod letting_go;
mod matter;
mod multigrid;
mod pockets;
mod pressure_at;
mod rig;
mod still;
mod surface;
mod transfer;
mod walls;

use crate::{
    element::ElementId,
    parallel::Team,
    particles::Particles,
    predictor::{Predictor, PredictorParams, PredictorReport},
    random::Random,
    simd::InstructionSet,
    solids::Solids,
};
use crate::{params::Domain, solids::centre};
use glam::{IVec2, Vec2};

/// Edge of a cell as the presets have it, d.
const CELL: f32 = 2.5;

/// A substep, s.
const DT: f32 = 1.0 / 60.0;

/// The rest density at which a lattice of spacing d is just as dense as the predictor wants it, so that all that is left
/// to do is the divergence.
const LATTICE: f32 = 1.0;

fn team() -> Team {
    Team { instructions: InstructionSet::detect(), threads: 1 }
}

/// Memory to work in: what is in there must not matter.
fn room() -> [Vec<f32>; 3] {
    std::array::from_fn(|_| vec![f32::NAN; 1 << 16])
}

/// Particles on those sites of the lattice of spacing d where `velocity` has one, but not in rock.
fn lattice(solids: &Solids, velocity: impl Fn(Vec2) -> Option<Vec2>) -> Particles {
    let mut particles = Particles::default();
    for k in 0..solids.columns() * solids.rows() {
        let cell = IVec2::new(k % solids.columns(), k / solids.columns());
        if let Some(velocity) = velocity(centre(cell)).filter(|_| !solids.is_solid(cell)) {
            particles.push(k as u32, ElementId(1), centre(cell), velocity);
        }
    }
    particles
}

/// A box of this size with rock where `is_rock` says so.
fn solids(columns: u32, rows: u32, is_rock: impl Fn(Vec2) -> bool) -> Solids {
    let mut solids = Solids::new(columns, rows);
    for k in 0..columns * rows {
        let cell = IVec2::new((k % columns) as i32, (k / columns) as i32);
        if is_rock(centre(cell)) {
            solids.insert(cell, ElementId(0), k);
        }
    }
    solids
}

/// Where gravity pulls.
const DOWN: Vec2 = Vec2::NEG_Y;

fn size(solids: &Solids) -> Vec2 {
    IVec2::new(solids.columns(), solids.rows()).as_vec2()
}

/// One prediction as a tick has it.
fn predict(particles: &mut Particles, solids: &Solids, rest_density: f32) -> PredictorReport {
    go_on(&mut Predictor::default(), particles, solids, (rest_density, DT))
}

/// One prediction over a substep (s) more by a predictor that there is, at a rest density as a multiple of the lattice's.
fn go_on(predictor: &mut Predictor, particles: &mut Particles, solids: &Solids, of: (f32, f32)) -> PredictorReport {
    pull(predictor, particles, solids, of, DOWN)
}

/// The same with a gravity of its own.
fn pull(
    predictor: &mut Predictor,
    particles: &mut Particles,
    solids: &Solids,
    (rest_density, dt): (f32, f32),
    gravity: Vec2,
) -> PredictorReport {
    let domain = Domain { size: size(solids), gravity };
    let instructions = InstructionSet::detect();
    let params = PredictorParams {
        domain: &domain,
        cell: CELL,
        rest_density,
        masses: None,
        grains: None,
        drawn: None,
        instructions,
        threads: 1,
        dt,
    };
    predictor.run(particles, solids, &params, room().each_mut())
}

/// Numbers from −1 to 1 that look random and are always the same.
fn noise(seed: u32) -> impl FnMut() -> f32 {
    let mut random = Random::new(seed.into());
    move || random.offset()
}

/// Order of convergence from errors on grids of which each is twice as fine as the one before: the least of the steps.
fn order(errors: &[f64]) -> f64 {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).fold(f64::INFINITY, f64::min)
}
