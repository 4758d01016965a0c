//! One benchmark a stage, at 10,000 particles of a tank at rest: once for each instruction set where the stage has lanes.
//! Criterion's `thrpt` is particles a second. (The air has a bench of its own.)

mod tank;

use criterion::{BatchSize, Bencher, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use powder_master::kernel::{
    air::Air,
    element::ElementParams,
    forces::{self, LaterDrag},
    params::{AIR_DENSITY, AirParams, OpenSides},
    predictor::{Predictor, PredictorParams},
    simd::InstructionSet,
    velocity,
};
use std::{hint::black_box, time::Duration};
use tank::{SIDE, SUBSTEP, Tank};

/// Times `stage` on a tank that stays the same but for what the stage itself does to it.
fn stage(bencher: &mut Bencher, mut tank: Tank, stage: impl Fn(&mut Tank)) {
    bencher.iter(|| stage(black_box(&mut tank)));
}

fn stages(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("stages");
    group.throughput(Throughput::Elements(u64::from(SIDE * SIDE)));
    let best = InstructionSet::detect();
    let liquid = ElementParams {
        drag: vec![0.001],
        viscosity: vec![0.02],
        vorticity: vec![0.0],
        mass: vec![1000.0],
        ..ElementParams::default()
    };
    group.bench_function("gravity", |b| {
        stage(b, Tank::new(best), |tank| {
            forces::begin_kick(Vec2::new(0.0, -1e-6), None, &mut tank.particles, 1, SUBSTEP);
        });
    });
    group.bench_function("drag", |b| {
        let tank = Tank::new(best);
        let params = AirParams { sound_speed: 1000.0, density: AIR_DENSITY, open: OpenSides::default() };
        let mut air = Air::new(tank.domain.size, 4.0, params);
        air.blow(Vec2::splat(50.0), 40.0, Vec2::new(30.0, 0.0));
        stage(b, tank, |tank| {
            forces::apply_drag(&air, &liquid, &mut tank.particles, &mut LaterDrag::default(), 1, SUBSTEP);
        });
    });
    for set in InstructionSet::available() {
        let name = set.name();
        group.bench_function(format!("predictor/{name}"), |b| predictor(b, &Tank::new(set)));
        group.bench_function(format!("predict/{name}"), |b| stage(b, Tank::new(set), Tank::predict));
        group.bench_function(format!("bin/{name}"), |b| bin(b, &Tank::new(set)));
        group.bench_function(format!("solve/{name}"), |b| stage(b, Tank::new(set), |tank| tank.solve(1)));
        group.bench_function(format!("velocity/{name}"), |b| stage(b, Tank::new(set), Tank::update_velocities));
        group.bench_function(format!("viscosity/{name}"), |b| {
            stage(b, Tank::new(set), |tank| {
                velocity::apply_viscosity(&mut tank.particles, &mut tank.solver, &tank.domain, &liquid, 1, SUBSTEP);
            });
        });
        group.bench_function(format!("vorticity/{name}"), |b| {
            stage(b, Tank::new(set), |tank| {
                velocity::apply_vorticity(&mut tank.particles, &mut tank.solver, &liquid, f64::MAX, 1, SUBSTEP);
            });
        });
    }
    group.finish();
}

/// Projects the same velocities each time.
fn predictor(bencher: &mut Bencher, tank: &Tank) {
    let (mut predictor, mut room) = (Predictor::default(), [(); 3].map(|()| Vec::new()));
    let params = PredictorParams {
        domain: &tank.domain,
        cell: tank.quality.kernel_radius,
        rest_density: 1.0,
        masses: None,
        grains: None,
        drawn: None,
        instructions: tank.solver.instructions,
        threads: 1,
        dt: SUBSTEP,
    };
    let project = |particles: &mut _| predictor.run(particles, &tank.solids, &params, room.each_mut());
    bencher.iter_batched_ref(|| tank.particles.clone(), project, BatchSize::SmallInput);
}

/// Sorting what is sorted is cheaper than what a tick does: the tank is mixed up as far as particles move in one.
fn bin(bencher: &mut Bencher, tank: &Tank) {
    let mixed = || {
        let mut mixed = tank.clone();
        mixed.predict();
        mixed
    };
    bencher.iter_batched_ref(mixed, Tank::bin, BatchSize::LargeInput);
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
