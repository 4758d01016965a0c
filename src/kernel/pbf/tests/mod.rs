//! The passes against a slow reference, on sets of particles that are hard in one way each.

mod focus;
pub(crate) mod reference;

use super::*;
use crate::{
    bins::Neighbours,
    element::{ElementId, Traits},
    params::{Domain, FluidParams, GradientKernel, Preset, Quality, WALL_GAP},
    particles::Particles,
    predictor::{Flow, Predictor},
    simd::InstructionSet,
    solids::Solids,
    velocity::{MoveReport, update_velocities},
};
use glam::Vec2;
use reference::{Question, Vector};

/// A box with particles and rock in it, ready to be solved.
pub(crate) struct Bench {
    pub(crate) particles: Particles,
    pub(crate) solids: Solids,
    pub(crate) domain: Domain,
    pub(crate) fluid: FluidParams,
    pub(crate) quality: Quality,
    /// Whether the passes are told that the pressure predictor ran.
    pub(crate) predicted: bool,
    pub(crate) solver: Solver,
}

impl Bench {
    /// A box of `columns × rows` cells without gravity, at the preset's quality.
    pub(crate) fn new(columns: u32, rows: u32, preset: Preset) -> Self {
        Self {
            particles: Particles::default(),
            solids: Solids::new(columns, rows),
            domain: Domain { size: Vec2::new(columns as f32, rows as f32), gravity: Vec2::ZERO },
            fluid: FluidParams::default(),
            quality: preset.quality(),
            predicted: false,
            solver: Solver::default(),
        }
    }

    /// Adds a particle.
    pub(crate) fn add(&mut self, position: Vec2, velocity: Vec2) {
        self.particles.push(self.particles.len() as u32, ElementId(0), position, velocity);
    }

    /// Puts rock into the cells `low … high`, `high` not included.
    pub(crate) fn rock(&mut self, low: (i32, i32), high: (i32, i32)) {
        for y in low.1..high.1 {
            for x in low.0..high.0 {
                self.solids.insert(glam::IVec2::new(x, y), ElementId(0), 1_000_000 + (y * 10_000 + x) as u32);
            }
        }
    }

    /// Bins the particles where they are; there are no corrections yet.
    pub(crate) fn bin(&mut self) {
        self.solver.bin(&mut self.particles, &self.solids, &self.domain, &self.quality, CROWDS_STAY, 1);
        self.solver.x.clone_from(&self.particles.x);
        self.solver.y.clone_from(&self.particles.y);
    }

    /// Bins and iterates.
    pub(crate) fn solve(&mut self, tension: bool) {
        self.bin();
        let params = SolveParams {
            domain: &self.domain,
            fluid: &self.fluid,
            quality: &self.quality,
            tension,
            predicted: self.predicted,
            masses: None,
            threads: 1,
        };
        self.solver.solve(&self.particles, &params);
    }

    /// Predicts over `dt` s, solves and moves.
    pub(crate) fn step(&mut self, tension: bool, dt: f32) {
        let Self { particles, solids, domain, quality, solver, predicted, .. } = self;
        let predicted = *predicted;
        crate::predict::predict(particles, solver.instructions, (solids, domain), quality, Traits::default(), 1, dt);
        let params = SolveParams { domain, fluid: &self.fluid, quality, tension, predicted, masses: None, threads: 1 };
        solver.bin(particles, solids, domain, quality, CROWDS_STAY, 1);
        solver.solve(particles, &params);
        // Of the flow nothing is known.
        let predictor = Predictor::default();
        self.update(predicted.then(|| predictor.flow()), dt);
    }

    /// Moves to the corrected positions, without gravity, as liquid.
    pub(crate) fn update(&mut self, flow: Option<Flow<'_>>, dt: f32) -> MoveReport {
        let Self { particles, solids, solver, .. } = self;
        update_velocities(particles, solver, solids, Vec2::ZERO, flow, Traits::default(), 1, dt)
    }
}

/// A rest density at which no cell is crowded: the equations are to hold for crowds, too.
const CROWDS_STAY: f32 = 1e6;

/// The same numbers in every run, 0 … 1.
pub(crate) fn random_numbers(seed: u32) -> impl FnMut() -> f32 {
    let mut state = crate::random::mix(seed) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state >> 8) as f32 / (1 << 24) as f32
    }
}

