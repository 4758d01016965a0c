//! A tank of water to run single stages on; shared by the benches and the instruction counts.

use glam::Vec2;
use powder_master::kernel::{
    bins::Neighbours,
    element::{ElementId, Traits},
    params::{Domain, FluidParams, Preset, Quality},
    particles::Particles,
    pbf::{SolveParams, Solver},
    predict,
    predictor::{GrainParams, Predictor, PredictorParams},
    random::Random,
    simd::InstructionSet,
    solids::Solids,
    velocity,
};

/// Particles along each edge of the tank.
pub const SIDE: u32 = 100;
/// Length of a substep, s.
pub const SUBSTEP: f32 = 1.0 / 60.0;

/// A full tank with a free surface, a little off the lattice, binned and solved once.
#[derive(Clone)]
pub struct Tank {
    /// The water.
    pub particles: Particles,
    /// No rock.
    pub solids: Solids,
    /// The box, a little higher than the water, and gravity.
    pub domain: Domain,
    /// `balanced`.
    pub quality: Quality,
    /// Binned for the particles as they stand.
    pub solver: Solver,
    /// Run once on the water as it stood before it was predicted.
    pub predictor: Predictor,
}

impl Tank {
    /// The tank, to be worked on by one thread on the lanes of `instructions`.
    pub fn new(instructions: InstructionSet) -> Self {
        let size = Vec2::new(SIDE as f32, SIDE as f32 + 20.0);
        let mut tank = Self {
            particles: Particles::default(),
            solids: Solids::new(SIDE, SIDE + 20),
            domain: Domain { size, gravity: Vec2::new(0.0, -98.1) },
            quality: Preset::Balanced.quality(),
            solver: Solver::new(instructions, Neighbours::Binned),
            predictor: Predictor::default(),
        };
        let mut random = Random::new(1);
        let mut random = || random.share() - 0.5;
        for id in 0..SIDE * SIDE {
            let site = Vec2::new((id % SIDE) as f32 + 0.5, (id / SIDE) as f32 + 0.5);
            let at = site + 0.3 * Vec2::new(random(), random());
            tank.particles.push(id, ElementId(0), at, 10.0 * Vec2::new(random(), random()));
        }
        tank.project();
        tank.predict();
        tank.bin();
        tank.solve(2);
        tank
    }

    /// Solves for the pressure.
    pub fn project(&mut self) {
        self.project_with(None);
    }

    /// The same with friction among what is a grain.
    pub fn project_with(&mut self, grains: Option<GrainParams>) {
        let Self { particles, solids, domain, quality, solver, predictor } = self;
        let params = PredictorParams {
            domain,
            cell: quality.kernel_radius,
            rest_density: 1.0,
            masses: None,
            grains,
            drawn: None,
            instructions: solver.instructions,
            threads: 1,
            dt: SUBSTEP,
        };
        predictor.run(particles, solids, &params, solver.room());
    }

    /// Velocities follow from the moves.
    pub fn update_velocities(&mut self) {
        let Self { particles, solids, solver, predictor, .. } = self;
        velocity::update_velocities(
            particles,
            solver,
            solids,
            Vec2::ZERO,
            Some(predictor.flow()),
            Traits::default(),
            1,
            SUBSTEP,
        );
    }

    /// Predicts positions.
    pub fn predict(&mut self) {
        let Self { particles, solids, domain, quality, solver, .. } = self;
        predict::predict(particles, solver.instructions, (solids, domain), quality, Traits::default(), 1, SUBSTEP);
    }

    /// Sorts into bins.
    pub fn bin(&mut self) {
        self.solver.bin(&mut self.particles, &self.solids, &self.domain, &self.quality, 1.0, 1);
    }

    /// Iterates the density constraint.
    pub fn solve(&mut self, iterations: u32) {
        let params = SolveParams {
            domain: &self.domain,
            fluid: &FluidParams::default(),
            quality: &Quality { iterations, ..self.quality },
            tension: false,
            predicted: true,
            masses: None,
            threads: 1,
        };
        self.solver.solve(&self.particles, &params);
    }
}
