//! What recording costs: the mark of every tick, and the state that is taken every 1,800 ticks.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use powder_master::{
    scene::{self, effects::EffectModes},
    sim::{
        checkpoint::Checkpoint,
        mark::Marker,
        simulation::Simulation,
        state::{AirGrid, Clock, ParticleStore, Rock},
        workers::Workers,
    },
};
use std::{hint::black_box, sync::Arc, time::Duration};

fn recorder(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("recorder");
    for columns in [71_u32, 224, 707] {
        let settings = [("columns".to_owned(), columns.to_string())];
        let blueprint = scene::load("dam_break")
            .and_then(|file| file.build(&settings, None, &EffectModes::new()))
            .unwrap_or_else(|error| panic!("{error}"));
        let mut simulation = Simulation::new(Arc::new(blueprint), Workers::default());
        (0..5).for_each(|_| simulation.tick());
        let world = simulation.world();
        let particles = world.resource::<ParticleStore>();
        let (rock, air, clock) = (world.resource::<Rock>(), world.resource::<AirGrid>(), world.resource::<Clock>());
        group.throughput(Throughput::Elements(particles.len() as u64));
        let mut marker = Marker::default();
        group.bench_function(format!("mark/{}", particles.len()), |bencher| {
            bencher.iter(|| marker.mark(black_box(particles), rock, air, clock));
        });
        group.bench_function(format!("start/{}", particles.len()), |bencher| bencher.iter(|| Checkpoint::of(world)));
        let start = Checkpoint::of(world);
        group.bench_function(format!("file/{}", particles.len()), |bencher| bencher.iter(|| start.encode()));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .without_plots();
    targets = recorder
}
criterion_main!(benches);