/// Sets of positions in a box of 24 × 18 with rock in it, each with its name.
fn sets() -> Vec<(&'static str, Vec<Vec2>)> {
    let mut random = random_numbers(5);
    let mut point = |low: Vec2, size: Vec2| low + Vec2::new(random(), random()) * size;
    let whole = Vec2::new(23.4, 17.4);
    let low = Vec2::splat(0.3);
    let mut clusters = Vec::new();
    for _ in 0..12 {
        let middle = point(low, whole - 2.0);
        clusters.extend((0..20).map(|_| point(middle, Vec2::splat(1.5))));
    }
    let pairs = (0..40).flat_map(|k| {
        let at = Vec2::new(1.0 + (k % 10) as f32 * 2.1, 6.0 + (k / 10) as f32 * 2.3);
        [at, at]
    });
    vec![
        ("random", (0..400).map(|_| point(low, whole)).collect()),
        ("lattice", (0..240).map(|k| Vec2::new((k % 24) as f32 + 0.5, (k / 24) as f32 + 0.5)).collect()),
        ("clusters", clusters),
        ("one particle", vec![Vec2::new(7.3, 9.1)]),
        ("one in the corner", vec![Vec2::splat(WALL_GAP)]),
        ("a horizontal line", (0..60).map(|k| Vec2::new(0.5 + 0.38 * k as f32, 9.0)).collect()),
        ("a vertical line", (0..60).map(|k| Vec2::new(6.0, 0.4 + 0.28 * k as f32)).collect()),
        ("coincident pairs", pairs.collect()),
        ("200 in one cell", (0..200).map(|_| point(Vec2::new(9.0, 9.0), Vec2::splat(0.6))).collect()),
    ]
}

/// Largest errors of density (relative), of λ (beside the largest of the set) and of Δx (d): rounding alone, and where
/// a wall's table (64 linear pieces) has a part in it.
const ROUNDING: [f64; 3] = [2e-6, 3e-6, 3e-5];
const TABLE: [f64; 3] = [2e-4, 5e-3, 1e-3];

fn check(set: (&str, &[Vec2]), quality: Quality, tension: bool, predicted: bool, fluid: FluidParams) {
    let mut bench = Bench::new(24, 18, Preset::Fast);
    (bench.fluid, bench.predicted) = (fluid, predicted);
    bench.quality = Quality { iterations: 1, ..quality };
    bench.rock((13, 0), (15, 7));
    bench.rock((20, 12), (21, 13));
    for &at in set.1 {
        if !bench.solids.is_solid(Solids::cell_of(at)) {
            bench.add(at, Vec2::ZERO);
        }
    }
    bench.solve(tension);
    let solver = &bench.solver;
    let points = |x: &[f32], y: &[f32]| -> Vec<Vector> {
        x.iter().zip(y).map(|(&x, &y)| [f64::from(x), f64::from(y)]).collect()
    };
    let anchors = points(&bench.particles.x, &bench.particles.y);
    let rock = points(&solver.bins.rock().x, &solver.bins.rock().y);
    let Bench { domain, fluid, quality, .. } = &bench;
    let answer = Question { particles: &anchors, rock: &rock, domain, fluid, quality, tension, predicted }.answer();
    let largest = answer.lambda.iter().fold(1e-3_f64, |most, value| most.max(value.abs()));
    let size = domain.size.as_dvec2().to_array();
    let [usual, longest] = [quality.correction_limit, quality.longest_correction()].map(f64::from);
    let aim = f64::from(fluid.rest_density);
    // A wall is felt at first hand and, in Δx, by way of a neighbour's λ.
    let near = |at: Vector, reach: f64| (0..2).any(|axis| at[axis] < reach || size[axis] - at[axis] < reach);
    for (i, &anchor) in anchors.iter().enumerate() {
        let tolerance = |quantity: usize, radii: f64| {
            if near(anchor, radii * f64::from(quality.kernel_radius)) { TABLE[quantity] } else { ROUNDING[quantity] }
        };
        let verify = |what: &str, found: f32, exact: f64, tolerance: f64| {
            assert!(
                (f64::from(found) - exact).abs() < tolerance,
                "{}, {quality:?}, tension {tension}, predicted {predicted}, {fluid:?}: {what} {found} instead of {exact} at {anchor:?}",
                set.0
            );
        };
        verify("ρ", solver.density[i], answer.density[i], tolerance(0, 1.0) * answer.density[i].max(1.0));
        verify("λ", solver.lambda[i], answer.lambda[i], tolerance(1, 1.0) * largest);
        // Past a density of 1.5 a particle may go further, past 2 furthest.
        let limit = usual + (longest - usual) * ((answer.density[i] / aim - 1.5) / 0.5).clamp(0.0, 1.0);
        for (axis, found) in [(0, solver.x[i]), (1, solver.y[i])] {
            let moved = anchor[axis] + answer.moves[i][axis].clamp(-limit, limit);
            let moved = moved.clamp(f64::from(WALL_GAP), size[axis] - f64::from(WALL_GAP));
            verify("x + Δx", found, moved, tolerance(2, 2.0));
        }
    }
}

