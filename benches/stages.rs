//! One benchmark a stage, at 10,000 particles of a tank at rest; the solver's passes once for each instruction set.

use criterion::{BatchSize, Bencher, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use powder_master::kernel::{
    air::Air,
    bins::Neighbours,
    element::ElementId,
    forces,
    params::{AirParams, Domain, FluidParams, OpenSides, Preset, Quality},
    particles::Particles,
    pbf::{SolveParams, Solver},
    predict,
    predictor::{Predictor, PredictorParams},
    simd::InstructionSet,
    solids::Solids,
    units::TICK_SECONDS,
    velocity,
};
use std::{hint::black_box, time::Duration};

const SIDE: u32 = 100;
const SUBSTEP: f32 = 1.0 / 60.0;

/// A full tank with a free surface, a little off the lattice, binned and solved once.
struct Tank {
    particles: Particles,
    solids: Solids,
    domain: Domain,
    quality: Quality,
    solver: Solver,
}

impl Tank {
    fn new(instructions: InstructionSet) -> Self {
        let size = Vec2::new(SIDE as f32, SIDE as f32 + 20.0);
        let mut tank = Self {
            particles: Particles::default(),
            solids: Solids::new(SIDE, SIDE + 20),
            domain: Domain { size, gravity: Vec2::new(0.0, -98.1) },
            quality: Preset::Balanced.quality(),
            solver: Solver::new(instructions, Neighbours::Binned),
        };
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / (1 << 24) as f32 - 0.5
        };
        for id in 0..SIDE * SIDE {
            let site = Vec2::new((id % SIDE) as f32 + 0.5, (id / SIDE) as f32 + 0.5);
            let at = site + 0.3 * Vec2::new(random(), random());
            tank.particles.push(id, ElementId(0), at, 10.0 * Vec2::new(random(), random()));
        }
        tank.predict();
        tank.bin();
        tank.solve(2);
        tank
    }

    fn predict(&mut self) {
        let Self { particles, solids, domain, quality, solver } = self;
        predict::predict(particles, solver, solids, domain, quality, 1, SUBSTEP);
    }

    fn bin(&mut self) {
        self.solver.bin(&mut self.particles, &self.solids, &self.domain, &self.quality, 1);
    }

    fn solve(&mut self, iterations: u32) {
        self.solver.solve(&SolveParams {
            domain: &self.domain,
            fluid: &FluidParams::default(),
            quality: &Quality { iterations, ..self.quality },
            tension: false,
            predicted: true,
            threads: 1,
        });
    }
}

/// Times `stage` on a tank that stays the same but for what the stage itself does to it.
fn stage(bencher: &mut Bencher, mut tank: Tank, stage: impl Fn(&mut Tank)) {
    bencher.iter(|| stage(black_box(&mut tank)));
}

fn stages(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stages");
    group.throughput(Throughput::Elements(u64::from(SIDE * SIDE)));
    let best = InstructionSet::detect();
    group.bench_function("gravity", |b| {
        stage(b, Tank::new(best), |tank| forces::apply_gravity(Vec2::new(0.0, -1e-6), &mut tank.particles, 1, SUBSTEP));
    });
    group.bench_function("drag", |b| {
        let tank = Tank::new(best);
        let params = AirParams { sound_speed: 1000.0, open: OpenSides::default() };
        let mut air = Air::new(tank.domain.size, 4.0, params);
        air.blow(Vec2::splat(50.0), 40.0, Vec2::new(30.0, 0.0));
        stage(b, tank, |tank| forces::apply_drag(&air, &[0.001], &mut tank.particles, 1, SUBSTEP));
    });
    group.bench_function("predictor", |b| {
        let tank = Tank::new(best);
        let mut predictor = Predictor::default();
        let setup = || tank.particles.clone();
        b.iter_batched_ref(
            setup,
            |particles| {
                let params = PredictorParams {
                    domain: &tank.domain,
                    cell: tank.quality.kernel_radius,
                    rest_density: 1.0,
                    instructions: best,
                    threads: 1,
                    dt: SUBSTEP,
                };
                predictor.run(particles, &tank.solids, &params)
            },
            BatchSize::SmallInput,
        );
    });
    group.bench_function("predict", |b| stage(b, Tank::new(best), Tank::predict));
    group.bench_function("bin", |b| {
        // Sorting what is sorted is cheaper than what a tick does: the tank is mixed up as far as particles move in one.
        let tank = Tank::new(best);
        b.iter_batched_ref(
            || {
                let mut mixed = Tank {
                    particles: tank.particles.clone(),
                    solids: tank.solids.clone(),
                    solver: tank.solver.clone(),
                    ..tank
                };
                mixed.predict();
                mixed
            },
            Tank::bin,
            BatchSize::LargeInput,
        );
    });
    for set in InstructionSet::available() {
        let name = format!("{set:?}").to_lowercase();
        group.bench_function(format!("solve/{name}"), |b| stage(b, Tank::new(set), |tank| tank.solve(1)));
        group.bench_function(format!("viscosity/{name}"), |b| {
            stage(b, Tank::new(set), |tank| {
                velocity::apply_viscosity(&mut tank.particles, &mut tank.solver, &[0.02], 1, TICK_SECONDS);
            });
        });
        group.bench_function(format!("vorticity/{name}"), |b| {
            stage(b, Tank::new(set), |tank| {
                velocity::apply_vorticity(&mut tank.particles, &mut tank.solver, &[0.0], 1, SUBSTEP);
            });
        });
    }
    group.bench_function("velocity", |b| {
        stage(b, Tank::new(best), |tank| {
            let Tank { particles, solids, quality, solver, .. } = tank;
            velocity::update_velocities(particles, solver, solids, quality, true, 1, SUBSTEP);
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .without_plots();
    targets = stages
}
criterion_main!(benches);