#[test]
fn one_iteration_equals_the_papers_equations_in_double_precision() {
    for (name, positions) in &sets() {
        for gradient in [GradientKernel::Spiky, GradientKernel::Rational] {
            // The shorter one: a crowd may go further.
            for correction_limit in [0.1, 0.5] {
                let quality = Quality { gradient, correction_limit, ..Preset::Fast.quality() };
                for (tension, predicted) in [(false, false), (true, false), (false, true), (true, true)] {
                    for rest_density in [1.0, 0.4, 2.5] {
                        let fluid = FluidParams { rest_density, ..FluidParams::default() };
                        check((name, positions), quality, tension, predicted, fluid);
                    }
                    let pulling =
                        FluidParams { constraint_floor: -0.1, tension_strength: 0.05, ..FluidParams::default() };
                    check((name, positions), quality, tension, predicted, pulling);
                }
            }
        }
    }
}

#[test]
fn a_free_blob_keeps_its_momentum() {
    for preset in [Preset::Classic, Preset::Balanced] {
        let mut bench = Bench::new(80, 80, preset);
        bench.quality.correction_limit = 0.5;
        let mut random = random_numbers(11);
        for k in 0..400 {
            let site = Vec2::new(30.0 + (k % 20) as f32, 30.0 + (k / 20) as f32);
            let jitter = Vec2::new(random(), random()) * 0.6;
            bench.add(site + jitter, Vec2::new(random() - 0.3, random() - 0.6) * 20.0);
        }
        let momentum = |bench: &Bench| -> [f64; 2] {
            [&bench.particles.vx, &bench.particles.vy].map(|v| v.iter().map(|&v| f64::from(v)).sum())
        };
        let start = momentum(&bench);
        for _ in 0..60 {
            bench.step(true, 1.0 / 240.0);
        }
        let end = momentum(&bench);
        // Rounding of positions near 40 over Δt: 4e-6 · 240 d/s a particle and step, at random.
        for (start, end) in start.into_iter().zip(end) {
            assert!((end - start).abs() < 0.5, "{}: momentum {start} became {end}", preset.name());
        }
        assert!(bench.particles.len() == 400);
    }
}

fn nearest(particles: &Particles) -> f32 {
    let mut nearest = f32::MAX;
    for i in 0..particles.len() {
        for j in 0..i {
            nearest = nearest.min(particles.position(i).distance(particles.position(j)));
        }
    }
    nearest
}

fn assert_sound(bench: &Bench, what: &str) {
    let particles = &bench.particles;
    let inside = |at: Vec2| at.cmpge(Vec2::ZERO).all() && at.cmple(bench.domain.size).all();
    for i in 0..particles.len() {
        let (at, velocity) = (particles.position(i), particles.velocity(i));
        assert!(at.is_finite() && velocity.is_finite(), "{what}: particle {i} at {at} with {velocity}");
        assert!(inside(at), "{what}: particle {i} left the box for {at}");
    }
}

#[test]
fn many_on_one_point_part() {
    for preset in Preset::ALL {
        for at in [Vec2::new(20.3, 20.7), Vec2::splat(WALL_GAP), Vec2::new(0.0, 17.0)] {
            let mut bench = Bench::new(40, 40, preset);
            for _ in 0..64 {
                bench.add(at, Vec2::ZERO);
            }
            for _ in 0..120 {
                bench.step(true, 1.0 / 120.0);
            }
            assert_sound(&bench, preset.name());
            let nearest = nearest(&bench.particles);
            assert!(nearest > 1e-3, "{}: of 64 on {at} two are still {nearest} d apart", preset.name());
            bench.solve(false);
            let densest = bench.solver.density.iter().copied().fold(0.0, f32::max);
            assert!(densest < 1.2, "{}: 64 on {at} are still at a density of {densest}", preset.name());
        }
    }
}

#[test]
fn ten_thousand_in_one_cell_spread() {
    let mut bench = Bench::new(300, 300, Preset::Draft);
    let mut random = random_numbers(3);
    for _ in 0..10_000 {
        bench.add(Vec2::new(150.0 + random(), 150.0 + random()), Vec2::ZERO);
    }
    for _ in 0..60 {
        bench.step(true, 1.0 / 120.0);
    }
    assert_sound(&bench, "10,000 in one cell");
    bench.solve(false);
    let crowded = bench.solver.density.iter().filter(|&&density| density > 1.5).count();
    assert!(crowded < 100, "{crowded} of 10,000 particles are still crowded");
}
